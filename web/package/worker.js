// SPDX-License-Identifier: GPL-2.0-or-later
// Command lines one after the other, in a worker of a browser or of Node.
import { run } from "./alembert.mjs";

const port = typeof globalThis.postMessage === "function" ? globalThis : (await import("node:worker_threads")).parentPort;
let last = Promise.resolve();
const hear = (data) => {
    last = last.then(() => run(data.words, data.files)).then(
        (answer) => port.postMessage({ id: data.id, answer }),
        (problem) => port.postMessage({ id: data.id, problem: String(problem?.message ?? problem) }));
};
if (port.on) port.on("message", hear);
else port.addEventListener("message", ({ data }) => hear(data));
