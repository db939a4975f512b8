// The page in a real Chromium against the fake server: errors, the frontier, budgets, overlays and the split picture.
import assert from "node:assert/strict";
import { test } from "node:test";
import { drag, pixels, screenshot, until } from "./chromium.mjs";
import { beginning, page, received, serve, server, text, untilReceived } from "./fake_page.mjs";

Object.assign(beginning, { accuracy: "report" });

const cell = (key) => page.locator(`#accuracy-rows [data-row=${key}]`);
const choose = (kind) => page.locator(`#goal-kinds [value=${kind}]`).check();
const show = (view) => page.locator(`#views [value=${view}]`).check();
const says = (selector, pattern) => until(page, ([node, wanted]) => new RegExp(wanted, "s").test(document.querySelector(node)?.textContent ?? ""), [selector, pattern.source]);
const sets = (key) => received("set").filter((message) => message.key === key).map(({ value }) => value);

/** How many pixels of the plot are nearly of a colour [0, 255]. */
const plotted = (red, green, blue) => page.evaluate((wanted) => {
    const canvas = document.querySelector("#frontier-plot canvas");
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4)
        count += wanted.every((value, channel) => Math.abs(value - data[i + channel]) < 12) && data[i + 3] > 200;
    return count;
}, [red, green, blue]);

test("numbers with their intervals, the formula, and the frontier with the live point on it", async () => {
    await until(page, () => window.farlight.lastHeader.flags.converged);
    await says("#accuracy-rows [data-row=measured]", /Measured error0\.00\d+0\.00\d+ to 0\.00\d+, against 12 samples/);
    assert.match(await cell("noise").textContent(), /0\.00\d+the rest is blur/);
    assert.match(await cell("inside").textContent(), /320 × 180full size/);
    assert.match(await cell("more").textContent(), /One more sample\+ \d+(\.\d+)? msraw 0\.\d+ to 0\.\d+/);
    assert.match(await cell("samples").textContent(), /1a frame, 24 in all/);
    assert.match(await cell("drawing").textContent(), /\d\d\.\d ms/);
    assert.match(await cell("encoding").textContent(), /2\.1 ms/);
    assert.match(await text(".formula"), /relMSE = mean\(\(x − r\)² \/ \(r² \+ 0\.01\)\)/);
    assert.match(await text("#frontier-word"), /Frontier from a report/);
    assert.match(await text("[data-stat=error]"), /^0\.00\d+ predicted$/);
    assert.equal((await page.evaluate(() => window.farlight.frontier.points)).length, 6);
    assert.match(await page.locator("#frontier-plot").getAttribute("aria-label"), /half size, 1 sample: 22 ms, error 0\.016.*now: /);
    assert.ok(await plotted(0x56, 0xb4, 0xe9) > 200, "the frontier is drawn");
    assert.ok(await plotted(0x00, 0x9e, 0x73) > 30, "the resting live point is drawn");
    await page.keyboard.down("ArrowRight");
    await says("#accuracy-rows [data-row=measured]", /–while still/);
    await says("#accuracy-rows [data-row=predicted]", /0\.00\d+ to 0\.00\d+/);
    await says("#accuracy-rows [data-row=more]", /error 0\.00\d+ to 0\.00\d+, raw 0\.\d+ to 0\.\d+/);
    assert.ok(await plotted(0xe6, 0x9f, 0x00) > 30, "the moving live point is drawn");
    await page.keyboard.up("ArrowRight");
    server.say({ type: "frontier", source: "learnt", points: [{ label: "only", settings: {}, ms: 20 }] });
    await says("#frontier-word", /learnt while running/);
    await screenshot(page, "fake_accuracy");
    assert.deepEqual(page.complaints, []);
});

test("a time budget is asked for, drawn with, and barred where no frame is that cheap", async () => {
    await choose("time");
    const first = await untilReceived("set", ({ key }) => key === "budget_ms");
    assert.ok(first.value >= 22, `${first.value} ms, the cheapest takes 22`);
    await until(page, () => window.farlight.settings.budget_ms > 0);
    await page.locator("#goal-number").fill("100");
    await page.locator("#goal-number").press("Tab");
    await until(page, () => window.farlight.lastHeader.rung === 4);
    await says("#goal-word", /“full size, 2 samples” fits: 92 ms, error 0\.002 \(from a report\)/);
    await says("#frontier-word", /Now drawing: full size, 2 samples \(92 ms/);
    assert.ok(await plotted(0xf0, 0xe4, 0x42) > 50, "the aim is drawn");
    const range = page.locator("#goal-range");
    await range.press("Home");
    const least = (await untilReceived("set", ({ key, value }) => key === "budget_ms" && value < 12)).value;
    await says("#goal-word", /Not reachable on this device: the cheapest frame takes 22 ms/);
    assert.match(await range.getAttribute("aria-valuetext"), /ms a frame\. Not reachable/);
    assert.equal(await range.getAttribute("data-barred"), "left");
    await screenshot(page, "fake_time_budget");
    await range.press("ArrowRight");
    await untilReceived("set", ({ key, value }) => key === "budget_ms" && value > least && value <= 2 * least);
    await choose("as_set");
    await untilReceived("set", ({ key, value }) => key === "budget_ms" && value === 0);
    await until(page, () => window.farlight.lastHeader.rung === 0 && document.querySelector("#goal-kinds [value=as_set]").checked);
    assert.equal(await page.locator("#goal-slider").isVisible(), false);
    assert.deepEqual(page.complaints, []);
});

test("an accuracy budget takes the place of a time budget and tells how long to rest for more", async () => {
    await choose("time");
    await until(page, () => window.farlight.settings.budget_ms > 0);
    await choose("accuracy");
    await until(page, () => window.farlight.settings.target_error > 0 && window.farlight.settings.budget_ms === 0);
    await page.locator("#goal-number").fill("0.004");
    await page.locator("#goal-number").press("Tab");
    await says("#goal-word", /“full size, 1 sample” reaches it while moving: 52 ms a frame/);
    await page.locator("#goal-range").press("End");
    await says("#goal-word", /Not while moving: the finest known frame has 5e-4.*Reachable after \d+ s still.*choose “unlimited”/);
    assert.equal(await page.locator("#goal-range").getAttribute("data-barred"), "right");
    await untilReceived("set", (message) => message.key === "target_error" && message.value < 5e-4);
    await screenshot(page, "fake_accuracy_budget");
});

test("what is typed beside the slider comes into range or is refused, and why is said", async () => {
    await choose("accuracy");
    const number = page.locator("#goal-number");
    await number.fill("0.004");
    await number.press("Enter");
    await untilReceived("set", ({ key, value }) => key === "target_error" && value === 0.004);
    for (const typed of ["", "0", "-2"]) {
        await number.fill(typed);
        await number.press("Enter");
        await says("#goal-problem", /a number above 0 is needed, at most 10 relMSE/);
        assert.equal(await number.inputValue(), "0.004", typed); // what holds
        await number.fill("0.005");
        await number.press("Enter");
        await says("#goal-problem", /^$/);
        await number.fill("0.004");
        await number.press("Enter");
    }
    await number.fill("99");
    await number.press("Enter");
    await says("#goal-problem", /99 is out of range: 10 relMSE is the most/);
    assert.equal(await number.inputValue(), "10");
    await until(page, () => window.farlight.settings.target_error === 10);
    assert.ok(sets("target_error").every((value) => value > 0 && value <= 10), `${sets("target_error")}`);
    await screenshot(page, "fake_number_refused");
    await page.locator("#goal-range").press("ArrowRight");
    assert.equal(await page.locator("#goal-problem").isVisible(), false);
    assert.deepEqual(page.complaints, []);
});

test("unlimited goes on to the last sample the server takes, and back", async () => {
    await choose("unlimited");
    assert.equal((await untilReceived("set", ({ key }) => key === "still_samples")).value, 65536);
    await until(page, () => window.farlight.lastHeader.accumulated_samples > 60);
    await says("#goal-word", /up to 65,536 samples a pixel\. Half of this error takes \d+.* more/);
    const port = server.port;
    await server.kill();
    await serve(beginning, port);
    await untilReceived("ack"); // of another session's frame: the page may not have seen yet that the one before has ended
    await until(page, () => document.querySelector("#goal-kinds [value=unlimited]").checked); // the same wish
    await choose("as_set");
    assert.equal((await untilReceived("set", ({ key, value }) => key === "still_samples" && value !== 65536)).value, 24);
    await until(page, () => window.farlight.lastHeader.flags.converged);
});

test("a picture traced at a smaller size is shown at its full one", async () => {
    await choose("time");
    await page.locator("#goal-number").fill("25");
    await page.locator("#goal-number").press("Tab");
    await until(page, () => window.farlight.lastHeader.width === 160);
    assert.deepEqual(await page.evaluate(() => [document.getElementById("picture").width, document.getElementById("picture").height]), [320, 180]);
    await says("#accuracy-rows [data-row=inside]", /160 × 90of 320 × 180/);
    await says("[data-stat=picture]", /160 × 90 of 320 × 180/);
    await says("#accuracy-rows [data-row=predicted]", /before it is enlarged/);
    const outside = await page.locator("#overlay td").evaluateAll((cells) => cells.filter((cell) => cell.getBoundingClientRect().right > document.getElementById("overlay").getBoundingClientRect().right).length);
    assert.equal(outside, 0, "nothing of the statistics is cut off");
});

test("overlays that the server has are a press away, with the scale of their colours", async () => {
    const offered = await page.locator("#views input").evaluateAll((inputs) => inputs.map(({ value }) => value));
    assert.deepEqual(offered, ["final", "predicted_deviation", "measured_error", "flip", "history_length", "variance", "bad_values", "wipe"]);
    assert.equal(await page.locator("#view-legend").isVisible(), false);
    await show("history_length");
    assert.equal((await untilReceived("set", ({ key }) => key === "view")).value, "history_length");
    await says("#view-legend", /History length.*frames.*0.*32/);
    assert.match(await page.locator("#view-legend .ramp").evaluate((node) => getComputedStyle(node).backgroundImage), /linear-gradient/);
    await screenshot(page, "fake_overlay");
    await show("final");
    await until(page, () => document.getElementById("view-legend").hidden);
});

test("the divider of a split picture is dragged or moved by keys, one position at a time, and the camera stays", async () => {
    await show("wipe");
    await page.locator("#wipe-line").waitFor();
    const cameras = received("camera").length;
    await drag(page, [0.5, 0.5], [0.8, 0.55]);
    await until(page, () => Math.abs(window.farlight.settings.wipe_position - 0.8) < 0.01);
    const left = await page.locator("#wipe-line").evaluate((node) => (node.getBoundingClientRect().left + node.clientWidth / 2) / document.getElementById("stage").clientWidth);
    assert.ok(Math.abs(left - 0.8) < 0.01, `the divider is at ${left}`);
    await until(page, () => window.farlight.lastHeader.flags.converged);
    const bytes = await pixels(page, { x: 0, y: 0.5, width: 1, height: 0.01 });
    const jump = [...Array(319).keys()].reduce((most, x) => {
        const step = Math.abs(bytes[4 * x] - bytes[4 * x + 4]);
        return step > most.step ? { step, x } : most;
    }, { step: 0, x: 0 });
    assert.ok(Math.abs(jump.x / 320 - 0.8) < 0.02, `the picture is split at ${jump.x / 320}`);
    await page.locator("#wipe-line").focus();
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("Home");
    await until(page, () => window.farlight.settings.wipe_position === 0);
    assert.equal(await page.locator("#wipe-line").getAttribute("aria-valuenow"), "0");
    await page.selectOption("#wipe-left", "accumulated");
    assert.equal((await untilReceived("set", ({ key }) => key === "wipe_left")).value, "accumulated");
    await until(page, () => window.farlight.settings.wipe_left === "accumulated");
    server.behaviour.mute = true;
    const before = sets("wipe_position").length;
    await page.locator("#wipe-line").focus();
    for (let i = 0; i < 5; ++i)
        await page.keyboard.press("ArrowRight");
    await untilReceived("set", ({ key, value }) => key === "wipe_position" && value === 0.02);
    assert.equal(sets("wipe_position").length, before + 1);
    server.behaviour.mute = false;
    const [session] = server.sessions;
    session.say({ type: "state", settings: session.values(), size: session.size, format: session.format });
    await untilReceived("set", ({ key, value }) => key === "wipe_position" && value === 0.1);
    assert.equal(sets("wipe_position").length, before + 2);
    assert.equal(received("camera").length, cameras);
    await screenshot(page, "fake_split");
    assert.deepEqual(page.complaints, []);
});

test("bad values are loud: by stage and kind, and the view that paints them says which colour is which", async () => {
    await says("#accuracy-rows [data-row=faulty]", /Bad values0/);
    assert.equal(await page.locator(".stages-met").isVisible(), false);
    Object.assign(server.behaviour, { nonfinite: 7, clamped: 2, stages: [{ name: "atrous_3", nan: 7 }, { name: "moments", clamped: 2 }] });
    await page.keyboard.press("ArrowRight");
    await says("#accuracy-rows .bad", /9pixels: the picture is faulty/);
    await says(".stages-met", /by stagestagenanclampedatrous_370moments02/);
    await show("bad_values");
    await says("#view-legend", /Bad values.*NaNinfinitenegativeclamped/);
    const patches = await page.locator("#view-legend .patch").evaluateAll((nodes) => nodes.map((node) => getComputedStyle(node).backgroundColor));
    assert.equal(new Set(patches).size, 4);
    await screenshot(page, "fake_bad_values");
    await page.keyboard.press("o");
    assert.equal(await page.locator(".stages-met").isVisible(), true, "in short statistics, too");
    await page.locator("#accuracy summary").click();
    await says("#accuracy-word.bad", /9 bad values/); // closed, too
});

test("a server that knows nothing of accuracy: what is not there is hidden, and that is said", async () => {
    await server.kill();
    await serve({});
    await page.goto(server.url);
    await says("#accuracy-absent", /knows no time budget, no accuracy budget, no error estimate/);
    await says("#accuracy-rows [data-row=drawing]", /50\.2 ms/);
    for (const key of ["predicted", "measured", "raw", "effective"])
        assert.equal(await cell(key).isVisible(), false, key);
    for (const part of ["#frontier", "#accuracy-formula"])
        assert.equal(await page.locator(part).isVisible(), false, part);
    const kinds = await page.locator("#goal-kinds input").evaluateAll((inputs) => inputs.map(({ value }) => value));
    assert.deepEqual(kinds, ["as_set", "unlimited"]);
    assert.deepEqual(await page.locator("#views input").evaluateAll((inputs) => inputs.map(({ value }) => value)), ["final", "history_length", "variance"]);
    assert.deepEqual(page.complaints, []);
});

test("on a phone the section fits its width", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await choose("accuracy");
    await until(page, () => document.querySelector("#frontier-plot canvas").clientWidth > 300);
    const [panel, plot] = await page.evaluate(() => [document.querySelector(".panel"), document.querySelector(".uplot")].map((node) => ({ ...node.getBoundingClientRect().toJSON(), scroll: node.scrollWidth, client: node.clientWidth })));
    assert.ok(panel.scroll <= panel.client, `${panel.scroll} in ${panel.client}`);
    assert.ok(plot.right <= 390 && plot.width > 330, JSON.stringify(plot));
    await page.locator("#goal-kinds").scrollIntoViewIfNeeded();
    await screenshot(page, "fake_accuracy_phone");
    await page.setViewportSize({ width: 1280, height: 800 });
});
