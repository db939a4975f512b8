// Error against time, both logarithmic: what this scene's frames may cost and bring, where the newest frame is, and what is aimed for.
import { errorNumber } from "./frontier.js";
import { niceRange } from "./goal_scale.js";
import { shortNumber } from "./dom.js";

/* After Okabe and Ito 2008, "Color Universal Design": told apart with any colour vision. Shapes differ too. */
const BLUE = "#56b4e9", ORANGE = "#e69f00", GREEN = "#009e73", YELLOW = "#f0e442";
const HEIGHT = 190;      // [px]
const WHISKER = 3;       // [px] half of its end
const WIDEST = 12;       // a range this many times what is needed is made narrower again

const MANTISSAS = [1, 2, 5];

/** 1, 2 and 5 times powers of ten within the range; only powers where those are many. */
export function ticks(lower, upper) {
    const decades = Math.log10(upper / lower);
    const mantissas = decades > 4 ? [1] : decades > 2 ? [1, 3] : MANTISSAS;
    const found = [];
    for (let exponent = Math.floor(Math.log10(lower)); exponent <= Math.ceil(Math.log10(upper)); ++exponent)
        found.push(...mantissas.map((mantissa) => Number((mantissa * 10 ** exponent).toPrecision(1))));
    return found.filter((x) => x >= lower * (1 - 1e-9) && x <= upper * (1 + 1e-9));
}

/** A range with room for all `values` above 0; the one from before as long as it fits. */
export function rangeFor(values, before, otherwise) {
    const known = values.filter((value) => value > 0 && Number.isFinite(value));
    if (known.length === 0)
        return before ?? otherwise;
    const [least, most] = [Math.min(...known), Math.max(...known)];
    const now = niceRange(least / 1.3, most * 1.3);
    const fits = before && before[0] <= least && before[1] >= most && before[1] / before[0] <= WIDEST * now[1] / now[0];
    return fits ? before : now;
}

export class FrontierPlot {
    #node; #pointed;
    #plot = null;
    #points = []; #untold = []; #live = null; #trail = []; #measured = null; #target = null;
    #x = null; #y = null;

    /** `node` holds the plot; `pointed(point)` tells which of the frontier's points is pointed at, null: none. */
    constructor(node, pointed) {
        this.#node = node;
        this.#pointed = pointed;
        new ResizeObserver(() => this.#fit()).observe(node);
    }

    /** `live` and `trail` are {ms, error, still}, `measured` is {ms, error, lower, upper} or null, `target` is {kind, value} or null, `describe` the words for who cannot see it. */
    show({ points, live, trail, measured, target }, describe) {
        this.#points = points.filter(({ error }) => error > 0);
        this.#untold = points.filter(({ error }) => !(error > 0));
        [this.#live, this.#trail, this.#measured, this.#target] = [live, trail, measured, target];
        const wanted = (kind) => (target?.kind === kind ? [target.value] : []);
        const seen = [...trail, live, measured].filter(Boolean);
        this.#x = rangeFor([...points, ...seen].map(({ ms }) => ms).concat(wanted("time")), this.#x, [10, 100]);
        this.#y = rangeFor([...this.#points.flatMap(({ error, lower, upper }) => [error, lower, upper]), ...seen.map(({ error }) => error), ...wanted("accuracy")], this.#y, [1e-3, 0.1]);
        this.#node.setAttribute("aria-label", describe);
        this.#plot?.setData(this.#columns());
    }

    #columns() {
        return [this.#points.map(({ ms }) => ms), this.#points.map(({ error }) => error)];
    }

    #fit() {
        const width = this.#node.clientWidth;
        if (width === 0 || !globalThis.uPlot)
            return;
        if (this.#plot)
            this.#plot.setSize({ width, height: HEIGHT });
        else
            this.#plot = new globalThis.uPlot(this.#options(width), this.#columns(), this.#node);
    }

    #options(width) {
        const colour = (name) => getComputedStyle(this.#node).getPropertyValue(name).trim();
        const axis = (label, size, format) => ({
            label, size, labelSize: 18, labelGap: 0, gap: 6, font: "11px system-ui, sans-serif", labelFont: "11px system-ui, sans-serif",
            stroke: colour("--quiet"), grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false },
            splits: (plot, index, lower, upper) => ticks(lower, upper), filter: (plot, splits) => splits, values: (plot, splits) => splits.map(format),
        });
        return {
            width, height: HEIGHT, padding: [8, 12, 0, 0], legend: { show: false },
            cursor: { drag: { x: false, y: false }, y: false, points: { size: 11 } },
            scales: { x: { time: false, distr: 3, range: () => this.#x ?? [10, 100] }, y: { distr: 3, range: () => this.#y ?? [1e-3, 0.1] } },
            axes: [axis("ms a frame, tracing and denoising", 26, shortNumber), axis("error (relMSE)", 40, (value) => errorNumber(value, 1))],
            series: [{}, { stroke: BLUE, width: 2, points: { show: true, size: 7, fill: BLUE, stroke: BLUE } }],
            hooks: {
                draw: [(plot) => this.#drawAbove(plot)],
                setCursor: [(plot) => this.#pointed(this.#points[plot.cursor.idx] ?? null)],
            },
        };
    }

    #drawAbove(plot) {
        const { ctx: context, bbox } = plot;
        const ratio = devicePixelRatio;
        const at = ({ ms, error }) => [plot.valToPos(ms, "x", true), plot.valToPos(error, "y", true)];
        context.save();
        context.beginPath();
        context.rect(bbox.left, bbox.top, bbox.width, bbox.height);
        context.clip();
        this.#drawWhiskers(context, at, ratio, bbox.top + bbox.height);
        this.#drawTarget(context, plot, ratio);
        this.#trail.forEach((point, i) => {
            context.globalAlpha = 0.25 + 0.4 * i / this.#trail.length;
            mark(context, at(point), 2 * ratio, point.still);
        });
        context.globalAlpha = 1;
        if (this.#measured)
            this.#drawMeasured(context, at, ratio);
        if (this.#live)
            mark(context, at(this.#live), 5.5 * ratio, this.#live.still, "#fff");
        context.restore();
    }

    #drawWhiskers(context, at, ratio, bottom) {
        context.strokeStyle = BLUE;
        context.lineWidth = 1.5 * ratio;
        context.beginPath();
        for (const point of this.#points.filter(({ lower, upper }) => lower < upper))
            this.#traceWhisker(context, at, ratio, point);
        for (const { ms } of this.#untold) { // its error is not known yet: a mark on the axis
            const x = at({ ms, error: this.#y[0] })[0];
            context.moveTo(x, bottom);
            context.lineTo(x, bottom - 8 * ratio);
        }
        context.stroke();
    }

    #traceWhisker(context, at, ratio, { ms, lower, upper }) {
        const [[x, low], [, high]] = [at({ ms, error: Math.max(lower, this.#y[0] / 10) }), at({ ms, error: upper })];
        context.moveTo(x, low);
        context.lineTo(x, high);
        for (const y of [low, high]) {
            context.moveTo(x - WHISKER * ratio, y);
            context.lineTo(x + WHISKER * ratio, y);
        }
    }

    #drawMeasured(context, at, ratio) {
        context.strokeStyle = GREEN;
        context.lineWidth = 2 * ratio;
        context.beginPath();
        this.#traceWhisker(context, at, ratio, this.#measured);
        traceDiamond(context, at(this.#measured), 5 * ratio);
        context.stroke();
    }

    #drawTarget(context, plot, ratio) {
        if (!this.#target)
            return;
        const { left, top, width, height } = plot.bbox;
        const upright = this.#target.kind === "time";
        const at = plot.valToPos(this.#target.value, upright ? "x" : "y", true);
        context.strokeStyle = YELLOW;
        context.lineWidth = 1.5 * ratio;
        context.setLineDash([5 * ratio, 4 * ratio]);
        context.beginPath();
        context.moveTo(upright ? at : left, upright ? top : at);
        context.lineTo(upright ? at : left + width, upright ? top + height : at);
        context.stroke();
        context.setLineDash([]);
    }
}

function traceDiamond(context, [x, y], size) {
    context.moveTo(x, y - size);
    context.lineTo(x + size, y);
    context.lineTo(x, y + size);
    context.lineTo(x - size, y);
    context.closePath();
}

/** A picture at rest is a diamond, a moving one a disc. */
function mark(context, [x, y], size, still, outline) {
    context.fillStyle = still ? GREEN : ORANGE;
    context.beginPath();
    if (still)
        traceDiamond(context, [x, y], 1.25 * size);
    else
        context.arc(x, y, size, 0, 2 * Math.PI);
    context.fill();
    if (outline) {
        context.strokeStyle = outline;
        context.lineWidth = size / 4;
        context.stroke();
    }
}
