// What this scene's frames may cost and bring (message `frontier`), and what a wish for time or accuracy would take. Pure.
//
// Errors are relMSE, times are milliseconds of tracing and denoising. What is not known is NaN.

export const ORIGINS = { report: "from a report", learnt: "learnt while running" };

/** The message with unknown errors as NaN. `rung` is what frames call a point; one that has no time has no place here. */
export function frontierOf({ source, points, reason = "" }) {
    const known = points.map(({ label, ms, error = NaN, lower = NaN, upper = NaN }, i) => ({ rung: i + 1, label, ms, error, lower, upper }));
    return { source, reason, points: known.filter(({ ms }) => ms > 0) };
}

const leastBy = (points, key) => points.reduce((least, point) => (least && !(point[key] < least[key]) ? least : point), null);

export const cheapest = (points) => leastBy(points, "ms");

/** The point of the least error; null while none is known. */
export const finest = (points) => leastBy(points.filter(({ error }) => error > 0), "error");

/** The least error for at most `ms`; where errors are not known yet, the dearest that fits. Null: none fits. */
export function bestWithin(points, ms) {
    const fitting = points.filter((point) => point.ms <= ms);
    return finest(fitting) ?? fitting.reduce((most, point) => (most && most.ms >= point.ms ? most : point), null);
}

/** The least time for at most `error`; null: none reaches it. */
export const cheapestReaching = (points, error) => cheapest(points.filter((point) => point.error <= error));

/**
 * The error of the picture shown at rest, `n` samples a pixel after the camera came to it. The server blends the denoised picture,
 * of error D, with the mean of all samples, of error R / n, R = raw * samples being that of one sample a pixel. The mean has the
 * share w = n / (n + c), c the setting refine_crossover, so that (1 - w)^2 D + w^2 R / n = (c^2 D + n R) / (n + c)^2.
 * `frame`: {raw: error of one frame's own samples, samples: a pixel and frame, crossover: c, 0 without a denoiser, denoised: D}.
 */
export function errorAfter(n, { raw, samples, crossover = 0, denoised = NaN }) {
    const one = raw * samples;
    return crossover > 0 ? (crossover ** 2 * denoised + n * one) / (n + crossover) ** 2 : one / n;
}

/** D of a frame at rest from the error that is shown, the other way round; NaN where the mean outweighs it, which magnifies mistakes. */
export function denoisedIn({ error, raw, samples, accumulated, crossover }) {
    const behind = (error * (accumulated + crossover) ** 2 - accumulated * raw * samples) / crossover ** 2;
    return accumulated < crossover ? Math.max(behind, 0) : NaN;
}

/**
 * How long a camera must rest until errorAfter() is `target` [s], and how many samples a pixel that is; a frame takes `ms`.
 * The error may rise at first, where the mean comes in too early, but it falls ever after: the larger root is meant.
 */
export function rest(target, frame) {
    const { raw, ms, samples, crossover: c = 0, denoised } = frame;
    const one = raw * samples;
    const square = c > 0 ? one ** 2 - 4 * target * c * (one - c * denoised) : one ** 2; // below 0: never as large as `target`
    const root = square < 0 || errorAfter(samples, frame) <= target ? samples : (one - 2 * target * c + Math.sqrt(square)) / (2 * target);
    const frames = Math.max(1, root / samples);
    return { seconds: frames * ms / 1000, samples: Math.ceil(frames * (1 - 1e-12)) * samples }; // 1e-12: rounding is no frame
}

/** 0.0023, 1.5, 120; below a thousandth 2.3e-4: errors span many decades. */
export function errorNumber(error, digits = 2) {
    if (!Number.isFinite(error))
        return "–";
    if (error !== 0 && Math.abs(error) < 1e-3)
        return error.toExponential(digits - 1).replace(/\.0+e/, "e");
    return Math.abs(error) >= 100 ? String(Math.round(error)) : String(Number(error.toPrecision(digits)));
}

/** "0.001 to 0.002" between `before` and `after`; nothing where it is not known. */
export function interval({ lower, upper }, before = "", after = "") {
    if (!Number.isFinite(lower) || !Number.isFinite(upper))
        return "";
    const digits = errorNumber(lower) === errorNumber(upper) ? 3 : 2; // a narrow one would look like none
    return `${before}${errorNumber(lower, digits)} to ${errorNumber(upper, digits)}${after}`;
}

/** The error to tell of a frame: of the picture that is shown, else of the denoised one behind it. {value, lower, upper, measured}, or null. */
export function errorOf(header) {
    for (const kind of ["predicted", "measured"])
        if (Number.isFinite(header[`${kind}_error`]))
            return { value: header[`${kind}_error`], lower: header[`${kind}_lower`], upper: header[`${kind}_upper`], measured: kind === "measured" };
    return null;
}

export function milliseconds(ms) {
    return ms >= 100 ? `${Math.round(ms)} ms` : `${Number(ms.toPrecision(3))} ms`;
}

/** 0.8 s, 45 s, 12 min, 3 h. */
export function duration(seconds) {
    if (seconds < 10)
        return `${seconds < 0.1 ? "0.1" : seconds.toFixed(1)} s`;
    if (seconds < 120)
        return `${Math.round(seconds)} s`;
    return seconds < 7200 ? `${Math.round(seconds / 60)} min` : `${Math.round(seconds / 3600)} h`;
}

const LEARNING = "What frames take and bring here is being learnt.";

/**
 * What one more sample a pixel costs and brings: {ms, raw, error}, NaN where that is not known. Another sample takes as long as
 * each of this frame's did, `traceMs` together, and s + 1 of them have s / (s + 1) of the variance of s. The filter keeps its
 * blur, so that of the picture's error only the noise shrinks. At rest the mean of all samples takes over: no `error` there.
 */
export function oneMore({ raw_error, predicted_error, noise_error, samples_per_pixel: samples, flags }, traceMs) {
    return {
        ms: traceMs / samples, raw: raw_error * samples / (samples + 1),
        error: flags.still ? NaN : predicted_error - noise_error / (samples + 1),
    };
}

const ROOM = 0.8; // of a budget: frames that would take more are not stepped up to, as equal frames take unequal times

/** What a budget of `ms` a frame gets: {reached, words}. */
export function reachOfTime({ source, points }, ms) {
    const least = cheapest(points);
    if (!least)
        return { reached: true, words: LEARNING };
    const point = bestWithin(points, ms);
    if (!point)
        return { reached: false, words: `Not reachable on this device: the cheapest frame takes ${milliseconds(least.ms)} (${ORIGINS[source]}).` };
    const tight = point.ms > ROOM * ms ? " With so little room the server may stay below it." : "";
    const error = point.error > 0 ? `, error ${errorNumber(point.error)}` : ", its error not known yet";
    return { reached: true, words: `“${point.label}” fits: ${milliseconds(point.ms)}${error} (${ORIGINS[source]}).${tight}` };
}

/**
 * What a wish for the error `target` takes: {reached, words}. `frame` as for rest(), with `most`, samples after which refining ends, `limit`, the most that can be set,
 * whether the picture is `still`, and its `error`.
 */
export function reachOfError({ source, points }, target, frame) {
    const point = cheapestReaching(points, target);
    if (point)
        return { reached: true, words: `“${point.label}” reaches it while moving: ${milliseconds(point.ms)} a frame (${ORIGINS[source]}).` };
    const best = finest(points);
    const moving = best ? `Not while moving: the finest known frame has ${errorNumber(best.error)} (${ORIGINS[source]}).` : LEARNING;
    if (frame.still && frame.error <= target)
        return { reached: !best, words: `${moving} The picture at rest has ${errorNumber(frame.error)} now.` };
    const { seconds, samples } = rest(target, frame);
    if (!Number.isFinite(seconds))
        return { reached: !best, words: `${moving} How long a resting camera takes is not known yet.` };
    const { most, limit = Infinity } = frame;
    const end = samples > limit ? `never goes beyond ${limit.toLocaleString("en")}` : `ends at ${most.toLocaleString("en")}: choose “unlimited”`;
    const patience = samples <= most ? "" : ` That is ${samples.toLocaleString("en")} samples a pixel, but refining ${end}.`;
    return { reached: !best, words: `${moving} Reachable after ${duration(seconds)} still.${patience}` };
}

/** What never stopping brings. `frame` as for rest(), with its `error`, `accumulated` samples a pixel and whether it is `still`. */
export function reachOfPatience(frame, most) {
    const limit = `Keeps accumulating while the camera rests, up to ${most.toLocaleString("en")} samples a pixel.`;
    const half = rest(frame.error / 2, frame);
    const seconds = half.seconds - frame.accumulated / frame.samples * frame.ms / 1000;
    if (!frame.still || !(seconds > 0) || half.samples > most)
        return limit;
    return `${limit} Half of this error takes ${duration(seconds)} more.`;
}
