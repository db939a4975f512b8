// Picker, play button and time line for the scene's camera paths.
import { element } from "./dom.js";
import { pathLength } from "./camera.js";

export class PathBar {
    #nodes; #steering; #paths = {};

    /** `nodes` are {box, pick, controls, play, time, loop, word}. */
    constructor(nodes, steering) {
        this.#nodes = nodes;
        this.#steering = steering;
        const { pick, play, time, loop } = nodes;
        pick.addEventListener("change", () => {
            steering.choosePath(pick.value, this.#paths[pick.value]);
            if (pick.value)
                steering.play();
        });
        play.addEventListener("click", () => (steering.path?.playing ? steering.pause() : steering.play()));
        time.addEventListener("input", () => {
            steering.pause();
            steering.seek(Number(time.value));
        });
        loop.addEventListener("change", () => { steering.path.loop = loop.checked; });
    }

    /** `welcome.camera_paths`; paths without keyframes cannot be played and are left out. */
    describe(paths) {
        this.#paths = Object.fromEntries(Object.entries(paths).filter(([, keyframes]) => keyframes.length > 0));
        const names = Object.keys(this.#paths);
        this.#nodes.pick.replaceChildren(element("option", { value: "" }, names.length ? "Steer by hand" : "This scene has none"),
            ...names.map((name) => element("option", { value: name }, name)));
        this.#nodes.pick.disabled = names.length === 0;
        if (this.#steering.path && !this.#paths[this.#steering.path.name])
            this.#steering.choosePath("");
        this.show();
    }

    show() {
        const { path } = this.#steering;
        const { pick, controls, play, time, loop, word } = this.#nodes;
        controls.hidden = !path;
        pick.value = path?.name ?? "";
        if (!path)
            return;
        play.textContent = path.playing ? "Pause" : "Play";
        play.setAttribute("aria-pressed", String(path.playing));
        time.max = pathLength(path.keyframes);
        time.value = path.frame;
        time.style.setProperty("--filled", `${100 * path.frame / Math.max(pathLength(path.keyframes), 1e-9)}%`);
        loop.checked = path.loop;
        word.textContent = `frame ${Math.round(path.frame)} of ${Math.round(pathLength(path.keyframes))}`;
    }
}
