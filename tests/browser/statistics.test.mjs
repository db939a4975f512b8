// What the overlay shows, from a clock that the test turns.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Statistics, quantile } from "../../client/web/statistics.js";

const header = (camera_sequence) => ({ camera_sequence });

test("quantiles are nearest ranks", () => {
    const hundred = Array.from({ length: 100 }, (_, i) => 100 - i);
    assert.equal(quantile(hundred, 0.5), 50);
    assert.equal(quantile(hundred, 0.95), 95);
    assert.equal(quantile([7], 0.95), 7);
    assert.ok(Number.isNaN(quantile([], 0.5)));
});

test("latency is that of the camera in the picture; overtaken and repeated ones do not count", () => {
    const statistics = new Statistics();
    statistics.frameShown(header(0), 10, 5);
    statistics.cameraSent(1, 10);
    statistics.cameraSent(2, 20);
    statistics.cameraSent(3, 30);
    statistics.frameShown(header(2), 10, 100);
    statistics.frameShown(header(2), 10, 200);
    statistics.frameShown(header(3), 10, 250);
    assert.deepEqual(statistics.latencies, [80, 220]);
    assert.deepEqual(statistics.latency(), { median: 80, p95: 220, count: 2 });
    assert.equal(statistics.framesShown, 4);
});

test("only the last 60 latencies count", () => {
    const statistics = new Statistics();
    for (let i = 1; i <= 100; ++i) {
        statistics.cameraSent(i, 1000 * i);
        statistics.frameShown(header(i), 1, 1000 * i + i);
    }
    assert.deepEqual(statistics.latency(), { median: 70, p95: 97, count: 60 });
});

test("the rate is that of the last three seconds and falls when the stream pauses", () => {
    const statistics = new Statistics();
    assert.ok(Number.isNaN(statistics.rate(0).frames));
    for (let i = 0; i <= 50; ++i)
        statistics.frameShown(header(0), 1000, 100 * i);
    const steady = statistics.rate(5000);
    assert.ok(Math.abs(steady.frames - 10) < 1e-9);
    assert.ok(Math.abs(steady.bytes - 10000) < 1e-6);
    assert.ok(statistics.rate(7000).frames < 5);
    assert.ok(Number.isNaN(statistics.rate(9000).frames));
});

test("a new connection forgets cameras on their way", () => {
    const statistics = new Statistics();
    statistics.cameraSent(1, 0);
    statistics.restart();
    statistics.frameShown(header(1), 1, 50);
    assert.equal(statistics.latency().count, 0);
});
