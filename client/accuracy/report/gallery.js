// Frames and where they are wrong. A click on any of them, or Enter, shows the reference instead.

const MAPS = [
    ["frame", "the frame, as shown"],
    ["absolute", "|x \u2212 r|, one frame"],
    ["flip", "FLIP, one frame"],
    ["bias", "bias: (mean of the seeds \u2212 r) / (r + 0.01)"],
    ["deviation", "deviation over the seeds"],
];

const SCALE_WORDS = { flip: "", bias: " of luminance" };

function scaleBar({ lower, upper, bar }) {
    return element("div", { class: "scale" }, element("span", {}, number(lower, 2)),
        element("img", { src: bar, alt: "colour scale" }), element("span", {}, number(upper, 2)));
}

/** A picture that a click swaps for the reference and back. */
function comparable(source, reference, alt) {
    const picture = element("img", { src: source, alt, tabindex: "0", role: "button", "aria-pressed": "false" });
    const swap = () => {
        const shows = picture.getAttribute("aria-pressed") === "true";
        picture.setAttribute("aria-pressed", String(!shows));
        picture.src = shows ? source : reference;
    };
    picture.addEventListener("click", swap);
    picture.addEventListener("keydown", (event) => {
        if (event.key === "Enter" || event.key === " ") {
            event.preventDefault();
            swap();
        }
    });
    return picture;
}

function galleryRow(point, gallery) {
    const figures = MAPS.map(([key, caption]) => element("figure", {},
        comparable(point[key], gallery.reference, `${point.label}: ${caption}`), element("figcaption", {}, caption)));
    return element("div", { class: "pictures" }, element("h3", {}, `${point.label}: ${milliseconds(point.ms)}, relMSE ${number(point.relmse)}`), element("div", { class: "row" }, ...figures));
}

function gallerySection(host, gallery) {
    const scales = MAPS.slice(1).map(([key, caption]) =>
        element("div", {}, element("span", { class: "caption" }, `${caption}${SCALE_WORDS[key] ?? ", linear radiance"}`), scaleBar(gallery.scales[key])));
    host.append(element("div", { class: "scales" }, ...scales),
        element("div", { class: "pictures" }, element("h3", {}, "the reference r"), element("div", { class: "row" },
            element("figure", {}, element("img", { src: gallery.reference, alt: "the reference" })))), ...gallery.points.map((point) => galleryRow(point, gallery)));
}
