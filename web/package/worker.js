// SPDX-License-Identifier: GPL-2.0-or-later
// Command lines one after the other, in a worker of a browser or of Node. The first message may have the compiled program.
import { load, run } from "./alembert.mjs";

let last = Promise.resolve();

function hear(data, port) {
    if (data.program) return void load(data.program);
    last = last.then(() => run(data.words, data.files, data.more)).then(
        (answer) => port.postMessage({ id: data.id, answer }),
        (problem) => port.postMessage({ id: data.id, problem: String(problem?.message ?? problem) }));
}

// No await outside of a function, which workers that a bundler makes may not have; and no literal name of a module of Node.
const of_node = "node:worker_threads";
if (typeof globalThis.postMessage === "function") globalThis.addEventListener("message", ({ data }) => hear(data, globalThis));
else import(/* @vite-ignore */ /* webpackIgnore: true */ of_node).then(({ parentPort }) => parentPort.on("message", (data) => hear(data, parentPort)));
