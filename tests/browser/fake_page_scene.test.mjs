// The page in a real Chromium against the fake server: programs and memory, time, edits of the scene.
import assert from "node:assert/strict";
import { test } from "node:test";
import { screenshot, until } from "./chromium.mjs";
import { page, received, serve, server, text, untilReceived } from "./fake_page.mjs";

test("which program draws, why each effect is in it, and where the memory goes", async () => {
    await until(page, () => document.getElementById("inspector-word").textContent === "specialised, 84.0 MB");
    await page.locator("#inspector summary").click();
    assert.match(await text("#inspector-body"), /Specialised program.*the 2 effects.*triangles.*36 triangles, first 'floor'.*lights/s);
    assert.match(await text(".memory:last-child"), /This picture\s*79\.0 MB.*svgf\.texture_12.*5 others\s*16\.0 MB/s);
    assert.doesNotMatch(await text("#inspector-body"), /Compiled as well/);
    await screenshot(page, "fake_inspector");
    server.behaviour.general = true;
    await until(page, () => document.querySelector(".program").dataset.kind === "general"); // it looks again while people do
    assert.match(await text("#inspector-body"), /all 6 effects, of which this scene calls for 2.*being compiled.*Compiled as well\s*spheres, fog, lens, alpha/s);
    server.behaviour.general = false;
    await until(page, () => document.querySelector(".program").dataset.kind === "specialised");
    await page.locator("summary", { hasText: "All other settings" }).click();
    await page.locator("#setting-effects").fill("general");
    await page.locator("#setting-effects").press("Tab");
    await until(page, () => /setting “effects” asks/.test(document.querySelector(".program").textContent));
    assert.deepEqual(page.complaints, []);
});

test("where nothing moves there is no time line, and the page says why", async () => {
    assert.equal(await page.locator("#time-controls").isVisible(), false);
    assert.match(await text("#time-word"), /Nothing in this scene moves/);
    assert.equal(await page.locator("[data-key=play], [data-key=time]").count(), 0);
});

test("time runs along its line, stops, goes where it is put and begins anew", async () => {
    await server.kill();
    await serve({ moves: { duration: 2.5 } });
    await page.goto(server.url);
    const seconds = () => page.evaluate(() => Number(document.getElementById("time").value));
    await until(page, () => Number(document.getElementById("time").value) > 0.2);
    await page.locator("#time-play").click();
    await untilReceived("set", ({ key, value }) => key === "play" && value === false);
    await until(page, () => document.getElementById("time-play").textContent === "Play");
    await page.locator("#time").fill("1.5");
    await untilReceived("set", ({ key, value }) => key === "time" && value === 1.5);
    await until(page, () => Math.abs(window.farlight.lastHeader.scene_time - 1.5) < 1e-6);
    assert.match(await text("#time-word"), /1\.5 s of 2\.5 s, then at rest/);
    await screenshot(page, "fake_time");
    const port = server.port;
    await server.kill();
    await serve({ moves: { duration: 2.5 } }, port);
    assert.deepEqual((await untilReceived("hello")).settings, { play: false, time: 1.5 }); // held still, it stays where it was
    await page.locator("#time-play").click();
    await until(page, () => document.getElementById("time-play").textContent === "Play again");
    await page.locator("#time-play").click();
    await untilReceived("set", ({ key, value }) => key === "time" && value === 0);
    await until(page, () => document.getElementById("time-play").textContent === "Pause");
    assert.ok(await seconds() < 2.5);
    const word = (wanted) => until(page, (pattern) => new RegExp(pattern).test(document.getElementById("time-word").textContent), wanted);
    const [session] = server.sessions;
    const describe = (moves) => {
        server.behaviour.moves = moves;
        session.say({ type: "scene_changed", scene: session.scene(), effects: [] });
    };
    session.time = 1.25;
    describe({ duration: 0.5, afterwards: "repeats" });
    await word("^0\\.\\d s of 0\\.5 s, then again$");
    describe({ duration: 0.5, afterwards: "goes_on" });
    await word("^[1-9]\\.\\d s; the line shows the first 0\\.5 s$");
    assert.equal(await text("#time-play"), "Pause");
    assert.deepEqual(page.complaints, []);
});

test("an edit is made, a refused one shows where it is wrong, the file comes back", async () => {
    await page.locator("summary", { hasText: "Edit the scene" }).click();
    const answer = (wanted) => until(page, (pattern) => new RegExp(pattern).test(document.getElementById("patch-word").textContent), wanted);
    await page.locator("#patch").fill('{"name": "Dawn"');
    await page.locator("#patch-apply").click();
    await answer("^Not JSON: ");
    await page.locator("#patch").fill("[1]");
    await page.locator("#patch").press("Control+Enter");
    await answer("^Expected an object");
    assert.equal(received("edit").length, 0);
    await page.locator("#patch").fill('{"name": "Dawn"}');
    await page.locator("#patch").press("Control+Enter");
    await answer("^Done");
    assert.equal(await text("#scene"), "Dawn");
    assert.deepEqual(await untilReceived("edit"), { type: "edit", id: 1, patch: { name: "Dawn" } });
    await page.locator("#patch").fill('{"colour": 3}');
    await page.locator("#patch-apply").click();
    await answer("unknown key");
    assert.equal(await text("#patch-word code"), "/colour");
    assert.equal(await page.locator(".notice").count(), 0);
    await screenshot(page, "fake_edit");
    await page.locator("#patch-reset").click();
    await answer("^Done");
    assert.equal(await text("#scene"), "Gradient");
    await page.locator("#patch").fill(JSON.stringify({ name: "x".repeat(20000) }));
    await page.locator("#patch-apply").click();
    await answer("the server takes 16384");
    assert.equal(received("edit").length, 3);
    assert.deepEqual(page.complaints, []);
});

test("somebody else's edit is told, and where edits are not taken none can be made", async () => {
    const [session] = server.sessions;
    session.name = "Night";
    session.say({ type: "scene_changed", scene: session.scene(), effects: [] });
    await page.getByText("Somebody else has edited the scene.").waitFor();
    assert.match(await page.title(), /Night/);
    await server.kill();
    await serve({ edits: false });
    await page.goto(server.url);
    await until(page, () => window.farlight.connected);
    assert.equal(await page.locator("#patch").isDisabled(), true);
    assert.match(await text("#patch-word"), /not to be edited/);
});
