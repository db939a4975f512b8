// What the newest picture was drawn with: which programs, the effects compiled into them and why, GPU memory by use.
import { bytesShort, element } from "./dom.js";

const FIRST_MS = 400;     // after something changed: the next frame is drawn by then, or the one after tells
const AGAIN_MS = 2000;    // while people look, or the scene's own programs are still being compiled
const MOST_ROWS = 8;      // of memory; beyond, the smallest share one

const total = (rows) => rows.reduce((sum, { bytes }) => sum + bytes, 0);

/** Each use once, largest first, at most MOST_ROWS; the smallest are summed up in the last. */
export function memoryRows(rows) {
    const uses = new Map();
    for (const { name, bytes } of rows)
        uses.set(name, (uses.get(name) ?? 0) + bytes);
    const sorted = [...uses].map(([name, bytes]) => ({ name, bytes })).sort((a, b) => b.bytes - a.bytes);
    if (sorted.length <= MOST_ROWS)
        return sorted;
    const rest = sorted.slice(MOST_ROWS - 1);
    return [...sorted.slice(0, MOST_ROWS - 1), { name: `${rest.length} others`, bytes: total(rest) }];
}

/** {kind, detail}: which programs drew the newest frame, in words. `asked` is the setting `effects`. */
export function programWords({ general, program, effects }, asked) {
    if (program.length === 0)
        return { kind: "", detail: "No frame has been drawn yet." };
    const called = effects.filter(({ setting }) => !setting).length;
    const known = new Set(effects.map(({ name }) => name));
    const bySettings = program.filter((name) => !known.has(name)).length + effects.length - called;
    const settings = bySettings ? `, and ${bySettings} that ${bySettings === 1 ? "a setting calls" : "settings call"} for` : "";
    if (!general)
        return { kind: "specialised", detail: `Holds the ${called} effects that this scene calls for${settings}; no other is compiled.` };
    return {
        kind: "general",
        detail: `Holds all ${program.length} effects, of which this scene calls for ${called}. `
            + (asked === "general" ? "The setting “effects” asks for it." : "The scene's own program is being compiled and takes over by itself."),
    };
}

function memoryTable(caption, rows) {
    const shown = memoryRows(rows);
    const largest = Math.max(...shown.map(({ bytes }) => bytes), 1);
    return element("table", { className: "memory" }, element("caption", {}, caption, element("b", {}, bytesShort(total(rows)))),
        element("tbody", {}, ...shown.map(({ name, bytes }) => {
            const fill = element("span", { className: "fill" });
            fill.style.width = `${100 * bytes / largest}%`;
            return element("tr", {}, element("th", { scope: "row" }, name), element("td", {}, bytesShort(bytes)),
                element("td", { className: "track", "aria-hidden": "true" }, fill));
        })));
}

export class Inspector {
    #nodes; #ask; #timer;
    #last = null;
    #asked = "auto";

    /** `nodes` are {box (details), word (in its summary), body}; `ask()` sends `inspect`. */
    constructor(nodes, ask) {
        this.#nodes = nodes;
        this.#ask = ask;
        nodes.box.addEventListener("toggle", () => nodes.box.open && this.changed(0));
    }

    get last() {
        return this.#last;
    }

    /** Something may have changed what is compiled or allocated. */
    changed(after = FIRST_MS) {
        clearTimeout(this.#timer);
        this.#timer = setTimeout(() => this.#ask(), after);
    }

    /** What holds on the server. */
    update({ effects }) {
        this.#asked = effects ?? "auto";
        this.changed();
    }

    show(inspection) {
        const before = JSON.stringify(this.#last);
        this.#last = inspection;
        const { kind } = programWords(inspection, this.#asked);
        if (this.#nodes.box.open || kind === "" || (kind === "general" && this.#asked === "auto"))
            this.changed(AGAIN_MS);
        if (before !== JSON.stringify(inspection))
            this.#draw(inspection);
    }

    #draw(inspection) {
        const { effects, program, scene_memory, view_memory } = inspection;
        const { kind, detail } = programWords(inspection, this.#asked);
        const bytes = bytesShort(total(scene_memory) + total(view_memory));
        this.#nodes.word.textContent = [kind, bytes].filter(Boolean).join(", ");
        const called = new Set(effects.map(({ name }) => name));
        const others = program.filter((name) => !called.has(name));
        this.#nodes.body.replaceChildren(
            element("p", { className: "program", "data-kind": kind }, element("strong", {}, kind ? `${kind === "general" ? "General" : "Specialised"} program` : "No program yet"), element("span", {}, detail)),
            element("h3", {}, "Effects this scene and the settings call for"),
            element("dl", { className: "effects" }, ...effects.flatMap(({ name, reason }) =>
                [element("dt", {}, name.replaceAll("_", " ")), element("dd", {}, reason)])),
            ...(others.length ? [element("h3", {}, "Compiled as well"), element("p", { className: "help" }, others.map((name) => name.replaceAll("_", " ")).join(", "))] : []),
            element("h3", {}, "GPU memory"), memoryTable("Scene", scene_memory), memoryTable("This picture", view_memory));
    }
}
