// What people must be told: the state of the connection over the picture, and passing notices.
import { element } from "./dom.js";

const NOTICE_MS = 8000;
const MOST_NOTICES = 4;

/** A curtain over the picture while there is no connection, with a countdown to the next attempt. */
export class Curtain {
    #nodes; #timer; #retryAt;

    /** `nodes` are {box, title, detail, retry, light, word}; `light` and `word` show the state at all times. */
    constructor(nodes, { retry, reload }) {
        this.#nodes = nodes;
        nodes.retry.addEventListener("click", () => (nodes.retry.dataset.does === "reload" ? reload() : retry()));
    }

    show({ phase, title, detail, retryAt }) {
        const { box, retry, light, word } = this.#nodes;
        clearInterval(this.#timer);
        this.#retryAt = retryAt;
        light.dataset.phase = phase;
        word.textContent = { open: "Connected", connecting: "Connecting", waiting: "Disconnected", stopped: "Stopped" }[phase];
        box.hidden = phase === "open";
        box.dataset.phase = phase;
        if (phase === "connecting" && box.dataset.title) // while it tries again, what went wrong stays readable
            this.#nodes.detail.textContent = title;
        else {
            box.dataset.title = phase === "open" || phase === "connecting" ? "" : title;
            this.#nodes.title.textContent = title;
            this.#nodes.detail.textContent = detail;
        }
        retry.hidden = phase === "connecting" || phase === "open";
        retry.dataset.does = phase === "stopped" ? "reload" : "retry";
        retry.textContent = "Reload the page";
        if (phase === "waiting") {
            this.#count();
            this.#timer = setInterval(() => this.#count(), 250);
        }
    }

    #count() {
        const seconds = Math.max(0, Math.ceil((this.#retryAt - performance.now()) / 1000));
        this.#nodes.retry.textContent = seconds > 0 ? `Try now (again in ${seconds} s)` : "Try now";
    }
}

/** Adds a notice to `box`; the same text is not shown twice at a time. */
export function notify(box, text, kind = "error") {
    const same = [...box.children].find((notice) => notice.dataset.text === text);
    same?.remove();
    while (box.children.length >= MOST_NOTICES)
        box.firstElementChild.remove();
    const dismiss = element("button", { type: "button", "aria-label": "Dismiss" }, "×");
    const notice = element("div", { className: `notice ${kind}`, "data-text": text }, element("span", {}, text), dismiss);
    dismiss.addEventListener("click", () => notice.remove());
    setTimeout(() => notice.remove(), NOTICE_MS);
    box.append(notice);
}
