// Unrest at rest, the error after the light has changed, and while lamps move.

function responseTable(response) {
    return table([
        { title: "frame", text: (row) => row.label },
        { title: "flicker", number: true, text: (row) => number(row.flicker) },
        { title: "mean change from frame to frame", number: true, text: (row) => number(row.difference) },
        { title: "lag after the step [frames]", number: true, text: (row) => (row.lag === undefined ? "\u2013" : String(row.lag)) },
    ], response.points, { id: "response-table" });
}

function motionTable({ points, frames }) {
    return table([
        { title: "frame", text: (row) => row.label },
        { title: "flicker about the truth, lamps moving", number: true, text: (row) => number(row.flicker) },
        { title: "relMSE of the last moving frame", number: true, text: (row) => number(row.errors[frames - 1]) },
        { title: "relMSE at the end", number: true, text: (row) => number(row.errors.at(-1)) },
        { title: "lag after they stop [frames]", number: true, text: (row) => String(row.lag) },
    ], points, { id: "motion-table" });
}

/** relMSE of each frame of a sequence: points with errors from frame `first` on. */
function sequencePlot(host, points, { title, x, first, verticals = [] }) {
    const looks = points.map((point, i) => ({
        color: [COLORS.blue, ...SERIES_COLORS, COLORS.green, COLORS.black][i % 7], shape: ["circle", ...SERIES_SHAPES, "ring"][i % 6], size: 3.5,
    }));
    const series = points.map((point, i) => (point.errors ?? []).map((error, at) => ({
        x: first + at, y: error, look: looks[i], label: "", tip: `${point.label}, frame ${first + at}: relMSE ${number(error)}`,
    })));
    logPlot(host, {
        title, linearX: true, x, y: "relMSE (no unit)", markers: series.flat(), verticals,
        lines: series.map((markers, i) => ({ points: markers.map(({ x: at, y }) => [at, y]), color: looks[i].color, width: 1.5 })),
    });
    host.append(legend(points.map((point, i) => ({ text: point.label, draw: (context, px, y, ratio) => drawMarker(context, looks[i], px, y, ratio) }))));
}
