// The viewer page: builds its parts and passes between them what the server says and what people do.
import { Accuracy } from "./accuracy.js";
import { attachInput } from "./input.js";
import { Connection } from "./connection.js";
import { element } from "./dom.js";
import { Inspector } from "./inspector.js";
import { Curtain, notify } from "./notices.js";
import { FIGURES, Overlay, stateOf } from "./overlay.js";
import { Panel } from "./panel.js";
import { PathBar } from "./path_bar.js";
import { PictureOptions } from "./picture_options.js";
import { Presenter } from "./presenter.js";
import { SceneEditor } from "./scene_editor.js";
import { Statistics } from "./statistics.js";
import { Steering } from "./steering.js";
import { TimeBar } from "./time_bar.js";
import { Views } from "./views.js";
import { Wipe } from "./wipe.js";

const CLIENT = "farlight web viewer 1";
const MICROSECONDS = 1000; // in a millisecond

const at = (id) => document.getElementById(id);
const statistics = new Statistics();
const overlay = new Overlay(at("overlay"), statistics);
let welcomed = null;      // the newest welcome
let lastFrame = null;
let status = { phase: "connecting" };
let sequence = 0;
const errors = [];        // the server's, newest last

const steering = new Steering((pose, cut) => {
    if (connection.send("camera", { sequence: sequence + 1, ...wirePose(pose), cut }))
        statistics.cameraSent(++sequence, performance.now());
}, () => pathBar.show());

const pathBar = new PathBar({
    pick: at("path"), controls: at("path-controls"), play: at("path-play"), time: at("path-time"),
    loop: at("path-loop"), word: at("path-word"),
}, steering);

const timeBar = new TimeBar({ controls: at("time-controls"), play: at("time-play"), time: at("time"), word: at("time-word") },
    (key, value) => connection.send("set", { key, value }));

const inspector = new Inspector({ box: at("inspector"), word: at("inspector-word"), body: at("inspector-body") },
    () => connection.send("inspect"));

const editor = new SceneEditor({ patch: at("patch"), apply: at("patch-apply"), reset: at("patch-reset"), word: at("patch-word") },
    (fields) => connection.send("edit", fields));

const panel = new Panel({ top: at("settings-top"), rest: at("settings-rest"), count: at("settings-count"), resetAll: at("settings-reset") },
    (key, value) => connection.send("set", { key, value }));

const ask = (key, value) => panel.ask(key, value);

const accuracy = new Accuracy({
    box: at("accuracy"), word: at("accuracy-word"), absent: at("accuracy-absent"), figure: at("frontier"),
    plot: at("frontier-plot"), caption: at("frontier-word"), rows: at("accuracy-rows"), formula: at("accuracy-formula"),
    goal: {
        box: at("goal"), kinds: at("goal-kinds"), slider: at("goal-slider"), label: at("goal-label"), unit: at("goal-unit"),
        range: at("goal-range"), number: at("goal-number"), ticks: at("goal-ticks"), ends: at("goal-ends"), problem: at("goal-problem"), word: at("goal-word"),
    },
}, ask, () => statistics.roundTrip());

const views = new Views(at("views"), at("view-legend"), ask);

const wipe = new Wipe({ box: at("wipe"), line: at("wipe-line"), left: at("wipe-left"), right: at("wipe-right"), stage: at("stage"), picture: at("picture") },
    ask, (position) => connection.send("set", { key: "wipe_position", value: position }));

const options = new PictureOptions(at("size"), at("format"), at("stage"), (type, fields) => connection.send(type, fields));

const presenter = new Presenter(at("picture"), {
    shown: showFrame,
    overtaken: () => ++statistics.framesOvertaken,
    undecodable: (header, reason) => {
        notify(at("notices"), `Frame ${header.frame_id} cannot be shown: ${reason}`);
        connection.send("ack", { frame_id: header.frame_id });
    },
});

const curtain = new Curtain({
    box: at("curtain"), title: at("curtain-title"), detail: at("curtain-detail"), retry: at("curtain-retry"),
    light: at("light"), word: at("connection-word"),
}, { retry: () => connection.retryNow(), reload: () => location.reload() });

const connection = new Connection(socketUrl(), () => ({
    client: CLIENT, mode: "interactive", format: options.format, settings: { ...panel.changed(), ...timeBar.held },
}), {
    status: showStatus,
    welcome: enter,
    state: (message) => {
        panel.update(message.settings);
        timeBar.update(message.settings);
        inspector.update(message.settings);
        options.state(message);
        wipe.answered();
        updateAccuracy();
    },
    frontier: (message) => accuracy.learn(message),
    scene_changed: changeScene,
    inspection: (message) => inspector.show(message),
    error: (message) => {
        errors.push(message);
        wipe.answered();
        if (!panel.complain(message.field, message.message) && editor.complain(message))
            return;
        notify(at("notices"), message.field ? `${message.field}: ${message.message}` : message.message);
        updateAccuracy();
    },
    frame: (buffer, arrivedAt) => presenter.accept(buffer, arrivedAt),
    pong: (milliseconds) => statistics.pong(milliseconds),
});

/** What holds on the server, once it has answered all that was asked of it. */
function updateAccuracy() {
    const values = panel.values();
    wipe.update(values);
    if (!panel.settled)
        return;
    accuracy.update(values);
    views.update(values);
}

function socketUrl() {
    const url = new URL("ws", location.href);
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    url.search = url.hash = "";
    return url.href;
}

/** A camera path's keyframe has more fields than a camera. */
function wirePose({ position, target, up, vertical_fov_degrees }) {
    return { position, target, up, vertical_fov_degrees };
}

function showStatus(next) {
    status = next;
    if (status.phase !== "open") {
        presenter.restart();
        statistics.restart();
    }
    at("app").dataset.phase = status.phase;
    curtain.show(status);
}

/** A session begins. In the scene of before, the camera stays where people had steered it. */
function enter(welcome) {
    const same = welcomed?.scene.file === welcome.scene.file && welcomed.scene.name === welcome.scene.name;
    welcomed = welcome;
    const software = welcome.device === "software";
    nameScene(welcome.scene);
    at("device").textContent = `${welcome.gl_renderer} (${software ? "software" : welcome.device})`;
    at("device").title = software ? "Drawn by the processor: no graphics card takes part" : welcome.device;
    panel.describe(welcome.settings);
    timeBar.describe(welcome.scene);
    timeBar.update(panel.values());
    inspector.update(panel.values());
    editor.welcome(welcome);
    options.state(welcome);
    options.welcome(welcome);
    accuracy.welcome(welcome);
    views.describe(welcome.settings);
    wipe.describe(welcome.settings);
    updateAccuracy();
    pathBar.describe(welcome.camera_paths);
    describeScene(welcome);
    steering.enter(welcome.scene, welcome.camera, same && steering.moved);
}

/** Somebody has edited the scene; the camera stays where it is. */
function changeScene({ edit, scene }) {
    welcomed = { ...welcomed, scene };
    nameScene(scene);
    timeBar.describe(scene);
    describeScene(welcomed);
    steering.changeScene(scene);
    inspector.changed();
    if (!editor.changed(edit))
        notify(at("notices"), "Somebody else has edited the scene.", "note");
}

function nameScene({ name }) {
    document.title = `${name} – Farlight`;
    at("scene").textContent = name;
    at("stage").setAttribute("aria-label", `Picture of ${name}. Arrow keys turn the camera, H lists all keys.`);
}

function describeScene({ scene, server, session, device }) {
    const rows = [["Scene file", scene.file], ["Triangles", scene.triangles.toLocaleString("en")], ["Lights", scene.lights],
        ["Device", device], ["Server", server], ["Session", session]];
    at("about").replaceChildren(
        element("dl", {}, ...rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, String(value))])),
        ...(scene.notes.length ? [element("h3", {}, "What the loader noted"), element("ul", {}, ...scene.notes.map((note) => element("li", {}, note)))] : []));
}

function showFrame(frame) {
    lastFrame = frame;
    const { header, decodeMs, shownMs, bytes } = frame;
    connection.send("ack", {
        frame_id: header.frame_id,
        decode_us: Math.round(decodeMs * MICROSECONDS), shown_us: Math.round(shownMs * MICROSECONDS),
    });
    statistics.frameShown(header, bytes, performance.now());
    overlay.show(frame);
    timeBar.frame(header);
    accuracy.frame(header, frame.passes);
    wipe.place();
    at("app").dataset.state = stateOf(header);
}

function toggleFullscreen() {
    if (document.fullscreenElement)
        document.exitFullscreen();
    else
        at("view").requestFullscreen().catch(() => notify(at("notices"), "The browser does not allow full screen here.", "note"));
}

function togglePanel() {
    const closed = at("app").classList.toggle("panel-closed");
    at("tool-panel").setAttribute("aria-expanded", String(!closed));
}

function toggleHelp() {
    if (at("help").open)
        at("help").close();
    else
        at("help").showModal();
}

/** The picture as it stands, as a PNG file. */
function savePicture() {
    at("picture").toBlob((blob) => {
        const link = element("a", { href: URL.createObjectURL(blob), download: `${welcomed?.scene.name ?? "farlight"}.png` });
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
}

const commands = {
    R: () => steering.pose && steering.reset(),
    O: () => overlay.cycle(),
    F: toggleFullscreen,
    P: savePicture,
    H: toggleHelp,
    "?": toggleHelp,
    X: togglePanel,
};
attachInput(at("stage"), steering, commands);
for (const [id, key] of Object.entries({ "tool-reset": "R", "tool-overlay": "O", "tool-fullscreen": "F", "tool-save": "P", "tool-help": "H", "tool-panel": "X" }))
    at(id).addEventListener("click", commands[key]);
at("help").addEventListener("keydown", (event) => event.key.toUpperCase() === "H" && at("help").close());

at("help-figures").append(...FIGURES.flatMap(([, name, meaning]) => [element("dt", {}, name), element("dd", {}, meaning)]));
if (matchMedia("(max-width: 700px), (max-height: 500px)").matches) {
    overlay.level = "brief";
    at("accuracy").open = false;
}
addEventListener("pagehide", () => connection.stop());
addEventListener("pageshow", (event) => event.persisted && connection.start());

/** What tests may see. */
Object.defineProperty(window, "farlight", {
    value: Object.freeze({
        get connected() { return connection.open; },
        get status() { return { ...status }; },
        get framesShown() { return statistics.framesShown; },
        get framesOvertaken() { return statistics.framesOvertaken; },
        get lastHeader() { return lastFrame && structuredClone(lastFrame.header); },
        get passes() { return lastFrame && structuredClone(lastFrame.passes); },
        get latency() { return statistics.latency(); },
        get settings() { return panel.values(); },
        get frontier() { return structuredClone(accuracy.frontier); },
        get inspection() { return structuredClone(inspector.last); },
        get camera() { return steering.pose && structuredClone(wirePose(steering.pose)); },
        get cameraSequence() { return sequence; },
        get errors() { return structuredClone(errors); },
    }),
});

connection.start();
