// Where the camera is and where it goes next: moves by hand, held keys, camera paths, and one message a screen frame.
import { distance, dolly, fly, orbit, pathLength, reachOf, samplePath } from "./camera.js";

const PATH_FRAMES_PER_SECOND = 30;
const LONGEST_STEP_S = 0.1;   // after a pause of the page, motion goes on instead of leaping
const TURN_PER_SECOND = 1.2;  // [rad], arrow keys
const FLY_PER_SECOND = 0.8;   // [distances to the target], letter keys
const ZOOM_PER_SECOND = 4;    // factor on the distance, + and -
const HASTE = 3;              // with shift

export class Steering {
    pose = null;
    hasty = false;        // held keys move faster
    moved = false;        // by hand or along a path since the last reset
    path = null;          // {name, keyframes, frame, playing, loop}
    #home = null;
    #reach = { nearest: 0, farthest: Infinity };
    #held = new Map();    // key -> [kind, factor]
    #dirty = false; #cut = false;
    #ticking = false; #lastTick = 0;
    #send; #pathChanged;

    /** `send(pose, cut)` puts a camera on the wire; `pathChanged()` tells that `path` did. */
    constructor(send, pathChanged) {
        this.#send = send;
        this.#pathChanged = pathChanged;
    }

    /** A (new) scene: starts at its own camera, unless `keep` holds on to where the camera is. */
    enter(scene, camera, keep) {
        this.#home = camera;
        this.#reach = reachOf(scene, camera);
        this.path = keep ? this.path : null;
        if (keep)
            this.#touch();
        else {
            this.pose = camera;
            this.moved = false;
        }
        this.#pathChanged();
    }

    /** Another scene before the same camera. */
    changeScene(scene) {
        this.#reach = reachOf(scene, this.#home);
    }

    reset() {
        this.pause();
        this.pose = this.#home;
        this.#touch(true);
        this.moved = false;
    }

    /** A move by hand: `change` is a function from pose to pose and reach. It takes over from a path. */
    apply(change) {
        if (!this.pose)
            return;
        this.pause();
        this.pose = change(this.pose, this.#reach);
        this.#touch();
    }

    /** A key went down: begins a motion of [kind, factor], with a first step that a short tap can see. */
    hold(key, motion) {
        if (this.#held.has(key))
            return;
        this.#held.set(key, motion);
        this.apply((pose, reach) => this.#advance(pose, reach, motion, LONGEST_STEP_S / 2));
    }

    release(key) {
        this.#held.delete(key);
    }

    releaseAll() {
        this.#held.clear();
    }

    choosePath(name, keyframes) {
        this.path = name ? { name, keyframes, frame: 0, playing: false, loop: this.path?.loop ?? false } : null;
        this.#pathChanged();
    }

    /** To a frame of the path; a jump, so the server forgets its history. */
    seek(frame, jump = true) {
        this.path.frame = frame;
        this.pose = samplePath(this.path.keyframes, frame);
        this.#touch(jump);
        this.#pathChanged();
    }

    play() {
        this.path.playing = true;
        this.seek(this.path.frame >= pathLength(this.path.keyframes) ? 0 : this.path.frame);
    }

    pause() {
        if (this.path?.playing) {
            this.path.playing = false;
            this.#pathChanged();
        }
    }

    #advance(pose, reach, [kind, factor], seconds) {
        const amount = factor * seconds * (this.hasty ? HASTE : 1);
        const step = amount * FLY_PER_SECOND * distance(pose);
        switch (kind) {
        case "yaw": return orbit(pose, amount * TURN_PER_SECOND, 0);
        case "pitch": return orbit(pose, 0, amount * TURN_PER_SECOND);
        case "forward": return fly(pose, step, 0, 0);
        case "right": return fly(pose, 0, step, 0);
        case "up": return fly(pose, 0, 0, step);
        default: return dolly(pose, ZOOM_PER_SECOND ** amount, reach);
        }
    }

    #touch(cut = false) {
        this.moved = true;
        this.#dirty = true;
        this.#cut ||= cut;
        if (!this.#ticking) {
            this.#ticking = true;
            this.#lastTick = performance.now();
            requestAnimationFrame((now) => this.#tick(now));
        }
    }

    #tick(now) {
        const seconds = Math.max(0, Math.min((now - this.#lastTick) / 1000, LONGEST_STEP_S));
        this.#lastTick = now;
        for (const motion of this.#held.values()) {
            this.pose = this.#advance(this.pose, this.#reach, motion, seconds);
            this.#dirty = true;
        }
        if (this.path?.playing)
            this.#advancePath(seconds);
        if (this.#dirty) {
            this.#send(this.pose, this.#cut);
            this.#dirty = this.#cut = false;
        }
        this.#ticking = this.#held.size > 0 || this.path?.playing === true;
        if (this.#ticking)
            requestAnimationFrame((next) => this.#tick(next));
    }

    #advancePath(seconds) {
        const end = pathLength(this.path.keyframes);
        const frame = this.path.frame + seconds * PATH_FRAMES_PER_SECOND;
        if (frame < end)
            return this.seek(frame, false);
        if (this.path.loop)
            return this.seek(0);
        this.path.playing = false;
        return this.seek(end, false);
    }
}
