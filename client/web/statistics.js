// What the viewer measures about its own stream: frame rate, latency, bytes. Pure; times are passed in [ms].

const KEPT = 60;          // samples behind each median
const RATE_SPAN_MS = 3000;  // frames older than this do not count towards the rate
const UNANSWERED = 600;   // cameras waiting for their picture that are remembered: 10 s at 60 a second

/** The value below which a share `rank` of `values` lies (nearest rank); NaN for none. */
export function quantile(values, rank) {
    const sorted = [...values].sort((a, b) => a - b);
    return sorted.length ? sorted[Math.max(0, Math.ceil(rank * sorted.length) - 1)] : NaN;
}

function keep(list, value, most = KEPT) {
    list.push(value);
    if (list.length > most)
        list.shift();
}

export class Statistics {
    framesShown = 0;
    framesOvertaken = 0;  // decoded, but a newer one was ready before the screen was
    latencies = [];       // camera sent -> its picture drawn
    roundTrips = [];
    #cameras = new Map();  // sequence -> time sent
    #shown = [];           // {at, bytes} within RATE_SPAN_MS

    /** A new connection: what was in flight will never be answered. */
    restart() {
        this.#cameras.clear();
        this.#shown = [];
        this.roundTrips = [];
    }

    cameraSent(sequence, now) {
        this.#cameras.set(sequence, now);
        if (this.#cameras.size > UNANSWERED)
            this.#cameras.delete(this.#cameras.keys().next().value);
    }

    /** The latency is that of the very camera in the picture; those it overtook never had a picture. */
    frameShown(header, bytes, now) {
        ++this.framesShown;
        keep(this.#shown, { at: now, bytes }, 1000);
        const sent = this.#cameras.get(header.camera_sequence);
        if (sent !== undefined)
            keep(this.latencies, now - sent);
        for (const sequence of this.#cameras.keys())
            if (sequence <= header.camera_sequence)
                this.#cameras.delete(sequence);
    }

    pong(milliseconds) {
        keep(this.roundTrips, milliseconds);
    }

    latency() {
        return { median: quantile(this.latencies, 0.5), p95: quantile(this.latencies, 0.95), count: this.latencies.length };
    }

    /** Median round trip of a ping [ms]; NaN before the first. */
    roundTrip() {
        return quantile(this.roundTrips, 0.5);
    }

    /** Frames and bytes a second up to now; NaN before there are two frames to compare. */
    rate(now) {
        this.#shown = this.#shown.filter(({ at }) => now - at <= RATE_SPAN_MS);
        const frames = this.#shown;
        if (frames.length < 2)
            return { frames: NaN, bytes: NaN };
        const span = frames.at(-1).at - frames[0].at;
        const late = now - frames.at(-1).at > 3 * span / (frames.length - 1); // the stream has paused
        const seconds = (late ? now - frames[0].at : span) / 1000;
        const bytes = frames.slice(1).reduce((sum, frame) => sum + frame.bytes, 0);
        return { frames: (frames.length - 1) / seconds, bytes: bytes / seconds };
    }
}
