// Quick buttons for the buffers behind the picture that tell of its accuracy, and the scale of each one's colours.
import { element } from "./dom.js";

/* Colour scales, dark to bright, as the server's shaders draw them. */
const HEAT = ["#000000", "#ff0000", "#ffff00", "#ffffff"];
const CIVIDIS = ["#00224e", "#424e6c", "#7c7b78", "#b9ac6b", "#fee837"];
const MAGMA = ["#000004", "#51127c", "#b73779", "#fc8961", "#fcfdbf"];
const GREY = ["#000000", "#ffffff"];
/** How bad values are painted: as shaders/shared/bad_values.h has it, which a test compares. */
export const BAD_COLOURS = { NaN: "#d55e00", infinite: "#f0e442", negative: "#56b4e9", clamped: "#cc79a7" };

/** What a button asks the setting `view` for. `scale`: its colours, what the ends stand for, and what is shown; `kinds`: what each colour stands for. */
export const VIEWS = [
    { view: "final", name: "Picture" },
    { view: "predicted_deviation", name: "Predicted deviation", scale: { colours: HEAT, ends: ["0", "0.5"], shows: "standard deviation of each pixel's noise, as a share of its brightness" } },
    { view: "measured_error", name: "Measured error", scale: { colours: HEAT, ends: ["0", "0.5"], shows: "distance of each pixel from the reference, as a share of its brightness" } },
    { view: "flip", name: "FLIP", scale: { colours: MAGMA, ends: ["0", "1"], shows: "difference from the reference as eyes see it, twice a second" } },
    { view: "history_length", name: "History length", scale: { colours: CIVIDIS, ends: ["0", ({ history_max = "the longest" }) => String(history_max)], shows: "frames that each pixel remembers" } },
    { view: "variance", name: "Variance", scale: { colours: GREY, ends: ["0", "1"], shows: "variance that guides the filter, exposed like the picture" } },
    { view: "bad_values", name: "Bad values", kinds: BAD_COLOURS, shows: "pixels of this frame in which some stage met a value that no healthy frame has" },
    { view: "wipe", name: "Split" },
];

function kindList(kinds) {
    return element("ul", { className: "kinds" }, ...Object.entries(kinds).map(([kind, colour]) => {
        const patch = element("span", { className: "patch", "aria-hidden": "true" });
        patch.style.background = colour;
        return element("li", {}, patch, kind);
    }));
}

export class Views {
    #buttons; #legend; #ask;
    #inputs = new Map();

    /** `buttons` gets a radio button for each view; `legend` lies over the picture; `ask(key, value)` asks for a setting. */
    constructor(buttons, legend, ask) {
        this.#buttons = buttons;
        this.#legend = legend;
        this.#ask = ask;
    }

    /** The server's list of settings: only what it lists can be had. */
    describe(settings) {
        const choices = settings.find(({ key }) => key === "view")?.choices ?? [];
        const offered = VIEWS.filter(({ view }) => choices.includes(view));
        this.#buttons.parentElement.hidden = offered.length < 2;
        this.#inputs = new Map(offered.map(({ view }) => {
            const input = element("input", { type: "radio", name: "quick-view", value: view });
            input.addEventListener("change", () => this.#ask("view", view));
            return [view, input];
        }));
        this.#buttons.replaceChildren(...offered.map(({ view, name }) => element("label", {}, this.#inputs.get(view), element("span", {}, name))));
    }

    /** What holds on the server. */
    update(values) {
        for (const [view, input] of this.#inputs)
            input.checked = view === values.view;
        const shown = VIEWS.find(({ view }) => view === values.view);
        this.#legend.hidden = !shown?.scale && !shown?.kinds;
        if (shown?.kinds)
            this.#legend.replaceChildren(element("b", {}, shown.name), element("span", {}, shown.shows), kindList(shown.kinds));
        if (!shown?.scale)
            return;
        const { colours, ends, shows } = shown.scale;
        const bar = element("span", { className: "ramp", "aria-hidden": "true" });
        bar.style.backgroundImage = `linear-gradient(to right, ${colours.join(", ")})`;
        const [from, to] = ends.map((end) => (typeof end === "function" ? end(values) : end));
        this.#legend.replaceChildren(element("b", {}, shown.name), element("span", {}, shows), element("div", {}, element("span", {}, from), bar, element("span", {}, to)));
    }
}
