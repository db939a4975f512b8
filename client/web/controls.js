// One setting as a control, made from its description in `welcome.settings`.
import { element, shortNumber, title } from "./dom.js";
import { nearestStop, stopsOf } from "./scale.js";

const MOST_SEGMENTS = 4;  // choices that fit side by side; more become a list
const MOST_LETTERS = 26;  // in all of them together

/** Choices keep the wire's own words, which are also those of the command line. */
const words = (choice) => choice.replaceAll("_", " ");

function segments(setting, ids, change) {
    const box = element("div", { className: "segments", role: "radiogroup", "aria-labelledby": ids.label, "aria-describedby": ids.help });
    const inputs = setting.choices.map((choice) => {
        const input = element("input", { type: "radio", name: ids.control, value: choice });
        input.addEventListener("change", () => change(choice));
        box.append(element("label", {}, input, element("span", {}, words(choice))));
        return input;
    });
    return { node: box, show: (value) => inputs.forEach((input) => { input.checked = input.value === value; }) };
}

function list(setting, ids, change) {
    const select = element("select", { id: ids.control, "aria-describedby": ids.help });
    select.append(...setting.choices.map((choice) => element("option", { value: choice }, words(choice))));
    select.addEventListener("change", () => change(select.value));
    return { node: select, show: (value) => { select.value = value; } };
}

function toggle(setting, ids, change) {
    const input = element("input", { type: "checkbox", id: ids.control, className: "toggle", role: "switch", "aria-describedby": ids.help });
    input.addEventListener("change", () => change(input.checked));
    return { node: input, show: (value) => { input.checked = value; } };
}

function text(setting, ids, change) {
    const input = element("input", { type: "text", id: ids.control, className: "text", spellcheck: false, "aria-describedby": ids.help });
    const show = (value) => {
        if (document.activeElement !== input)
            input.value = value;
    };
    input.addEventListener("change", () => change(input.value)); // the server says so if it is not to be had
    return { node: input, show };
}

function slider(setting, ids, change) {
    const stops = stopsOf(setting);
    const range = element("input", {
        type: "range", id: ids.control, min: 0, max: stops.length - 1, step: 1, "aria-describedby": ids.help,
    });
    const number = element("input", {
        type: "number", min: setting.lower, max: setting.upper, step: setting.type === "integer" ? 1 : "any",
        "aria-labelledby": ids.label,
    });
    const show = (value) => {
        range.value = nearestStop(stops, value);
        range.setAttribute("aria-valuetext", shortNumber(value));
        range.style.setProperty("--filled", `${100 * range.value / Math.max(1, stops.length - 1)}%`);
        if (document.activeElement !== number)
            number.value = value;
    };
    range.addEventListener("input", () => {
        show(stops[range.value]);
        change(stops[range.value]);
    });
    number.addEventListener("change", () => {
        if (number.value !== "")
            change(Number(number.value)); // the server says so if it is out of range
    });
    return { node: element("div", { className: "slider" }, range, number), show };
}

function controlFor(setting) {
    if (setting.type === "choice") {
        const letters = setting.choices.join("").length;
        return setting.choices.length <= MOST_SEGMENTS && letters <= MOST_LETTERS ? segments : list;
    }
    return { boolean: toggle, text }[setting.type] ?? slider;
}

/** The row of one setting: {node, show(value), complain(text)}. `change(value)` asks the server for another value. */
export function settingRow(setting, change) {
    const ids = { control: `setting-${setting.key}`, label: `label-${setting.key}`, help: `help-${setting.key}` };
    const [, unit, help] = /^(?:\[([^\]]*)\]\s*)?(.*)$/s.exec(setting.help ?? "");
    const make = controlFor(setting);
    const control = make(setting, ids, change);

    const name = title(setting.key);
    const label = element(make === segments ? "span" : "label", { id: ids.label, className: "name" }, name);
    if (make !== segments)
        label.htmlFor = ids.control;
    const heading = element("div", { className: "heading" }, label);
    if (unit)
        heading.append(element("span", { className: "unit" }, unit));
    const reset = element("button", {
        type: "button", className: "reset", title: `Reset to ${setting.default}`,
        "aria-label": `Reset ${name} to ${setting.default}`,
    }, "Reset");
    reset.addEventListener("click", () => change(setting.default));
    heading.append(reset);
    const problem = element("p", { className: "problem", role: "alert", hidden: true });
    const node = element("div", { className: "setting", "data-key": setting.key, title: setting.key },
        heading, control.node, element("p", { id: ids.help, className: "help" }, help), problem);
    node.classList.toggle("inline", make === toggle);

    return {
        node,
        show(value) {
            control.show(value);
            reset.hidden = value === setting.default;
            node.classList.toggle("changed", value !== setting.default);
            problem.hidden = true;
        },
        complain(text) {
            problem.textContent = text;
            problem.hidden = false;
        },
    };
}
