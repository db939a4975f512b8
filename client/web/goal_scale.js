// The stops of the slider for time and accuracy: logarithmic, round numbers, wide enough for what the frontier knows. Pure.
import { cheapest, errorAfter, finest } from "./frontier.js";
import { roundStops } from "./scale.js";

const STILL_MS = 30000;      // the finest accuracy on offer is what a camera at rest for this long reaches
const FINEST = 1e-7;         // relMSE; below, single precision of the samples' mean shows

/** Rounded outwards to 1, 2 or 5 times a power of ten. */
export function niceRange(lower, upper) {
    const nice = (x, factors, accept) => {
        const power = 10 ** Math.floor(Math.log10(x));
        return Number((factors.find((factor) => accept(factor * power)) * power).toPrecision(3));
    };
    return [nice(lower, [5, 2, 1], (y) => y <= lower * (1 + 1e-9)), nice(upper, [1, 2, 5, 10], (y) => y >= upper * (1 - 1e-9))];
}

const positive = (values) => values.filter((value) => value > 0 && Number.isFinite(value));

/** At least a decade of it is on offer, even where the setting allows less than the frames call for. */
function within(from, to, { lower, upper }) {
    return roundStops(Math.min(Math.max(from, lower), upper / 10), Math.min(to, upper));
}

/** Rising stops [ms] for a setting with `lower` and `upper`. */
export function timeStops(points, frame, setting) {
    const known = positive([...points.map(({ ms }) => ms), frame.ms]);
    const [least, most] = known.length ? [Math.min(...known), Math.max(...known)] : [10, 100];
    const [from, to] = niceRange(least / 3, most * 2);
    return within(from, to, setting);
}

/** Falling stops of relMSE: as with time, farther right is a finer picture. */
export function errorStops(points, frame, setting) {
    const known = positive([...points.map(({ error }) => error), frame.error]);
    const [least, most] = known.length ? [Math.min(...known), Math.max(...known)] : [1e-3, 0.1];
    const resting = positive([errorAfter(STILL_MS / frame.ms * frame.samples, frame)]);
    const [from, to] = niceRange(Math.max(FINEST, Math.min(least / 4, ...resting)), most * 4);
    return within(from, to, setting).reverse();
}

/**
 * What somebody gets who types `typed` (NaN: no number) for a setting with `lower` and `upper`, 0 of which means off:
 * {value, problem}; null where what holds stays, "" where nothing is wrong.
 */
export function wished(typed, { lower, upper }, unit) {
    if (!(typed > 0))
        return { value: null, problem: `${Number.isNaN(typed) ? "That is no number" : `${typed} is too little`}: a number above ${lower} is needed, at most ${upper} ${unit}.` };
    const value = Math.min(Math.max(typed, lower), upper);
    return { value, problem: value === typed ? "" : `${typed} is out of range: ${value} ${unit} is the ${value < typed ? "most" : "least"}.` };
}

/** Where `value` lies among `stops`, rising or falling, as a share of the slider's way [0, 1]. */
export function shareOf(stops, value) {
    const last = stops.length - 1;
    const sign = stops[last] >= stops[0] ? 1 : -1;
    const beyond = stops.findIndex((stop) => sign * stop >= sign * value);
    if (beyond <= 0 || last < 1)
        return beyond === 0 ? 0 : 1;
    const [a, b] = [stops[beyond - 1], stops[beyond]];
    return (beyond - 1 + Math.log(value / a) / Math.log(b / a)) / last;
}

/** The part of the slider's way that no moving frame reaches: {side, share}; share 0 where all of it is, or nothing is known. */
export function barredPart(kind, stops, points) {
    if (kind === "time")
        return { side: "left", share: cheapest(points) ? shareOf(stops, cheapest(points).ms) : 0 };
    return { side: "right", share: finest(points) ? 1 - shareOf(stops, finest(points).error) : 0 };
}
