// A plot on logarithmic axes with markers, whiskers, lines across and words, on top of uPlot's axes.

const PLOT_FONT = "12px system-ui, sans-serif";
const plots = [];

/** Powers of ten, or 1-2-5 steps over less than two decades; around the values with room for words. */
function logRange(values) {
    const usable = values.filter((value) => value > 0 && Number.isFinite(value));
    if (!usable.length)
        return [0.1, 10];
    // From 9.5 to 10 times a power of ten uPlot's ticks never end: their first step rounds to 11 times it.
    const lower = Math.min(...usable) / 1.6;
    const ninth = 9 * 10 ** Math.floor(Math.log10(lower));
    return [Math.min(lower, ninth), Math.max(...usable) * 1.6];
}

function plotSize(host) {
    const width = Math.max(280, Math.floor(host.clientWidth));
    return { width, height: Math.max(300, Math.min(560, Math.round(0.6 * width))) };
}

/** Fits all plots to their places; called when the window or the medium changes. */
function resizePlots() {
    for (const { plot, host } of plots)
        plot.setSize(plotSize(host));
}

function axis(label, format) {
    return {
        label, font: PLOT_FONT, labelFont: `bold ${PLOT_FONT}`, stroke: "#222222", values: (_, ticks) => ticks.map(format),
        grid: { stroke: "#e4e4e4", width: 1 }, ticks: { stroke: "#888888", width: 1 },
    };
}

/**
 * markers: [{x, y, lower, upper, xLower, xUpper, look: {shape, color, size, faded}, label, tip}]
 * lines: [{points: [[x, y]], color, width, dash}], drawn under the markers
 * verticals: [{x, text}], horizontals: [{y, text, color}], stars: [{x, y, text}]
 */
function logPlot(host, { title, x, y, markers, lines = [], verticals = [], horizontals = [], stars = [], linearX = false }) {
    const xs = markers.map((marker) => marker.x);
    // Few seeds make whiskers long: they take at most a decade beyond their marker.
    const ys = markers.flatMap(({ y: at, lower, upper }) => [at, lower > 0 ? Math.max(lower, at / 10) : at, Math.min(upper, 10 * at)]).concat(horizontals.map(({ y: at }) => at));
    const place = element("div", { class: "plot", role: "img", "aria-label": title });
    host.append(place);
    const xRange = linearX ? [Math.min(...xs) - 0.5, Math.max(...xs) + 0.5] : logRange(xs.concat(stars.map((star) => star.x)));
    const yRange = logRange(ys);
    const order = [...new Set(xs)].sort((a, b) => a - b);
    const plot = new uPlot({
        ...plotSize(place),
        legend: { show: false },
        cursor: { drag: { x: false, y: false }, points: { show: false } },
        scales: {
            x: linearX ? { time: false, range: xRange } : { time: false, distr: 3, log: 10, range: xRange },
            y: { distr: 3, log: 10, range: yRange },
        },
        axes: [axis(x, linearX ? (at) => (Number.isInteger(at) ? String(at) : "") : tick), { ...axis(y, tick), size: 64 }],
        // One series for the axes alone; all that is seen is drawn by the hook.
        series: [{}, { show: true, paths: () => null, points: { show: false } }],
        hooks: {
            draw: [(u) => drawAll(u, { markers, lines, verticals, horizontals, stars })],
            setCursor: [(u) => showTip(u, place, markers)],
        },
    }, [order, order.map((at) => markers.find((marker) => marker.x === at).y)], place);
    place.append(element("div", { class: "tip", hidden: "" }));
    plots.push({ plot, host: place });
    return plot;
}

function drawAll(u, { markers, lines, verticals, horizontals, stars }) {
    const context = u.ctx;
    const ratio = uPlot.pxRatio;
    const at = (px, py) => [u.valToPos(px, "x", true), u.valToPos(py, "y", true)];
    context.save();
    context.beginPath();
    context.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    context.clip();
    context.font = `${12 * ratio}px system-ui, sans-serif`;
    drawVerticals(u, context, ratio, verticals);
    horizontals.forEach((line) => drawHorizontal(u, context, ratio, line));
    lines.forEach((line) => drawLine(context, ratio, at, line));
    markers.forEach((marker) => drawWhiskers(context, ratio, at, marker));
    markers.forEach((marker) => drawMarker(context, marker.look, ...at(marker.x, marker.y), ratio));
    markers.filter((marker) => marker.label).forEach((marker) => drawBadge(context, ratio, at, marker));
    stars.forEach((star) => drawStar(u, context, ratio, at, star));
    context.restore();
}

/** Words with a white edge, so that they are read on top of lines. */
function drawWords(context, ratio, text, x, y, color = "#222222") {
    context.lineWidth = 4 * ratio;
    context.strokeStyle = "rgba(255, 255, 255, 0.85)";
    context.strokeText(text, x, y);
    context.fillStyle = color;
    context.fillText(text, x, y);
}

/** Dotted lines; the word of one that stands too near the last one's is left out. */
function drawVerticals(u, context, ratio, verticals) {
    let free = 0;
    context.textAlign = "left";
    for (const { x, text } of [...verticals].sort((a, b) => a.x - b.x)) {
        const left = u.valToPos(x, "x", true);
        context.setLineDash([2 * ratio, 4 * ratio]);
        context.strokeStyle = "#999999";
        context.lineWidth = ratio;
        context.beginPath();
        context.moveTo(left, u.bbox.top);
        context.lineTo(left, u.bbox.top + u.bbox.height);
        context.stroke();
        context.setLineDash([]);
        if (left < free || left + context.measureText(text).width > u.bbox.left + u.bbox.width)
            continue;
        drawWords(context, ratio, text, left + 3 * ratio, u.bbox.top + 13 * ratio, "#666666");
        free = left + context.measureText(text).width + 8 * ratio;
    }
}

function drawHorizontal(u, context, ratio, { y, text, color }) {
    const top = u.valToPos(y, "y", true);
    context.setLineDash([8 * ratio, 5 * ratio]);
    context.strokeStyle = color;
    context.lineWidth = 1.5 * ratio;
    context.beginPath();
    context.moveTo(u.bbox.left, top);
    context.lineTo(u.bbox.left + u.bbox.width, top);
    context.stroke();
    context.setLineDash([]);
    context.textAlign = "left";
    drawWords(context, ratio, text, u.bbox.left + 6 * ratio, top - 5 * ratio, color);
}

function drawLine(context, ratio, at, { points, color, width, dash = [], faded = false }) {
    context.save();
    context.globalAlpha = faded ? 0.4 : 1;
    context.setLineDash(dash.map((length) => length * ratio));
    context.strokeStyle = color;
    context.lineWidth = width * ratio;
    context.lineJoin = "round";
    context.beginPath();
    points.forEach(([x, y], i) => (i ? context.lineTo(...at(x, y)) : context.moveTo(...at(x, y))));
    context.stroke();
    context.restore();
}

function drawWhiskers(context, ratio, at, { x, y, lower, upper, xLower, xUpper, look }) {
    context.save();
    context.globalAlpha = look.faded ? 0.35 : 0.8;
    context.strokeStyle = look.color;
    context.lineWidth = ratio;
    context.beginPath();
    if (upper > 0) {
        const [px, top] = at(x, upper);
        // What reaches down to 0 or below reaches the end of the axis.
        const bottom = lower > 0 ? at(x, lower)[1] : 1e5;
        const cap = 3 * ratio;
        context.moveTo(px - cap, top);
        context.lineTo(px + cap, top);
        context.moveTo(px, top);
        context.lineTo(px, bottom);
        context.moveTo(px - cap, bottom);
        context.lineTo(px + cap, bottom);
    }
    if (xLower > 0) {
        context.moveTo(...at(xLower, y));
        context.lineTo(...at(xUpper, y));
    }
    context.stroke();
    context.restore();
}

function drawBadge(context, ratio, at, { x, y, label }) {
    const [px, py] = at(x, y);
    context.textAlign = "center";
    context.font = `bold ${12 * ratio}px system-ui, sans-serif`;
    drawWords(context, ratio, label, px - 11 * ratio, py + 16 * ratio);
    context.font = `${12 * ratio}px system-ui, sans-serif`;
}

function drawStar(u, context, ratio, at, { x, y, text }) {
    const [px, py] = at(x, y);
    context.strokeStyle = "#000000";
    context.lineWidth = 2 * ratio;
    context.beginPath();
    for (const angle of [0, 1, 2].map((third) => third * Math.PI / 3)) {
        const [dx, dy] = [7 * ratio * Math.cos(angle), 7 * ratio * Math.sin(angle)];
        context.moveTo(px - dx, py - dy);
        context.lineTo(px + dx, py + dy);
    }
    context.stroke();
    const right = px > u.bbox.left + u.bbox.width / 2;
    context.textAlign = right ? "right" : "left";
    drawWords(context, ratio, text, px + (right ? -4 : 4) * ratio, py - 14 * ratio);
}

/** What the marker next to the pointer is, in a box beside it. */
function showTip(u, place, markers) {
    const tip = place.querySelector(".tip");
    const { left, top } = u.cursor;
    if (!tip || left === undefined || left < 0) {
        tip?.setAttribute("hidden", "");
        return;
    }
    const away = (marker) => Math.hypot(u.valToPos(marker.x, "x") - left, u.valToPos(marker.y, "y") - top);
    const nearest = markers.reduce((best, marker) => (away(marker) < away(best) ? marker : best), markers[0]);
    if (!nearest || away(nearest) > 24) {
        tip.setAttribute("hidden", "");
        return;
    }
    tip.textContent = nearest.tip;
    tip.removeAttribute("hidden");
    const x = u.over.offsetLeft + left;
    tip.style.left = `${Math.min(x + 12, place.clientWidth - tip.offsetWidth)}px`;
    tip.style.top = `${u.over.offsetTop + top + 14}px`;
}
