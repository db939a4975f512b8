// A server of a few dozen lines that speaks farlight.v1 with made-up pictures: for what a real one does only by
// accident (another version, odd errors, a slow or silent stream), and to see the page without one.
//
// The picture is a gradient whose hue follows the camera; `view` sheet shows four quarters, `wipe` two halves. The test
// reads `received` and steers through `behaviour` and the methods. `behaviour.accuracy` is the source of the frontier it
// sends; without it this is a server that knows nothing of accuracy.
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname } from "node:path";
import { pathToFileURL } from "node:url";
import { WebSocketServer } from "ws";
import { FLAGS, FORMATS, HEADER_FIELDS, KINDS } from "../../client/web/protocol.js";
import { ACCURACY_SETTINGS, ACCURACY_VIEWS, accuracyFields, fakeFrontier } from "./fake_accuracy.mjs";
import { png } from "./png.mjs";

const WEB = new URL("../../client/web/", import.meta.url);
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };
const POLICY = "default-src 'self'; img-src 'self' blob: data:";
const SIZES = { u8: 1, u16: 2, u32: 4, f32: 4, u64: 8 };

const choice = (key, value, choices, help) => ({ key, type: "choice", value, default: value, choices, help });
const integer = (key, value, lower, upper, help) => ({ key, type: "integer", value, default: value, lower, upper, help });
const real = (key, value, lower, upper, help) => ({ ...integer(key, value, lower, upper, help), type: "real" });

const SETTINGS = () => [
    choice("denoiser", "svgf", ["none", "accumulate", "svgf"], "how samples become a picture"),
    integer("samples_per_pixel", 1, 1, 1024, "paths traced a pixel and frame"),
    integer("max_depth", 4, 1, 64, "[segments] longest path from the camera"),
    { key: "light_sampling", type: "boolean", value: true, default: true, help: "sample the lights at every hit" },
    integer("seed", 0, 0, 4294967295, "same seed, same picture"),
    real("sigma_luminance", 4, 0.01, 100, "luminance edge stop, in standard deviations"),
    real("exposure", 1, 0, 1e6, "linear scale before tone mapping"),
    choice("tonemap", "aces", ["aces", "linear"], "curve from scene-linear to display"),
    choice("view", "final", ["final", "sheet", "raw_radiance", "albedo", "depth", "shading_normal", "variance", "history_length"],
        "the finished picture or a buffer behind it"),
    { key: "play", type: "boolean", value: true, default: true, help: "time passes in a scene that moves" },
    real("time", 0, 0, 3600, "[s] of a scene that moves: setting it goes there"),
    { key: "effects", type: "text", value: "auto", default: "auto", help: "effects compiled in" },
    integer("still_samples", 24, 1, 65536, "samples after which a resting picture is final"),
];
const CAMERA = { position: [0, 1, 4], target: [0, 1, 0], up: [0, 1, 0], vertical_fov_degrees: 45 };

const EFFECTS = [{ name: "triangles", reason: "36 triangles, first 'floor'" }, { name: "lights", reason: "1 light, first 'lamp'" }];
const EVERY_EFFECT = ["triangles", "spheres", "lights", "fog", "lens", "alpha"];

function hueColour(hue, light) {
    return [0, 1 / 3, 2 / 3].map((shift) => Math.round(255 * light * (0.5 + 0.45 * Math.cos(2 * Math.PI * (hue + shift)))));
}

const NEWEST_HEADER = 136;  // bytes
const OLDER_HEADER = 80;    // of a server that knows nothing of accuracy

/** Names, each with what `write(entry, at, row)` writes into the `size` bytes after it; padded to 8. */
function tableOf(rows, size, write) {
    const table = Buffer.concat(rows.map((row) => {
        const length = Buffer.byteLength(row.name);
        const entry = Buffer.alloc(1 + length + size);
        entry.writeUInt8(length, 0);
        entry.write(row.name, 1);
        write(entry, 1 + length, row);
        return entry;
    }));
    return Buffer.concat([table, Buffer.alloc(-table.length & 7)]);
}

function binaryFrame(fixed, fields, { stages = [], passes }, payload) {
    const counts = tableOf(stages, 16, (entry, at, stage) => KINDS.forEach((kind, i) => entry.writeUInt32LE(stage[kind] ?? 0, at + 4 * i)));
    const table = tableOf(passes, 4, (entry, at, { ms }) => entry.writeFloatLE(ms, at));
    const size = fixed + counts.length;
    const padded = table.length;
    const frame = Buffer.alloc(size + padded + payload.length);
    frame.write("FARL", 0, "latin1");
    const all = { version: 1, header_size: size, pass_count: passes.length, passes_size: padded, payload_size: payload.length, stage_count: stages.length, ...fields };
    for (const [offset, type, name] of HEADER_FIELDS.filter(([at]) => at < fixed)) {
        if (type === "f32")
            frame.writeFloatLE(all[name] ?? NaN, offset);
        else if (type !== "u64")
            frame.writeUIntLE(all[name] ?? 0, offset, SIZES[type]);
    }
    counts.copy(frame, fixed);
    table.copy(frame, size);
    payload.copy(frame, size + padded);
    return frame;
}

class Session {
    settings = SETTINGS();
    camera = CAMERA;
    sequence = 0; frame = 0; acked = 0; samples = 0; epoch = 1;
    size = [320, 180];
    time = 0;  // [s] of the scene, 20 ms a frame while it plays
    name = "Gradient";
    format = "jpeg420";

    constructor(socket, server) {
        Object.assign(this, { socket, server });
        if (server.behaviour.accuracy) {
            this.settings.find(({ key }) => key === "view").choices.push(...ACCURACY_VIEWS);
            this.settings.push(...ACCURACY_SETTINGS());
        }
        socket.on("message", (text) => this.receive(JSON.parse(text)));
        this.timer = setInterval(() => this.draw(), server.behaviour.frameMs);
        socket.on("close", () => clearInterval(this.timer));
    }

    say(message) { this.socket.send(JSON.stringify(message)); }

    value(key) { return this.settings.find((setting) => setting.key === key).value; }

    receive(message) {
        this.server.received.push(message);
        if (message.type === "inspect")
            return this.inspect();
        if (message.type === "edit")
            return this.edit(message);
        const change = { camera: this.move, set: this.set, resize: this.resize, format: this.reformat }[message.type];
        if (message.type === "hello")
            this.welcome(message);
        else if (message.type === "ack")
            this.acked = Math.max(this.acked, message.frame_id);
        else if (message.type === "ping" && !this.server.behaviour.silent)
            this.say({ type: "pong", t: message.t });
        else if (change && change.call(this, message) !== false) {
            this.samples = 0;
            if (message.type !== "camera" && !this.server.behaviour.mute)
                this.say({ type: "state", settings: this.values(), size: this.size, format: this.format });
        }
    }

    welcome({ settings = {}, format }) {
        this.format = format;
        for (const [key, value] of Object.entries(settings))
            this.set({ key, value });
        this.say({
            type: "welcome", protocol: this.server.behaviour.protocol, server: "fake 1", session: "s1", mode: "interactive",
            format: this.format, size: this.size, max_in_flight: 2, device: "software", gl_renderer: "made-up pictures",
            scene: this.scene(), edits: this.server.behaviour.edits,
            camera: CAMERA,
            camera_paths: { "fly by": [{ frame: 0, ...CAMERA }, { frame: 30, ...CAMERA, position: [4, 1, 0] }] },
            effects: ["quads: 17 objects, first 'floor'"], settings: this.settings,
            limits: { max_dimension: 4096, max_in_flight: 8, max_message_bytes: 16384 },
        });
        if (this.server.behaviour.accuracy)
            this.say(fakeFrontier(this.server.behaviour.accuracy));
        this.ready = true;
    }

    values() { return Object.fromEntries(this.settings.map(({ key, value }) => [key, value])); }

    scene() {
        const { moves } = this.server.behaviour;
        return {
            name: this.name, file: "gradient.json", notes: ["made up for tests"], triangles: 1234567, lights: 1,
            bounds: { lower: [-1, 0, -1], upper: [1, 2, 1] }, ...moves,
        };
    }

    inspect() {
        const general = this.server.behaviour.general || this.value("effects") === "general";
        this.say({
            type: "inspection", effects: EFFECTS, general, program: general ? EVERY_EFFECT : EFFECTS.map(({ name }) => name),
            constants: [{ name: "BVH_STACK_SIZE", value: general ? 64 : 5 }], passes: ["gbuffer", "path_trace"], scene_memory: [{ name: "bvh_nodes", bytes: 1344 }, { name: "vertices", bytes: 5_000_000 }],
            view_memory: Array.from({ length: 13 }, (_, i) => ({ name: `svgf.texture_${Math.max(1, i)}`, bytes: 1e6 * Math.max(1, i) })), compile_ms: 812.5,
        });
    }

    /** Knows one key of a scene's document: its name. */
    edit({ id, patch, reset }) {
        const other = Object.keys(patch).find((key) => key !== "name");
        if (other)
            return this.say({ type: "error", code: "edit_refused", message: `gradient.json: /${other}: found an unknown key`, field: `/${other}`, fatal: false });
        this.name = patch.name ?? (reset ? "Gradient" : this.name);
        return this.say({ type: "scene_changed", edit: id, scene: this.scene(), effects: [] });
    }

    move(message) {
        this.camera = message;
        this.sequence = message.sequence;
    }

    resize({ width, height }) {
        this.size = [width, height];
        ++this.epoch;
    }

    reformat({ format }) {
        this.format = format;
    }

    set({ key, value }) {
        const setting = this.settings.find((each) => each.key === key);
        const fits = setting && (setting.choices?.includes(value) ?? (setting.lower === undefined || (value >= setting.lower && value <= setting.upper)));
        if (!fits) {
            this.say({ type: "error", code: "bad_setting", message: `found ${JSON.stringify(value)}, expected another`, field: key, fatal: false });
            return false;
        }
        setting.value = value;
        if (key === "time")
            this.time = value;
        return true;
    }

    colour([width, height] = this.size) {
        const [x0, y0, z0] = this.camera.position;
        const hue = Math.atan2(x0, z0) / Math.PI + Math.hypot(x0, y0, z0) / 20;
        const sheet = this.value("view") === "sheet";
        const light = Math.min(1, 0.8 * this.value("exposure"));
        const wipe = this.value("view") === "wipe" ? this.value("wipe_position") : 0;
        return (x, y) => hueColour(x < wipe * width ? 0.5 + y / height / 3 : sheet ? (x * 2 >= width) / 4 + (y * 2 >= height) / 2 : hue + x / width / 3, light * (0.4 + 0.6 * y / height));
    }

    draw() {
        const { behaviour } = this.server;
        const final = this.samples > 0 && this.samples >= this.value("still_samples");
        if (!this.ready || behaviour.silent || this.frame - this.acked >= 2 || this.finished === this.sequence && final)
            return;
        this.samples += this.value("samples_per_pixel");
        const plays = behaviour.moves && this.value("play");
        this.time += plays ? 0.02 : 0;
        const last = !plays && this.samples >= this.value("still_samples");
        const still = this.samples > 4;
        const jpeg = behaviour.jpeg && this.format.startsWith("jpeg") && !last;
        const [width, height] = this.size;
        const fields = {
            width, height, trace_us: 36000, denoise_us: 14200,
            ...(behaviour.accuracy && accuracyFields(this.values(), this.size, { still, accumulated: this.samples, frame: this.frame })),
        };
        const inside = [fields.width, fields.height];
        const payload = behaviour.garbage ? Buffer.from("no picture") : jpeg ? behaviour.jpeg : png(...inside, this.colour(inside));
        const flags = (still ? FLAGS.still : 0) | (last ? FLAGS.lossless | FLAGS.converged : 0);
        this.finished = last ? this.sequence : -1;
        const ms = [["gbuffer", 4.2], ["path_trace", 31.75], ["svgf reproject", 3.1], ["svgf a-trous 0", 5.5], ["svgf a-trous 1", 5.6], ["tonemap", 0.9]];
        this.socket.send(binaryFrame(behaviour.accuracy ? NEWEST_HEADER : OLDER_HEADER, {
            format: FORMATS.indexOf(jpeg ? this.format : "png"), flags, frame_id: ++this.frame, camera_sequence: this.sequence,
            session_epoch: this.epoch, full_width: width, full_height: height, accumulated_samples: this.samples,
            wait_us: 900, encode_us: 2100, nonfinite_count: behaviour.nonfinite, clamped_count: behaviour.clamped,
            scene_time: this.time, ...fields,
        }, { stages: behaviour.stages, passes: ms.map(([name, time]) => ({ name, ms: time })) }, payload));
    }
}

export class FakeServer {
    received = [];
    sessions = new Set();
    behaviour = { protocol: "farlight.v1", subprotocols: ["farlight.v1"], frameMs: 20, jpeg: null, nonfinite: 0, clamped: 0, stages: [], silent: false, garbage: false, moves: null, general: false, edits: true, accuracy: null, mute: false };

    constructor(behaviour = {}) {
        Object.assign(this.behaviour, behaviour);
    }

    async start(port = 0) {
        this.http = createServer((request, response) => this.answer(request, response));
        const sockets = new WebSocketServer({ noServer: true, handleProtocols: (offered) => [...offered].find((name) => this.behaviour.subprotocols.includes(name)) ?? false });
        this.http.on("upgrade", (request, socket, head) => {
            const offered = request.headers["sec-websocket-protocol"] ?? "";
            if (!this.behaviour.subprotocols.some((name) => offered.includes(name)))
                return socket.end(`HTTP/1.1 426 Upgrade Required\r\nConnection: close\r\n\r\n${this.behaviour.subprotocols}\n`);
            return sockets.handleUpgrade(request, socket, head, (open) => {
                const session = new Session(open, this);
                this.sessions.add(session);
                open.on("close", () => this.sessions.delete(session));
            });
        });
        await new Promise((resolve) => this.http.listen(port, "127.0.0.1", resolve));
        this.port = this.http.address().port;
        this.url = `http://127.0.0.1:${this.port}/`;
        return this;
    }

    async answer(request, response) {
        const path = new URL(request.url, "http://host").pathname;
        if (path === "/readyz")
            return response.end("ready\n");
        if (path === "/ws")
            return response.writeHead(426).end(`${this.behaviour.subprotocols}\n`);
        const name = path === "/" ? "index.html" : path.slice(1);
        try {
            const body = await readFile(new URL(name, WEB));
            return response.writeHead(200, { "content-type": TYPES[extname(name)] ?? "text/plain", "content-security-policy": POLICY }).end(body);
        } catch {
            return response.writeHead(404).end();
        }
    }

    /** Everybody is told the same. */
    say(message) {
        this.sessions.forEach((session) => session.say(message));
    }

    close(code, reason = "") {
        this.sessions.forEach(({ socket }) => socket.close(code, reason));
    }

    /** As when the process is killed: no goodbye. */
    async kill() {
        this.sessions.forEach(({ socket }) => socket.terminate());
        this.http.closeAllConnections();
        await new Promise((resolve) => this.http.close(resolve));
    }
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
    const server = await new FakeServer({ accuracy: process.argv[3] ?? "report" }).start(Number(process.argv[2] ?? 8081));
    console.log(`fake server: listening on ${server.url}`);
}
