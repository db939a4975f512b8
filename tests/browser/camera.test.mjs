// The camera's moves: what each keeps, and where it leads.
import assert from "node:assert/strict";
import { test } from "node:test";
import { basis, distance, dolly, fly, orbit, pan, pathLength, reachOf, samplePath } from "../../client/web/camera.js";

const pose = { position: [0, 1, 4], target: [0, 1, 0], up: [0, 1, 0], vertical_fov_degrees: 90 };
const reach = { nearest: 1, farthest: 100 };

/** Coordinates here are below 1000, so rounding stays below 1e-12 of that. */
const near = (actual, expected, name = "") => actual.forEach((x, i) =>
    assert.ok(Math.abs(x - expected[i]) < 1e-9, `${name} [${actual}], expected [${expected}]`));

test("the view's axes are unit vectors, right-handed, with the horizon level", () => {
    const { forward, right, up } = basis(pose);
    near(forward, [0, 0, -1]);
    near(right, [1, 0, 0]);
    near(up, [0, 1, 0]);
});

test("an orbit turns counter-clockwise seen from above and keeps the distance", () => {
    near(orbit(pose, Math.PI / 2, 0).position, [4, 1, 0]);
    near(orbit(pose, Math.PI, 0).position, [0, 1, -4]);
    near(orbit(pose, 0, Math.PI / 4).position, [0, 1 + 4 * Math.SQRT1_2, 4 * Math.SQRT1_2]);
    let turned = pose;
    for (let i = 0; i < 1000; ++i)
        turned = orbit(turned, 0.1, i % 2 ? 0.3 : -0.31);
    assert.ok(Math.abs(distance(turned) - 4) < 1e-9);
});

test("an orbit stops short of the poles and comes back", () => {
    const above = orbit(pose, 0, 10);
    assert.ok(above.position[1] > 4.99 && above.position[2] > 0, `${above.position}`);
    assert.ok(basis(above).up.every(Number.isFinite));
    const back = orbit(above, 0, -(Math.PI / 2 - Math.PI / 360));
    near(back.position, pose.position);
});

test("an orbit works about any up axis and from straight above", () => {
    const lying = { ...pose, up: [0, 0, 2], position: [3, 1, 0] };
    near(orbit(lying, Math.PI / 2, 0).position, [0, 4, 0]);
    const straight = { ...pose, position: [0, 5, 0] };
    assert.ok(orbit(straight, 0.3, 0.1).position.every(Number.isFinite));
    assert.ok(basis(straight).right.every(Number.isFinite));
});

test("a pan keeps the point under the pointer", () => {
    // At distance 4 and 90 degrees the picture is 8 units high.
    const shifted = pan(pose, 0.25, 0.125);
    near(shifted.target, [-2, 2, 0]);
    near(shifted.position, [-2, 2, 4]);
});

test("a dolly scales the distance between its limits", () => {
    near(dolly(pose, 0.5, reach).position, [0, 1, 2]);
    near(dolly(pose, 0.5, reach).target, pose.target);
    assert.equal(distance(dolly(pose, 1e6, reach)), 100);
});

test("a dolly nearer than the limit goes on into the room", () => {
    let inside = pose;
    for (let i = 0; i < 100; ++i)
        inside = dolly(inside, 0.8, reach);
    assert.ok(inside.position[2] < -5, `${inside.position}`);
    assert.ok(Math.abs(distance(inside) - 1) < 1e-9);
});

test("flying moves camera and target alike", () => {
    const moved = fly(pose, 1, 2, 3);
    near(moved.position, [2, 4, 3]);
    near(moved.target, [2, 4, -1]);
});

test("how far a camera goes follows the scene, or its camera where the scene is empty", () => {
    const cornell = reachOf({ bounds: { lower: [0, 0, 0], upper: [300, 400, 0] } }, pose);
    assert.equal(cornell.nearest, 250 * 0.05);
    assert.equal(cornell.farthest, 250 * 20);
    assert.equal(reachOf({}, pose).farthest, 80);
});

test("a path is linear between its keyframes and held at its ends", () => {
    const path = [
        { frame: 10, ...pose },
        { frame: 20, ...pose, position: [10, 1, 4], vertical_fov_degrees: 50 },
        { frame: 40, ...pose, position: [10, 21, 4], up: [0, 0, 1] },
    ];
    assert.equal(pathLength(path), 40);
    assert.equal(pathLength([]), 0);
    near(samplePath(path, 0).position, [0, 1, 4]);
    near(samplePath(path, 12.5).position, [2.5, 1, 4]);
    assert.equal(samplePath(path, 15).vertical_fov_degrees, 70);
    near(samplePath(path, 20).position, [10, 1, 4]);
    near(samplePath(path, 30).up, [0, 0.5, 0.5]);
    near(samplePath(path, 1000).position, [10, 21, 4]);
    near(samplePath(path.slice(0, 1), 3).position, [0, 1, 4]);
});
