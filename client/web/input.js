// Mouse, touch and keys, turned into moves of the camera and commands.
import { dolly, orbit, pan } from "./camera.js";

const WHEEL_NOTCH = 100;       // [px] of deltaY
const WHEEL_FACTOR = 0.88;     // on the distance, per notch towards the picture
const LINE_PX = 33;            // browsers that count wheel turns in lines: about three to a notch
const TURN_PER_HEIGHT = Math.PI;  // [rad] for a drag over the picture's height

const MOTIONS = {
    ArrowLeft: ["yaw", -1], ArrowRight: ["yaw", 1], ArrowUp: ["pitch", 1], ArrowDown: ["pitch", -1],
    KeyW: ["forward", 1], KeyS: ["forward", -1], KeyA: ["right", -1], KeyD: ["right", 1],
    KeyQ: ["up", -1], KeyE: ["up", 1],
    "+": ["zoom", -1], "=": ["zoom", -1], "-": ["zoom", 1], _: ["zoom", 1],
};

/** Where fingers or a pressed mouse are: their middle and how far apart, in picture heights. */
function gripOf(points, height) {
    const middle = (name) => points.reduce((sum, point) => sum + point[name], 0) / points.length;
    const [x, y] = [middle("x"), middle("y")];
    const spread = points.reduce((sum, point) => sum + Math.hypot(point.x - x, point.y - y), 0) / points.length;
    return { x: x / height, y: y / height, spread: spread / height };
}

function attachPointers(stage, steering) {
    const pointers = new Map(); // id -> {x, y}
    let grip = null;
    let panning = false;
    const regrip = () => {
        grip = pointers.size ? gripOf([...pointers.values()], stage.clientHeight) : null;
        stage.classList.toggle("grabbed", pointers.size > 0);
    };
    stage.addEventListener("pointerdown", (event) => {
        stage.setPointerCapture(event.pointerId);
        panning = event.button === 1 || event.button === 2 || event.shiftKey;
        pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        regrip();
    });
    stage.addEventListener("pointermove", (event) => {
        if (!pointers.has(event.pointerId))
            return;
        pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        const before = grip;
        regrip();
        const [x, y] = [grip.x - before.x, grip.y - before.y];
        const pinch = pointers.size > 1 && grip.spread > 0 ? before.spread / grip.spread : 1;
        steering.apply((pose, reach) => {
            if (pointers.size === 1 && !panning)
                return orbit(pose, -x * TURN_PER_HEIGHT, y * TURN_PER_HEIGHT);
            return dolly(pan(pose, x, y), pinch, reach);
        });
    });
    const lift = (event) => {
        pointers.delete(event.pointerId);
        regrip();
    };
    stage.addEventListener("pointerup", lift);
    stage.addEventListener("pointercancel", lift);
    stage.addEventListener("mousedown", (event) => event.button === 1 && event.preventDefault()); // no autoscroll
    stage.addEventListener("contextmenu", (event) => event.preventDefault());
    stage.addEventListener("wheel", (event) => {
        event.preventDefault();
        const pixels = event.deltaY * [1, LINE_PX, stage.clientHeight][event.deltaMode];
        const notches = Math.max(-5, Math.min(5, pixels / WHEEL_NOTCH));
        steering.apply((pose, reach) => dolly(pose, WHEEL_FACTOR ** -notches, reach));
    }, { passive: false });
}

/** True where a key belongs to the control that has the focus: all keys while typing, the steering ones on a slider. */
function taken(event, motion) {
    const control = event.target.closest?.("input, select, textarea, dialog");
    const moves = control?.matches("[type=range], [type=radio], [type=checkbox]");
    return Boolean(control) && (!moves || (motion && !event.code.startsWith("Key")));
}

function attachKeys(steering, commands) {
    addEventListener("keydown", (event) => {
        const motion = MOTIONS[event.code] ?? MOTIONS[event.key];
        const command = commands[event.key.toUpperCase()];
        if (event.ctrlKey || event.metaKey || event.altKey || !(motion || command) || taken(event, motion))
            return;
        event.preventDefault();
        steering.hasty = event.shiftKey;
        if (motion)
            steering.hold(event.code, motion);
        else if (!event.repeat)
            command();
    });
    addEventListener("keyup", (event) => {
        steering.hasty = event.shiftKey;
        steering.release(event.code);
        if (event.key === "Meta") // a Mac swallows the keyup of what was held under it
            steering.releaseAll();
    });
    addEventListener("blur", () => steering.releaseAll());
}

/** `commands` maps an upper-case key to a function. */
export function attachInput(stage, steering, commands) {
    attachPointers(stage, steering);
    attachKeys(steering, commands);
}
