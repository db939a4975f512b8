// Unrest at rest, and the error after the light has changed.

function responseTable(response) {
    return table([
        { title: "frame", text: (row) => row.label },
        { title: "flicker", number: true, text: (row) => number(row.flicker) },
        { title: "mean change from frame to frame", number: true, text: (row) => number(row.difference) },
        { title: "lag after the step [frames]", number: true, text: (row) => (row.lag === undefined ? "\u2013" : String(row.lag)) },
    ], response.points, { id: "response-table" });
}

/** relMSE of each frame after the step, against the reference of the new light. */
function responsePlot(host, response) {
    const looks = response.points.map((point, i) => ({
        color: [COLORS.blue, ...SERIES_COLORS, COLORS.green, COLORS.black][i % 7], shape: ["circle", ...SERIES_SHAPES, "ring"][i % 6], size: 3.5,
    }));
    const series = response.points.map((point, i) => (point.errors ?? []).map((error, frame) => ({
        x: frame, y: error, look: looks[i], label: "", tip: `${point.label}, ${frame} frames after the step: relMSE ${number(error)}`,
    })));
    logPlot(host, {
        title: "relMSE after the light has changed", linearX: true, x: "frames after the step", y: "relMSE (no unit)", markers: series.flat(),
        lines: series.map((markers, i) => ({ points: markers.map(({ x, y }) => [x, y]), color: looks[i].color, width: 1.5 })),
    });
    host.append(legend(response.points.map((point, i) => ({ text: point.label, draw: (context, x, y, ratio) => drawMarker(context, looks[i], x, y, ratio) }))));
}
