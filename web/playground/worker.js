// SPDX-License-Identifier: MIT
// Runs the program away from the page. It gets the compiled module first, and then command lines.
import { load, run } from "./alembert.mjs";

addEventListener("message", async ({ data: { module, words, files } }) => {
    if (module) return load(module);
    try {
        postMessage({ answer: await run(words, files) });
    } catch (problem) {
        postMessage({ problem: String(problem?.message ?? problem) });
    }
});
