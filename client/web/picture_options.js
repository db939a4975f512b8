// Size and format of the pictures asked for.
import { element } from "./dom.js";

const RESIZE_REST_MS = 250;  // the window must rest this long before the server is asked for another size
const MOST_PIXEL_RATIO = 2;  // finer screens show no more of a picture that is traced path by path
const SMALLEST = 16;         // [px]

/** What a browser can draw, in the words of the wire. */
const FORMATS = { jpeg420: "JPEG 4:2:0, smallest", jpeg444: "JPEG 4:4:4, full colour", png: "PNG, lossless" };
const SHARES = { half: ["Half window", 0.5], window: ["Window", 1] };

export class PictureOptions {
    #size; #format; #stage; #send;
    #suggested = null; #largest = SMALLEST;
    #timer;
    #holds = null;  // the size that holds on the server

    /** `size` and `format` are selects, `stage` what the picture fills; `send(type, fields)` goes to the server. */
    constructor(size, format, stage, send) {
        this.#size = size;
        this.#format = format;
        this.#stage = stage;
        this.#send = send;
        size.append(element("option", { value: "server" }), ...Object.keys(SHARES).map((value) => element("option", { value })));
        format.append(...Object.entries(FORMATS).map(([value, text]) => element("option", { value }, text)));
        size.addEventListener("change", () => this.#ask());
        format.addEventListener("change", () => send("format", { format: format.value }));
        new ResizeObserver(() => {
            this.#label();
            clearTimeout(this.#timer);
            this.#timer = setTimeout(() => this.#ask(), RESIZE_REST_MS);
        }).observe(stage);
    }

    get format() {
        return this.#format.value;
    }

    /** A new session has the size that the server suggests; another one is asked for at once. */
    welcome({ size, limits }) {
        this.#suggested = size;
        this.#largest = limits.max_dimension;
        this.#label();
        this.#holds = size;
        this.#ask();
    }

    state({ size, format }) {
        this.#holds = size;
        this.#format.value = format;
    }

    #wanted(choice) {
        if (choice === "server")
            return this.#suggested;
        const scale = SHARES[choice][1] * Math.min(devicePixelRatio, MOST_PIXEL_RATIO);
        return [this.#stage.clientWidth, this.#stage.clientHeight].map((length) =>
            Math.min(Math.max(Math.round(length * scale), SMALLEST), this.#largest));
    }

    #label() {
        for (const option of this.#suggested ? this.#size.options : []) {
            const [width, height] = this.#wanted(option.value);
            option.textContent = `${SHARES[option.value]?.[0] ?? "Server"}, ${width} × ${height}`;
        }
    }

    #ask() {
        const wanted = this.#suggested && this.#wanted(this.#size.value);
        if (wanted && wanted.join() !== this.#holds?.join())
            this.#send("resize", { width: wanted[0], height: wanted[1] });
    }
}
