// One WebSocket to the server, kept alive: hello, control messages, and connecting again by itself.
//
// Handlers: status({phase, title, detail, retryAt}), welcome(message), state(message), error(message),
// frame(buffer, arrivedAt), pong(milliseconds). `phase` is "connecting", "open", "waiting" (will try again
// at `retryAt`, or when the page is visible again), or "stopped" (will not).
import { PROTOCOL, RECONNECT_AFTER, ProtocolError, decodeMessage, encodeMessage } from "./protocol.js";

const FIRST_DELAY_MS = 250;
const LONGEST_DELAY_MS = 8000;
const PATIENCE_MS = 15000;  // without a welcome, or without any sign of life, before giving a connection up
const PING_EVERY_MS = 2000;
const PROBE_MS = 3000;

/** PROTOCOL.md section 7: doubling from 250 ms to 8 s, varied by up to a fifth. */
export function retryDelay(attempt, random = Math.random) {
    return Math.min(LONGEST_DELAY_MS, FIRST_DELAY_MS * 2 ** attempt) * (0.8 + 0.4 * random());
}

/** Why a connection ended, for people. */
export function describeClose(code, reason) {
    const known = {
        1000: "The session has ended", 1001: "The server is shutting down", 1002: "The connection broke the rules",
        1008: "The server refused this session", 1009: "The server refused a message as too long",
        1011: "The renderer failed", 1013: "The server is full", 4008: "The server stopped waiting for this page",
    };
    const title = known[code] ?? (code === 1006 ? "The server is gone" : `The connection was closed (${code})`);
    return { title, detail: reason || (code === 1006 ? "Camera and settings are kept. This page connects again by itself." : "") };
}

/** What a server that refuses the WebSocket has to say: {gone} or {title, detail, stop}. */
async function probe(socketUrl) {
    const httpUrl = socketUrl.replace(/^ws/, "http");
    const ask = (url) => fetch(url, { cache: "no-store", signal: AbortSignal.timeout(PROBE_MS) });
    try {
        const ready = await ask(new URL("readyz", httpUrl));
        if (!ready.ok)
            return { title: "The server is not ready", detail: (await ready.text()).trim() };
        const refusal = await ask(httpUrl);
        const text = (await refusal.text()).trim();
        if (refusal.status === 426 && !text.includes(PROTOCOL))
            return { ...mismatch(text), stop: true };
        return { title: "The server refuses the connection", detail: refusal.status === 503 ? text : "It may be full." };
    } catch {
        return { gone: true };
    }
}

function mismatch(found) {
    return {
        title: "Page and server do not match",
        detail: `This page speaks ${PROTOCOL}; the server says: ${found || "nothing"}. Reload the page.`,
    };
}

export class Connection {
    #url; #hello; #on;
    #socket = null;
    #attempt = 0;
    #retryTimer; #patienceTimer; #pingTimer;
    #lastHeard = 0; #pingSent = 0;
    #farewell = null;   // the server's bye, or its fatal error
    #stopped = true;

    constructor(url, hello, on) {
        this.#url = url;
        this.#hello = hello;
        this.#on = on;
        document.addEventListener("visibilitychange", () => {
            if (!document.hidden && this.#retryTimer === null)
                this.retryNow();
        });
    }

    get open() {
        return this.#socket?.welcomed === true;
    }

    start() {
        this.#stopped = false;
        this.#attempt = 0;
        this.retryNow();
    }

    /** Says goodbye: for leaving the page. */
    stop() {
        this.send("bye");
        this.#drop();
        this.#stopped = true;
    }

    retryNow() {
        clearTimeout(this.#retryTimer);
        this.#retryTimer = undefined;
        if (!this.#stopped && !this.#socket)
            this.#connect();
    }

    /** False when there is no connection to send on. */
    send(type, fields) {
        if (!this.open)
            return false;
        this.#socket.send(encodeMessage(type, fields));
        return true;
    }

    #connect() {
        this.#on.status({ phase: "connecting", title: this.#attempt ? "Connecting again…" : "Connecting…", detail: "" });
        this.#farewell = null;
        const socket = new WebSocket(this.#url, [PROTOCOL]);
        this.#socket = socket;
        socket.binaryType = "arraybuffer";
        socket.onopen = () => {
            socket.answered = true;
            if (socket.protocol === PROTOCOL)
                socket.send(encodeMessage("hello", this.#hello()));
            else
                this.#end({ ...mismatch(socket.protocol), stop: true });
        };
        socket.onmessage = ({ data }) => this.#receive(data);
        socket.onclose = ({ code, reason }) => this.#closed(socket, code, reason);
        this.#patienceTimer = setTimeout(() => this.#end({ title: "The server does not answer", detail: "" }), PATIENCE_MS);
    }

    #receive(data) {
        this.#lastHeard = performance.now();
        try {
            if (typeof data !== "string")
                this.#on.frame(data, this.#lastHeard);
            else
                this.#dispatch(decodeMessage(data));
        } catch (fault) {
            if (!(fault instanceof ProtocolError))
                throw fault;
            this.#end({ title: "The server sent something this page cannot read", detail: fault.message, stop: true });
        }
    }

    #dispatch(message) {
        if (message?.type === "welcome")
            this.#welcome(message);
        else if (message?.type === "bye")
            this.#farewell = { title: "The server says goodbye", detail: message.reason, least: message.reconnect_ms };
        else if (message?.type === "pong")
            this.#on.pong(performance.now() - message.t);
        else if (message?.type === "error" && message.fatal)
            this.#farewell = { title: "The server refused this session", detail: message.field ? `${message.field}: ${message.message}` : message.message };
        else if (message)
            this.#on[message.type](message);
    }

    #welcome(message) {
        if (message.protocol !== PROTOCOL)
            return this.#end({ ...mismatch(message.protocol), stop: true });
        clearTimeout(this.#patienceTimer);
        this.#attempt = 0;
        this.#socket.welcomed = true;
        this.#pingTimer = setInterval(() => this.#ping(), PING_EVERY_MS);
        this.#on.welcome(message);
        this.#on.status({ phase: "open", title: "Connected", detail: "" });
    }

    #ping() {
        const now = performance.now();
        const silent = this.#pingSent > this.#lastHeard;
        if (silent && now - this.#pingSent > PATIENCE_MS)
            this.#end({ title: "The server is gone", detail: `Nothing was heard for ${PATIENCE_MS / 1000} s.` });
        else if (!silent) {
            this.#pingSent = now;
            this.send("ping", { t: now });
        }
    }

    async #closed(socket, code, reason) {
        if (socket !== this.#socket)
            return; // one that was given up before
        this.#drop();
        const farewell = this.#farewell;
        let why = { ...describeClose(code, reason), ...farewell, stop: RECONNECT_AFTER[code] === false };
        if (!socket.answered) {
            const found = await probe(this.#url);
            if (this.#socket || this.#stopped)
                return;
            if (!found.gone)
                why = found;
        }
        this.#end(why);
    }

    /** Detaches from the socket, so that nothing more of it is heard. */
    #drop() {
        clearTimeout(this.#patienceTimer);
        clearInterval(this.#pingTimer);
        const socket = this.#socket;
        this.#socket = null;
        if (socket) {
            socket.onmessage = socket.onclose = socket.onopen = null;
            socket.close();
        }
    }

    #end({ title, detail, least = 0, stop = false }) {
        this.#drop();
        if (stop) {
            this.#stopped = true;
            return this.#on.status({ phase: "stopped", title, detail });
        }
        const delay = Math.max(least, retryDelay(this.#attempt++));
        // A hidden page shows nothing, so it would only be closed as stalled again: it waits to be seen.
        this.#retryTimer = document.hidden ? null : setTimeout(() => this.retryNow(), delay);
        return this.#on.status({ phase: "waiting", title, detail, retryAt: performance.now() + delay });
    }
}
