// Elements made from what they hold.

/** element("td", {class: "number"}, "text", child, ...) */
function element(name, attributes = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes))
        made.setAttribute(key, value);
    made.append(...children.filter((child) => child !== null && child !== undefined));
    return made;
}

/** A section of the page with its heading; returns it to be filled. */
function section(id, title, ...children) {
    const made = element("section", { id }, element("h2", {}, title), ...children);
    document.getElementById("report").append(made);
    return made;
}

const paragraph = (...children) => element("p", {}, ...children);

/** columns: [{title, text: row => string, number: true}] */
function table(columns, rows, attributes = {}) {
    const head = element("tr", {}, ...columns.map((column) => element("th", { scope: "col", class: column.number ? "number" : "" }, column.title)));
    const body = rows.map((row) => element("tr", {}, ...columns.map((column) =>
        element("td", { class: column.number ? "number" : "" }, column.text(row)))));
    return element("div", { class: "wide" }, element("table", attributes, element("thead", {}, head), element("tbody", {}, ...body)));
}

/** A legend's entries: [{text, draw(context, x, y, ratio)}] */
function legend(entries) {
    return element("ul", { class: "legend" }, ...entries.map(({ text, draw }) => {
        const ratio = 2;
        const swatch = element("canvas", { width: 26 * ratio, height: 14 * ratio, class: "swatch" });
        draw(swatch.getContext("2d"), 13 * ratio, 7 * ratio, ratio);
        return element("li", {}, swatch, text);
    }));
}
