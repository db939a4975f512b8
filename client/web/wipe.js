// The divider between two states of the picture (view `wipe`): drawn by the server, moved here.
import { element } from "./dom.js";

const STEP = 0.02;      // of the width, arrow keys
const LEAP = 0.1;       // page keys, or with shift
const SIDES = ["left", "right"];

/** Where `content` (width, height) lies when it is fitted into `box`: {left, top, width, height}. */
export function fitted(content, box) {
    const scale = Math.min(box.width / content.width, box.height / content.height);
    const [width, height] = [content.width * scale, content.height * scale];
    return { left: (box.width - width) / 2, top: (box.height - height) / 2, width, height };
}

export class Wipe {
    #nodes; #ask; #send;
    #rect = { left: 0, top: 0, width: 1, height: 1 };
    #position = 0.5;
    #waiting = false; #next = null;  // one position on its way to the server at a time; the newest goes next
    #held = false;

    /** `nodes` are {box, line, left, right (selects), stage, picture}; `ask` as elsewhere; `send(position)` at once, false where it could not. */
    constructor(nodes, ask, send) {
        this.#nodes = nodes;
        this.#ask = ask;
        this.#send = send;
        for (const side of SIDES)
            nodes[side].addEventListener("change", () => ask(`wipe_${side}`, nodes[side].value));
        this.#listen(nodes.line);
        new ResizeObserver(() => this.place()).observe(nodes.stage);
    }

    describe(settings) {
        this.#waiting = false;
        this.#next = null;
        for (const side of SIDES) {
            const choices = settings.find(({ key }) => key === `wipe_${side}`)?.choices ?? [];
            this.#nodes[side].hidden = choices.length === 0;
            this.#nodes[side].replaceChildren(...choices.map((value) => element("option", { value }, value)));
        }
    }

    /** What holds on the server. */
    update(values) {
        this.#nodes.box.hidden = values.view !== "wipe" || values.wipe_position === undefined;
        for (const side of SIDES)
            this.#nodes[side].value = values[`wipe_${side}`];
        if (!this.#held && !this.#waiting && values.wipe_position !== undefined)
            this.#position = values.wipe_position;
        this.place();
    }

    /** The server has answered: the next position may go. */
    answered() {
        this.#waiting = false;
        if (this.#next !== null)
            this.#pass(this.#next);
    }

    /** Follows the picture, which is fitted into the stage. */
    place() {
        const { stage, picture, box, left, right } = this.#nodes;
        if (box.hidden)
            return;
        this.#rect = fitted(picture, { width: stage.clientWidth, height: stage.clientHeight });
        for (const [name, value] of Object.entries(this.#rect))
            box.style[name] = `${value}px`;
        this.#show(this.#position);
        left.style.maxWidth = right.style.maxWidth = `${this.#rect.width / 2 - 16}px`;
    }

    #listen(line) {
        line.addEventListener("pointerdown", (event) => {
            line.setPointerCapture(event.pointerId);
            this.#held = true;
        });
        line.addEventListener("pointermove", ({ clientX }) => {
            if (this.#held)
                this.#go((clientX - this.#nodes.stage.getBoundingClientRect().left - this.#rect.left) / this.#rect.width);
        });
        for (const type of ["pointerup", "pointercancel", "lostpointercapture"])
            line.addEventListener(type, () => { this.#held = false; });
        line.addEventListener("keydown", (event) => {
            const step = event.shiftKey ? LEAP : STEP;
            const to = {
                ArrowLeft: this.#position - step, ArrowRight: this.#position + step, ArrowDown: this.#position - step, ArrowUp: this.#position + step,
                PageDown: this.#position - LEAP, PageUp: this.#position + LEAP, Home: 0, End: 1,
            }[event.key];
            if (to === undefined)
                return;
            event.preventDefault();
            event.stopPropagation(); // the camera stays
            this.#go(to);
        });
    }

    #go(position) {
        const within = Math.round(1000 * Math.min(Math.max(position, 0), 1)) / 1000;
        this.#show(within);
        this.#pass(within);
    }

    #pass(position) {
        this.#next = this.#waiting ? position : null;
        if (!this.#waiting)
            this.#waiting = this.#send(position);
    }

    #show(position) {
        this.#position = position;
        const { line, left, right } = this.#nodes;
        const percent = Math.round(100 * position);
        line.style.left = `${100 * position}%`;
        line.setAttribute("aria-valuenow", percent);
        line.setAttribute("aria-valuetext", `${percent} % ${left.value}, ${100 - percent} % ${right.value}`);
    }
}
