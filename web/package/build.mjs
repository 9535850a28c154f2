// SPDX-License-Identifier: GPL-2.0-or-later
// Puts the package together: build.mjs ROOT PROGRAM_FOLDER FOLDER (web/package.sh calls it). Verbs, options and what is said
// of them are taken from the program: its completion for fish, and its help.
import { chmodSync, copyFileSync, cpSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [root, program, folder] = process.argv.slice(2);
const NOT_PACKED = ["build.mjs", "types.d.ts"];
/// Options that are the package's own affair, or have no sense in it.
const LEFT_OUT = ["help", "language", "json", "open", "watch", "port", "threads"];
/// Earlier names of the command line that are functions of their own, as in Python: [verb, option].
const ALIASES = { agree: ["check", "formalisms"], kinematics: ["eval", "kinematics"], inertia: ["eval", "inertia"], identify: ["eval", "identify"],
    inverse: ["eval", "inverse"], impact: ["eval", "impact"], linearize: ["stability", "matrices"] };

const { run } = await import(pathToFileURL(join(program, "alembert.mjs")));
const said = async (...words) => {
    const { code, stdout, stderr } = await run(words);
    if (code !== 0) throw new Error(`alembert ${words.join(" ")}: ${stderr}`);
    return stdout;
};
const unquoted = (text) => text.replaceAll("'\\''", "'").replaceAll("\\\\", "\\");

/// {verb: {about, options: {name: {about, takes, values, file, repeats}}}}
async function verbs() {
    const found = {};
    for (const line of (await said("--completion", "fish")).split("\n")) {
        const verb = /-n __fish_use_subcommand -a (\S+) -d '((?:[^'\\]|\\.|'\\'')*)'$/.exec(line);
        if (verb) found[verb[1]] = { about: unquoted(verb[2]), options: {} };
        const option = /__fish_seen_subcommand_from (\S+)' (?:-s \w )?-l ([\w-]+)( -r| -x)?( -F)?(?: -a '([^']*)')? -d '((?:[^'\\]|\\.|'\\'')*)'$/.exec(line);
        if (!option || LEFT_OUT.includes(option[2]) && !(option[1] === "emit" && option[2] === "language")) continue;
        const [, of, name, takes, file, values, about] = option;
        found[of].options[name] = { about: unquoted(about), ...(takes ? { takes: "VALUE" } : {}), ...(file ? { file: true } : {}),
            ...(values ? { values: values.split(" ") } : {}) };
    }
    for (const [verb, { options }] of Object.entries(found)) {
        const pages = [await said(verb, "--help")];
        for (const more of pages[0].matchAll(/'alembert \S+ (--\w+) --help'/g)) pages.push(await said(verb, more[1], "--help"));
        for (const flag of ["--kinematics", "--inertia", "--identify", "--inverse", "--impact"]) if (verb === "eval") pages.push(await said(verb, flag, "--help"));
        for (const [, name, takes, repeats] of pages.join("\n").matchAll(/^ +(?:-\w, )?--([\w-]+)(?: ([A-Z][\w=:.]*)(…?))?(?= |$)/gm))
            if (options[name]?.takes && takes) Object.assign(options[name], { takes }, repeats ? { repeats: true } : {});
    }
    return found;
}

const camel = (name) => name.replace(/-(\w)/g, (_, c) => c.toUpperCase());

function type_of({ takes, values, repeats }) {
    if (!takes) return "boolean";
    if (/^NAME=/.test(takes)) return /FROM/.test(takes) ? "Ranges" : "Values";
    if (values) return values.map((one) => JSON.stringify(one)).join(" | ");
    if (/^(S|X|N|SECONDS|NUMBER)$/.test(takes)) return "number | string";
    if (/^(NAMES|LIST)$/.test(takes) || repeats) return "string | readonly string[]";
    return "string";
}

/// index.d.ts: what types.d.ts says by hand, and then verbs and their options.
function types(all) {
    const name_of = (verb) => `${verb[0].toUpperCase()}${verb.slice(1)}Options`;
    const comment = (text) => `/** ${text.replaceAll("*/", "* /")} */`;
    const lines = [readFileSync(join(root, "web/package/types.d.ts"), "utf-8").trimEnd(), ""];
    for (const [verb, { options }] of Object.entries(all)) {
        lines.push(`export interface ${name_of(verb)} extends Options {`);
        if (verb === "check")
            lines.push("    /** Equations, one a line, in place of the scene's own claims. */", "    claims?: string | readonly string[];",
                "    /** A derivation in LaTeX, Markdown or plain text, line by line. */", "    derivation?: string;");
        for (const [name, option] of Object.entries(options)) lines.push(`    ${comment(option.about)}`, `    ${camel(name)}?: ${type_of(option)};`);
        lines.push("}");
    }
    const results = { derive: "Derived", check: "Checked", eval: "Evaluated", simulate: "Simulated", stability: "Stability", equilibrium: "Equilibria", emit: "Emitted",
        report: "Written", agree: "Agreed" };
    lines.push("", "export interface Verbs {");
    for (const [verb, { about }] of Object.entries(all)) {
        const result = `Promise<Result<${results[verb] ?? "Json"}>>`;
        // Without quotes, new() would be a constructor.
        lines.push(`    ${comment(about)}`, verb === "new" ? `    "new"(options?: ${name_of(verb)}): ${result};` : `    ${verb}(scene: Scene, options?: ${name_of(verb)}): ${result};`);
    }
    for (const [name, [verb, option]] of Object.entries(ALIASES))
        lines.push(`    ${comment(all[verb].options[option].about)}`, `    ${name}(scene: Scene, options?: ${name_of(verb)}): Promise<Result<${results[name] ?? "Json"}>>;`);
    lines.push("    /** Judges a derivation in LaTeX, Markdown or plain text line by line. */", "    mark(scene: Scene, derivation: string, options?: CheckOptions): Promise<Result<Checked>>;", "}", "");
    const names = [...Object.keys(all), ...Object.keys(ALIASES), "mark"];
    const reserved = ["eval", "import", "new"];
    for (const name of names) lines.push(`declare const ${reserved.includes(name) ? `${name}_` : name}: Verbs[${JSON.stringify(name)}];`);
    lines.push(`export { ${names.map((name) => reserved.includes(name) ? `${name}_ as ${name}` : name).join(", ")} };`);
    lines.push("declare const verbs: Verbs;", "export default verbs;");
    return lines.join("\n") + "\n";
}

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const all = await verbs();
const version = (await said("--version")).trim().split(" ").at(-1);
writeFileSync(join(folder, "verbs.js"), `// SPDX-License-Identifier: GPL-2.0-or-later\n// Made by web/package/build.mjs from the program's own words.\nexport const version = ${JSON.stringify(version)};\nexport const aliases = ${JSON.stringify(ALIASES)};\nexport const verbs = ${JSON.stringify(all, null, 1)};\n`);
writeFileSync(join(folder, "index.d.ts"), types(all));
for (const name of readdirSync(join(root, "web/package"))) if (!NOT_PACKED.includes(name)) copyFileSync(join(root, "web/package", name), join(folder, name));
for (const name of ["alembert.mjs", "alembert.wasm"]) copyFileSync(join(program, name), join(folder, name));
cpSync(join(root, "LICENSES"), join(folder, "LICENSES"), { recursive: true });
// Names of the module are known before it runs, so they stand in its text.
const names = [...Object.keys(all), ...Object.keys(ALIASES), "mark"];
const exported = names.map((name) => `const ${name}_ = here[${JSON.stringify(name)}];`).join("\n") + `\nexport { ${names.map((name) => `${name}_ as ${name}`).join(", ")} };\n`;
writeFileSync(join(folder, "index.js"), readFileSync(join(folder, "index.js"), "utf-8") + "\n" + exported);
chmodSync(join(folder, "command.js"), 0o755);
chmodSync(join(folder, "alembert.wasm"), 0o644);
const about = JSON.parse(readFileSync(join(folder, "package.json"), "utf-8"));
writeFileSync(join(folder, "package.json"), JSON.stringify({ ...about, version }, null, 2) + "\n");
console.log(`${folder}: ${names.length} functions, version ${version}`);
