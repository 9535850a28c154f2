// SPDX-License-Identifier: GPL-2.0-or-later
// Each verb of the command line as a function: a scene in, the JSON object of the verb out. Verbs and options are those that
// the program names itself (verbs.js is made from it).
import { load, run } from "./alembert.mjs";
import { aliases, verbs, version } from "./verbs.js";

export { load, prepare, run } from "./alembert.mjs";
export { version };

/// What the program says where it gives no result: exit codes 3 (the input), 4 (the numbers), 5 (the environment).
export class AlembertError extends Error {
    constructor(answer, result, names = []) {
        super(answer.stderr.trim() || `the program ended with ${answer.code}`);
        this.name = "AlembertError";
        this.code = answer.code;
        this.diagnostics = diagnostics_of(answer.stderr, names);
        this.result = result;
        this.written = answer.files;
    }
}

/// `names` are those of the files that the program had, which may have blanks in them.
function diagnostics_of(stderr, names) {
    const found = [];
    for (const line of stderr.split("\n")) {
        const file = names.find((name) => line.startsWith(`${name}:`)) ?? /^[^\s:]+/.exec(line)?.[0];
        const place = file && /^:(\d+):(?:(\d+):)? (.*)$/.exec(line.slice(file.length));
        if (place && !place[3].startsWith("warning:"))
            found.push({ file, line: Number(place[1]), column: Number(place[2] ?? 1), message: place[3] });
    }
    return found;
}

const dashed = (name) => name.replaceAll("_", "-").replace(/[A-Z]/g, (c) => `-${c.toLowerCase()}`);

function written(value) {
    if (Array.isArray(value)) return value.map(written).join(":");
    if (typeof value === "number" && !Number.isFinite(value)) throw new TypeError(`${value} is no number for an option`);
    return String(value);
}

/// An option as words of a command line. `true` is the option alone; an object is NAME=VALUE for each of its names, with [from, to,
/// count] as FROM:TO:COUNT; a list is the option again and again, or its values with commas where the option takes NAMES.
function words_of(verb, name, value) {
    const key = dashed(name), known = verbs[verb].options[key];
    if (!known) throw new TypeError(`${verb} has no option '${name}'; there are ${Object.keys(verbs[verb].options).join(", ")}`);
    if (value === undefined || value === null || value === false) return [];
    const option = `--${key}`;
    if (!known.takes) {
        if (value !== true) throw new TypeError(`${verb}: the option '${name}' is true or false`);
        return [option];
    }
    if (value === true) throw new TypeError(`${verb}: the option '${name}' needs a value, ${known.takes}`);
    if (Array.isArray(value)) return known.repeats ? value.flatMap((one) => [option, written(one)]) : [option, value.map(written).join(",")];
    if (typeof value === "object") return Object.entries(value).flatMap(([left, right]) => [option, `${left}=${written(right)}`]);
    return [option, written(value)];
}

/// The scene as files: a text, or {files: {name: text}, scene: name}.
function taken(verb, source) {
    if (typeof source === "string") {
        const name = verb !== "import" ? "scene.toml" : source.includes("<mujoco") ? "robot.xml" : source.includes("<sdf") ? "robot.sdf" : "robot.urdf";
        return { files: { [name]: source }, scene: name };
    }
    const files = source?.files;
    if (!files || typeof files !== "object") throw new TypeError(`${verb} takes the text of a scene, or {files: {name: text}}`);
    const scene = source.scene ?? Object.keys(files).find((name) => name.endsWith(".toml")) ?? Object.keys(files)[0];
    if (!(scene in files)) throw new TypeError(`${verb}: there is no file '${scene}'`);
    return { files: { ...files }, scene };
}

const derivation_name = (text) => (/\\[a-zA-Z]|\$/.test(text) ? "derivation.tex" : "derivation.md");

/// Claims (a text, or a list of equations) or a derivation, as a further file of `check`.
function second_file(options, files) {
    const { claims, derivation, ...rest } = options;
    if (claims !== undefined && derivation !== undefined) throw new TypeError("check takes claims or a derivation");
    if (claims !== undefined) files["claims.txt"] = Array.isArray(claims) ? claims.join("\n") + "\n" : claims;
    else if (derivation !== undefined) {
        const name = derivation_name(derivation);
        files[name] = derivation;
        return { name, rest };
    }
    return { name: claims === undefined ? null : "claims.txt", rest };
}

/// Options that name a file which is read. They may hold the text itself.
const READ = { report: "derivation", sweep: "vary_from", import: "loops" };

function with_files(verb, options, files) {
    const given = { ...options };
    for (const [name, value] of Object.entries(given)) {
        if (dashed(name) !== dashed(READ[verb] ?? "") || typeof value !== "string" || value in files) continue;
        given[name] = verb === "sweep" ? "points.csv" : verb === "import" ? "loops.toml" : derivation_name(value);
        files[given[name]] = value;
    }
    return given;
}

const OWN = ["signal", "worker"]; // options that are not the program's

function command_of(verb, fixed, source, options) {
    const words = [verb];
    const given = { ...fixed, ...options };
    for (const name of OWN) delete given[name];
    if (verb === "new") return { words: ["new", "pendulum.toml", "--json", ...rest_of(verb, given)], files: {}, folders: [] };
    const { files, scene } = taken(verb, source);
    words.push(scene);
    let rest = with_files(verb, given, files);
    if (verb === "check") {
        const second = second_file(rest, files);
        if (second.name) words.push(second.name);
        rest = second.rest;
    }
    if (verb === "emit" && !rest.output && !rest.o && !rest.fmu) rest = { ...rest, output: "." };
    if (verb === "import" && !rest.output) rest = { ...rest, output: "scene.toml" };
    return { words: [...words, "--json", ...rest_of(verb, rest)], files, folders: folders_of(verb, rest) };
}

/// The folders in which the program is to write.
function folders_of(verb, options) {
    const folders = [];
    for (const [name, value] of Object.entries(options)) {
        const end = verbs[verb].options[dashed(name)]?.file && typeof value === "string" ? value.lastIndexOf("/") : -1;
        if (end > 0) folders.push(value.startsWith("/") ? value.slice(0, end) : `/scene/${value.slice(0, end)}`);
    }
    return folders;
}

const rest_of = (verb, options) => Object.entries(options).flatMap(([name, value]) => name === "json" ? [] : words_of(verb, name, value));

/// The JSON object, with what is no part of it beside it: the files `written`, the `exitCode`, and what was `told` as warnings.
function result_of(answer, names) {
    let result;
    try {
        result = JSON.parse(answer.stdout);
    } catch {
        result = answer.code <= 2 ? { text: answer.stdout } : undefined;
    }
    if (answer.code > 2) throw new AlembertError(answer, result, names);
    // By the same names as in `written`.
    const plain = (name) => (typeof name === "string" ? name.replace(/^(\.\/)+/, "") : name);
    if (Array.isArray(result.files)) result.files = result.files.map(plain);
    if (typeof result.file === "string") result.file = plain(result.file);
    for (const [name, value] of Object.entries({ written: answer.files, exitCode: answer.code, told: answer.stderr }))
        Object.defineProperty(result, name, { value });
    return result;
}

function functions_with(runner) {
    const made = {};
    const add = (name, verb, fixed) => {
        made[name] = async (source, options = {}) => {
            if (verb === "new" && source && typeof source === "object") [source, options] = [undefined, source];
            const { words, files, folders } = command_of(verb, fixed, source, options);
            return result_of(await runner(words, files, options, { folders }), Object.keys(files));
        };
        Object.defineProperty(made[name], "name", { value: name });
    };
    for (const name of Object.keys(verbs)) add(name, name, {});
    for (const [name, [verb, option]] of Object.entries(aliases)) add(name, verb, { [option]: true });
    made.mark = (source, derivation, options = {}) => made.check(source, { ...options, derivation });
    return made;
}

/// Node 18 and 20 have no Worker of their own outside of this module, whose name bundlers for browsers must not see.
async function worker_of_node() {
    const name = "node:worker_threads", { Worker } = await import(/* @vite-ignore */ /* webpackIgnore: true */ name);
    return new Worker(new URL("./worker.js", import.meta.url));
}

/// The functions of this module in a worker of their own: a thread that long work does not take from the caller.
///
///     const away = await inWorker();
///     try { await away.simulate(scene, { duration: 1000 }); } finally { await away.terminate(); }
export async function inWorker() {
    // As one expression, in which bundlers see the file of the worker.
    const worker = globalThis.Worker ? new Worker(new URL("./worker.js", import.meta.url), { type: "module" }) : await worker_of_node();
    const waiting = new Map();
    let number = 0, ended = null;
    const end = (problem) => {
        ended = problem;
        for (const { reject } of waiting.values()) reject(problem);
        waiting.clear();
    };
    const hear = (name, listen) => worker.on ? worker.on(name, listen) : worker.addEventListener(name, listen);
    hear("message", (event) => {
        const { id, answer, problem } = worker.on ? event : event.data;
        const { resolve, reject } = waiting.get(id) ?? {};
        waiting.delete(id);
        if (waiting.size === 0) worker.unref?.();
        if (problem === undefined) resolve?.(answer);
        else reject?.(new Error(problem));
    });
    hear("error", (event) => end(new Error(event.message ?? "the worker cannot be loaded")));
    worker.unref?.();
    // All workers share the program that is compiled here.
    worker.postMessage({ program: await load() });
    const runner = (words, files, options, more) => new Promise((resolve, reject) => {
        if (ended) return reject(ended);
        waiting.set(++number, { resolve, reject });
        worker.ref?.();
        worker.postMessage({ id: number, words, files, more });
    });
    const terminate = async () => {
        end(new Error("the worker has been terminated"));
        await worker.terminate();
    };
    return { ...functions_with(runner), run: (words, files, more) => runner(words, files, {}, more), terminate };
}

/// Runs here, or, with `worker: true` or a signal that can abort it, in a worker that ends with the work.
async function anywhere(words, files, { worker, signal }, more) {
    if (!worker && !signal) return run(words, files, more);
    signal?.throwIfAborted();
    const away = await inWorker();
    const aborted = () => away.terminate();
    signal?.addEventListener("abort", aborted);
    try {
        return await away.run(words, files, more);
    } catch (problem) {
        signal?.throwIfAborted();
        throw problem;
    } finally {
        signal?.removeEventListener("abort", aborted);
        await away.terminate();
    }
}

const here = functions_with(anywhere);
export default here;
