// When the page connects again, and when never: connection.js with a socket and timers that the test drives.
import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";
import { Connection, describeClose, retryDelay } from "../../client/web/connection.js";
import { PROTOCOL, RECONNECT_AFTER } from "../../client/web/protocol.js";
import { examples } from "./protocol_page.mjs";

const WELCOME = examples("json server").find((block) => block.includes('"welcome"'));

class Socket {
    static made = [];
    sent = [];
    protocol = PROTOCOL;
    constructor(url, protocols) {
        Object.assign(this, { url, protocols });
        Socket.made.push(this);
    }
    send(text) { this.sent.push(JSON.parse(text)); }
    close() { this.closed = true; }
    welcome() {
        this.onopen();
        this.onmessage({ data: WELCOME });
    }
}

/** Timers on a clock that the test turns; node 18 and 20 disagree about how to ask node:test for that. */
const clock = {
    now: 0, timers: new Map(), next: 1,
    install() {
        Object.assign(this, { now: 0, timers: new Map() });
        const add = (every) => (run, ms) => {
            this.timers.set(this.next, { run, at: this.now + ms, every: every ? ms : 0 });
            return this.next++;
        };
        mock.method(globalThis, "setTimeout", add(false));
        mock.method(globalThis, "setInterval", add(true));
        for (const name of ["clearTimeout", "clearInterval"])
            mock.method(globalThis, name, (id) => this.timers.delete(id));
    },
    tick(ms) {
        const end = this.now + ms;
        for (;;) {
            const due = [...this.timers].filter(([, timer]) => timer.at <= end).sort(([, a], [, b]) => a.at - b.at)[0];
            if (!due)
                break;
            const [id, timer] = due;
            this.now = timer.at;
            if (timer.every)
                timer.at += timer.every;
            else
                this.timers.delete(id);
            timer.run();
        }
        this.now = end;
    },
};

let connection, statuses, errors;
const visible = { hidden: false, listeners: [], addEventListener(_, listener) { this.listeners.push(listener); } };
const settle = () => new Promise((resolve) => setImmediate(resolve));
const last = () => statuses.at(-1);

beforeEach(() => {
    Object.assign(globalThis, { WebSocket: Socket, document: Object.assign(visible, { hidden: false, listeners: [] }) });
    clock.install();
    mock.method(globalThis, "fetch", () => Promise.reject(new TypeError("refused")));
    Socket.made = [];
    [statuses, errors] = [[], []];
    connection = new Connection("ws://host/ws", () => ({ client: "test" }), {
        status: (status) => statuses.push(status), welcome() {}, state() {}, error: (error) => errors.push(error), frame() {}, pong() {},
    });
    connection.start();
});

afterEach(() => mock.restoreAll());

test("the delay doubles from 250 ms to 8 s, give or take a fifth", () => {
    const exact = [0, 1, 2, 3, 4, 5, 6, 20].map((attempt) => retryDelay(attempt, () => 0.5));
    assert.deepEqual(exact, [250, 500, 1000, 2000, 4000, 8000, 8000, 8000]);
    assert.equal(retryDelay(0, () => 0), 200);
    assert.ok(retryDelay(0, () => 0.999) <= 300);
});

test("offers farlight.v1 and says hello", () => {
    const [socket] = Socket.made;
    assert.deepEqual(socket.protocols, [PROTOCOL]);
    socket.onopen();
    assert.deepEqual(socket.sent, [{ type: "hello", client: "test" }]);
    assert.equal(connection.open, false);
    socket.onmessage({ data: WELCOME });
    assert.equal(connection.open, true);
    assert.equal(last().phase, "open");
});

for (const [code, again] of [...Object.entries(RECONNECT_AFTER), ["1006", true], ["4999", true]])
    test(`close ${code} (${describeClose(Number(code), "").title}): ${again ? "connects again" : "stops"}`, async () => {
        Socket.made[0].welcome();
        Socket.made[0].onclose({ code: Number(code), reason: "why" });
        await settle();
        assert.equal(last().phase, again ? "waiting" : "stopped");
        assert.equal(last().detail, "why");
        clock.tick(300);
        assert.equal(Socket.made.length, again ? 2 : 1);
    });

test("waits longer each time and starts over after a welcome", async () => {
    for (let i = 0; i < 4; ++i) {
        Socket.made.at(-1).onclose({ code: 1006, reason: "" });
        await settle();
        clock.tick(250 * 2 ** i * 0.8 - 1);
        assert.equal(Socket.made.length, i + 1, "not before four fifths of the delay");
        clock.tick(250 * 2 ** i * 0.4 + 2);
        assert.equal(Socket.made.length, i + 2, "after six fifths of it");
    }
    Socket.made.at(-1).welcome();
    Socket.made.at(-1).onclose({ code: 1006, reason: "" });
    await settle();
    clock.tick(301);
    assert.equal(Socket.made.length, 6);
});

test("after bye it waits at least as long as the server asks", async () => {
    Socket.made[0].welcome();
    Socket.made[0].onmessage({ data: '{"type":"bye","reason":"shutting down","reconnect_ms":5000}' });
    Socket.made[0].onclose({ code: 1001, reason: "" });
    await settle();
    assert.equal(last().detail, "shutting down");
    clock.tick(4999);
    assert.equal(Socket.made.length, 1);
    clock.tick(2);
    assert.equal(Socket.made.length, 2);
});

test("a hidden page waits to be seen", async () => {
    Socket.made[0].welcome();
    document.hidden = true;
    Socket.made[0].onclose({ code: 4008, reason: "" });
    await settle();
    clock.tick(60000);
    assert.equal(Socket.made.length, 1);
    document.hidden = false;
    document.listeners.forEach((listener) => listener());
    assert.equal(Socket.made.length, 2);
});

test("a server of another version stops it, with a clear message", () => {
    Socket.made[0].protocol = "";
    Socket.made[0].onopen();
    assert.equal(last().phase, "stopped");
    assert.match(last().title, /do not match/);
    clock.tick(60000);
    assert.equal(Socket.made.length, 1);
});

test("a refusal that lists other versions stops it; a server that is not ready is asked again", async () => {
    const answers = [new Response("loading", { status: 503 }), new Response("ready"), new Response("farlight.v2", { status: 426 })];
    fetch.mock.mockImplementation(() => Promise.resolve(answers.shift()));
    Socket.made[0].onclose({ code: 1006, reason: "" });
    await settle();
    assert.equal(last().phase, "waiting");
    assert.equal(last().detail, "loading");
    clock.tick(301);
    Socket.made[1].onclose({ code: 1006, reason: "" });
    await settle();
    await settle();
    assert.equal(last().phase, "stopped");
    assert.match(last().detail, /farlight\.v2/);
});

test("a fatal error's reason is told; an error that is not is handed on", async () => {
    Socket.made[0].welcome();
    Socket.made[0].onmessage({ data: '{"type":"error","code":"bad_setting","message":"no","fatal":false}' });
    assert.equal(errors[0].code, "bad_setting");
    Socket.made[0].onmessage({ data: '{"type":"error","code":"render_failed","message":"context lost","fatal":true}' });
    Socket.made[0].onclose({ code: 1011, reason: "" });
    await settle();
    assert.equal(last().phase, "waiting");
    assert.equal(last().detail, "context lost");
});

test("bytes it cannot read stop it; a message of a type it does not know does not", () => {
    Socket.made[0].welcome();
    Socket.made[0].onmessage({ data: '{"type":"teapot"}' });
    assert.equal(last().phase, "open");
    Socket.made[0].onmessage({ data: "{" });
    assert.equal(last().phase, "stopped");
    assert.match(last().detail, /not JSON/);
});

test("leaving the page says bye", () => {
    Socket.made[0].welcome();
    connection.stop();
    assert.deepEqual(Socket.made[0].sent.at(-1), { type: "bye" });
    assert.equal(Socket.made[0].closed, true);
});
