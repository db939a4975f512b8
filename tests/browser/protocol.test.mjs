// protocol.js against PROTOCOL.md: every table of one must be in the other, every example must pass.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
    CLIENT_MESSAGES, FLAGS, FORMATS, HEADER_FIELDS, PROTOCOL, ProtocolError, RECONNECT_AFTER, SERVER_MESSAGES,
    decodeFrame, decodeMessage, encodeMessage,
} from "../../client/web/protocol.js";
import { bytesOf, examples, messagesOf, tablesUnder } from "./protocol_page.mjs";

const exampleFrame = () => bytesOf(examples("hex frame")[0]);

/** The example with some bytes replaced: {offset: [bytes]}. */
function frameWith(changes) {
    const buffer = exampleFrame();
    for (const [offset, bytes] of Object.entries(changes))
        new Uint8Array(buffer).set(bytes, Number(offset));
    return buffer;
}

test("every client example is encoded to the same message", () => {
    const blocks = examples("json client");
    assert.ok(blocks.length >= Object.keys(CLIENT_MESSAGES).length, `only ${blocks.length} examples`);
    for (const block of blocks) {
        const { type, ...fields } = JSON.parse(block);
        assert.deepEqual(JSON.parse(encodeMessage(type, fields)), JSON.parse(block));
    }
});

test("every server example is decoded, every server message has one", () => {
    const seen = examples("json server").map((block) => {
        const message = decodeMessage(block);
        assert.deepEqual(message, JSON.parse(block));
        return message.type;
    });
    assert.deepEqual(new Set(seen), new Set(Object.keys(SERVER_MESSAGES)));
    assert.equal(decodeMessage(examples("json server").find((block) => block.includes("welcome"))).protocol, PROTOCOL);
});

test("the client's messages and their fields are those of section 3", () => {
    const documented = {};
    for (const type of messagesOf("## 3. Messages from the client")) {
        const rows = tablesUnder(`### ${type}\n`)[0] ?? [];
        documented[type] = Object.fromEntries(rows.map(({ field, required }) => [field, required === "yes"]));
    }
    assert.deepEqual(CLIENT_MESSAGES, { ...documented, bye: {} });
});

test("the fields required of the server are those of section 4", () => {
    for (const type of messagesOf("## 4. Messages from the server")) {
        const heading = type === "bye" ? null : `### ${type}\n`; // `bye` is also a message of the client
        const rows = heading ? tablesUnder(heading)[0] : tablesUnder("## 4. Messages from the server").at(-1);
        const required = rows.filter((row) => row.required === "yes").map((row) => row.field);
        assert.deepEqual(SERVER_MESSAGES[type], required, type);
    }
});

test("the header, its flags and formats are those of section 5", () => {
    const [header, flags] = tablesUnder("## 5. Frames");
    const documented = header.filter(({ field }) => field && field !== "magic").map((row) => [Number(row.offset), row.type, row.field]);
    assert.deepEqual(HEADER_FIELDS, documented);
    assert.deepEqual(FLAGS, Object.fromEntries(flags.map(({ flag, value }) => [flag, Number(value)])));
    const formats = header.find(({ field }) => field === "format").meaning;
    assert.equal(FORMATS.map((name, i) => `${i} ${name}`).join(", "), formats);
});

test("after which close codes to connect again is that of section 7", () => {
    const rows = tablesUnder("## 7. Closing, and connecting again")[0].filter((row) => /^\d+$/.test(row["close code"]));
    assert.deepEqual(RECONNECT_AFTER,
        Object.fromEntries(rows.map((row) => [row["close code"], row["connect again"].startsWith("yes")])));
});

test("the example frame reads as PROTOCOL.md says", () => {
    const { header, passes, payload } = decodeFrame(exampleFrame());
    assert.deepEqual(header, {
        version: 1, format: "raw", header_size: 136,
        flags: { still: false, lossless: true, history_reset: true, converged: false },
        pass_count: 2, passes_size: 32, frame_id: 7, camera_sequence: 41, session_epoch: 1, payload_size: 24,
        width: 2, height: 1, full_width: 2, full_height: 1, accumulated_samples: 1,
        wait_us: 850, trace_us: 13750, denoise_us: 9000, encode_us: 40, nonfinite_count: 0, scene_time: 0,
        framebuffer_hash: "5bcc63c641b2222d",
        predicted_error: 0.25, predicted_lower: 0.125, predicted_upper: 0.5, measured_error: NaN, measured_lower: NaN,
        measured_upper: NaN, reference_samples: 0, effective_samples: 2, raw_error: 0.5, frame_us: 23000,
        samples_per_pixel: 1, rung: 0, noise_error: 0.0625, negative_count: 0, clamped_count: 0, stage_count: 0,
    });
    assert.deepEqual(passes, [{ name: "gbuffer", ms: 1.5 }, { name: "path_trace", ms: 12.25 }]);
    const floats = new Float32Array(payload.slice().buffer);
    assert.deepEqual([...floats], [1, 0.5, 0.25, 0, 2, 4]);
});

test("a longer header, unknown flags and unknown fields are no fault", () => {
    const old = new Uint8Array(exampleFrame());
    const longer = new Uint8Array(old.length + 8);
    longer.set(old.subarray(0, 136));
    longer.set(old.subarray(136), 144);
    longer[6] = 144;
    longer[9] = 0x80;
    const { header, passes, payload } = decodeFrame(longer.buffer);
    assert.equal(header.flags.lossless, true);
    assert.equal(passes[1].name, "path_trace");
    assert.equal(payload.length, 24);
    assert.equal(decodeMessage('{"type":"pong","t":1,"more":2}').t, 1);
    assert.equal(decodeMessage('{"type":"teapot"}'), null);
});

test("of an older server's shorter header the missing fields are unknown", () => {
    const now = new Uint8Array(exampleFrame());
    const older = new Uint8Array(now.length - 56);
    older.set(now.subarray(0, 80));
    older.set(now.subarray(136), 80);
    older[6] = 80;
    const { header, passes } = decodeFrame(older.buffer);
    assert.equal(passes[1].name, "path_trace");
    assert.ok(Number.isNaN(header.measured_error));
    assert.equal(header.rung, 0);
});

test("stages that met bad values are told by kind", () => {
    const plain = new Uint8Array(exampleFrame());
    const stage = [3, ...new TextEncoder().encode("fog"), ...[1, 2, 3, 256].flatMap((count) => [count & 255, count >> 8, 0, 0])];
    const frame = new Uint8Array(plain.length + 24);
    frame.set(plain.subarray(0, 136));
    frame.set(stage, 136);
    frame.set(plain.subarray(136), 160);
    frame[6] = 160;
    frame[132] = 1;
    const { stages, passes } = decodeFrame(frame.buffer);
    assert.deepEqual(stages, [{ name: "fog", nan: 1, infinite: 2, negative: 3, clamped: 256 }]);
    assert.equal(passes[1].name, "path_trace");
    frame[132] = 2;
    assert.throws(() => decodeFrame(frame.buffer), /stage 1/);
});

for (const [fault, changes, expected] of [
    ["another magic", { 0: [0x47] }, /FARL/],
    ["another version", { 4: [2] }, /version 2, expected 1/],
    ["an unknown format", { 5: [9] }, /format 9/],
    ["a short header_size", { 6: [72, 0] }, /header_size/],
    ["a crooked passes_size", { 12: [31] }, /passes_size 31/],
    ["a payload_size beyond the message", { 28: [25] }, /has 192 bytes, its header says 193/],
    ["more passes than fit", { 10: [4, 0] }, /pass 3/],
    ["far too many passes", { 10: [0xff, 0xff] }, /65535 entries/],
    ["a pass name beyond the table", { 136: [200] }, /pass 0/],
])
    test(`a frame with ${fault} is refused`, () =>
        assert.throws(() => decodeFrame(frameWith(changes)), (error) => error instanceof ProtocolError && expected.test(error.message)));

test("a frame cut short anywhere is refused", () => {
    const whole = exampleFrame();
    for (let size = 0; size < whole.byteLength; ++size)
        assert.throws(() => decodeFrame(whole.slice(0, size)), ProtocolError, `${size} bytes`);
});

test("messages that cannot be sent or read are refused", () => {
    assert.throws(() => encodeMessage("ping", { t: NaN }), /finite/);
    assert.throws(() => encodeMessage("resize", { width: 1 }), /needs 'height'/);
    assert.throws(() => encodeMessage("ack", { frame_id: 1, mood: 2 }), /no field 'mood'/);
    assert.throws(() => encodeMessage("teapot"), /teapot/);
    assert.throws(() => decodeMessage("{"), ProtocolError);
    assert.throws(() => decodeMessage("[]"), ProtocolError);
    assert.throws(() => decodeMessage('{"type":"bye"}'), /lacks 'reason'/);
});
