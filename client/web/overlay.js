// The statistics over the picture: what moves, how late it is, and where the milliseconds go.
import { bytesShort, element, fixed } from "./dom.js";
import { errorNumber, errorOf } from "./frontier.js";
import { KINDS, badValues, wrongValues } from "./protocol.js";

const REFRESH_MS = 250;   // more often, numbers cannot be read
const FORMAT_NAMES = { jpeg420: "JPEG 4:2:0", jpeg444: "JPEG 4:4:4", png: "PNG", raw: "raw float" };
const MOST_PASSES = 16;   // rows of the table; beyond, the shortest passes share one
const LEVELS = ["full", "brief", "off"];
const STAGES = ["wait", "trace", "denoise", "encode"];

/** [key, name, what it means]: the rows of figures, explained in the page's help. */
export const FIGURES = [
    ["latency", "Camera to picture", "from sending a camera until its picture is drawn, on this page's clock: median and 95th percentile of the last 60"],
    ["server", "Server", "time from asking for this frame until it was encoded: wait, trace, denoise, encode"],
    ["decode", "Decoding", "time this page took to decode the newest frame"],
    ["shown", "Arrival to screen", "from the newest frame's arrival until it was drawn, decoding included"],
    ["network", "Round trip", "a ping to the server and back, median of the last two minutes"],
    ["picture", "Picture", "size and format of the newest frame"],
    ["traffic", "Traffic", "size of the newest frame, and bytes received a second"],
    ["error", "Error", "relMSE = mean((x − r)² / (r² + 0.01)) of the picture; how it is known is said beside it"],
    ["samples", "Samples", "paths a pixel in this picture since camera or settings last changed"],
    ["bad", "Bad values", "NaN, infinite, negative and clamped values met while drawing, by stage where there are any; 0 in a healthy picture"],
];

/** The words for what a frame's flags say. */
export function stateOf({ flags }) {
    if (flags.converged)
        return flags.lossless ? "Final, lossless" : "Final";
    return flags.still ? "Refining" : "Moving";
}

/** A picture traced at less than its full size says so. */
function sizeWords({ width, height, full_width, full_height, format }) {
    const whole = width === full_width && height === full_height;
    return `${width} × ${height}${whole ? "" : ` of ${full_width} × ${full_height}`} ${FORMAT_NAMES[format]}`;
}

function errorWords(header) {
    const error = errorOf(header);
    return error ? `${errorNumber(error.value)} ${error.measured ? "measured" : "predicted"}` : "";
}

function passRow(name) {
    const [time, fill] = [element("td"), element("span", { className: "fill" })];
    const track = element("td", { className: "track", "aria-hidden": "true" }, fill);
    return { time, fill, row: element("tr", {}, element("th", { scope: "row" }, name), time, track) };
}

/** A row a stage that met bad values; kinds that none met have no column. */
function badTable(stages) {
    const kinds = KINDS.filter((kind) => stages.some((stage) => stage[kind] > 0));
    const cells = (texts) => texts.map((text) => element("td", {}, text));
    return [element("caption", {}, "Pixels with bad values, by stage"),
        element("thead", {}, element("tr", {}, element("th", { scope: "row" }, "stage"), ...kinds.map((kind) => element("th", { scope: "col" }, kind)))),
        element("tbody", {}, ...stages.map((stage) => element("tr", {}, element("th", { scope: "row" }, stage.name), ...cells(kinds.map((kind) => String(stage[kind]))))))];
}

/** At most MOST_PASSES rows in the order of execution; the shortest passes are summed up in the last. */
export function passRows(passes) {
    if (passes.length <= MOST_PASSES)
        return passes;
    const kept = new Set([...passes].sort((a, b) => b.ms - a.ms).slice(0, MOST_PASSES - 1));
    const rest = passes.filter((pass) => !kept.has(pass));
    return [...passes.filter((pass) => kept.has(pass)), { name: `${rest.length} others`, ms: rest.reduce((sum, { ms }) => sum + ms, 0) }];
}

/** A figure to be read from afar, with its unit below. */
function bigFigure(key, unit) {
    const [value, below] = [element("b", { "data-stat": key }, "–"), element("span", {}, unit)];
    return { value, below, node: element("div", {}, value, below) };
}

export class Overlay {
    #root; #state; #rate; #late; #cells = {}; #bar = {}; #legend = {}; #passes; #graph; #bad;
    #passNames = null; #passRows = [];
    #frame = null; #statistics;
    #timer; #drawnAt = -Infinity;

    constructor(root, statistics) {
        this.#root = root;
        this.#statistics = statistics;
        this.#state = element("strong", { className: "state" }, "Waiting for a picture");
        this.#rate = bigFigure("rate", "frames/s");
        this.#late = bigFigure("late", "ms camera to picture");
        const rows = FIGURES.map(([key, name]) => {
            this.#cells[key] = element("td", { "data-stat": key }, "–");
            return element("tr", { "data-row": key }, element("th", { scope: "row" }, name), this.#cells[key]);
        });
        const bar = element("div", { className: "bar", "aria-hidden": "true" });
        const legend = element("p", { className: "legend" });
        for (const stage of STAGES) {
            bar.append(this.#bar[stage] = element("span", { className: stage }));
            this.#legend[stage] = element("b", {}, "–");
            legend.append(element("span", { className: stage }, `${stage} `, this.#legend[stage]));
        }
        this.#graph = element("canvas", { width: 240, height: 32, role: "img", "aria-label": "Camera-to-picture latency of the last 60 moves" });
        this.#passes = element("tbody");
        this.#bad = element("table", { className: "stages-met", hidden: true });
        root.append(this.#state, element("div", { className: "headline" }, this.#rate.node, this.#late.node), this.#graph, element("table", { className: "figures" }, element("tbody", {}, ...rows)), this.#bad,
            element("div", { className: "stages" }, bar, legend),
            element("table", { className: "passes" }, element("caption", {}, "Milliseconds per pass"), this.#passes));
        this.level = "full";
    }

    get level() {
        return this.#root.dataset.level;
    }

    set level(level) {
        this.#root.dataset.level = level;
        this.#root.hidden = level === "off";
    }

    cycle() {
        this.level = LEVELS[(LEVELS.indexOf(this.level) + 1) % LEVELS.length];
    }

    /** A frame was shown: draws its figures, now or when the last ones have been readable for a while. */
    show(frame) {
        this.#frame = frame;
        clearTimeout(this.#timer);
        const wait = this.#drawnAt + REFRESH_MS - performance.now();
        if (wait <= 0)
            this.#draw();
        else
            this.#timer = setTimeout(() => this.#draw(), wait);
    }

    #draw() {
        this.#drawnAt = performance.now();
        const { header, stages, passes, bytes, decodeMs, shownMs } = this.#frame;
        const times = STAGES.map((stage) => header[`${stage}_us`] / 1000);
        const total = times.reduce((sum, time) => sum + time, 0);
        const latency = this.#statistics.latency();
        const rate = this.#statistics.rate(this.#drawnAt);
        const done = header.flags.converged;
        this.#state.textContent = stateOf(header);
        this.#state.dataset.state = done ? "final" : header.flags.still ? "refining" : "moving";
        this.#rate.value.textContent = done ? "–" : fixed(rate.frames);
        this.#rate.below.textContent = done ? "at rest" : "frames/s";
        this.#late.value.textContent = fixed(latency.median, 0);
        const figures = {
            latency: latency.count ? `${fixed(latency.median, 0)} ms, p95 ${fixed(latency.p95, 0)} ms` : "move the camera",
            server: `${fixed(total)} ms`,
            decode: `${fixed(decodeMs)} ms`,
            shown: `${fixed(shownMs)} ms`,
            network: `${fixed(this.#statistics.roundTrip())} ms`,
            picture: sizeWords(header),
            traffic: bytesShort(bytes) + (done ? "" : `, ${bytesShort(rate.bytes)}/s`),
            error: errorWords(header),
            samples: `${header.accumulated_samples} a pixel`,
            bad: String(badValues(header)),
        };
        for (const [key, text] of Object.entries(figures))
            this.#cells[key].textContent = text;
        this.#cells.error.parentElement.hidden = figures.error === "";
        this.#cells.bad.classList.toggle("bad", wrongValues(header) !== 0);
        this.#cells.bad.classList.toggle("cut", wrongValues(header) === 0 && badValues(header) !== 0);
        this.#bad.hidden = stages.length === 0;
        this.#bad.replaceChildren(...(stages.length ? badTable(stages) : []));
        STAGES.forEach((stage, i) => {
            this.#bar[stage].style.flexGrow = times[i];
            this.#legend[stage].textContent = fixed(times[i]);
        });
        this.#drawPasses(passRows(passes));
        this.#drawGraph();
    }

    #drawPasses(passes) {
        const longest = Math.max(...passes.map(({ ms }) => ms), 1e-3);
        const names = passes.map(({ name }) => name).join("\n");
        if (names !== this.#passNames) {
            this.#passNames = names;
            this.#passRows = passes.map(({ name }) => passRow(name));
            this.#passes.replaceChildren(...this.#passRows.map(({ row }) => row));
        }
        passes.forEach(({ ms }, i) => {
            this.#passRows[i].time.textContent = fixed(ms, 2);
            this.#passRows[i].fill.style.width = `${100 * ms / longest}%`;
        });
    }

    #drawGraph() {
        const { latencies } = this.#statistics;
        const context = this.#graph.getContext("2d");
        const { width, height } = this.#graph;
        const highest = Math.max(...latencies, 1);
        const step = width / 60;
        context.clearRect(0, 0, width, height);
        context.fillStyle = "#ffb454";
        latencies.forEach((value, i) => {
            const bar = Math.max(1, height * value / highest);
            context.fillRect(width - (latencies.length - i) * step, height - bar, step - 1, bar);
        });
    }
}
