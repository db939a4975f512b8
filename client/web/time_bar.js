// Play button and time line of a scene that moves by itself. What does not move has none, and says so.
import { fixed } from "./dom.js";

const AFTERWARDS = { rests: "then at rest", repeats: "then again", goes_on: "and on" };

export class TimeBar {
    #nodes; #send;
    #duration = null;   // [s] of all that follows time; null: nothing does
    #afterwards = "rests";
    #plays = false;     // the setting, as it holds on the server
    #shown = 0;         // [s] the newest picture's moment
    #wanted = null;     // [s] asked for by the slider, not yet on the wire

    /** `nodes` are {controls, play, time, word}; `send(key, value)` asks the server for another setting. */
    constructor(nodes, send) {
        this.#nodes = nodes;
        this.#send = send;
        nodes.play.addEventListener("click", () => this.#press());
        nodes.time.addEventListener("input", () => this.#seek(Number(nodes.time.value)));
    }

    /** Settings of a session that goes on after another: a paused scene stays where it is. */
    get held() {
        return this.#duration !== null && !this.#plays ? { time: this.#shown } : {};
    }

    /** `scene` of a welcome or a change. */
    describe({ duration = null, afterwards = "rests" }) {
        this.#duration = duration;
        this.#afterwards = afterwards;
        this.#nodes.controls.hidden = duration === null;
        this.#nodes.time.max = duration ?? 1;
        this.#show();
    }

    /** What holds on the server. */
    update({ play }) {
        this.#plays = play ?? false;
        this.#show();
    }

    frame({ scene_time }) {
        this.#shown = scene_time;
        this.#show();
    }

    get #ended() {
        return this.#afterwards === "rests" && this.#shown >= this.#duration;
    }

    #press() {
        if (this.#plays && !this.#ended)
            return this.#send("play", false);
        if (this.#ended)
            this.#send("time", 0);
        if (!this.#plays)
            this.#send("play", true);
        return undefined;
    }

    /** To look at one moment, the scene holds still; asked once a screen frame at most. */
    #seek(time) {
        if (this.#plays)
            this.#send("play", false);
        if (this.#wanted === null)
            requestAnimationFrame(() => {
                this.#send("time", this.#wanted);
                this.#wanted = null;
            });
        this.#wanted = time;
        this.#shown = time;
        this.#show();
    }

    #show() {
        const { play, time, word } = this.#nodes;
        if (this.#duration === null) {
            word.textContent = "Nothing in this scene moves by itself.";
            return;
        }
        const within = this.#afterwards === "repeats" && this.#duration > 0 ? this.#shown % this.#duration : Math.min(this.#shown, this.#duration);
        const beyond = this.#afterwards === "goes_on" && this.#shown > this.#duration;
        if (this.#wanted === null)
            time.value = within;
        time.style.setProperty("--filled", `${100 * within / Math.max(this.#duration, 1e-9)}%`);
        time.setAttribute("aria-valuetext", `${fixed(within)} seconds`);
        play.textContent = this.#ended ? "Play again" : this.#plays ? "Pause" : "Play";
        word.textContent = beyond ? `${fixed(this.#shown)} s; the line shows the first ${fixed(this.#duration)} s`
            : `${fixed(within)} s of ${fixed(this.#duration)} s, ${AFTERWARDS[this.#afterwards]}`;
    }
}
