// Frames onto the canvas: taken apart, decoded by the browser, drawn in step with the screen, then acknowledged.
//
// A frame counts as shown in the animation frame that draws it. A hidden page has no animation frames, so it
// acknowledges nothing and the server stops sending by itself.
import { decodeFrame } from "./protocol.js";

const MEDIA_TYPES = { jpeg420: "image/jpeg", jpeg444: "image/jpeg", png: "image/png" };

export class Presenter {
    #canvas; #context; #on;
    #generation = 0;      // counts connections: what an old one left behind is thrown away
    #decoding = Promise.resolve();
    #ready = null;        // the newest decoded frame that is not yet drawn

    /** on.shown(frame), on.undecodable(header, reason), on.overtaken(); a frame carries {header, stages, passes, decodeMs, shownMs, bytes}. */
    constructor(canvas, on) {
        this.#canvas = canvas;
        this.#context = canvas.getContext("2d", { alpha: false });
        this.#on = on;
    }

    /** Forgets frames under way: their connection is gone. */
    restart() {
        ++this.#generation;
        this.#ready?.bitmap.close();
        this.#ready = null;
    }

    /** Throws ProtocolError for a message that is no frame. */
    accept(buffer, arrivedAt) {
        const frame = { ...decodeFrame(buffer), arrivedAt, bytes: buffer.byteLength };
        const generation = this.#generation;
        this.#decoding = this.#decoding.then(() => this.#decode(frame, generation)); // in order of arrival
    }

    async #decode(frame, generation) {
        if (generation !== this.#generation)
            return;
        const began = performance.now();
        try {
            const type = MEDIA_TYPES[frame.header.format];
            if (!type)
                throw new Error(`a browser does not draw the format '${frame.header.format}'`);
            frame.bitmap = await createImageBitmap(new Blob([frame.payload], { type }));
        } catch (fault) {
            if (generation === this.#generation)
                this.#on.undecodable(frame.header, fault.message);
            return;
        }
        frame.decodeMs = performance.now() - began;
        if (generation !== this.#generation)
            frame.bitmap.close();
        else
            this.#present(frame);
    }

    #present(frame) {
        const waiting = this.#ready;
        this.#ready = frame;
        if (waiting) {
            waiting.bitmap.close();
            this.#on.overtaken();
        } else {
            requestAnimationFrame(() => this.#draw());
        }
    }

    #draw() {
        const frame = this.#ready;
        if (!frame)
            return;
        this.#ready = null;
        const { bitmap, header } = frame;
        // A picture traced at a smaller size is shown, and saved, at its full one.
        const [width, height] = [header.full_width || bitmap.width, header.full_height || bitmap.height];
        if (this.#canvas.width !== width || this.#canvas.height !== height) {
            this.#canvas.width = width;
            this.#canvas.height = height;
        }
        this.#context.drawImage(bitmap, 0, 0, width, height);
        bitmap.close();
        frame.shownMs = performance.now() - frame.arrivedAt;
        this.#on.shown(frame);
    }
}
