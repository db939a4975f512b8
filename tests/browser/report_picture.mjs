// A section of a report as a picture: node report_picture.mjs REPORT.html SECTION OUT.png
import { resolve } from "node:path";
import { Browser, until } from "./chromium.mjs";

const [report, section, out] = process.argv.slice(2);
if (!out) {
    console.error("found less than three arguments, expected REPORT.html SECTION OUT.png");
    process.exit(2);
}
const browser = await Browser.start({ viewport: { width: 960, height: 800 } });
const page = await browser.open(`file://${resolve(report)}`);
await until(page, () => document.body.dataset.ready === "true");
await page.waitForTimeout(300); // plots draw in the next frame
await page.locator(`#${section}`).screenshot({ path: out });
await browser.stop();
