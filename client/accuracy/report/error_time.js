// Error against time: every point, the frontier, averaged frames, what they tend to.

const FRAME_RATES = [60, 30, 10, 1];

function markerOf(point, key, denoisers, frontier) {
    const denoiser = point.settings.denoiser;
    const onFrontier = frontier.includes(point);
    return {
        x: point.ms, y: point[key], xLower: point.ms_lower, xUpper: point.ms_upper,
        lower: point[`${key}_lower`], upper: point[`${key}_upper`],
        look: { ...lookOf(denoiser, denoisers), size: onFrontier ? 5.5 : 4, faded: !onFrontier },
        label: point.frontier ? String(point.frontier) : "",
        tip: `${point.label}: ${milliseconds(point.ms)}, ${key === "flip" ? "FLIP" : "relMSE"} ${number(point[key])}`
            + (point.reference_limited ? "; too near the reference's own noise" : ""),
    };
}

function averagedMarker(point, key) {
    return {
        x: point.ms, y: point[key], lower: point[`${key}_lower`], upper: point[`${key}_upper`],
        look: { ...lookOf("averaging"), size: 3.5, faded: point.reference_limited }, label: "",
        tip: `mean of ${point.frames} raw frames: ${milliseconds(point.ms)}, ${key === "flip" ? "FLIP" : "relMSE"} ${number(point[key])}`,
    };
}

/** The denoiser's ladder of samples: all else as the sweep's base. */
function ladder(report, denoiser) {
    const others = Object.keys(report.base).filter((key) => !["denoiser", "samples_per_pixel"].includes(key));
    return report.points
        .filter((point) => point.settings.denoiser === denoiser && others.every((key) => point.settings[key] === report.base[key]))
        .sort((a, b) => a.settings.samples_per_pixel - b.settings.samples_per_pixel);
}

const denoisersOf = (report) => [...new Set(report.points.map((point) => point.settings.denoiser))];

/** error = rate / time through the averaged frames, over the plot's width. */
function slopeGuide(report, markers) {
    const rate = report.averaging.rate;
    const xs = markers.map((marker) => marker.x);
    return rate ? [{ points: [Math.min(...xs) / 2, Math.max(...xs) * 2].map((x) => [x, rate / x]), color: COLORS.grey, width: 1.5, dash: [2, 4] }] : [];
}

/** Denoisers whose error tends to more than nothing. */
const floorsOf = (report) => report.fits.filter((fit) => fit.floor > 0 && fit.denoiser !== "none");

const floorWords = (fit) => (fit.floor_is_measured ? "bias floor" : "fitted floor");

function errorLegend(report, denoisers, withFits) {
    const marker = (name) => (context, x, y, ratio) => drawMarker(context, { ...lookOf(name, denoisers), size: 4.5 }, x, y, ratio);
    const line = (color, width, dash) => (context, x, y, ratio) =>
        drawLine(context, ratio, (px, py) => [px, py], { points: [[2, y], [2 * x - 2, y]], color, width, dash });
    const entries = denoisers.map((name) => ({ text: name === "none" ? "raw samples (none)" : name, draw: marker(name) }));
    entries.push({ text: "mean of raw frames (accumulate)", draw: marker("averaging") });
    entries.push({ text: "frontier; what it beats is faded. Numbers are those of the price list", draw: line(COLORS.green, 4) });
    if (withFits) {
        entries.push({ text: "slope \u22121: half the error for twice the time", draw: line(COLORS.grey, 1.5, [2, 4]) });
        const floor = line(COLORS.vermilion, 1.5, [8, 5]);
        if (floorsOf(report).some((fit) => fit.floor_is_measured))
            entries.push({ text: "bias floor: bias\u00b2 at the denoiser's most samples", draw: floor });
        if (floorsOf(report).some((fit) => !fit.floor_is_measured))
            entries.push({ text: "fitted floor: b\u00b2 of b\u00b2 + c / t, where seeds show no bias", draw: floor });
    }
    return legend(entries);
}

/** key: relmse or flip */
function errorTimePlot(host, report, key, frontier) {
    const denoisers = denoisersOf(report);
    const isRelMse = key === "relmse";
    const usable = report.points.filter((point) => point[key] > 0);
    const averaged = report.averaging.points.filter((point) => point[key] > 0);
    const markers = usable.map((point) => markerOf(point, key, denoisers, frontier)).concat(averaged.map((point) => averagedMarker(point, key)));
    markers.sort((a, b) => Number(b.look.faded) - Number(a.look.faded)); // bold ones on top
    const toPoints = (points) => points.filter((point) => point[key] > 0).map((point) => [point.ms, point[key]]);
    const lines = denoisers.map((name) => ({ points: toPoints(ladder(report, name)), color: lookOf(name, denoisers).color, width: 1.5, faded: true }));
    lines.push({ points: toPoints(averaged), color: COLORS.black, width: 1 });
    if (isRelMse)
        lines.push(...slopeGuide(report, markers));
    lines.push({ points: toPoints(frontier), color: COLORS.green, width: 4, faded: false });
    const floors = isRelMse ? floorsOf(report) : [];
    const [from, to] = logRange(markers.map((marker) => marker.x));
    logPlot(host, {
        title: `${isRelMse ? "relMSE" : "FLIP"} against time a frame, both logarithmic`,
        x: "time a frame [ms], all passes", y: isRelMse ? "relMSE (no unit)" : "mean FLIP (no unit, 0 to 1)", markers, lines,
        verticals: FRAME_RATES.map((rate) => ({ x: 1000 / rate, text: `${rate} fps` })).filter(({ x }) => x > from && x < to),
        horizontals: floors.map((fit) => ({ y: fit.floor, text: `${floorWords(fit)} of ${fit.denoiser}: ${number(fit.floor, 2)}`, color: lookOf(fit.denoiser, denoisers).color })),
        stars: floors.filter((fit) => fit.crossing_ms).map((fit) => ({
            x: fit.crossing_ms, y: fit.crossing_relmse, text: `t* = ${milliseconds(fit.crossing_ms)}`,
        })),
    });
    host.append(errorLegend(report, denoisers, isRelMse));
}
