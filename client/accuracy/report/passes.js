// Stacked milliseconds a pass, a bar for each point of the frontier.

/** Passes that are alike but for their number, as the a-trous ones, are one. */
const passGroup = (name) => name.replace(/\s+\d+$/, "");

const PASS_COLORS = ["#0072b2", "#56b4e9", "#009e73", "#f0e442", "#e69f00", "#d55e00", "#cc79a7", "#777777", "#000000"];

function groupedPasses(point) {
    const groups = new Map();
    for (const { name, ms } of point.passes)
        groups.set(passGroup(name), (groups.get(passGroup(name)) ?? 0) + ms);
    return groups;
}

function passPlot(host, points) {
    const perPoint = points.map(groupedPasses);
    const names = [...new Set(perPoint.flatMap((groups) => [...groups.keys()]))];
    // The topmost series is the sum of all; each next one covers it from below.
    const sums = names.map((_, last) => perPoint.map((groups) => names.slice(0, last + 1).reduce((sum, name) => sum + (groups.get(name) ?? 0), 0)));
    const place = element("div", { class: "plot", role: "img", "aria-label": "milliseconds a pass" });
    host.append(place);
    const color = (at) => PASS_COLORS[at % PASS_COLORS.length];
    const numbers = points.map((_, i) => i + 1);
    const plot = new uPlot({
        ...plotSize(place),
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false, range: [0.4, points.length + 0.6] }, y: { range: (_, __, upper) => [0, 1.05 * upper] } },
        axes: [{ ...axis("point of the frontier (#)", (at) => (Number.isInteger(at) ? `#${at}` : "")), splits: () => numbers },
            { ...axis("time a frame [ms]", String), size: 64 }],
        series: [{}, ...names.map((_, i) => names.length - 1 - i).map((at) => ({
            fill: color(at), stroke: "#ffffff", width: 1, points: { show: false }, paths: uPlot.paths.bars({ size: [0.7, 90] }),
        }))],
    }, [numbers, ...sums.reverse()], place);
    plots.push({ plot, host: place });
    host.append(legend(names.map((name, at) => ({
        text: name,
        draw: (context, x, y, ratio) => {
            context.fillStyle = color(at);
            context.fillRect(x - 8 * ratio, y - 5 * ratio, 16 * ratio, 10 * ratio);
        },
    }))));
}
