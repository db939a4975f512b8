// What people aim for: a time for each frame, an accuracy, patience without end, or settings as they set them; one slider
// serves time and accuracy. What no moving frame reaches is barred on its track, and said below it.
import { element, shortNumber } from "./dom.js";
import { cheapest, denoisedIn, errorNumber, finest, reachOfError, reachOfPatience, reachOfTime } from "./frontier.js";
import { barredPart, errorStops, shareOf, timeStops, wished } from "./goal_scale.js";
import { nearestStop } from "./scale.js";

const KINDS = {
    as_set: { name: "As set", needs: [] },
    time: { name: "Time", needs: ["budget_ms"], key: "budget_ms", unit: "ms a frame", label: "Time budget", ends: ["faster", "finer"] },
    accuracy: { name: "Accuracy", needs: ["target_error"], key: "target_error", unit: "relMSE", label: "Accuracy budget", ends: ["coarser", "finer"] },
    unlimited: { name: "Unlimited", needs: ["still_samples"] },
};
const DIGITS = 3;  // of an error in the number box

/** Which kind the settings that hold amount to. `described` are the server's descriptions by key. */
export function kindOf(values, described) {
    if (values.budget_ms > 0)
        return "time";
    if (values.target_error > 0)
        return "accuracy";
    const limit = described.get("still_samples")?.upper;
    return limit !== undefined && values.still_samples >= limit ? "unlimited" : "as_set";
}

/** Kinds that a server with these settings can be asked for. */
export const kindsFor = (described) => Object.keys(KINDS).filter((kind) => KINDS[kind].needs.every((key) => described.has(key)));

export class Goal {
    #nodes; #ask; #changed;
    #described = new Map(); #values = {};
    #frontier = { source: "learnt", points: [] };
    #frame = { ms: NaN, raw: NaN, error: NaN, denoised: NaN, samples: 1, accumulated: 0, still: false };
    #rested = {};     // of the last frame at rest, for rest(): moving ones may be smaller
    #measured = null; // error of the denoised picture at rest
    #kind = "as_set"; #kinds = [];
    #stops = [];
    #radios = new Map();
    #patient = null;  // still_samples as they were before "unlimited"

    /** `nodes` are {box, kinds, slider, label, unit, range, number, ticks, ends, problem, word}; `ask(key, value)` asks for a setting; `changed()` tells of another goal. */
    constructor(nodes, ask, changed) {
        this.#nodes = nodes;
        this.#ask = ask;
        this.#changed = changed;
        nodes.range.addEventListener("input", () => this.#wish(this.#stops[nodes.range.value]));
        nodes.number.addEventListener("change", () => this.#read(nodes.number.valueAsNumber));
    }

    /** {kind: "time" or "accuracy", value}, or null. */
    get target() {
        const value = this.#values[KINDS[this.#kind].key];
        return value > 0 ? { kind: this.#kind, value } : null;
    }

    get kind() {
        return this.#kind;
    }

    /** The server's list of settings. */
    describe(settings) {
        this.#described = new Map(settings.map((setting) => [setting.key, setting]));
        this.#kinds = kindsFor(this.#described);
        this.#nodes.box.hidden = this.#kinds.length < 2;
        this.#radios = new Map(this.#kinds.map((kind) => {
            const input = element("input", { type: "radio", name: "goal", value: kind });
            input.addEventListener("change", () => this.#choose(kind));
            return [kind, input];
        }));
        this.#nodes.kinds.replaceChildren(...[...this.#radios].map(([kind, input]) => element("label", {}, input, element("span", {}, KINDS[kind].name))));
        this.#stops = [];
        this.#rested = {};
        this.#measured = null;
    }

    /** What holds on the server. */
    update(values) {
        this.#values = { ...values };
        const kind = kindOf(values, this.#described);
        this.#stops = kind === this.#kind ? this.#stops : [];
        this.#kind = kind;
        this.show();
    }

    learn(frontier) {
        this.#frontier = frontier;
        this.show();
    }

    /** What the newest frame tells: {ms, raw, error, measured, samples, accumulated, still}; numbers may be NaN. */
    frame({ measured, ...frame }) {
        const { denoiser, refine_crossover = 0, still_samples = Infinity } = this.#values;
        const crossover = denoiser === "svgf" ? refine_crossover : 0;
        const known = Object.entries(frame).filter(([, value]) => !Number.isNaN(value));
        this.#frame = { ...this.#frame, ...Object.fromEntries(known), crossover, most: still_samples };
        const { ms, raw, error, samples } = this.#frame;
        if (!frame.still) {
            this.#frame.denoised = error;
            return;
        }
        // Measured once, at rest, it is known better than any later prediction.
        this.#measured = measured >= 0 ? measured : this.#measured;
        const denoised = this.#measured ?? denoisedIn(this.#frame);
        if (!Number.isNaN(denoised))
            this.#frame.denoised = denoised;
        this.#rested = { ms, raw, samples, denoised: this.#frame.denoised };
    }

    #choose(kind) {
        const before = this.#kind;
        this.#kind = kind;
        this.#stops = [];
        this.#complain("");
        const { key } = KINDS[kind];
        for (const other of ["budget_ms", "target_error"])
            if (other !== key && this.#values[other] > 0)
                this.#set(other, 0);
        if (kind === "unlimited") {
            this.#patient = this.#values.still_samples;
            this.#set("still_samples", this.#described.get("still_samples").upper);
        } else if (before === "unlimited")
            this.#set("still_samples", this.#patient ?? this.#described.get("still_samples").default);
        if (key)
            this.#set(key, this.#firstWish(kind));
        this.show();
        this.#changed();
    }

    /** Where the slider starts: near what holds now, but within reach. */
    #firstWish(kind) {
        const { points } = this.#frontier;
        const stops = this.#stopsOf(kind);
        if (kind === "time") {
            const now = this.#frame.ms > 0 ? this.#frame.ms : stops[Math.floor(stops.length / 2)];
            const least = Math.max(now, cheapest(points)?.ms ?? 0);
            return stops.find((stop) => stop >= least) ?? stops.at(-1);
        }
        const now = this.#frame.error > 0 ? this.#frame.error : stops[Math.floor(stops.length / 2)];
        const most = Math.max(now, finest(points)?.error ?? 0);
        return stops.findLast((stop) => stop >= most) ?? stops[0];
    }

    /** What was typed: NaN if that is no number. */
    #read(typed) {
        const { key, unit } = KINDS[this.#kind];
        const { value, problem } = wished(typed, this.#described.get(key), unit);
        if (value !== null)
            this.#wish(value);
        this.#complain(problem);
        this.#nodes.number.value = this.#typed(this.#values[key]);
    }

    #complain(problem) {
        this.#nodes.problem.textContent = problem;
        this.#nodes.problem.hidden = problem === "";
    }

    /** A value as the number box shows it. */
    #typed(value) {
        return this.#kind === "time" ? value : Number(value.toPrecision(DIGITS));
    }

    #wish(value) {
        this.#complain("");
        this.#set(KINDS[this.#kind].key, value);
        this.show();
        this.#changed();
    }

    #set(key, value) {
        this.#values[key] = value;
        this.#ask(key, value);
    }

    #stopsOf(kind) {
        return (kind === "time" ? timeStops : errorStops)(this.#frontier.points, this.#frame, this.#described.get(KINDS[kind].key));
    }

    /** Brings controls and words up to date; a slider that is being held keeps its scale. */
    show() {
        const { slider, word } = this.#nodes;
        for (const [kind, input] of this.#radios)
            input.checked = kind === this.#kind;
        slider.hidden = !KINDS[this.#kind].key;
        if (KINDS[this.#kind].key) {
            this.#widen();
            this.#showSlider();
        } else
            word.textContent = this.#kind === "unlimited" ? reachOfPatience(this.#frame, this.#values.still_samples)
                : "Settings stay as you set them. Choose a time or an accuracy, and the server sets them for you.";
    }

    /** The scale changes when it must show more, never while it is in somebody's hand. */
    #widen() {
        const before = this.#stops;
        const now = this.#stopsOf(this.#kind);
        const outside = (stop) => stop < Math.min(...before) || stop > Math.max(...before);
        if (before.length === 0 || ((outside(now[0]) || outside(now.at(-1))) && document.activeElement !== this.#nodes.range))
            this.#stops = now;
    }

    #showSlider() {
        const { slider, label, unit, range, number, ends, word } = this.#nodes;
        const kind = KINDS[this.#kind];
        const value = this.#values[kind.key];
        const last = this.#stops.length - 1;
        label.textContent = kind.label;
        unit.textContent = kind.unit;
        number.max = this.#described.get(kind.key).upper;
        range.max = last;
        range.value = nearestStop(this.#stops, value);
        const reach = this.#kind === "time" ? reachOfTime(this.#frontier, value) : reachOfError(this.#frontier, value, { ...this.#frame, ...this.#rested, limit: this.#described.get("still_samples")?.upper });
        const shown = this.#kind === "time" ? shortNumber : errorNumber;
        range.setAttribute("aria-valuetext", `${shown(value)} ${kind.unit}. ${reach.words}`);
        range.style.setProperty("--at", range.value / last);
        const { side, share } = barredPart(this.#kind, this.#stops, this.#frontier.points);
        range.dataset.barred = share > 0 ? side : "none";
        range.style.setProperty("--barred", share);
        slider.classList.toggle("beyond", !reach.reached);
        if (document.activeElement !== number)
            number.value = this.#typed(value);
        ends.replaceChildren(...[0, last].map((at, i) => element("span", {}, `${shown(this.#stops[at])}, ${kind.ends[i]}`)));
        word.textContent = reach.words;
        this.#showTicks();
    }

    /** A mark on the track for each point of the frontier. */
    #showTicks() {
        const { points } = this.#frontier;
        this.#nodes.ticks.replaceChildren(...points.map((point) => (this.#kind === "time" ? point.ms : point.error))
            .filter((value) => value > 0).map((value) => {
                const tick = element("span");
                tick.style.setProperty("--at", shareOf(this.#stops, value));
                return tick;
            }));
    }
}
