// The tables: prices, techniques, effects, the classic comparison, all points.

function priceTable(report) {
    return table([
        { title: "#", number: true, text: (row) => String(row.from) },
        { title: "from here", text: (row) => row.label },
        { title: "time [ms]", number: true, text: (row) => number(row.ms) },
        { title: "relMSE", number: true, text: (row) => number(row.relmse) },
        { title: "to halve the error", number: true, text: (row) => (row.to ? `+${number(row.extra_ms)} ms (to #${row.to}, error / ${number(row.factor, 2)})` : "not within this sweep") },
        { title: "by", text: (row) => row.by ?? "\u2013" },
        { title: "or by averaging while nothing moves", number: true, text: (row) => (row.averaging_ms ? milliseconds(row.averaging_ms) : "\u2013") },
    ], report.prices, { id: "prices-table" });
}

function techniqueTable(report) {
    const at = (index) => report.points[index];
    const sign = (value) => `${value >= 0 ? "+" : ""}${number(value, 2)}`;
    return table([
        { title: "technique", text: (row) => row.name },
        { title: "compared with", text: (row) => `${at(row.without).label}` },
        { title: "costs [ms]", number: true, text: (row) => sign(at(row.with).ms - at(row.without).ms) },
        { title: "relMSE without", number: true, text: (row) => withInterval(at(row.without), "relmse") },
        { title: "relMSE with", number: true, text: (row) => withInterval(at(row.with), "relmse") },
        { title: "error divided by", number: true, text: (row) => number(at(row.without).relmse / at(row.with).relmse) },
    ], report.techniques, { id: "techniques-table" });
}

/** Why an effect could not be left out, where the server said. */
const refusals = (effects) => effects.rows.filter((row) => row.refused).map((row) => `${row.effect}: ${row.refused}.`).join(" ");

function effectTable(effects) {
    const measured = (row) => row.ratio !== undefined;
    return table([
        { title: "effect", text: (row) => row.effect },
        { title: "the scene has it because of", text: (row) => row.reason },
        { title: "with [ms]", number: true, text: (row) => number(row.ms_with) },
        { title: "without [ms]", number: true, text: (row) => number(row.ms_without) },
        { title: "time, with / without", number: true, text: (row) => (measured(row) ? withInterval(row, "ratio") : row.refused ? "see below" : "not measured alone") },
        { title: "noise of 1 raw sample, with", number: true, text: (row) => number(row.noise_with) },
        { title: "without", number: true, text: (row) => number(row.noise_without) },
    ], effects.rows, { id: "effects-table" });
}

function classicTable(report) {
    return table([
        { title: "frame", text: (row) => row.label },
        { title: "frames a second", number: true, text: (row) => number(row.frames_per_second) },
        { title: "time [ms]", number: true, text: (row) => number(row.ms) },
        { title: "relMSE", number: true, text: (row) => withInterval(row, "relmse") },
        { title: "FLIP", number: true, text: (row) => number(row.flip) },
    ], report.classic, { id: "classic-table" });
}

function pointTable(report) {
    return table([
        { title: "point", text: (row) => row.label + (row.reference_limited ? " \u2020" : "") },
        { title: "frontier", number: true, text: (row) => (row.frontier ? `#${row.frontier}` : "") },
        { title: "time [ms]", number: true, text: (row) => withInterval(row, "ms") },
        { title: "relMSE", number: true, text: (row) => withInterval(row, "relmse") },
        { title: "of it bias\u00b2", number: true, text: (row) => withInterval(row, "bias") },
        { title: "of it noise", number: true, text: (row) => withInterval(row, "variance") },
        { title: "relMSE 99.9", number: true, text: (row) => number(row.relmse999) },
        { title: "FLIP", number: true, text: (row) => number(row.flip) },
        { title: "fireflies [px]", number: true, text: (row) => number(row.fireflies) },
        { title: "encode [ms]", number: true, text: (row) => number(row.encode_ms, 2) },
    ], [...report.points].sort((a, b) => a.ms - b.ms), { id: "points-table" });
}
