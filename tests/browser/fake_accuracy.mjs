// What the fake server says of accuracy: settings, a frontier, and for each frame an error that follows from them.
//
// A frame of n samples at scale s takes 12 + 40 n s^2 ms and has the error 0.004 / (n s^2), its raw samples 40 times that. A resting
// picture has that of a plain mean once this is less; the error of its denoised frames is measured once 12 samples are forgotten.
const RUNGS = [[0.5, 1], [0.75, 1], [1, 1], [1, 2], [1, 4], [1, 8]];
const RAW = 40;  // times the error that the filter leaves

const msOf = ([scale, samples]) => 12 + 40 * samples * scale * scale;
const errorOf = ([scale, samples]) => 0.004 / (samples * scale * scale);

const choice = (key, value, choices, help) => ({ key, type: "choice", value, default: value, choices, help });
const real = (key, value, lower, upper, help) => ({ key, type: "real", value, default: value, lower, upper, help });
const STATES = ["raw", "denoised", "accumulated"];

export const ACCURACY_VIEWS = ["predicted_deviation", "measured_error", "flip", "bad_values", "wipe"];
export const ACCURACY_SETTINGS = () => [
    real("resolution_scale", 1, 0.25, 1, "size at which the picture is traced"),
    real("budget_ms", 0, 0, 10000, "[ms] a frame; 0: none"),
    real("target_error", 0, 0, 10, "relMSE to reach; 0: none"),
    { key: "history_max", type: "integer", value: 32, default: 32, lower: 1, upper: 4096, help: "[frames] longest history" },
    { key: "error_estimate", type: "boolean", value: true, default: true, help: "estimate errors" },
    choice("wipe_left", "raw", STATES, "left of the divider"),
    choice("wipe_right", "denoised", STATES, "right of the divider"),
    real("wipe_position", 0.5, 0, 1, "the divider, as a share of the width"),
];

const label = ([scale, samples]) => `${scale === 1 ? "full" : scale === 0.5 ? "half" : "three quarter"} size, ${samples} ${samples === 1 ? "sample" : "samples"}`;

export function fakeFrontier(source) {
    return {
        type: "frontier", source, points: RUNGS.map((rung, i) => ({
            label: label(rung), settings: { resolution_scale: rung[0], samples_per_pixel: rung[1] }, ms: msOf(rung),
            ...(source === "learnt" && i > 3 ? {} : { error: errorOf(rung), lower: 0.8 * errorOf(rung), upper: 1.25 * errorOf(rung) }),
        })),
    };
}

/** Which of the frontier's points the settings ask for, counted from 1; 0: none. */
function rungFor({ budget_ms, target_error }) {
    if (budget_ms > 0)
        return Math.max(1, RUNGS.filter((rung) => msOf(rung) <= budget_ms).length);
    const reached = RUNGS.findIndex((rung) => errorOf(rung) <= target_error);
    return target_error > 0 ? (reached < 0 ? RUNGS.length : reached + 1) : 0;
}

/** Header fields of the frame that comes next; `accumulated` samples a pixel are in it. */
export function accuracyFields(values, [width, height], { still, accumulated, frame }) {
    const rung = rungFor(values);
    const [scale, samples] = rung ? RUNGS[rung - 1] : [values.resolution_scale, values.samples_per_pixel];
    const ms = msOf([scale, samples]);
    const wobble = 1 + 0.06 * Math.sin(frame);
    const noise = errorOf([scale, samples]) * wobble;
    const raw = RAW * noise;
    const error = still ? Math.min(noise, raw * samples / accumulated) : noise;
    const measured = still && accumulated > 12;
    return {
        width: Math.round(width * scale), height: Math.round(height * scale), rung, samples_per_pixel: samples, raw_error: raw,
        predicted_error: error, predicted_lower: 0.8 * error, predicted_upper: 1.25 * error, noise_error: 0.75 * error,
        ...(measured && { measured_error: 1.1 * noise, measured_lower: noise, measured_upper: 1.2 * noise, reference_samples: accumulated - 12 }),
        effective_samples: samples * raw / error,
        trace_us: Math.round(600 * ms * wobble), denoise_us: Math.round(400 * ms * wobble), frame_us: Math.round(1020 * ms * wobble),
    };
}
