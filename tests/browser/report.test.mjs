// The page of `farlight accuracy` in a real Chromium, made by a real sweep (FARLIGHT_REPORT names its folder).
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { Browser, screenshot, until } from "./chromium.mjs";

const FOLDER = process.env.FARLIGHT_REPORT;
const PLOTS = { "error-time": 1, "flip-time": 1, passes: 1, response: 1, motion: 1 };

let browser, page, report, asked;

before(async () => {
    report = JSON.parse(readFileSync(`${FOLDER}/accuracy.json`, "utf8"));
    browser = await Browser.start();
    page = await browser.open("about:blank");
    asked = [];
    page.on("request", (request) => asked.push(request.url()));
    await page.goto(`file://${FOLDER}/accuracy.html`);
    await until(page, () => document.body.dataset.ready === "true");
    await page.waitForTimeout(300); // plots draw in the next frame
});

after(() => browser?.stop());

/** Shares of a section's canvases that are not white, and how many colours each has. */
const drawn = (id) => page.evaluate((section) => [...document.querySelectorAll(`#${section} .plot canvas`)].map((canvas) => {
    const bytes = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    const inked = bytes.filter((pixel) => pixel >>> 24 > 0 && pixel !== 0xffffffff);
    return { share: inked.length / bytes.length, colors: new Set(inked).size };
}), id);

test("every plot is drawn, and nobody complains", async () => {
    for (const [id, count] of Object.entries(PLOTS)) {
        const canvases = await drawn(id);
        assert.equal(canvases.length, count, id);
        for (const { share, colors } of canvases)
            assert.ok(share > 0.01 && colors > 20, `${id}: ${share} of the pixels in ${colors} colours`);
    }
    await screenshot(page, "report_desktop");
    assert.deepEqual(page.complaints, []);
});

test("the page asks for nothing but itself", () => {
    const elsewhere = asked.filter((url) => !url.startsWith("data:") && url !== `file://${FOLDER}/accuracy.html`);
    assert.deepEqual(elsewhere, []);
});

test("axes are labelled with units", async () => {
    const labels = await page.evaluate(() => [...document.querySelectorAll(".plot")].map((plot) => plot.getAttribute("aria-label")));
    assert.equal(labels.filter(Boolean).length, Object.keys(PLOTS).length);
});

test("tables hold what was measured", async () => {
    const rows = (id) => page.locator(`#${id} tbody tr`).count();
    assert.equal(await rows("prices-table"), report.prices.length);
    assert.equal(await rows("classic-table"), report.classic.length);
    assert.equal(await rows("points-table"), report.points.length);
    assert.equal(await rows("techniques-table"), report.techniques.length);
    assert.equal(await rows("motion-table"), report.motion.points.length);
    assert.match(await page.locator("#prices-table").textContent(), /\+[\d.]+ ms/);
    const text = await page.locator("main").innerText();
    assert.doesNotMatch(text, /undefined|NaN|\[object/);
});

test("a click on a picture shows the reference, another the picture again", async () => {
    const picture = page.locator("#gallery figure img[role=button]").first();
    const before = await picture.getAttribute("src");
    await picture.click();
    const reference = await picture.getAttribute("src");
    assert.notEqual(reference, before);
    assert.equal(reference, await page.locator("#gallery img[alt='the reference']").getAttribute("src"));
    await picture.press("Enter");
    assert.equal(await picture.getAttribute("src"), before);
    const widths = await page.evaluate(() => [...document.querySelectorAll("#gallery figure img")].map((image) => image.naturalWidth));
    assert.ok(widths.every((width) => width === report.size[0]), String(widths));
});

test("the marker under the pointer says what it is", async () => {
    const over = page.locator("#error-time .u-over");
    await over.scrollIntoViewIfNeeded();
    const spot = await page.evaluate(() => {
        const { plot } = plots[0];
        const point = JSON.parse(document.getElementById("data").textContent).frontier.points[0];
        return [plot.valToPos(point.ms, "x"), plot.valToPos(point.relmse, "y")];
    });
    await over.hover({ position: { x: spot[0], y: spot[1] } });
    assert.match(await page.locator("#error-time .tip").innerText(), /relMSE/);
});

test("a phone's width needs no sideways scrolling", async () => {
    await page.setViewportSize({ width: 360, height: 740 });
    await until(page, () => document.querySelector("#error-time canvas").getBoundingClientRect().right <= innerWidth);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await screenshot(page, "report_phone");
    assert.deepEqual(page.complaints, []);
});

test("a plot is drawn wherever its range begins", async () => {
    const before = await page.locator(".plot").count();
    await page.evaluate(() => {
        const look = { shape: "circle", color: "#000000", size: 4 };
        for (const lower of [1.04, 9.4, 9.5, 9.7, 9.99])
            for (const decade of [1e-4, 1])
                logPlot(document.body, { title: "any", x: "x", y: "y", markers: [1.6, 16].map((at) => ({ x: lower * decade * at, y: lower * decade * at, look, label: "", tip: "" })) });
    });
    await page.waitForTimeout(300);
    assert.equal(await page.locator(".plot").count(), before + 10);
    assert.deepEqual(page.complaints, []);
});

test("where no frame has an error that shows, the page says so", async () => {
    const nothing = {
        ...report, prices: [], fits: [], techniques: [], slope: null, flip_frontier: [], frontier: { points: [] }, averaging: { ...report.averaging, rate: undefined },
        points: report.points.map(({ frontier, ...point }) => ({ ...point, relmse: 0, relmse_lower: 0, relmse_upper: 0, flip: 0 })),
    };
    const html = readFileSync(`${FOLDER}/accuracy.html`, "utf8");
    const gallery = JSON.parse(await page.locator("#data").textContent()).gallery;
    const bare = await browser.open("about:blank");
    await bare.setContent(html.replace(/(<script id="data"[^>]*>)[^]*?(<\/script>)/, (_, open, close) => open + JSON.stringify({ ...nothing, gallery }) + close));
    await until(bare, () => document.body.dataset.ready === "true");
    assert.match(await bare.locator(".answer").innerText(), /No frame has an error/);
    assert.match(await bare.locator("#method").innerText(), /too little error to say how it falls/);
    assert.deepEqual(bare.complaints, []);
    await bare.close();
});
