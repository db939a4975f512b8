// Live edits: a merge patch of the scene's document as JSON text, and what the server says to it.
import { element } from "./dom.js";

/** The bytes that an `edit` message has besides its patch. */
const ENVELOPE_BYTES = 64;

export class SceneEditor {
    #nodes; #send;
    #longest = Infinity;  // [bytes] of a message
    #id = 0;
    #waiting = null;      // id of the edit that is being made

    /** `nodes` are {patch, apply, reset, word}; `send(fields)` puts an `edit` on the wire and says whether it could. */
    constructor(nodes, send) {
        this.#nodes = nodes;
        this.#send = send;
        nodes.apply.addEventListener("click", () => this.#apply());
        nodes.reset.addEventListener("click", () => this.#ask({ patch: {}, reset: true }));
        nodes.patch.addEventListener("keydown", (event) => {
            if (event.key === "Enter" && (event.ctrlKey || event.metaKey))
                this.#apply();
        });
    }

    /** A session begins. */
    welcome({ edits = true, limits }) {
        this.#longest = limits.max_message_bytes;
        this.#waiting = null;
        for (const node of [this.#nodes.patch, this.#nodes.apply, this.#nodes.reset])
            node.disabled = !edits;
        this.#say(edits ? "" : "This server's scene is not to be edited.");
    }

    /** The scene has changed: true if it was by this page. */
    changed(id) {
        const own = id !== undefined && id === this.#waiting;
        if (own) {
            this.#waiting = null;
            this.#say("Done: the next picture shows it.", "good");
        }
        return own;
    }

    /** An error that is about no setting: true if it answers an edit. */
    complain({ field, message }) {
        if (this.#waiting === null)
            return false;
        this.#waiting = null;
        this.#say(message, "bad", field);
        return true;
    }

    #apply() {
        const text = this.#nodes.patch.value.trim();
        let patch;
        try {
            patch = JSON.parse(text || "{}");
        } catch (fault) {
            return this.#say(`Not JSON: ${fault.message}`, "bad");
        }
        if (patch === null || typeof patch !== "object" || Array.isArray(patch))
            return this.#say("Expected an object: { … }", "bad");
        return this.#ask({ patch });
    }

    #ask(fields) {
        const bytes = new TextEncoder().encode(JSON.stringify(fields)).length + ENVELOPE_BYTES;
        if (bytes > this.#longest)
            return this.#say(`${bytes} bytes, but the server takes ${this.#longest}.`, "bad");
        if (!this.#send({ id: this.#id + 1, ...fields }))
            return this.#say("Not connected.", "bad");
        this.#waiting = ++this.#id;
        return this.#say("The server is making the scene anew…");
    }

    #say(text, kind = "", pointer = "") {
        const { word } = this.#nodes;
        word.dataset.kind = kind;
        const place = pointer ? text.indexOf(pointer) : -1;
        if (place < 0)
            word.replaceChildren(pointer ? `${pointer}: ${text}` : text);
        else
            word.replaceChildren(text.slice(0, place), element("code", {}, pointer), text.slice(place + pointer.length));
    }
}
