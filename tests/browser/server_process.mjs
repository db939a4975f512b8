// The real server as a process of this test: FARLIGHT_SERVER names its binary, else that of the release build.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";

const ROOT = fileURLToPath(new URL("../../", import.meta.url));
const BINARY = process.env.FARLIGHT_SERVER ?? `${ROOT}build/release/farlight-server`;
const START_MS = 120000; // a cold shader cache on a slow machine

export class ServerProcess {
    log = "";

    /** Resolves when the server says where it listens. */
    static async start({ port = 0, scene = "scenes/cornell_box.json", options = [] } = {}) {
        if (!existsSync(BINARY))
            throw new Error(`${BINARY} does not exist: build farlight-server, or name it in FARLIGHT_SERVER`);
        const server = new ServerProcess();
        server.child = spawn(BINARY, ["--scene", `${ROOT}${scene}`, "--port", String(port), "--device", "software", ...options],
            { stdio: ["ignore", "pipe", "pipe"] });
        server.gone = new Promise((resolve) => server.child.once("exit", (code, signal) => resolve({ code, signal })));
        server.url = await new Promise((resolve, reject) => {
            const late = setTimeout(() => reject(new Error(`the server does not listen:\n${server.log}`)), START_MS);
            const hear = (text) => {
                server.log += text;
                const found = /listening on (http:\S+)/.exec(server.log);
                if (found) {
                    clearTimeout(late);
                    resolve(found[1]);
                }
            };
            server.child.stdout.on("data", hear);
            server.child.stderr.on("data", hear);
            server.child.once("error", reject);
            server.gone.then(({ code, signal }) => {
                clearTimeout(late);
                reject(new Error(`the server ended with ${code ?? signal}:\n${server.log}`));
            });
        });
        server.port = Number(new URL(server.url).port);
        return server;
    }

    /** Ends it with `signal` and returns how it went. */
    async stop(signal = "SIGTERM") {
        this.child.kill(signal);
        return this.gone;
    }
}
