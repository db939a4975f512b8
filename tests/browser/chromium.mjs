// Chromium for the tests: started bare, with a profile of its own, and a page whose console is kept.
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const BINARY = process.env.FARLIGHT_CHROMIUM ?? "/usr/bin/chromium";
const PICTURES = process.env.FARLIGHT_BROWSER_OUT ?? fileURLToPath(new URL("../../build/browser/", import.meta.url));
const FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync"];

/** Waits for what the page says of itself; generous, because a machine may be slow, never because it must take long. */
export const PATIENCE_MS = 60000;

export class Browser {
    static async start(options = {}) {
        const browser = new Browser();
        browser.profile = mkdtempSync(join(tmpdir(), "farlight-chromium-"));
        browser.context = await chromium.launchPersistentContext(browser.profile, {
            executablePath: BINARY, args: FLAGS, viewport: { width: 1280, height: 800 }, timeout: PATIENCE_MS, ...options,
        });
        browser.context.setDefaultTimeout(PATIENCE_MS);
        return browser;
    }

    /** A page at `url`; `complaints` collects console errors, warnings and uncaught exceptions. */
    async open(url) {
        const page = await this.context.newPage();
        page.complaints = [];
        page.on("console", (message) => {
            if (["error", "warning"].includes(message.type()))
                page.complaints.push(message.text());
        });
        page.on("pageerror", (error) => page.complaints.push(String(error)));
        await page.goto(url);
        return page;
    }

    async stop() {
        await this.context?.close();
        rmSync(this.profile, { recursive: true, force: true });
    }
}

/** Resolves when `condition`, a function run in the page with `argument`, holds. */
export const until = (page, condition, argument) => page.waitForFunction(condition, argument, { timeout: PATIENCE_MS });

export async function untilFrames(page, more = 1) {
    const before = await page.evaluate(() => window.farlight?.framesShown ?? 0);
    await until(page, (frames) => window.farlight?.framesShown >= frames, before + more);
}

/** Bytes (RGBA) of the picture, or of the part {x, y, width, height} in shares of it; from a copy, so that the page's canvas is left alone. */
export const pixels = (page, part = { x: 0, y: 0, width: 1, height: 1 }) => page.evaluate(({ x, y, width, height }) => {
    const picture = document.getElementById("picture");
    const [w, h] = [picture.width, picture.height];
    const copy = new OffscreenCanvas(w, h).getContext("2d", { willReadFrequently: true });
    copy.drawImage(picture, 0, 0);
    return Array.from(copy.getImageData(x * w, y * h, Math.max(1, width * w), Math.max(1, height * h)).data);
}, part);

/** Mean red, green and blue of the picture or a part of it [0, 255]. */
export async function meanColour(page, part) {
    const bytes = await pixels(page, part);
    return [0, 1, 2].map((channel) => bytes.reduce((sum, value, i) => (i % 4 === channel ? sum + value : sum), 0) / (bytes.length / 4));
}

/** Mean absolute difference of two pictures of one size [0, 255]. */
export function difference(a, b) {
    return a.length === b.length ? a.reduce((sum, value, i) => sum + Math.abs(value - b[i]), 0) / a.length : Infinity;
}

export async function drag(page, from, to, options = {}) {
    const box = await page.locator("#stage").boundingBox();
    const point = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
    await page.mouse.move(...point(from));
    await page.mouse.down(options);
    await page.mouse.move(...point(to), { steps: 8 });
    await page.mouse.up(options);
}

export async function screenshot(page, name) {
    mkdirSync(PICTURES, { recursive: true });
    await page.screenshot({ path: join(PICTURES, `${name}.png`) });
}
