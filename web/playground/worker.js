// SPDX-License-Identifier: MIT
// Runs the program away from the page. It gets the compiled module first, and then command lines. Each run needs an instance of
// its own, which is made while nothing is asked.
import { load, prepare, run } from "./alembert.mjs";

addEventListener("message", async ({ data: { module, words, files } }) => {
    if (module) {
        load(module);
        return prepare().catch(() => {}); // the first run says what is wrong
    }
    try {
        postMessage({ answer: await run(words, files) });
    } catch (problem) {
        postMessage({ problem: String(problem?.message ?? problem) });
    }
    prepare().catch(() => {});
});
