// Elements from a tag, properties and children; and the few texts that several parts of the page share.

/** `properties` with a dash, and `role` and `for`, are attributes; the others are set on the element. */
export function element(tag, properties = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(properties)) {
        if (name.includes("-") || name === "role" || name === "for")
            made.setAttribute(name, value);
        else
            made[name] = value;
    }
    made.append(...children);
    return made;
}

/** svgf_moments_alpha -> "SVGF moments alpha": what cannot be spoken is an abbreviation. */
export function title(key) {
    const words = key.replaceAll("_", " ").replace(/\b[^aeiouy\W\d]{2,}\b/g, (word) => word.toUpperCase());
    return words.charAt(0).toUpperCase() + words.slice(1);
}

/** At least three significant digits without an exponent or trailing zeros; "–" when there is no number. */
export function shortNumber(value) {
    if (!Number.isFinite(value))
        return "–";
    return Math.abs(value) >= 100 ? String(Math.round(value)) : String(Number(value.toPrecision(3)));
}

/** Always `digits` behind the point, so that a column of numbers does not jump about. */
export const fixed = (value, digits = 1) => (Number.isFinite(value) ? value.toFixed(digits) : "–");

/** Bytes as kB or MB, powers of ten. */
export function bytesShort(bytes) {
    return bytes >= 1e6 ? `${fixed(bytes / 1e6)} MB` : `${fixed(bytes / 1e3)} kB`;
}
