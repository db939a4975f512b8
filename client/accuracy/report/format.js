// Numbers as people read them.

/** Three significant digits, no exponent between 0.001 and 10000; "-" for what is not there. */
function number(value, digits = 3) {
    if (value === undefined || value === null || !Number.isFinite(value))
        return "\u2013";
    const size = Math.abs(value);
    if (size !== 0 && (size < 1e-3 || size >= 1e5))
        return value.toExponential(digits - 1).replace("e-", "e\u2212").replace("e+", "e");
    return String(Number(value.toPrecision(digits))).replace("-", "\u2212");
}

const milliseconds = (value) => (value >= 10000 ? `${number(value / 1000)} s` : `${number(value)} ms`);

const percent = (share) => `${number(100 * share, 2)}\u00a0%`;

/** "0.0023 (0.0022 to 0.0025)" of the keys `name`, `name`_lower and `name`_upper. */
function withInterval(row, name) {
    const [lower, upper] = [row[`${name}_lower`], row[`${name}_upper`]];
    return `${number(row[name])} (${number(lower)} to ${number(upper)})`;
}

/** A tick of a logarithmic axis: 0.01, 1, 100, and powers beyond. */
function tick(value) {
    if (value === null)
        return "";
    const [digits, exponent] = value.toExponential(0).split("e").map(Number);
    return exponent >= -3 && exponent <= 4 ? String(Number(value.toPrecision(1))) : `${digits}e${exponent}`.replace("-", "\u2212");
}
