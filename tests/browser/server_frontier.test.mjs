// A report of `farlight accuracy` given to the real server: its frontier in the page, what the page tells of rest, and reports that are refused.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { errorAfter } from "../../client/web/frontier.js";
import { Browser, screenshot, until, untilFrames } from "./chromium.mjs";
import { ServerProcess } from "./server_process.mjs";

/** What the server reads of a report. */
const REPORT = {
    scene: { name: "Cornell box", file: "cornell_box.json", triangles: 38, lights: 1 }, size: [640, 360], gl_renderer: "a faster device",
    frontier: { points: [
        { label: "half size", settings: { resolution_scale: 0.5 }, ms: 10, relmse: 0.02, relmse_lower: 0.019, relmse_upper: 0.021 },
        { label: "one sample", settings: {}, ms: 30, relmse: 0.001 },
        { label: "four samples", settings: { samples_per_pixel: 4 }, ms: 60, relmse: 0.0008 },
    ] },
};
const folder = mkdtempSync(join(tmpdir(), "farlight-frontier-"));
let browser;

before(async () => { browser = await Browser.start(); });
after(async () => {
    await browser.stop();
    rmSync(folder, { recursive: true });
});

function file(name, content) {
    const path = join(folder, name);
    writeFileSync(path, content);
    return path;
}

test("a report's frontier is shown with the live point, and said to be of another size and device", async () => {
    const server = await ServerProcess.start({ options: ["--size", "96x54", "--frontier", file("report.json", JSON.stringify(REPORT))] });
    const page = await browser.open(server.url);
    await untilFrames(page, 2);
    await until(page, () => window.farlight.frontier?.points.length === 3);
    assert.match(await page.locator("#frontier-word").textContent(), /Frontier from a report: measured at 640x360 on a faster device/);
    await page.locator("#goal-kinds [value=accuracy]").check();
    await page.locator("#goal-number").fill("0.0009");
    await page.locator("#goal-number").press("Enter");
    await until(page, () => /“four samples” reaches it while moving: .*\(from a report\)/.test(document.getElementById("goal-word").textContent));
    await page.locator("#goal-number").fill("0.0000002");
    await page.locator("#goal-number").press("Enter");
    await until(page, () => /Not while moving: the finest known frame has 8e-4/.test(document.getElementById("goal-word").textContent));
    await until(page, () => window.farlight.lastHeader.reference_samples > 0);
    await screenshot(page, "server_frontier");
    assert.deepEqual(page.complaints, []);
    await page.close();
    await server.stop();
});

test("at rest the page's formula and the server's are one", async () => {
    const server = await ServerProcess.start({ options: ["--size", "96x54"] });
    const page = await browser.open(server.url);
    await until(page, () => window.farlight.lastHeader?.reference_samples > 0);
    const { header, settings } = await page.evaluate(() => ({ header: window.farlight.lastHeader, settings: window.farlight.settings }));
    const after = errorAfter(header.accumulated_samples, {
        raw: header.raw_error, samples: header.samples_per_pixel, crossover: settings.refine_crossover, denoised: header.measured_error,
    });
    // A frame's figures may be those of the frame before: half a percent at this many samples.
    const tolerance = 2 * header.samples_per_pixel / header.accumulated_samples;
    assert.ok(Math.abs(after / header.predicted_error - 1) <= tolerance, `${after} here, ${header.predicted_error} there, after ${header.accumulated_samples} samples`);
    await page.close();
    await server.stop();
});

test("a report that is broken or of another scene ends the server with what was found and expected", async () => {
    const other = { ...REPORT, scene: { ...REPORT.scene, name: "Hall", triangles: 7 } };
    const cases = [
        [JSON.stringify(REPORT).slice(0, 300), /bad\.json.*found broken JSON/],
        [JSON.stringify({ ...REPORT, frontier: { points: [] } }), /bad\.json: \/frontier\/points: found an empty array/],
        [JSON.stringify(other), /bad\.json: \/scene: found "Hall" of 7 triangles and 1 lights, expected "Cornell box" of 38 triangles/],
    ];
    for (const [content, reason] of cases)
        await assert.rejects(ServerProcess.start({ options: ["--size", "96x54", "--frontier", file("bad.json", content)] }), (problem) => {
            assert.match(problem.message, /the server ended with 2/);
            assert.match(problem.message, reason);
            return true;
        });
});
