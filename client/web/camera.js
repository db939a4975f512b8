// The camera's moves as pure functions from pose to pose, and the interpolation of camera paths.
//
// A pose is {position, target, up, vertical_fov_degrees} in world space, as on the wire. `up` is the axis
// that orbits turn about and no move changes it, so the horizon stays level. Angles are in radians.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.hypot(a[0], a[1], a[2]);
const normalize = (a) => scale(a, 1 / length(a));
const clamp = (x, lower, upper) => Math.min(Math.max(x, lower), upper);
const mix = (a, b, t) => a + (b - a) * t;

/** Half a degree short of the poles, where the view direction would meet `up`. */
const STEEPEST = Math.PI / 2 - Math.PI / 360;

/** A unit vector along the part of `a` that is perpendicular to the unit vector `axis`; any such if there is none. */
function acrossFrom(a, axis) {
    const part = subtract(a, scale(axis, dot(a, axis)));
    if (length(part) > 1e-9 * length(a)) // rounding of the subtraction above is some 1e-16 of |a|
        return normalize(part);
    return normalize(cross(axis, Math.abs(axis[0]) < 0.5 ? [1, 0, 0] : [0, 1, 0]));
}

/** Unit vectors of the view; `up` is that of the picture. */
export function basis(pose) {
    const forward = normalize(subtract(pose.target, pose.position));
    const up = acrossFrom(pose.up, forward);
    return { forward, up, right: cross(forward, up) };
}

export const distance = (pose) => length(subtract(pose.target, pose.position));

/** Turns about the target: `yaw` about the up axis, counter-clockwise from above; `pitch` raises the camera. */
export function orbit(pose, yaw, pitch) {
    const axis = normalize(pose.up);
    const offset = subtract(pose.position, pose.target);
    const radius = length(offset);
    const elevation = Math.asin(clamp(dot(offset, axis) / radius, -1, 1));
    const level = acrossFrom(offset, axis);
    const turned = add(scale(level, Math.cos(yaw)), scale(cross(axis, level), Math.sin(yaw)));
    const raised = pitch === 0 ? elevation : clamp(elevation + pitch, -STEEPEST, STEEPEST);
    const direction = add(scale(turned, Math.cos(raised)), scale(axis, Math.sin(raised)));
    return { ...pose, position: add(pose.target, scale(direction, radius)) };
}

/** Shifts camera and target alike, in scene units along the view's own axes. */
export function fly(pose, forward, right, up) {
    const view = basis(pose);
    const step = add(add(scale(view.forward, forward), scale(view.right, right)), scale(view.up, up));
    return { ...pose, position: add(pose.position, step), target: add(pose.target, step) };
}

/** Shifts so that a point at the target's distance follows the pointer; `x` right and `y` down in picture heights. */
export function pan(pose, x, y) {
    const height = 2 * distance(pose) * Math.tan(pose.vertical_fov_degrees * Math.PI / 360);
    return fly(pose, 0, -x * height, y * height);
}

/**
 * Scales the distance to the target. Nearer than `reach.nearest` the target is pushed ahead, so that one
 * can go on into a room; farther than `reach.farthest` it stops.
 */
export function dolly(pose, factor, reach) {
    const before = distance(pose);
    const after = Math.min(before * factor, Math.max(reach.farthest, before));
    const { forward } = basis(pose);
    const position = add(pose.position, scale(forward, before - after));
    return { ...pose, position, target: add(position, scale(forward, Math.max(after, Math.min(reach.nearest, before)))) };
}

/** How near and far a camera may sensibly go, from the scene's bounds (or its camera, if it has none). */
export function reachOf(scene, camera) {
    const { bounds } = scene;
    const radius = bounds ? length(subtract(bounds.upper, bounds.lower)) / 2 : 0;
    const scope = radius > 0 ? radius : distance(camera);
    return { nearest: scope * 0.05, farthest: Math.max(scope, distance(camera)) * 20 };
}

export const pathLength = (keyframes) => keyframes.at(-1)?.frame ?? 0;

/** The pose at `frame` on a path: linear between keyframes, field by field; held before the first and after the last. */
export function samplePath(keyframes, frame) {
    const next = keyframes.findIndex((keyframe) => keyframe.frame > frame);
    const b = keyframes[next < 0 ? keyframes.length - 1 : next];
    const a = next > 0 ? keyframes[next - 1] : b;
    const t = a === b ? 0 : (frame - a.frame) / (b.frame - a.frame);
    const between = (name) => a[name].map((x, i) => mix(x, b[name][i], t));
    return {
        position: between("position"), target: between("target"), up: between("up"),
        vertical_fov_degrees: mix(a.vertical_fov_degrees, b.vertical_fov_degrees, t),
    };
}
