// The page in a real Chromium against the fake server: what is said on the wire, and what people are told.
import assert from "node:assert/strict";
import { test } from "node:test";
import { difference, drag, meanColour, pixels, screenshot, until, untilFrames } from "./chromium.mjs";
import { page, received, serve, server, text, untilReceived } from "./fake_page.mjs";

test("shows the picture, the scene's name and the device, without complaint", async () => {
    const colour = await meanColour(page);
    assert.ok(Math.max(...colour) > 30, `mean colour ${colour}`);
    assert.equal(await text("#scene"), "Gradient");
    assert.equal(await text("#device"), "made-up pictures (software)");
    assert.match(await page.title(), /Gradient/);
    assert.equal(await page.locator("#curtain").isVisible(), false);
    await until(page, () => window.farlight.lastHeader.flags.converged);
    await until(page, () => document.querySelector(".state").textContent === "Final, lossless");
    assert.deepEqual(page.complaints, []);
});

test("the final picture has the very pixels that were sent", async () => {
    await until(page, () => window.farlight.lastHeader.flags.converged);
    const shown = await pixels(page);
    const [session] = server.sessions;
    const colour = session.colour();
    for (let i = 0; i < shown.length / 4; ++i)
        assert.deepEqual(shown.slice(4 * i, 4 * i + 3), colour(i % 320, Math.floor(i / 320)), `pixel ${i}`);
});

test("a drag turns the camera, the picture follows, the latency is measured", async () => {
    await until(page, () => window.farlight.lastHeader.flags.converged);
    const still = await pixels(page);
    await drag(page, [0.2, 0.3], [0.5, 0.2]);
    const camera = await untilReceived("camera", ({ sequence }) => sequence >= 1);
    assert.deepEqual(camera.target, [0, 1, 0]);
    assert.ok(camera.position[0] < -1 && camera.position[1] < 1, `dragged right and up, the camera went to ${camera.position}`);
    await until(page, (sequence) => window.farlight.lastHeader.camera_sequence >= sequence, camera.sequence);
    assert.ok(difference(still, await pixels(page)) > 2);
    const latency = await page.evaluate(() => window.farlight.latency);
    assert.ok(latency.count > 0 && latency.median > 0 && latency.p95 >= latency.median, JSON.stringify(latency));
    await until(page, () => /^\d+ ms, p95 \d+ ms$/.test(document.querySelector("[data-stat=latency]").textContent));
});

test("a storm of pointer moves becomes one camera a screen frame", async () => {
    const before = received("camera").length;
    const frames = await page.evaluate(async () => {
        const stage = document.getElementById("stage");
        const fire = (type, x) => stage.dispatchEvent(new PointerEvent(type, { pointerId: 1, clientX: x, clientY: 300, button: 0, bubbles: true }));
        stage.setPointerCapture = () => {};
        fire("pointerdown", 0);
        let frames = 0;
        for (; frames < 10; ++frames) {
            for (let i = 1; i <= 50; ++i)
                fire("pointermove", frames * 50 + i);
            await new Promise(requestAnimationFrame);
        }
        fire("pointerup", 500);
        return frames;
    });
    await untilReceived("camera", ({ sequence }) => sequence > 5);
    await page.waitForTimeout(300);
    const sent = received("camera").slice(before);
    assert.ok(sent.length >= 2 && sent.length <= frames + 1, `${sent.length} cameras for ${frames} screen frames`);
    assert.deepEqual(sent.map(({ sequence }) => sequence), sent.map((_, i) => sent[0].sequence + i));
});

test("mouse buttons, wheel and keys do what the help says", async () => {
    const camera = () => page.evaluate(() => window.farlight.camera);
    const apart = ({ position, target }) => Math.hypot(...position.map((x, i) => x - target[i]));
    const start = await camera();
    await drag(page, [0.5, 0.5], [0.6, 0.5], { button: "right" });
    const panned = await camera();
    assert.ok(panned.target[0] < start.target[0] - 0.1 && Math.abs(apart(panned) - apart(start)) < 1e-9);
    await page.mouse.wheel(0, -300);
    await until(page, () => window.farlight.camera.position[2] < 3.5);
    assert.ok(apart(await camera()) < 0.8 * apart(start));
    for (const [key, changed] of [["ArrowRight", "position"], ["ArrowUp", "position"], ["w", "target"], ["d", "target"], ["e", "target"], ["-", "position"]]) {
        const before = await camera();
        await page.keyboard.press(key);
        assert.notDeepEqual((await camera())[changed], before[changed], key);
    }
    await page.keyboard.press("r");
    assert.deepEqual(await camera(), start);
    assert.equal((await untilReceived("camera", ({ cut }) => cut)).cut, true);
    await page.keyboard.press("h");
    assert.equal(await page.locator("#help").isVisible(), true);
    await page.keyboard.press("h");
    assert.equal(await page.locator("#help").isVisible(), false);
    const levels = [];
    for (let i = 0; i < 3; ++i) {
        await page.keyboard.press("o");
        levels.push(await page.locator("#overlay").getAttribute("data-level"));
    }
    assert.deepEqual(levels, ["brief", "off", "full"]);
    await page.keyboard.press("f");
    await until(page, () => document.fullscreenElement?.id === "view");
    await page.keyboard.press("f");
    await until(page, () => !document.fullscreenElement);
});

test("a key held down moves on until it is released", async () => {
    await page.keyboard.down("ArrowRight");
    await until(page, () => window.farlight.cameraSequence > 15);
    await page.keyboard.up("ArrowRight");
    await page.waitForTimeout(100);
    const rested = await page.evaluate(() => window.farlight.cameraSequence);
    await page.waitForTimeout(300);
    assert.equal(await page.evaluate(() => window.farlight.cameraSequence), rested);
});

test("a JPEG is shown too", async () => {
    const bytes = await page.evaluate(async () => {
        const canvas = new OffscreenCanvas(64, 36);
        const context = canvas.getContext("2d");
        context.fillStyle = "rgb(200, 40, 90)";
        context.fillRect(0, 0, 64, 36);
        const blob = await canvas.convertToBlob({ type: "image/jpeg", quality: 0.95 });
        return Array.from(new Uint8Array(await blob.arrayBuffer()));
    });
    server.behaviour.jpeg = Buffer.from(bytes);
    await page.keyboard.press("ArrowRight");
    await until(page, () => window.farlight.lastHeader.format === "jpeg420");
    const colour = await meanColour(page);
    [200, 40, 90].forEach((value, i) => assert.ok(Math.abs(colour[i] - value) < 4, `${colour}`)); // JPEG's own rounding
});

test("acknowledges only what was drawn: without screen frames the stream stops by itself", async () => {
    await page.addInitScript(() => {
        window.held = [];
        window.holding = true;
        const real = window.requestAnimationFrame.bind(window);
        window.requestAnimationFrame = (run) => (window.holding ? window.held.push(run) : real(run));
    });
    await page.reload();
    server.received.length = 0;
    const polling = { polling: 50 }; // [ms]; the usual way to wait would ask for screen frames
    await page.waitForFunction(() => window.held.length > 0, null, polling);
    await page.waitForTimeout(500); // many times the fake server's 20 ms a frame
    assert.equal(received("ack").length, 0);
    assert.equal([...server.sessions].at(-1).frame, 2);
    assert.equal(await page.evaluate(() => window.farlight.framesOvertaken), 1);
    await page.evaluate(() => {
        window.holding = false;
        window.held.splice(0).forEach((run) => run(performance.now()));
    });
    await page.waitForFunction(() => window.farlight.framesShown > 3, null, polling);
    const [ack] = received("ack");
    assert.equal(ack.frame_id, 2);
    assert.ok(Number.isInteger(ack.decode_us) && ack.shown_us >= ack.decode_us, JSON.stringify(ack));
});

test("settings are those of the server's list, and changes come back from it", async () => {
    assert.equal(await page.locator("[data-key]").count(), 11); // those of time have a line of their own
    const top = await page.locator("#settings-top [data-key]").evaluateAll((rows) => rows.map((row) => row.dataset.key));
    assert.deepEqual(top, ["denoiser", "samples_per_pixel", "view"]);
    await page.getByRole("radio", { name: "none" }).check();
    assert.equal((await untilReceived("set", ({ key }) => key === "denoiser")).value, "none");
    await until(page, () => window.farlight.settings.denoiser === "none");
    await page.locator("#setting-samples_per_pixel").focus();
    await page.keyboard.press("ArrowRight");
    await until(page, () => window.farlight.settings.samples_per_pixel === 2);
    await page.locator("summary", { hasText: "All other settings" }).click();
    await page.locator("#setting-light_sampling").uncheck();
    await until(page, () => window.farlight.settings.light_sampling === false);
    assert.equal(await text("#settings-count"), "3 changed");
    await page.locator("[data-key=denoiser] .reset").click();
    await until(page, () => window.farlight.settings.denoiser === "svgf");
    await screenshot(page, "fake_settings");
    await page.locator("#settings-reset").click();
    await until(page, () => window.farlight.settings.samples_per_pixel === 1 && window.farlight.settings.light_sampling);
    assert.deepEqual(page.complaints, []);
});

test("a refused value says why, beside its control, which shows what holds", async () => {
    await page.locator("summary", { hasText: "All other settings" }).click();
    const number = page.locator("[data-key=exposure] input[type=number]");
    await number.fill("-3");
    await number.press("Tab");
    await page.locator("[data-key=exposure] .problem").waitFor();
    assert.match(await text("[data-key=exposure] .problem"), /found -3/);
    assert.match(await text("#notices"), /exposure: found -3/);
    assert.equal(await number.inputValue(), "1");
});

test("the sheet shows four quarters", async () => {
    await page.selectOption("#setting-view", "sheet");
    await until(page, () => window.farlight.settings.view === "sheet");
    await untilFrames(page, 2);
    const quarters = await Promise.all([[0, 0], [0.5, 0], [0, 0.5], [0.5, 0.5]].map(([x, y]) => meanColour(page, { x, y, width: 0.5, height: 0.5 })));
    for (const [i, a] of quarters.entries())
        for (const b of quarters.slice(i + 1))
            assert.ok(Math.hypot(...a.map((value, c) => value - b[c])) > 10, `${quarters}`);
});

test("a camera path plays to its end, and a hand on the picture takes over", async () => {
    await page.selectOption("#path", "fly by");
    await untilReceived("camera");
    assert.equal(received("camera")[0].cut, true);
    await until(page, () => window.farlight.camera.position[0] === 4);
    assert.equal(await text("#path-play"), "Play");
    await page.locator("#path-loop").check();
    await page.locator("#path-play").click();
    await until(page, () => document.getElementById("path-play").textContent === "Pause");
    await drag(page, [0.5, 0.5], [0.55, 0.5]);
    assert.equal(await text("#path-play"), "Play");
});

test("size and format are asked for and follow the window", async () => {
    await page.selectOption("#size", "window");
    const size = await page.locator("#stage").evaluate((stage) => [stage.clientWidth, stage.clientHeight]);
    const resize = await untilReceived("resize");
    assert.deepEqual([resize.width, resize.height], size);
    await until(page, (width) => window.farlight.lastHeader.width === width, size[0]);
    await page.setViewportSize({ width: 1000, height: 700 });
    await untilReceived("resize", ({ width }) => width === 660);
    await page.selectOption("#size", "server");
    await untilReceived("resize", ({ width, height }) => width === 320 && height === 180);
    await page.selectOption("#format", "png");
    assert.equal((await untilReceived("format")).format, "png");
    await page.setViewportSize({ width: 1280, height: 800 });
});

test("a killed server is told clearly; when it is back, so are picture, settings and camera", async () => {
    await page.getByRole("radio", { name: "accumulate" }).check();
    await until(page, () => window.farlight.settings.denoiser === "accumulate");
    await drag(page, [0.4, 0.5], [0.7, 0.4]);
    const camera = await page.evaluate(() => window.farlight.camera);
    await server.kill();
    await until(page, () => document.getElementById("curtain-title").textContent === "The server is gone");
    await until(page, () => window.farlight.status.phase === "waiting");
    assert.equal(await page.locator("#curtain").isVisible(), true);
    assert.match(await text("#curtain-detail"), /connects again by itself|Connecting again/);
    await screenshot(page, "fake_server_gone");
    const frames = await page.evaluate(() => window.farlight.framesShown);
    await serve({}, server.port);
    await until(page, (before) => window.farlight.connected && window.farlight.framesShown > before + 2, frames);
    assert.equal(await page.locator("#curtain").isVisible(), false);
    assert.deepEqual(received("hello")[0].settings, { denoiser: "accumulate" });
    assert.deepEqual((await untilReceived("camera")).position, camera.position);
});

test("a server of another version: the page says so and stops", async () => {
    await server.kill();
    await serve({ subprotocols: ["farlight.v9"] });
    await page.goto(server.url);
    await until(page, () => window.farlight.status.phase === "stopped");
    assert.match(await text("#curtain-title"), /do not match/);
    assert.match(await text("#curtain-detail"), /farlight\.v1.*farlight\.v9/);
    assert.equal(await text("#curtain-retry"), "Reload the page");
    await screenshot(page, "fake_version");
});

test("a goodbye and a refusal are told in the server's words", async () => {
    server.say({ type: "error", code: "out_of_range", message: "width is 9, expected more", field: "width", fatal: false });
    await page.getByText("width: width is 9, expected more").waitFor();
    server.say({ type: "bye", reason: "shutting down for the night", reconnect_ms: 60000 });
    server.close(1001);
    await page.getByText("shutting down for the night").waitFor();
    assert.equal(await page.evaluate(() => window.farlight.status.phase), "waiting");
    await page.locator("#curtain-retry").click();
    await until(page, () => window.farlight.connected);
    server.say({ type: "error", code: "too_many_errors", message: "enough", fatal: true });
    server.close(1008);
    await page.getByText("enough").waitFor();
    assert.equal(await page.evaluate(() => window.farlight.status.phase), "stopped");
});

test("bad values are shown in red, at every level of the overlay but off", async () => {
    server.behaviour.nonfinite = 3;
    await page.keyboard.press("ArrowRight");
    const cell = page.locator("[data-stat=bad].bad");
    await cell.waitFor();
    assert.equal(await cell.textContent(), "3");
    await page.keyboard.press("o");
    assert.equal(await cell.isVisible(), true);
});

test("a payload that is no picture is told and acknowledged, so the stream goes on", async () => {
    server.behaviour.garbage = true;
    await page.keyboard.press("ArrowRight");
    await page.getByText(/cannot be shown/).first().waitFor();
    server.behaviour.garbage = false;
    await page.keyboard.press("ArrowRight");
    await untilFrames(page, 2);
    assert.equal(await page.evaluate(() => window.farlight.connected), true);
});

test("every control has a name and can be reached by the tab key", async () => {
    await page.locator("summary", { hasText: "All other settings" }).click();
    const nameless = await page.evaluate(() => [...document.querySelectorAll("button, input, select, summary")]
        .filter((node) => !(node.labels?.length || node.getAttribute("aria-label") || node.getAttribute("aria-labelledby") || node.textContent.trim()))
        .map((node) => node.outerHTML));
    assert.deepEqual(nameless, []);
    const reached = new Set();
    await page.locator("#tool-reset").focus();
    for (let i = 0; i < 60; ++i) {
        reached.add(await page.evaluate(() => document.activeElement.id));
        await page.keyboard.press("Tab");
    }
    for (const id of ["tool-reset", "tool-panel", "stage", "setting-view", "setting-exposure", "path", "size", "format"])
        assert.ok(reached.has(id), `${id} is not among ${[...reached]}`);
});

for (const width of [390, 320])
    test(`nothing sticks out sideways on a page ${width} px wide`, async () => {
        await page.setViewportSize({ width, height: 844 });
        await page.locator("summary", { hasText: "All other settings" }).click();
        const sizes = await page.evaluate(() => [".app", ".panel", ".top", "#view"].map((selector) => {
            const node = document.querySelector(selector);
            return [selector, node.scrollWidth, node.clientWidth, node.getBoundingClientRect().right <= innerWidth];
        }));
        for (const [selector, scroll, client, within] of sizes)
            assert.ok(scroll <= client && within, `${selector}: ${scroll} in ${client}`);
        await screenshot(page, `fake_phone_${width}`);
        await page.setViewportSize({ width: 1280, height: 800 });
    });
