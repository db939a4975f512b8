// Colours that everybody can tell apart (Okabe and Ito 2008), and shapes for who prints in grey.
const COLORS = {
    black: "#000000", orange: "#e69f00", sky: "#56b4e9", green: "#009e73",
    blue: "#0072b2", vermilion: "#d55e00", purple: "#cc79a7", grey: "#777777",
};
const SERIES_COLORS = [COLORS.vermilion, COLORS.purple, COLORS.orange, COLORS.sky];
const SERIES_SHAPES = ["square", "triangle", "diamond", "cross"];

/** Colour and shape of a denoiser; raw samples are blue circles, averaged frames black rings. */
function lookOf(denoiser, denoisers) {
    if (denoiser === "none")
        return { color: COLORS.blue, shape: "circle" };
    if (denoiser === "averaging")
        return { color: COLORS.black, shape: "ring" };
    const at = denoisers.filter((name) => name !== "none").indexOf(denoiser);
    return { color: SERIES_COLORS[at % SERIES_COLORS.length], shape: SERIES_SHAPES[at % SERIES_SHAPES.length] };
}

/** Adds the shape's outline around (x, y) to the context's path; `r` is half its size. */
function tracePath(context, shape, x, y, r) {
    context.beginPath();
    if (shape === "circle" || shape === "ring")
        context.arc(x, y, r, 0, 2 * Math.PI);
    else if (shape === "square")
        context.rect(x - 0.9 * r, y - 0.9 * r, 1.8 * r, 1.8 * r);
    else
        polygonOf(shape).forEach(([px, py], i) => (i ? context.lineTo(x + px * r, y + py * r) : context.moveTo(x + px * r, y + py * r)));
    context.closePath();
}

function polygonOf(shape) {
    if (shape === "triangle")
        return [[0, -1.15], [1.1, 0.85], [-1.1, 0.85]];
    if (shape === "diamond")
        return [[0, -1.2], [1.2, 0], [0, 1.2], [-1.2, 0]];
    return [[-1, -0.4], [-0.4, -1], [0, -0.5], [0.4, -1], [1, -0.4], [0.5, 0], [1, 0.4], [0.4, 1], [0, 0.5], [-0.4, 1], [-1, 0.4], [-0.5, 0]];
}

function drawMarker(context, { shape, color, size, faded }, x, y, ratio) {
    context.save();
    context.globalAlpha = faded ? 0.35 : 1;
    tracePath(context, shape, x, y, size * ratio);
    context.lineWidth = 1.5 * ratio;
    context.strokeStyle = color;
    context.fillStyle = shape === "ring" ? "#ffffff" : color;
    context.fill();
    context.stroke();
    context.restore();
}
