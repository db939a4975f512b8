// Slider stops for every kind of range.
import assert from "node:assert/strict";
import { test } from "node:test";
import { nearestStop, stopsOf } from "../../client/web/scale.js";

const RANGES = [
    { type: "integer", lower: 1, upper: 1024, default: 1 },
    { type: "integer", lower: 1, upper: 64, default: 4 },
    { type: "integer", lower: 0, upper: 4294967295, default: 0 },
    { type: "integer", lower: 1, upper: 100, default: 80 },
    { type: "real", lower: 0, upper: 1e6, default: 1 },
    { type: "real", lower: 0.01, upper: 100, default: 1 },
    { type: "real", lower: 0.001, upper: 1, default: 0.2 },
    { type: "real", lower: -1, upper: 1, default: 0.9 },
    { type: "real", lower: 0, upper: 1024, default: 128 },
    { type: "real", lower: 0, upper: 1, default: 0 },
    { type: "real", lower: 3, upper: 3, default: 3 },
];

for (const range of RANGES)
    test(`stops of ${range.type} ${range.lower} to ${range.upper}, default ${range.default}`, () => {
        const stops = stopsOf(range);
        assert.equal(stops[0], range.lower);
        assert.equal(stops.at(-1), range.upper);
        assert.ok(stops.includes(range.default));
        assert.ok(stops.every((stop, i) => i === 0 || stop > stops[i - 1]), `rising: ${stops}`);
        assert.ok(stops.length <= 130, `${stops.length} stops`);
        if (range.type === "integer")
            assert.ok(stops.every(Number.isInteger));
        assert.equal(stops[nearestStop(stops, range.default)], range.default);
    });

test("small counts have a stop each, also on wide ranges", () =>
    assert.deepEqual(stopsOf(RANGES[0]).slice(0, 6), [1, 2, 3, 4, 5, 6]));

test("a wide real range has as many stops below its default as above in each decade", () => {
    const stops = stopsOf(RANGES[5]);
    assert.ok(stops.includes(0.1) && stops.includes(0.25) && stops.includes(25));
});
