// For tests of the page in a real Chromium: before each one a fake server and a page that shows its pictures.
import { after, afterEach, before, beforeEach } from "node:test";
import { Browser, untilFrames } from "./chromium.mjs";
import { FakeServer } from "./fake_server.mjs";

export let browser, server, page;

/** Behaviour of the fake server that each test begins with; a file of tests may add to it. */
export const beginning = {};

before(async () => { browser = await Browser.start(); });
after(() => browser.stop());

beforeEach(async () => {
    await serve(beginning);
    page = await browser.open(server.url);
    await untilFrames(page, 2);
});

afterEach(async () => {
    await page.close();
    await server.kill();
});

/** Another server takes the place of the one before, which the caller has ended. */
export async function serve(options = {}, port = undefined) {
    server = await new FakeServer(options).start(port);
}

export const received = (type) => server.received.filter((message) => message.type === type);
export const text = (selector) => page.locator(selector).textContent();

/** Waits until the server has received something that `condition` holds for. */
export async function untilReceived(type, condition = () => true) {
    for (let i = 0; i < 600; ++i) {
        const found = received(type).findLast?.(condition) ?? received(type).filter(condition).at(-1);
        if (found)
            return found;
        await page.waitForTimeout(100);
    }
    throw new Error(`no ${type} as expected; the last was ${JSON.stringify(received(type).at(-1))}`);
}
