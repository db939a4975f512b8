// The settings the server offers, as rows of controls. The page knows no
// setting but the three it puts on top and those of time and accuracy, which have controls of their own.
import { element } from "./dom.js";
import { settingRow } from "./controls.js";

const BUDGETS = ["budget_ms", "target_error"];
const ELSEWHERE = ["play", "time", "time_step",  // the time line's; the step is for recordings
    ...BUDGETS, "wipe_left", "wipe_right", "wipe_position"];
const ON_TOP = ["denoiser", "samples_per_pixel", "view"];

export class Panel {
    #top; #rest; #count; #resetAll; #send;
    #rows = new Map();       // key -> row
    #described = new Map();  // key -> the server's description
    #values = new Map();     // key -> the value that holds on the server
    #wanted = new Map();     // key -> the value last asked for, not yet on the wire
    #unanswered = 0;

    /** `nodes` are {top, rest, count, resetAll}; `send(key, value)` asks the server and says whether it could. */
    constructor(nodes, send) {
        ({ top: this.#top, rest: this.#rest, count: this.#count, resetAll: this.#resetAll } = nodes);
        this.#send = send;
        this.#resetAll.addEventListener("click", () => this.#resetEverything());
    }

    /** Values that differ from the server's defaults: what a new session starts from. */
    changed() {
        return Object.fromEntries([...this.#values].filter(([key, value]) => value !== this.#described.get(key).default));
    }

    #changedRows() {
        return Object.keys(this.changed()).filter((key) => this.#rows.has(key) || BUDGETS.includes(key));
    }

    values() {
        return Object.fromEntries(this.#values);
    }

    /** True when the server has answered everything that was asked of it. */
    get settled() {
        return this.#unanswered === 0 && this.#wanted.size === 0;
    }

    /** The list in `welcome`. Rows are made anew only when the server offers others than before. */
    describe(settings) {
        const before = JSON.stringify([...this.#described.values()]);
        this.#described = new Map(settings.map(({ value, ...description }) => [description.key, description]));
        if (JSON.stringify([...this.#described.values()]) !== before)
            this.#build(settings);
        this.#unanswered = 0;
        this.#wanted.clear();
        this.update(Object.fromEntries(settings.map(({ key, value }) => [key, value])));
    }

    /** What holds on the server. A control that is being moved keeps its place until the last answer is in. */
    update(values) {
        this.#unanswered = Math.max(0, this.#unanswered - 1);
        for (const [key, value] of Object.entries(values)) {
            if (!this.#described.has(key))
                continue;
            this.#values.set(key, value);
            if (this.#unanswered === 0 && !this.#wanted.has(key))
                this.#rows.get(key)?.show(value);
        }
        const changed = this.#changedRows().length;
        this.#count.textContent = changed ? `${changed} changed` : "";
        this.#resetAll.disabled = changed === 0;
    }

    /** A refusal: true if it is about a setting, which then shows the value that holds and the reason. */
    complain(key, text) {
        if (this.#described.has(key))
            this.#unanswered = Math.max(0, this.#unanswered - 1);
        const row = this.#rows.get(key);
        if (!row)
            return false;
        row.show(this.#values.get(key));
        row.complain(text);
        return true;
    }

    #build(settings) {
        const shown = settings.filter(({ key }) => !ELSEWHERE.includes(key));
        this.#rows = new Map(shown.map((setting) =>
            [setting.key, settingRow(setting, (value) => this.ask(setting.key, value))]));
        const rank = (setting) => ON_TOP.indexOf(setting.key);
        const top = shown.filter((setting) => rank(setting) >= 0).sort((a, b) => rank(a) - rank(b));
        const rest = shown.filter((setting) => rank(setting) < 0);
        this.#top.replaceChildren(...top.map(({ key }) => this.#rows.get(key).node));
        this.#rest.replaceChildren(...rest.map(({ key }) => this.#rows.get(key).node));
        this.#rest.append(element("p", { className: "help", hidden: rest.length > 0 }, "This server offers no others."));
    }

    /** A slider in motion asks once a screen frame at most; only its newest value counts. */
    ask(key, value) {
        if (this.#wanted.size === 0)
            requestAnimationFrame(() => this.#flush());
        this.#wanted.set(key, value);
    }

    #flush() {
        const wanted = [...this.#wanted];
        this.#wanted.clear();
        for (const [key, value] of wanted) {
            if (this.#send(key, value))
                ++this.#unanswered;
            else
                this.#rows.get(key)?.show(this.#values.get(key));
        }
    }

    #resetEverything() {
        for (const key of this.#changedRows())
            this.ask(key, this.#described.get(key).default);
    }
}
