#!/usr/bin/env node
// SPDX-License-Identifier: GPL-2.0-or-later
// The command line `alembert`, on files of this computer: the program gets those that the words name, and what it writes is
// written here.
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync, writeSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { run } from "./alembert.mjs";

const words = process.argv.slice(2);
const here = process.cwd();
/// A path as the program has it: with the folders of this computer, by slashes.
const inner = (path) => resolve(path).replace(/^([A-Za-z]):/, "/$1").replaceAll("\\", "/");
const outer = (path) => process.platform === "win32" ? resolve(here, path.replace(/^\/([A-Za-z])\//, "$1:/")) : resolve(here, path);

const files = {}, folders = new Set();

function take(path) {
    if (!path || path === "-") return;
    let kind = null;
    try {
        kind = statSync(path);
    } catch { /* there is none: it is an output, or no path at all */ }
    if (kind?.isFile()) files[inner(path)] = readFileSync(path);
    else if (kind?.isDirectory()) {
        folders.add(inner(path));
        for (const name of readdirSync(path)) if (statSync(join(path, name)).isFile()) files[inner(join(path, name))] = readFileSync(join(path, name));
    }
    if (!kind?.isDirectory() && existsSync(dirname(path))) folders.add(inner(dirname(path)));
}

words.forEach((word, k) => {
    const value = /^--?[\w-]+=(.*)$/.exec(word)?.[1] ?? (word.startsWith("-") ? "" : word);
    if (k === 0 && !/[./]/.test(word)) return; // the verb
    if (/^-o./.test(word)) take(word.slice(2));
    take(value);
    if (words.includes("--resume")) take(`${value}.unfinished`);
});
if (words[0] === "new" && words.every((word, k) => k === 0 || word.startsWith("-"))) take("pendulum.toml");

const tongue = process.env.LC_ALL || process.env.LC_MESSAGES || process.env.LANG || "";
const said = (process.env.LANGUAGE && tongue && tongue !== "C" ? process.env.LANGUAGE : tongue).startsWith("zh") && !words.includes("--language") && words[0] !== "emit";
const stdin = words.includes("-") ? readFileSync(0) : null;

const answer = await run(said ? [...words, "--language", "zh"] : words, files, { folder: inner(here), folders: [...folders], stdin });

/// All of a text, also where a pipe takes it in pieces.
function write_all(stream, text) {
    let bytes = Buffer.from(text);
    while (bytes.length) {
        try {
            bytes = bytes.subarray(writeSync(stream, bytes));
        } catch (problem) {
            if (problem.code === "EAGAIN") continue;
            if (problem.code === "EPIPE") process.exit(answer.code);
            throw problem;
        }
    }
}

let code = answer.code;
write_all(2, answer.stderr);
for (const [name, content] of Object.entries(answer.files)) {
    const path = outer(name);
    try {
        mkdirSync(dirname(path), { recursive: true });
        writeFileSync(path, content);
    } catch (problem) {
        write_all(2, `alembert: ${path}: ${problem.message}\n`);
        code = 5;
    }
}
write_all(1, answer.stdout);
process.exitCode = code;
