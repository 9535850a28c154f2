// SPDX-License-Identifier: GPL-2.0-or-later
// The time of a right-hand side by code in memory, as WebAssembly and native, and their ratio:
//   node web/rhs.mjs NATIVE FOLDER SCENE...
// NATIVE is bench_memory_code (tests/bench/memory_code.cpp), FOLDER has alembert.mjs and alembert.wasm. The module is the one
// that `simulate` makes: it is caught where the program hands it to the engine, and its function is called from here, each
// call with the result of the one before. What a call from JavaScript takes by itself (a function without instructions: 10 to
// 20 ns) is told, and is no part of the ratio.
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { basename, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [native, folder, ...scenes] = process.argv.slice(2);
const { load, run } = await import(pathToFileURL(resolve(folder, "alembert.mjs")));
await load();

/// The solver that the program makes of a scene: its functions, and a place in its memory where nothing else is.
async function solver(scene, text) {
    const { Instance } = WebAssembly, found = [];
    WebAssembly.Instance = function (module, imports) {
        const instance = new Instance(module, imports);
        found.push({ functions: Object.values(instance.exports), memory: imports.e.m });
        return instance;
    };
    const ended = await run(["simulate", scene, "--duration", "1e-3", "--method", "dop853", "--no-estimate", "--code", "memory"], { [scene]: text });
    WebAssembly.Instance = Instance;
    if (ended.code !== 0) throw new Error(ended.stderr);
    return found[0];
}

/// The scene's own numbers, as emitted code has them.
async function numbers_of(scene, text) {
    const { files } = await run(["emit", scene, "-o", "out", "--language", "js"], { [scene]: text });
    const { parameter_values, initial_state } = await import(`data:text/javascript,${encodeURIComponent(Object.values(files)[0])}`);
    return { parameter_values, initial_state };
}

/// Nanoseconds of one call, the least of 25 runs of at least a millisecond.
function nanoseconds(call) {
    let least = Infinity;
    for (let round = 0; round < 25; ++round)
        for (let count = 1; ; count *= 2) {
            const begin = performance.now();
            for (let k = 0; k < count; ++k) call();
            const time = performance.now() - begin;
            if (time < 1) continue;
            least = Math.min(least, 1e6 * time / count);
            break;
        }
    return least;
}

/// A module of one function, (t, state, par, rate), without instructions.
const nothing = new WebAssembly.Instance(new WebAssembly.Module(Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, 1, 8, 1, 0x60, 4, 0x7c, 0x7f, 0x7f, 0x7f, 0,
    3, 2, 1, 0, 7, 5, 1, 1, 0x30, 0, 0, 10, 4, 1, 2, 0, 11))).exports[0];

console.log(`${"".padEnd(28)}  operations  native, ns     web, ns    call, ns   ratio`);
for (const scene of scenes) {
    const text = readFileSync(scene, "utf8"), name = basename(scene);
    const { functions, memory } = await solver(name, text);
    const rhs = functions.find((one) => one.length === 4), prepare = functions[0].length === 1 ? functions[0] : () => {};
    const { parameter_values, initial_state } = await numbers_of(name, text);
    const place = memory.buffer.byteLength;
    memory.grow(8);
    const numbers = new Float64Array(memory.buffer, place), room = 8192;
    initial_state.forEach((x, k) => { numbers[k] = x + 0.01 * k; });
    parameter_values.forEach((x, k) => { numbers[room + k] = x; });
    const par = place + 8 * room, rate = place + 16 * room;
    prepare(par);
    const time_of = (called) => nanoseconds(() => {
        called(0.1, place, par, rate);
        numbers[0] += 1e-18 * numbers[2 * room];
    });
    const web = time_of(rhs), call = time_of(nothing);
    const said = spawnSync(native, [scene], { encoding: "utf8" }).stdout.trim().split("\n").at(-1).trim().split(/\s+/);
    const operations = Number(said[1]), own = Number(said[3]);
    const columns = [operations, own.toFixed(1), web.toFixed(1), call.toFixed(1)].map((text) => String(text).padStart(12)).join("");
    console.log(`${name.padEnd(28)}${columns}${((web - call) / own).toFixed(2).padStart(8)}`);
}
