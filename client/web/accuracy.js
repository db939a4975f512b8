// The accuracy section: what this frame's error is and costs, among what the scene's frames may cost and bring.
//
// Header and frontier come from the server; the goal (goal.js) and the plot (frontier_plot.js) are parts of it.
import { element, fixed } from "./dom.js";
import { ORIGINS, errorNumber, errorOf, frontierOf, interval, milliseconds, oneMore } from "./frontier.js";
import { FrontierPlot } from "./frontier_plot.js";
import { badValues, wrongValues } from "./protocol.js";
import { Goal } from "./goal.js";

const REFRESH_MS = 250;     // more often, numbers cannot be read
const STEP_MS = 100;        // the live point's
const TRAIL = 40;           // points behind it
const TRACING = "path_trace"; // the pass whose time grows with the samples
const ESTIMATES = 120;      // bytes of a frame header that tells errors with their intervals

/** [key, name, what it is]: the rows of numbers. */
const ROWS = [
    ["predicted", "Predicted error", "of the picture that is shown, from its own samples"],
    ["noise", "Noise in it", "the part of the predicted error that more samples take away; the rest is what the filter blurs"],
    ["measured", "Measured error", "of the denoised picture, when it rests, against samples that are not in it"],
    ["raw", "Raw error", "of this frame's own samples without any filter"],
    ["effective", "Effective samples", "samples a pixel that a plain mean would need for the picture's error"],
    ["samples", "Samples a pixel", "of this frame, and in all since camera or settings last changed"],
    ["more", "One more sample", "what another sample a pixel would add to the frame's time, and what it would take from the error: less each time"],
    ["inside", "Internal size", "the picture as it is traced, and the size it is shown at"],
    ["drawing", "Drawing", "tracing and denoising on the server"],
    ["encoding", "Encoding", "from pixels to bytes"],
    ["network", "Network", "a ping there and back, median"],
    ["faulty", "Bad values", "NaN, infinite, negative and clamped values met while drawing: must be 0"],
];

/** The time that this frame's samples took [ms]; NaN without passes. */
const tracingOf = (passes) => passes.find(({ name }) => name === TRACING)?.ms ?? NaN;

function oneMoreCells(header, passes) {
    const { ms, raw, error } = oneMore(header, tracingOf(passes));
    const fromTo = (name, from, to, digits) => (Number.isFinite(to) ? [`${name} ${errorNumber(from, digits)} to ${errorNumber(to, digits)}`] : []);
    return [Number.isFinite(ms) ? `+ ${milliseconds(ms)}` : "–",
        [...fromTo("error", header.predicted_error, error, 3), ...fromTo("raw", header.raw_error, raw, 2)].join(", ")];
}

/** {key: [number, what belongs to it]} for ROWS. */
function cellsOf(header, passes, roundTrip) {
    const { width, height, full_width, full_height } = header;
    const whole = width === full_width && height === full_height;
    const intervalOf = (kind, before, after) => interval({ lower: header[`${kind}_lower`], upper: header[`${kind}_upper`] }, before, after);
    return {
        predicted: [errorNumber(header.predicted_error), intervalOf("predicted") + (whole ? "" : ", before it is enlarged")],
        noise: [errorNumber(header.noise_error), "the rest is blur"],
        measured: [errorNumber(header.measured_error), header.reference_samples ? `${intervalOf("measured", "", ", ")}against ${header.reference_samples} samples` : header.flags.still ? "after more samples" : "while still"],
        raw: [errorNumber(header.raw_error), "unfiltered"],
        effective: [Number.isFinite(header.effective_samples) ? errorNumber(header.effective_samples, 3) : "–", "of a plain mean"],
        samples: [header.samples_per_pixel || "–", `a frame, ${header.accumulated_samples} in all`],
        more: oneMoreCells(header, passes),
        inside: [`${width} × ${height}`, whole ? "full size" : `of ${full_width} × ${full_height}`],
        drawing: [`${fixed((header.trace_us + header.denoise_us) / 1000)} ms`, header.frame_us ? `of ${fixed(header.frame_us / 1000)} in all` : ""],
        encoding: [`${fixed(header.encode_us / 1000)} ms`, "to bytes"],
        network: [Number.isFinite(roundTrip) ? `${fixed(roundTrip)} ms` : "–", "there and back"],
        faulty: [String(badValues(header)), wrongValues(header) ? "pixels: the picture is faulty" : badValues(header) ? "pixels, cut at a limit" : "pixels"],
    };
}

export class Accuracy {
    #nodes; #roundTrip;
    #cells = {};
    #plot; #goal;
    #frontier = null; #header = null; #passes = [];
    #trail = [];
    #expects = false;  // the server knows budgets, so a frontier will come
    #drawnAt = -Infinity; #steppedAt = -Infinity; #timer;

    /** `nodes` are {box, word, absent, figure, plot, caption, rows, formula, goal: {...}}; `ask(key, value)` asks for a setting; `roundTrip()` in ms. */
    constructor(nodes, ask, roundTrip) {
        this.#nodes = nodes;
        this.#roundTrip = roundTrip;
        this.#goal = new Goal(nodes.goal, ask, () => this.#refresh());
        this.#plot = new FrontierPlot(nodes.plot, (point) => this.#caption(point));
        nodes.rows.append(...ROWS.map(([key, name, meaning]) => {
            const cells = this.#cells[key] = [element("td"), element("td")];
            return element("tr", { "data-row": key, title: meaning }, element("th", { scope: "row" }, name), ...cells);
        }));
        nodes.box.addEventListener("toggle", () => this.#refresh());
    }

    get frontier() {
        return this.#frontier;
    }

    /** A session begins: with another scene, nothing is known any more. */
    welcome({ settings }) {
        this.#frontier = null;
        this.#header = null;
        this.#trail = [];
        this.#goal.describe(settings);
        this.#goal.learn({ source: "learnt", points: [] });
        const missing = missingFrom(settings);
        this.#nodes.absent.hidden = missing.length === 0;
        this.#nodes.absent.textContent = `This server knows no ${missing.join(", no ")}.`;
        this.#expects = settings.some(({ key }) => key === "budget_ms" || key === "target_error");
        this.#refresh();
    }

    update(values) {
        this.#goal.update(values);
        this.#refresh();
    }

    learn(message) {
        this.#frontier = frontierOf(message);
        this.#goal.learn(this.#frontier);
        this.#refresh();
    }

    frame(header, passes) {
        this.#header = header;
        this.#passes = passes;
        const error = errorOf(header);
        const ms = (header.trace_us + header.denoise_us) / 1000;
        this.#goal.frame({
            ms, raw: header.raw_error, error: error?.value ?? NaN, measured: header.measured_error, samples: header.samples_per_pixel || 1,
            accumulated: header.accumulated_samples, still: header.flags.still,
        });
        const now = performance.now();
        if (error?.value > 0 && ms > 0 && now - this.#steppedAt >= STEP_MS) {
            this.#steppedAt = now;
            this.#trail.push({ ms, error: error.value, still: header.flags.still });
            this.#trail.splice(0, this.#trail.length - TRAIL - 1);
            this.#drawPlot();
        }
        clearTimeout(this.#timer);
        this.#timer = setTimeout(() => this.#refresh(), Math.max(0, this.#drawnAt + REFRESH_MS - now));
    }

    #refresh() {
        this.#drawnAt = performance.now();
        const error = this.#header && errorOf(this.#header);
        const faulty = this.#header !== null && wrongValues(this.#header) > 0;
        this.#nodes.word.textContent = faulty ? `${badValues(this.#header)} bad values`
            : error ? `${errorNumber(error.value)} ${error.measured ? "measured" : "predicted"}` : "";
        this.#nodes.word.classList.toggle("bad", faulty);
        if (!this.#nodes.box.open)
            return;
        this.#goal.show();
        this.#drawPlot();
        this.#caption(null);
        this.#nodes.figure.hidden = !this.#expects && !this.#frontier && this.#trail.length === 0;
        if (this.#header)
            this.#drawRows();
    }

    #drawRows() {
        for (const [key, texts] of Object.entries(cellsOf(this.#header, this.#passes, this.#roundTrip())))
            this.#cells[key].forEach((cell, i) => { cell.textContent = texts[i]; });
        const estimates = this.#header.header_size >= ESTIMATES;
        for (const key of ["predicted", "noise", "measured", "raw", "effective", "more"])
            this.#cells[key][0].parentElement.hidden = (!estimates || key === "noise") && this.#cells[key][0].textContent === "–";
        this.#nodes.formula.hidden = !estimates;
        this.#cells.faulty[0].parentElement.classList.toggle("bad", wrongValues(this.#header) !== 0);
    }

    #drawPlot() {
        if (!this.#nodes.box.open)
            return;
        const points = this.#frontier?.points ?? [];
        const live = this.#trail.at(-1) ?? null;
        const words = [...points.map(({ label, ms, error }) => `${label}: ${milliseconds(ms)}, error ${errorNumber(error)}`),
            ...(live ? [`now: ${milliseconds(live.ms)}, error ${errorNumber(live.error)}`] : [])];
        this.#plot.show({ points, live, trail: this.#trail.slice(0, -1), measured: this.#measured(), target: this.#goal.target }, `Error against time. ${words.join("; ")}`);
    }

    /** The denoised picture behind the one that is shown, where that is another. */
    #measured() {
        const header = this.#header;
        if (!(header?.measured_error > 0) || errorOf(header).measured)
            return null;
        return { ms: (header.trace_us + header.denoise_us) / 1000, error: header.measured_error, lower: header.measured_lower, upper: header.measured_upper };
    }

    /** Below the plot: what is pointed at, or which point draws now, and where the frontier is from. */
    #caption(pointed) {
        const { source, reason, points } = this.#frontier ?? { points: [] };
        const point = pointed ?? points.find(({ rung }) => rung === this.#header?.rung);
        const origin = source ? `Frontier ${ORIGINS[source]}${reason ? `: ${reason}` : ""}.` : "The frontier is not known yet.";
        const error = point?.error > 0 ? `error ${errorNumber(point.error)}${interval(point, ", ")}` : "error not known yet";
        this.#nodes.caption.replaceChildren(element("span", {}, origin),
            ...(point ? [" ", element("b", {}, `${pointed ? "" : "Now drawing: "}${point.label}`), ` (${milliseconds(point.ms)}, ${error})`] : []));
    }
}

/** What of this section the server's settings lack, in words. */
function missingFrom(settings) {
    const keys = new Set(settings.map(({ key }) => key));
    return Object.entries({ budget_ms: "time budget", target_error: "accuracy budget", error_estimate: "error estimate" })
        .filter(([key]) => !keys.has(key)).map(([, words]) => words);
}
