// SPDX-License-Identifier: MIT
// Puts the playground together: build.mjs ROOT PROGRAM_FOLDER FOLDER (web/playground.sh calls it).
import { createHash } from "node:crypto";
import { copyFileSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const [root, program, folder] = process.argv.slice(2);
const read = (...path) => readFileSync(join(root, ...path), "utf-8");
const NOT_SERVED = ["build.mjs", "examples.txt"];

/// The title of a scene, as it says it.
function title_of(scene, name) {
    const title = /^title\s*=\s*"((?:[^"\\]|\\.)*)"/m.exec(scene)?.[1];
    if (!title) throw new Error(`scenes/${name}.toml has no title`);
    return JSON.parse(`"${title}"`);
}

/// The menu: groups with their scenes, from examples.txt.
function examples() {
    const groups = [];
    for (const line of read("web/playground/examples.txt").split("\n")) {
        if (line.startsWith("## ")) groups.push({ group: line.slice(3).split("|").map((one) => one.trim()), scenes: [] });
        if (!line.trim() || line.startsWith("#")) continue;
        const [name, chinese, derivation] = line.split("|").map((one) => one.trim());
        const scene = read("scenes", `${name}.toml`);
        groups.at(-1).scenes.push({ name, title: [title_of(scene, name), chinese], scene,
            derivation: derivation ? read("tests/derivations", derivation) : "" });
    }
    return groups;
}

/// The functions of expressions, from the reference of the scene language.
function functions() {
    const text = read("docs/scene-language.md");
    const numbers = /\*\*Functions of numbers:\*\*([^]*?)\n\n/.exec(text)[1];
    const geometry = /\*\*Functions of the geometry\*\*[^]*?\n\n([^]*?)\n\n/.exec(text)[1];
    const partial = /\*\*Partial derivatives:\*\*([^]*?)\n\n/.exec(text)[1];
    const named = (part, pattern) => Array.from(part.matchAll(pattern), (found) => found[1]);
    const all = [...named(numbers, /`([a-z]\w+)(?:\([^)]*\))?`(?:[,.; ]|$)/g),
        ...named(named(geometry, /^\| (.*?) \|/gm).join(" "), /`([a-z]+)\(/g).sort(), ...named(partial, /`(\w+)\(/g).slice(0, 1)];
    if (all.length < 15) throw new Error("docs/scene-language.md does not list the functions as before");
    return [...new Set(all)];
}

function palette() {
    const style = read("templates/page_style.css");
    return style.slice(0, style.indexOf("\n* {") + 1);
}

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const data = { examples: examples(), schema: JSON.parse(read("docs/scene.schema.json")), functions: functions() };
writeFileSync(join(folder, "data.json"), JSON.stringify(data));
writeFileSync(join(folder, "palette.css"), palette());
for (const name of readdirSync(join(root, "web/playground")))
    if (!NOT_SERVED.includes(name)) copyFileSync(join(root, "web/playground", name), join(folder, name));
for (const name of ["alembert.wasm", "alembert.mjs"]) copyFileSync(join(program, name), join(folder, name));

const files = readdirSync(folder).filter((name) => name !== "service_worker.js").sort();
const hash = createHash("sha256");
for (const name of files) hash.update(name).update(readFileSync(join(folder, name)));
const worker = readFileSync(join(folder, "service_worker.js"), "utf-8");
writeFileSync(join(folder, "service_worker.js"), worker.replace("@VERSION@", hash.update(worker).digest("hex").slice(0, 16))
    .replace('"@FILES@"', JSON.stringify(["./", ...files])));
const count = data.examples.reduce((sum, { scenes }) => sum + scenes.length, 0);
console.log(`${folder}: ${files.length + 1} files, ${count} examples`);
