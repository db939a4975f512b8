// The page in a real Chromium against the real server, on the software device: from the first picture to a restart.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Browser, difference, drag, meanColour, pixels, screenshot, until, untilFrames } from "./chromium.mjs";
import { ServerProcess } from "./server_process.mjs";

let browser, server, page;

before(async () => {
    server = await ServerProcess.start();
    browser = await Browser.start();
    page = await browser.open(server.url);
    await untilFrames(page, 2);
});

after(async () => {
    await browser?.stop();
    await server?.stop();
});

const header = (of = page) => of.evaluate(() => window.farlight.lastHeader);

/** Changes a setting by its control on top of the panel and waits for a picture drawn with it. */
async function choose(key, value) {
    if (await page.locator(`select#setting-${key}`).count())
        await page.selectOption(`#setting-${key}`, value);
    else
        await page.locator(`[data-key=${key}] input[value=${value}]`).check();
    await until(page, ([name, wanted]) => window.farlight.settings[name] === wanted, [key, value]);
    await untilFrames(page, 3); // at most two were on their way
}

test("the Cornell box appears: lit, white in the middle, red to the left, green to the right", async () => {
    await page.waitForTimeout(500);
    const [middle, left, right] = await Promise.all([0.4, 0.02, 0.88].map((x) =>
        meanColour(page, { x: 0.5 + (x + 0.05 - 0.5) * 9 / 16, y: 0.4, width: 0.02, height: 0.2 })));
    assert.ok(Math.min(...middle) > 20, `middle ${middle}`);
    assert.ok(left[0] > 1.5 * left[1], `left ${left}`);
    assert.ok(right[1] > 1.5 * right[0], `right ${right}`);
    assert.match(await page.locator("#device").textContent(), /llvmpipe.*\(software\)/);
    assert.notEqual(await page.locator("#scene").textContent(), "Farlight");
    await screenshot(page, "server_first_picture");
    assert.deepEqual(page.complaints, []);
});

test("a drag moves the picture and the overlay tells the latency", async () => {
    const before = await pixels(page);
    await drag(page, [0.5, 0.6], [0.6, 0.55]);
    const sequence = await page.evaluate(() => window.farlight.cameraSequence);
    assert.ok(sequence > 0);
    await until(page, (wanted) => window.farlight.lastHeader.camera_sequence >= wanted, sequence);
    assert.ok(difference(before, await pixels(page)) > 2);
    const latency = await page.evaluate(() => window.farlight.latency);
    assert.ok(latency.count > 0 && Number.isFinite(latency.median) && Number.isFinite(latency.p95), JSON.stringify(latency));
    await until(page, () => /^\d+ ms, p95 \d+ ms$/.test(document.querySelector("[data-stat=latency]").textContent));
    await screenshot(page, "server_dragged");
});

test("the header's figures reach the overlay, and no value is bad", async () => {
    const passes = await page.evaluate(() => window.farlight.passes);
    assert.ok(passes.length >= 5, JSON.stringify(passes));
    const { nonfinite_count, negative_count, clamped_count, trace_us, encode_us } = await header();
    assert.deepEqual([nonfinite_count, negative_count, clamped_count], [0, 0, 0]);
    assert.ok(trace_us > 0 && encode_us > 0);
    const rows = await page.locator(".passes tbody tr").count();
    assert.ok(rows >= 5, `${rows} rows`);
    assert.equal(await page.locator("[data-stat=bad]").textContent(), "0");
});

test("keys move the camera", async () => {
    await page.locator("#stage").focus();
    for (const key of ["ArrowLeft", "w", "e", "+"]) {
        const before = await page.evaluate(() => window.farlight.cameraSequence);
        await page.keyboard.press(key);
        await until(page, (sequence) => window.farlight.lastHeader.camera_sequence > sequence, before);
    }
    await page.keyboard.press("r");
    await untilFrames(page, 2);
    const { camera } = await page.evaluate(() => window.farlight);
    assert.ok(camera.position.every(Number.isFinite));
});

test("the denoiser picker changes the picture", async () => {
    const smooth = await pixels(page);
    await choose("denoiser", "none");
    const noisy = await pixels(page);
    assert.ok(difference(smooth, noisy) > 1);
    await screenshot(page, "server_denoiser_none");
    await choose("denoiser", "accumulate");
    await choose("denoiser", "svgf");
});

test("the sheet of debug views and a buffer of its own", async () => {
    await choose("view", "sheet");
    const quarters = await Promise.all([[0, 0], [0.5, 0], [0, 0.5], [0.5, 0.5]].map(([x, y]) => meanColour(page, { x, y, width: 0.5, height: 0.5 })));
    for (const [i, a] of quarters.entries())
        for (const b of quarters.slice(i + 1))
            assert.ok(Math.hypot(...a.map((value, c) => value - b[c])) > 3, `quarters are alike: ${quarters}`);
    await screenshot(page, "server_sheet");
    await choose("view", "shading_normal");
    await screenshot(page, "server_normals");
    await choose("view", "final");
});

test("errors are predicted while the camera moves and measured when it rests", async () => {
    await page.locator("#stage").focus();
    await page.keyboard.down("ArrowLeft");
    await until(page, () => window.farlight.lastHeader.predicted_error > 0 && !window.farlight.lastHeader.flags.still);
    await page.keyboard.up("ArrowLeft");
    const moving = await header();
    assert.ok(moving.predicted_lower <= moving.predicted_error && moving.predicted_error <= moving.predicted_upper, JSON.stringify(moving));
    await page.keyboard.press("r");
    await until(page, () => window.farlight.lastHeader.measured_error > 0 && window.farlight.lastHeader.reference_samples > 8);
    const resting = await header();
    assert.ok(resting.predicted_error > 0 && resting.raw_error > resting.predicted_error, JSON.stringify(resting));
    assert.ok(resting.effective_samples > resting.samples_per_pixel, JSON.stringify(resting));
    await until(page, () => /Measured error\d.* to .*, against \d+ samples/.test(document.getElementById("accuracy-rows").textContent));
    await screenshot(page, "server_accuracy");
    assert.deepEqual(page.complaints, []);
});

test("overlays are a press away, and a split picture is raw on the left of its divider", async () => {
    for (const view of ["predicted_deviation", "measured_error", "flip", "bad_values", "wipe"]) {
        await page.locator(`#views [value=${view}]`).check();
        await until(page, (wanted) => window.farlight.settings.view === wanted, view);
        await untilFrames(page, 3);
        await screenshot(page, `server_${view}`);
    }
    const rough = async (x) => {
        const bytes = await pixels(page, { x, y: 0.3, width: 0.1, height: 0.2 });
        return bytes.slice(4).reduce((sum, value, i) => sum + Math.abs(value - bytes[i]), 0) / bytes.length;
    };
    assert.ok(await rough(0.38) > 2 * await rough(0.52), `${await rough(0.38)} left, ${await rough(0.52)} right of the middle`);
    await drag(page, [0.5, 0.5], [0.75, 0.5]);
    await until(page, () => Math.abs(window.farlight.settings.wipe_position - 0.75) < 0.01);
    await untilFrames(page, 3);
    assert.ok(await rough(0.52) > 10, `${await rough(0.52)} left of the divider at three quarters`);
    await page.locator("#views [value=final]").check();
    await until(page, () => window.farlight.settings.view === "final");
    assert.deepEqual(page.complaints, []);
});

test("under a time budget that is hard to keep, moving pictures are drawn smaller and shown at their full size", async () => {
    await page.locator("#goal-kinds [value=time]").check();
    await page.locator("#goal-number").fill("1");
    await page.locator("#goal-number").press("Tab");
    await until(page, () => window.farlight.settings.budget_ms === 1);
    await page.locator("#stage").focus();
    await page.keyboard.down("ArrowLeft");
    await until(page, () => window.farlight.lastHeader.rung === 1 && window.farlight.lastHeader.width < window.farlight.lastHeader.full_width);
    await page.keyboard.up("ArrowLeft");
    const { full_width, full_height } = await header();
    assert.deepEqual(await page.evaluate(() => [document.getElementById("picture").width, document.getElementById("picture").height]), [full_width, full_height]);
    assert.equal(await page.evaluate(() => window.farlight.frontier.source), "learnt");
    await until(page, () => /Not reachable on this device: the cheapest frame takes .* ms \(learnt/.test(document.getElementById("goal-word").textContent));
    await screenshot(page, "server_time_budget");
    await page.locator("#goal-kinds [value=as_set]").check();
    await page.keyboard.press("r");
    await until(page, () => window.farlight.settings.budget_ms === 0 && window.farlight.lastHeader.width === window.farlight.lastHeader.full_width);
    assert.deepEqual(page.complaints, []);
});

test("a slider changes a setting on the server", async () => {
    await page.locator("summary", { hasText: "All other settings" }).click();
    const slider = page.locator("#setting-exposure");
    await slider.focus();
    const before = await meanColour(page);
    for (let i = 0; i < 8; ++i)
        await page.keyboard.press("ArrowRight");
    await until(page, () => window.farlight.settings.exposure > 3);
    await untilFrames(page, 3);
    const after = await meanColour(page);
    assert.ok(after[0] > before[0] + 10, `${before} became ${after}`);
    await screenshot(page, "server_settings");
    await page.locator("[data-key=exposure] .reset").click();
    await until(page, () => window.farlight.settings.exposure === 1);
    await page.locator("summary", { hasText: "All other settings" }).click();
});

test("an edit adds fog: the page tells it among the effects, a wrong edit shows where, the file comes back", async () => {
    const answer = (kind) => until(page, (wanted) => document.getElementById("patch-word").dataset.kind === wanted, kind);
    await page.locator("summary", { hasText: "Edit the scene" }).click();
    await page.locator("#patch").fill('{"fog": {"scattering": [1, "thick", 1]}}');
    await page.locator("#patch-apply").click();
    await answer("bad");
    assert.equal(await page.locator("#patch-word code").textContent(), "/fog/scattering");
    await page.locator("#patch").fill('{"fog": {"scattering": [0.0002, 0.0002, 0.0002]}}');
    await page.locator("#patch-apply").click();
    await answer("good");
    await page.locator("#inspector summary").click();
    await until(page, () => window.farlight.inspection.program.includes("fog"));
    await page.locator(".effects dt", { hasText: "fog" }).waitFor();
    await until(page, () => document.querySelector(".program").dataset.kind === "specialised");
    assert.ok(await page.locator(".memory .fill").count() > 5);
    await page.locator("#inspector").evaluate((node) => node.scrollIntoView());
    await screenshot(page, "server_fog");
    await page.locator("#patch-reset").click();
    await until(page, () => !window.farlight.inspection.effects.some(({ name }) => name === "fog"));
    await until(page, () => !window.farlight.inspection.program.includes("fog"));
    await page.locator("#inspector summary").click();
    await page.locator("summary", { hasText: "Edit the scene" }).click();
    assert.deepEqual(page.complaints, []);
});

test("a scene that moves has a time line, which goes where it is put", async () => {
    const moving = await ServerProcess.start({ scene: "scenes/moving.json" });
    const other = await browser.open(moving.url);
    await until(other, () => window.farlight?.lastHeader?.scene_time > 0.2);
    await other.locator("#time").fill("2.5");
    await until(other, () => window.farlight.lastHeader.scene_time === 2.5 && window.farlight.lastHeader.flags.still);
    assert.equal(await other.locator("#time-play").textContent(), "Play");
    await screenshot(other, "server_time");
    await other.locator("#time").fill("0.5");
    await other.locator("#time-play").click();
    await until(other, () => window.farlight.lastHeader.scene_time > 0.6 && window.farlight.lastHeader.scene_time < 2.5);
    assert.deepEqual(other.complaints, []);
    await other.close();
    await moving.stop();
    await page.bringToFront();
});

test("at rest the picture is refined and ends lossless", async () => {
    await page.locator("summary", { hasText: "All other settings" }).click();
    const number = page.locator("[data-key=still_samples] input[type=number]");
    await number.fill("8");
    await number.press("Tab");
    await page.locator("summary", { hasText: "All other settings" }).click();
    await until(page, () => window.farlight.lastHeader.flags.converged);
    const last = await header();
    assert.deepEqual(last.flags, { ...last.flags, still: true, lossless: true, converged: true });
    assert.equal(last.format, "png");
    assert.ok(last.accumulated_samples >= 8, `${last.accumulated_samples} samples`);
    await until(page, () => document.querySelector(".state").textContent === "Final, lossless");
    await screenshot(page, "server_final");
    assert.deepEqual(page.complaints, []);
});

test("two pages each have a camera of their own", async () => {
    const other = await browser.open(server.url);
    await untilFrames(other, 2);
    const here = await page.evaluate(() => window.farlight.camera);
    await drag(other, [0.5, 0.6], [0.7, 0.6]);
    await until(other, () => window.farlight.lastHeader.camera_sequence > 0);
    assert.notDeepEqual(await other.evaluate(() => window.farlight.camera), here);
    assert.deepEqual(await page.evaluate(() => window.farlight.camera), here);
    assert.deepEqual(other.complaints, []);
    await other.close();
    await page.bringToFront();
});

test("a touch drag on a phone turns the camera, two fingers pinch, nothing sticks out", async () => {
    const phone = await Browser.start({ viewport: { width: 390, height: 844 }, deviceScaleFactor: 3, isMobile: true, hasTouch: true });
    const other = await phone.open(server.url);
    await untilFrames(other, 2);
    const touch = await phone.context.newCDPSession(other);
    const box = await other.locator("#stage").boundingBox();
    const at = (points) => points.map(([x, y], id) => ({ x: box.x + x * box.width, y: box.y + y * box.height, id }));
    const gesture = async (...steps) => {
        for (const [i, points] of steps.entries())
            await touch.send("Input.dispatchTouchEvent", { type: i ? "touchMove" : "touchStart", touchPoints: at(points) });
        await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    };
    const camera = () => other.evaluate(() => window.farlight.camera);
    const apart = ({ position, target }) => Math.hypot(...position.map((x, i) => x - target[i]));
    const start = await camera();
    await gesture([[0.3, 0.6]], [[0.35, 0.6]], [[0.4, 0.6]]);
    await until(other, () => window.farlight.cameraSequence > 0 && window.farlight.lastHeader.camera_sequence === window.farlight.cameraSequence);
    await screenshot(other, "server_phone");
    const turned = await camera();
    assert.deepEqual(turned.target, start.target);
    assert.ok(Math.abs(turned.position[0] - start.position[0]) > 1);
    await gesture([[0.4, 0.6], [0.6, 0.6]], [[0.3, 0.6], [0.7, 0.6]], [[0.2, 0.6], [0.8, 0.6]]);
    assert.ok(apart(await camera()) < 0.6 * apart(turned), "spreading the fingers moves nearer");
    await gesture([[0.4, 0.5], [0.6, 0.5]], [[0.4, 0.6], [0.6, 0.6]], [[0.4, 0.7], [0.6, 0.7]]);
    assert.notDeepEqual((await camera()).target, start.target);
    assert.ok(await other.evaluate(() => document.documentElement.scrollWidth <= innerWidth && document.querySelector(".panel").scrollWidth <= innerWidth));
    assert.deepEqual(other.complaints, []);
    await phone.stop();
});

test("the server stops in order: the page says so; started again on its port, pictures come back", async () => {
    await drag(page, [0.5, 0.6], [0.55, 0.6]);
    const camera = await page.evaluate(() => window.farlight.camera);
    const frames = await page.evaluate(() => window.farlight.framesShown);
    assert.deepEqual(await server.stop("SIGTERM"), { code: 0, signal: null });
    await until(page, () => !window.farlight.connected);
    await page.locator("#curtain-title").waitFor();
    await screenshot(page, "server_stopped");
    server = await ServerProcess.start({ port: server.port });
    await until(page, (shown) => window.farlight.connected && window.farlight.framesShown > shown + 2, frames);
    assert.deepEqual(await page.evaluate(() => window.farlight.camera), camera);
    assert.equal(await page.evaluate(() => window.farlight.settings.still_samples), 8);
});

test("the server is killed: a clear message, and pictures again when it is back", async () => {
    const frames = await page.evaluate(() => window.farlight.framesShown);
    await server.stop("SIGKILL");
    await until(page, () => document.getElementById("curtain-title").textContent === "The server is gone");
    assert.equal(await page.locator("#curtain").isVisible(), true);
    await screenshot(page, "server_gone");
    server = await ServerProcess.start({ port: server.port });
    await until(page, (shown) => window.farlight.connected && window.farlight.framesShown > shown + 2, frames);
    assert.equal(await page.locator("#curtain").isVisible(), false);
    const colour = await meanColour(page);
    assert.ok(Math.max(...colour) > 10, `mean colour ${colour}`);
});
