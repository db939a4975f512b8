// The pure parts of the accuracy section: what is in reach, the slider's scale, the plot's, whom a goal asks for what.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
    bestWithin, cheapest, cheapestReaching, denoisedIn, duration, errorAfter, errorNumber, errorOf, finest, frontierOf, interval, oneMore, reachOfError, reachOfPatience,
    reachOfTime, rest,
} from "../../client/web/frontier.js";
import { rangeFor, ticks } from "../../client/web/frontier_plot.js";
import { kindOf, kindsFor } from "../../client/web/goal.js";
import { barredPart, errorStops, niceRange, shareOf, timeStops, wished } from "../../client/web/goal_scale.js";
import { BAD_COLOURS, VIEWS } from "../../client/web/views.js";
import { fitted } from "../../client/web/wipe.js";

const REPORT = frontierOf({ source: "report", points: [
    { label: "half", settings: {}, ms: 14, error: 0.02, lower: 0.015, upper: 0.03 },
    { label: "whole", settings: {}, ms: 50, error: 0.004 },
    { label: "two", settings: {}, ms: 90, error: 0.002 },
] });
const LEARNT = frontierOf({ source: "learnt", points: [{ label: "half", settings: {}, ms: 14 }, { label: "whole", settings: {}, ms: 50, error: 0.004 }] });
const NOTHING = frontierOf({ source: "learnt", points: [] });
const FRAME = { ms: 40, raw: 0.2, error: 0.004, samples: 2, accumulated: 2, still: false, most: 1000 };

test("a frontier knows its cheapest, its finest, and what is between", () => {
    assert.equal(cheapest(REPORT.points).label, "half");
    assert.equal(finest(REPORT.points).label, "two");
    assert.equal(finest(LEARNT.points).label, "whole");
    assert.equal(finest(NOTHING.points), null);
    assert.equal(cheapest(NOTHING.points), null);
    assert.equal(bestWithin(REPORT.points, 89).label, "whole");
    assert.equal(bestWithin(REPORT.points, 13), null);
    assert.equal(bestWithin(LEARNT.points, 20).label, "half"); // its error is not known, but it fits
    assert.equal(cheapestReaching(REPORT.points, 0.004).label, "whole");
    assert.equal(cheapestReaching(REPORT.points, 0.001), null);
    assert.equal(cheapestReaching(LEARNT.points, 1).label, "whole");
});

test("points keep the number that frames call them by, unknown errors are NaN", () => {
    const { points, reason } = frontierOf({ source: "learnt", points: [{ label: "a", ms: 0 }, { label: "b", ms: 3, error: 1 }, { label: "c", ms: 4 }] });
    assert.deepEqual(points.map(({ rung }) => rung), [2, 3]);
    assert.ok(Number.isNaN(points[0].lower) && Number.isNaN(points[1].error) && Number.isNaN(points[1].upper));
    assert.equal(reason, "");
});

test("a mean of n frames has the raw error over n", () => {
    assert.deepEqual(rest(0.002, FRAME), { seconds: 4, samples: 200 });      // 100 frames of 40 ms and 2 samples
    assert.deepEqual(rest(0.5, FRAME), { seconds: 0.04, samples: 2 });       // one frame is the least
    assert.ok(Number.isNaN(rest(0.1, { ms: 40, raw: NaN, samples: 1 }).seconds));
});

const near = (actual, expected) => assert.ok(Math.abs(actual - expected) <= 1e-9 * Math.abs(expected), `${actual}, expected ${expected}`);

// By hand, with c = 64, R = raw * samples = 0.4, D = 0.004: 64 samples a pixel at rest give both a share of 1/2, so
// 0.004 / 4 + 0.4 / 64 / 4 = 0.001 + 0.0015625; 192 give (1/4)^2 0.004 + (3/4)^2 0.4 / 192 = 0.00025 + 0.001171875.
const BLEND = { ...FRAME, crossover: 64, denoised: 0.004 };

test("at rest the denoised picture turns into the mean, and its error with it", () => {
    near(errorAfter(64, BLEND), 0.0025625);
    near(errorAfter(192, BLEND), 0.001421875);
    near(errorAfter(192, { ...BLEND, crossover: 0 }), 0.4 / 192);
    near(denoisedIn({ ...BLEND, error: errorAfter(30, BLEND), accumulated: 30 }), 0.004);
    assert.ok(Number.isNaN(denoisedIn({ ...BLEND, error: 0.0025625, accumulated: 64 }))); // the mean has half of it
    assert.equal(denoisedIn({ ...BLEND, error: 1e-9, accumulated: 30 }), 0); // less than the mean's own share
});

test("how long to rest follows the blend", () => {
    const half = rest(0.0025625, BLEND); // 32 frames of 2 samples and 40 ms
    near(half.seconds, 1.28);
    assert.equal(half.samples, 64);
    const later = rest(0.001421875, BLEND);
    near(later.seconds, 3.84);
    assert.equal(later.samples, 192);
    assert.deepEqual(rest(0.05, BLEND), { seconds: 0.04, samples: 2 }); // the first frame has 0.004 and a little
    near(rest(0.000390784, BLEND).seconds, 18.72); // 936 samples: (64^2 0.004 + 936 * 0.4) / 1000^2
    assert.ok(Number.isNaN(rest(0.001, { ...BLEND, denoised: NaN }).seconds));
    // A denoised picture better than the mean of 64: the error rises from 0.0001 to 0.0016 before it falls.
    const rises = { ...BLEND, denoised: 0.0001 };
    assert.ok(errorAfter(60, rises) > 0.0015 && errorAfter(60, rises) > errorAfter(2, rises));
    assert.equal(rest(0.001, rises).samples, 2);
    near(errorAfter(rest(0.0002, rises).seconds / 0.04 * 2, rises), 0.0002);
    assert.deepEqual(rest(0.01, rises), { seconds: 0.04, samples: 2 }); // it never is as large
});

test("what is typed is a number above 0, in range or brought there, and why is said", () => {
    const setting = { lower: 0, upper: 10 };
    assert.deepEqual(wished(0.5, setting, "relMSE"), { value: 0.5, problem: "" });
    assert.deepEqual(wished(99, setting, "relMSE"), { value: 10, problem: "99 is out of range: 10 relMSE is the most." });
    assert.deepEqual(wished(0.1, { lower: 1, upper: 10 }, "ms"), { value: 1, problem: "0.1 is out of range: 1 ms is the least." });
    assert.deepEqual(wished(-3, setting, "relMSE"), { value: null, problem: "-3 is too little: a number above 0 is needed, at most 10 relMSE." });
    assert.equal(wished(0, setting, "relMSE").value, null); // 0 would mean off
    assert.deepEqual(wished(NaN, setting, "relMSE"), { value: null, problem: "That is no number: a number above 0 is needed, at most 10 relMSE." });
});

test("one more sample takes as long as each did, and shrinks noise alone", () => {
    const header = { raw_error: 0.09, predicted_error: 0.005, noise_error: 0.004, samples_per_pixel: 2, flags: { still: false } };
    const { ms, raw, error } = oneMore(header, 30); // 2 / 3 of the raw error; the noise in the picture falls by a third of itself
    assert.equal(ms, 15);
    near(raw, 0.06);
    near(error, 0.001 + 0.004 * 2 / 3);
    assert.ok(Number.isNaN(oneMore({ ...header, flags: { still: true } }, 30).error));
    assert.ok(Number.isNaN(oneMore({ ...header, raw_error: NaN }, NaN).ms));
});

test("a time budget below the cheapest frame says what that takes", () => {
    assert.deepEqual(reachOfTime(REPORT, 12), { reached: false, words: "Not reachable on this device: the cheapest frame takes 14 ms (from a report)." });
    const fits = reachOfTime(REPORT, 60);
    assert.ok(fits.reached);
    assert.match(fits.words, /“whole” fits: 50 ms, error 0\.004 \(from a report\)/);
    assert.match(reachOfTime(REPORT, 60).words, /With so little room the server may stay below it\.$/); // 50 is more than 0.8 * 60
    assert.doesNotMatch(reachOfTime(REPORT, 65).words, /room/);
    assert.match(reachOfTime(LEARNT, 20).words, /“half” fits: 14 ms, its error not known yet \(learnt while running\)/);
    assert.deepEqual([reachOfTime(NOTHING, 1).reached, /learnt/.test(reachOfTime(NOTHING, 1).words)], [true, true]);
});

test("an accuracy that no moving frame has says how long the camera must rest", () => {
    const moving = reachOfError(REPORT, 0.005, FRAME);
    assert.deepEqual([moving.reached, /“whole” reaches it while moving: 50 ms a frame/.test(moving.words)], [true, true]);
    const still = reachOfError(REPORT, 0.001, FRAME); // 200 frames: 400 samples, 8 s
    assert.deepEqual(still, { reached: false, words: "Not while moving: the finest known frame has 0.002 (from a report). Reachable after 8.0 s still." });
    const patience = reachOfError(REPORT, 0.0001, FRAME); // 2000 frames: 4000 samples, 80 s
    assert.match(patience.words, /after 80 s still\. That is 4,000 samples a pixel, but refining ends at 1,000: choose “unlimited”/);
    assert.match(reachOfError(REPORT, 0.0001, { ...FRAME, limit: 3999 }).words, /That is 4,000 samples a pixel, but refining never goes beyond 3,999\./);
    assert.match(reachOfError(REPORT, 0.001, { ...FRAME, raw: NaN }).words, /not known yet/);
    const there = { ...FRAME, still: true, error: 0.0009 };
    assert.match(reachOfError(REPORT, 0.001, there).words, /Not while moving.*The picture at rest has 9e-4 now\./);
    assert.match(reachOfError(REPORT, 0.001, { ...there, error: 0.0011 }).words, /after 8\.0 s still/);
    assert.equal(reachOfError(NOTHING, 0.001, FRAME).reached, true); // nothing is barred before anything is known
    assert.match(reachOfError(NOTHING, 0.001, FRAME).words, /being learnt\. Reachable after 8\.0 s still/);
});

test("patience: half the error, and how much longer that takes", () => {
    const resting = { ...FRAME, still: true, accumulated: 200, error: 0.002 }; // half needs 200 frames, 100 are done
    assert.match(reachOfPatience(resting, 65536), /up to 65,536 samples.*Half of this error takes 4\.0 s more\./);
    assert.doesNotMatch(reachOfPatience({ ...resting, still: false }, 65536), /Half/);
    assert.doesNotMatch(reachOfPatience(resting, 300), /Half/);
    assert.doesNotMatch(reachOfPatience({ ...resting, raw: NaN }, 65536), /Half/);
});

test("numbers and durations are short", () => {
    assert.deepEqual([0.0123, 0.00123, 0.000123, 1e-4, 0, 3.14159, 120.4, NaN].map((x) => errorNumber(x)), ["0.012", "0.0012", "1.2e-4", "1e-4", "0", "3.1", "120", "–"]);
    assert.deepEqual([0.01, 0.84, 9.96, 44.6, 600, 9000].map(duration), ["0.1 s", "0.8 s", "10.0 s", "45 s", "10 min", "3 h"]);
    assert.equal(interval({ lower: 0.001, upper: 0.002 }, "(", ")"), "(0.001 to 0.002)");
    assert.equal(interval({ lower: 0.8618, upper: 0.8642 }), "0.862 to 0.864"); // two digits would make it a point
    assert.equal(interval({ lower: NaN, upper: 0.002 }, "("), "");
});

test("a frame's error is that of the picture shown, else the measured one", () => {
    const header = { predicted_error: 2, predicted_lower: 1, predicted_upper: 3, measured_error: 5, measured_lower: 4, measured_upper: 6 };
    assert.deepEqual(errorOf(header), { value: 2, lower: 1, upper: 3, measured: false });
    assert.deepEqual(errorOf({ ...header, predicted_error: NaN }), { value: 5, lower: 4, upper: 6, measured: true });
    assert.equal(errorOf({ ...header, predicted_error: NaN, measured_error: NaN }), null);
});

test("the slider's scale is logarithmic, holds all points, and right is finer", () => {
    const time = timeStops(REPORT.points, FRAME, { lower: 0, upper: 10000 });
    assert.ok(time[0] <= 14 / 3 && time.at(-1) >= 180, `${time}`);
    assert.ok(time.every((stop, i) => i === 0 || (stop > time[i - 1] && stop <= 2 * time[i - 1])), `rising: ${time}`);
    const errors = errorStops(REPORT.points, FRAME, { lower: 0, upper: 10 });
    assert.ok(errors[0] >= 0.08 && errors.at(-1) <= 0.0005, `${errors}`);
    assert.ok(errors.every((stop, i) => i === 0 || stop < errors[i - 1]), `falling: ${errors}`);
    assert.ok(errors.at(-1) <= FRAME.raw * FRAME.ms / 30000);
    for (const stops of [timeStops([], { ms: NaN, raw: NaN, error: NaN }, { lower: 0, upper: 10000 }), errorStops([], { ms: NaN, raw: NaN, error: NaN }, { lower: 0, upper: 10 })])
        assert.ok(stops.length > 5);
    const slow = timeStops([{ ms: 40000 }], FRAME, { lower: 0, upper: 10000 });
    assert.equal(slow.at(-1), 10000);
    assert.ok(slow.length > 5);
});

test("places on the slider's way, rising and falling", () => {
    assert.equal(shareOf([1, 10, 100], 10), 0.5);
    assert.ok(Math.abs(shareOf([1, 10, 100], Math.sqrt(10)) - 0.25) < 1e-12);
    assert.ok(Math.abs(shareOf([100, 10, 1], Math.sqrt(10)) - 0.75) < 1e-12);
    assert.deepEqual([0.5, 200].map((x) => shareOf([1, 10, 100], x)), [0, 1]);
    assert.deepEqual([0.5, 200].map((x) => shareOf([100, 10, 1], x)), [1, 0]);
});

test("what no moving frame reaches is barred: cheap times on the left, fine errors on the right", () => {
    assert.deepEqual(barredPart("time", [1, 14, 196], REPORT.points), { side: "left", share: 0.5 });
    assert.deepEqual(barredPart("accuracy", [0.02, 0.002, 0.0002], REPORT.points), { side: "right", share: 0.5 });
    assert.equal(barredPart("time", [20, 200], REPORT.points).share, 0);
    assert.equal(barredPart("accuracy", [1, 0.1], NOTHING.points).share, 0);
});

test("ranges are round and stay while they fit", () => {
    assert.deepEqual(niceRange(0.013, 73), [0.01, 100]);
    assert.deepEqual(niceRange(2, 5), [2, 5]);
    const range = rangeFor([14, 90], null, [1, 2]);
    assert.deepEqual(range, [10, 200]);
    assert.equal(rangeFor([20, 80, NaN, 0], range, [1, 2]), range);
    assert.deepEqual(rangeFor([14, 300], range, [1, 2]), [10, 500]);
    assert.deepEqual(rangeFor([20, 80], [0.01, 1e6], [1, 2]), [10, 200]); // far too wide: made narrower
    assert.deepEqual(rangeFor([], null, [1, 2]), [1, 2]);
    assert.deepEqual(ticks(10, 200), [10, 20, 50, 100, 200]);
    assert.deepEqual(ticks(1e-4, 0.03), [1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.03]);
    assert.deepEqual(ticks(1e-6, 0.1), [1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1]);
});

test("settings amount to a goal, and only what the server knows can be one", () => {
    const described = new Map([["budget_ms", {}], ["target_error", {}], ["still_samples", { upper: 100 }]]);
    assert.deepEqual(kindsFor(described), ["as_set", "time", "accuracy", "unlimited"]);
    assert.deepEqual(kindsFor(new Map()), ["as_set"]);
    assert.equal(kindOf({ budget_ms: 0, target_error: 0, still_samples: 10 }, described), "as_set");
    assert.equal(kindOf({ budget_ms: 5, target_error: 0, still_samples: 100 }, described), "time");
    assert.equal(kindOf({ budget_ms: 0, target_error: 0.1, still_samples: 10 }, described), "accuracy");
    assert.equal(kindOf({ budget_ms: 0, target_error: 0, still_samples: 100 }, described), "unlimited");
    assert.equal(kindOf({}, new Map()), "as_set");
});

test("a picture is fitted into the stage", () => {
    assert.deepEqual(fitted({ width: 16, height: 9 }, { width: 320, height: 200 }), { left: 0, top: 10, width: 320, height: 180 });
    assert.deepEqual(fitted({ width: 160, height: 90 }, { width: 100, height: 90 }), { left: 0, top: 16.875, width: 100, height: 56.25 });
});

test("each overlay's scale has colours and two ends", () => {
    for (const { view, scale } of VIEWS.filter((each) => each.scale)) {
        assert.equal(scale.ends.length, 2, view);
        assert.ok(scale.colours.length > 1 && scale.colours.every((colour) => /^#[0-9a-f]{6}$/.test(colour)), view);
    }
});

test("the legend of bad values has the colours that the shader paints them in", () => {
    const header = readFileSync(new URL("../../shaders/shared/bad_values.h", import.meta.url), "utf8");
    const painted = [...header.matchAll(/^#define (\w+)_COLOR 0x([0-9a-f]{6})u$/gm)].map(([, kind, colour]) => [kind.toLowerCase(), `#${colour}`]);
    assert.deepEqual(Object.entries(BAD_COLOURS).map(([kind, colour]) => [kind.toLowerCase(), colour]), painted);
});
