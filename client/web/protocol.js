// farlight.v1 as a viewer speaks it: control messages out and in, frames in. No DOM, no socket.
//
// protocol/PROTOCOL.md is the truth; tests/browser/protocol.test.mjs holds every table of this file
// against the tables there and runs the examples there through it.

export const PROTOCOL = "farlight.v1";

/** The header's `format` is an index into this. */
export const FORMATS = ["jpeg420", "jpeg444", "png", "raw"];

export const FLAGS = { still: 1, lossless: 2, history_reset: 4, converged: 8 };

/** Kinds of bad values, in the order of the stage table's counts. */
export const KINDS = ["nan", "infinite", "negative", "clamped"];

/** Values of a frame that no healthy one has; those that are wrong, not only cut at a limit. */
export const badValues = ({ nonfinite_count, negative_count, clamped_count }) => nonfinite_count + negative_count + clamped_count;
export const wrongValues = ({ nonfinite_count, negative_count }) => nonfinite_count + negative_count;

/** Close codes after which a client may connect again. Codes not listed: it may. */
export const RECONNECT_AFTER = {
    1000: false, 1001: true, 1002: false, 1003: false, 1007: false, 1008: false, 1009: false,
    1011: true, 1013: true, 4008: true,
};

/** [offset in bytes, type, name], little-endian. */
export const HEADER_FIELDS = [
    [4, "u8", "version"], [5, "u8", "format"], [6, "u16", "header_size"], [8, "u16", "flags"],
    [10, "u16", "pass_count"], [12, "u32", "passes_size"], [16, "u32", "frame_id"],
    [20, "u32", "camera_sequence"], [24, "u32", "session_epoch"], [28, "u32", "payload_size"],
    [32, "u16", "width"], [34, "u16", "height"], [36, "u16", "full_width"],
    [38, "u16", "full_height"], [40, "u32", "accumulated_samples"], [44, "f32", "predicted_error"],
    [48, "u32", "wait_us"], [52, "u32", "trace_us"], [56, "u32", "denoise_us"],
    [60, "u32", "encode_us"], [64, "u32", "nonfinite_count"], [68, "f32", "scene_time"],
    [72, "u64", "framebuffer_hash"], [80, "f32", "predicted_lower"], [84, "f32", "predicted_upper"],
    [88, "f32", "measured_error"], [92, "f32", "measured_lower"], [96, "f32", "measured_upper"],
    [100, "u32", "reference_samples"], [104, "f32", "effective_samples"], [108, "f32", "raw_error"],
    [112, "u32", "frame_us"], [116, "u16", "samples_per_pixel"], [118, "u16", "rung"], [120, "f32", "noise_error"],
    [124, "u32", "negative_count"], [128, "u32", "clamped_count"], [132, "u16", "stage_count"],
];
const SMALLEST_HEADER = 80;
const STAGES_AT = 136;
const MOST_STAGES = 256;
const MOST_PASSES = 256;

/** Fields a client may send, by message type; `true` marks a required one. */
export const CLIENT_MESSAGES = {
    hello: { client: true, mode: false, format: false, size: false, max_in_flight: false, settings: false },
    camera: { sequence: true, position: true, target: true, up: true, vertical_fov_degrees: true, cut: false },
    set: { key: true, value: true },
    resize: { width: true, height: true },
    format: { format: true },
    ack: { frame_id: true, decode_us: false, shown_us: false },
    ping: { t: true },
    edit: { id: false, patch: true, reset: false },
    inspect: {},
    bye: {},
};

/** Fields without which a server's message cannot be used, by type. */
export const SERVER_MESSAGES = {
    welcome: ["protocol", "server", "session", "mode", "format", "size", "max_in_flight", "device",
        "gl_renderer", "scene", "camera", "camera_paths", "effects", "settings", "limits"],
    scene_changed: ["scene", "effects"],
    inspection: ["effects", "program", "constants", "passes", "scene_memory", "view_memory", "compile_ms"],
    frontier: ["source", "points"],
    state: ["settings", "size", "format"],
    error: ["code", "message", "fatal"],
    pong: ["t"],
    bye: ["reason", "reconnect_ms"],
};

/** The peer broke the protocol; the text says how. */
export class ProtocolError extends Error {}

function refuseNonFinite(key, value) {
    if (typeof value === "number" && !Number.isFinite(value))
        throw new RangeError(`${key || "a value"} is ${value}, expected a finite number`);
    return value;
}

/** The text of one message. Throws RangeError for a mistake of ours: JSON has no NaN, the server no such field. */
export function encodeMessage(type, fields = {}) {
    const known = CLIENT_MESSAGES[type];
    if (!known)
        throw new RangeError(`no message is called '${type}'`);
    for (const name of Object.keys(fields))
        if (!Object.hasOwn(known, name))
            throw new RangeError(`${type} has no field '${name}'`);
    for (const [name, required] of Object.entries(known))
        if (required && fields[name] === undefined)
            throw new RangeError(`${type} needs '${name}'`);
    return JSON.stringify({ type, ...fields }, refuseNonFinite);
}

/** A server's message as an object, or null for a type newer than this page. Throws ProtocolError. */
export function decodeMessage(text) {
    let message;
    try {
        message = JSON.parse(text);
    } catch {
        throw new ProtocolError(`a message is not JSON: ${text.slice(0, 60)}`);
    }
    if (typeof message?.type !== "string")
        throw new ProtocolError("a message has no type");
    const required = Object.hasOwn(SERVER_MESSAGES, message.type) ? SERVER_MESSAGES[message.type] : null;
    if (!required)
        return null;
    for (const name of required)
        if (message[name] === undefined)
            throw new ProtocolError(`${message.type} lacks '${name}'`);
    return message;
}

const READERS = {
    u8: (view, offset) => view.getUint8(offset),
    u16: (view, offset) => view.getUint16(offset, true),
    u32: (view, offset) => view.getUint32(offset, true),
    f32: (view, offset) => view.getFloat32(offset, true),
    u64: (view, offset) => view.getBigUint64(offset, true),
};

const BYTES = { u8: 1, u16: 2, u32: 4, f32: 4, u64: 8 };

/** What fields beyond the end of an older server's header read as. */
const ABSENT = { f32: NaN, u32: 0, u16: 0 };

function readHeader(view) {
    if (view.byteLength < SMALLEST_HEADER)
        throw new ProtocolError(`a frame has ${view.byteLength} bytes, expected at least ${SMALLEST_HEADER}`);
    if (view.getUint32(0) !== 0x4641524c)
        throw new ProtocolError("a frame does not begin with FARL");
    const end = Math.min(Math.max(view.getUint16(6, true), SMALLEST_HEADER), view.byteLength);
    const header = Object.fromEntries(HEADER_FIELDS.map(([offset, type, name]) =>
        [name, offset + BYTES[type] <= end ? READERS[type](view, offset) : ABSENT[type]]));
    if (header.version !== 1)
        throw new ProtocolError(`a frame has version ${header.version}, expected 1`);
    if (header.header_size < SMALLEST_HEADER || header.header_size % 8 || header.passes_size % 8)
        throw new ProtocolError(`a frame's header_size ${header.header_size} or passes_size ${header.passes_size} is wrong`);
    const size = header.header_size + header.passes_size + header.payload_size;
    if (size !== view.byteLength)
        throw new ProtocolError(`a frame has ${view.byteLength} bytes, its header says ${size}`);
    if (header.format >= FORMATS.length)
        throw new ProtocolError(`a frame has format ${header.format}, expected 0 to ${FORMATS.length - 1}`);
    return header;
}

/** `count` entries from `at` on: a name, and what `read(offset)` gives of the `size` bytes after it. */
function readTable(view, what, { count, most, at, end, size, read }) {
    if (count > most)
        throw new ProtocolError(`the ${what} table of a frame has ${count} entries, expected at most ${most}`);
    const entries = [];
    for (let i = 0; i < count; ++i) {
        const length = at < end ? view.getUint8(at) : 0;
        if (at + 1 + length + size > end)
            throw new ProtocolError(`${what} ${i} of a frame lies outside the ${what} table`);
        const name = new TextDecoder().decode(new Uint8Array(view.buffer, view.byteOffset + at + 1, length));
        entries.push({ name, ...read(at + 1 + length) });
        at += 1 + length + size;
    }
    return entries;
}

function readPasses(view, { pass_count, header_size, passes_size }) {
    return readTable(view, "pass", {
        count: pass_count, most: MOST_PASSES, at: header_size, end: header_size + passes_size, size: 4,
        read: (at) => ({ ms: view.getFloat32(at, true) }),
    });
}

function readStages(view, { stage_count, header_size }) {
    return readTable(view, "stage", {
        count: stage_count, most: MOST_STAGES, at: STAGES_AT, end: header_size, size: 16,
        read: (at) => Object.fromEntries(KINDS.map((kind, i) => [kind, view.getUint32(at + 4 * i, true)])),
    });
}

/**
 * One binary message, an ArrayBuffer, taken apart. Returns {header, stages, passes, payload}: `header` by the
 * names of PROTOCOL.md, with `format` as its word, `flags` as booleans by name and the hash as hex;
 * `payload` is a view into the message. Throws ProtocolError.
 */
export function decodeFrame(buffer) {
    const view = new DataView(buffer);
    const header = readHeader(view);
    const passes = readPasses(view, header);
    const stages = readStages(view, header);
    const payload = new Uint8Array(buffer, header.header_size + header.passes_size, header.payload_size);
    const bits = header.flags;
    header.format = FORMATS[header.format];
    header.flags = Object.fromEntries(Object.entries(FLAGS).map(([name, bit]) => [name, (bits & bit) !== 0]));
    header.framebuffer_hash = header.framebuffer_hash.toString(16).padStart(16, "0");
    return { header, stages, passes, payload };
}
