// SPDX-License-Identifier: MIT
// Opens a folder with a page of the package in headless Chromium, and prints what the page sends to /said:
// node test_page.mjs FOLDER. Exit code 1 unless its last line is "done".
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";

const folder = process.argv[2];
const kinds = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm" };
const profile = mkdtempSync(join(tmpdir(), "alembert-page-"));
let browser = null;

const server = createServer((request, response) => {
    if (request.url === "/said") {
        let text = "";
        request.on("data", (part) => { text += part; });
        request.on("end", () => end(text));
        return;
    }
    const path = normalize(join(folder, request.url === "/" ? "index.html" : decodeURIComponent(new URL(request.url, "http://here").pathname)));
    try {
        const content = readFileSync(path);
        response.writeHead(200, { "content-type": kinds[extname(path)] ?? "application/octet-stream" }).end(content);
    } catch {
        response.writeHead(404).end();
    }
});

function end(text) {
    console.log(text);
    browser.kill("SIGKILL");
    browser.on("exit", () => {
        rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
        process.exit(text.trimEnd().endsWith("done") ? 0 : 1);
    });
}

server.listen(0, "127.0.0.1", () => {
    browser = spawn("chromium", ["--headless", "--no-sandbox", "--disable-gpu", `--user-data-dir=${profile}`, `http://127.0.0.1:${server.address().port}/`],
        { stdio: "ignore" });
    browser.on("error", (problem) => { console.log(`there is no chromium: ${problem.message}`); process.exit(77); });
});
