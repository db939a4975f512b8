// The stops of a slider for a setting of any range, so that each step of it is a round number and does something.

const WIDE = 20;       // a range this many times the default's distance from its start wants a geometric scale
const EVERY_VALUE = 64;  // integer ranges up to here stop at every value
const LINEAR_STOPS = 100;
const MANTISSAS = [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8];

const round = (x) => Number(x.toPrecision(12));

/** 1, 2 or 5 times a power of ten, the smallest that is at least `x`. */
function niceStep(x) {
    const power = 10 ** Math.floor(Math.log10(x));
    return round(power * [1, 2, 5, 10].find((factor) => factor * power >= x * (1 - 1e-9)));
}

function geometric(smallest, upper) {
    const stops = [];
    for (let exponent = Math.floor(Math.log10(smallest)); 10 ** exponent <= upper; ++exponent)
        stops.push(...MANTISSAS.map((mantissa) => round(mantissa * 10 ** exponent)));
    return stops;
}

/** Round numbers on a logarithmic scale from `lower` to `upper`, both among them; both above 0. */
export function roundStops(lower, upper) {
    return [...new Set([lower, ...geometric(lower, upper).filter((x) => x > lower && x < upper), upper])];
}

function linear(lower, upper, step) {
    const stops = [];
    for (let i = Math.ceil(lower / step); i * step <= upper; ++i)
        stops.push(round(i * step));
    return stops;
}

/** Rising values from `lower` to `upper`, both and the default among them, for a setting of `welcome.settings`. */
export function stopsOf({ type, lower, upper, default: initial }) {
    const integer = type === "integer";
    const wide = lower >= 0 && upper - lower > WIDE * (initial - lower);
    let stops;
    if (integer && upper - lower <= EVERY_VALUE)
        stops = linear(lower, upper, 1);
    else if (wide)
        stops = geometric(integer ? 1 : lower > 0 ? lower : Math.max(initial, 1e-6) / 100, upper);
    else
        stops = linear(lower, upper, Math.max(niceStep((upper - lower) / LINEAR_STOPS), integer ? 1 : 0));
    stops = [...stops.map((x) => (integer ? Math.round(x) : x)).filter((x) => x >= lower && x <= upper), lower, upper, initial];
    return [...new Set(stops)].sort((a, b) => a - b);
}

/** Index of the stop nearest to `value`. */
export function nearestStop(stops, value) {
    let best = 0;
    for (let i = 1; i < stops.length; ++i)
        if (Math.abs(stops[i] - value) < Math.abs(stops[best] - value))
            best = i;
    return best;
}
