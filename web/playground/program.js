// SPDX-License-Identifier: MIT
// The program, in workers. A desk does one thing at a time, and what is newer ends what is older.

/// Smallest module with a `try`: what the program's exceptions need of the engine.
const WITH_TRY = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 8, 1, 6, 0, 6, 64, 25, 11, 11);

/// The name of the text that says why the program cannot run here, or null.
export function missing_feature() {
    if (typeof WebAssembly !== "object") return "no_wasm";
    return WebAssembly.validate(WITH_TRY) ? null : "no_exceptions";
}

let compiled = null;

/// The program's module, compiled while it is fetched.
export function program() {
    compiled ??= fetched(new URL("alembert.wasm", import.meta.url));
    return compiled;
}

async function fetched(place) {
    const answer = await fetch(place);
    if (!answer.ok) throw new Error(`alembert.wasm: ${answer.status} ${answer.statusText}`.trim());
    if (/^application\/wasm\b/.test(answer.headers.get("content-type") ?? "")) return WebAssembly.compileStreaming(answer);
    return WebAssembly.compile(await answer.arrayBuffer());
}

export class Superseded extends Error {}

export class Desk {
    #worker = null;
    #reject = null;
    #turn = 0;

    constructor() {
        this.#hire();
    }

    /// A worker that knows the program, before there is something to do.
    #hire() {
        const worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
        this.#worker = worker;
        program().then((module) => worker.postMessage({ module }), () => {});
    }

    /// Ends what is being done here.
    stop() {
        this.#turn += 1;
        if (!this.#reject) return;
        this.#worker.terminate();
        this.#reject(new Superseded("superseded"));
        this.#reject = null;
        this.#hire();
    }

    /// What the command line `words` gives in a folder with these files: `{code, stdout, stderr, files}`.
    async run(words, files) {
        this.stop();
        const turn = this.#turn;
        await program();
        if (turn !== this.#turn) throw new Superseded("superseded");
        return new Promise((resolve, reject) => {
            this.#reject = reject;
            this.#worker.onmessage = ({ data }) => {
                this.#reject = null;
                if (data.problem) reject(new Error(data.problem));
                else resolve(data.answer);
            };
            this.#worker.onerror = (event) => {
                event.preventDefault?.();
                this.#worker.terminate();
                this.#reject = null;
                this.#hire();
                reject(new Error(event.message || "alembert.mjs cannot be loaded"));
            };
            this.#worker.postMessage({ words, files });
        });
    }
}
