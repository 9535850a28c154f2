// SPDX-License-Identifier: MIT
// What the page asks of the program, and what it makes of the answers: messages and marks with their places.
import { say } from "./strings.js";

const SCENE = "scene.toml", OBJECT = "verdicts.json";

/// The messages of the error stream: `NAME:LINE:COLUMN: TEXT`, below each the line itself, set in.
export function messages_of(stderr, warning_word) {
    const found = [];
    for (const line of stderr.split("\n")) {
        if (!line.trim() || /^\s/.test(line)) continue;
        const [, file = "", number = 0, column = 0, text] = /^(?:([^\s:]+):(?:(\d+):(?:(\d+):)?)? )?(.*)$/.exec(line);
        const warning = text.startsWith(warning_word);
        found.push({ kind: warning ? "warn" : "bad", file, line: Number(number), column: Number(column),
            text: warning ? text.slice(warning_word.length).trim() : text });
    }
    return found.filter((one, k) => found.findIndex((other) => other.line === one.line && other.text === one.text) === k);
}

const warning_word = (tongue) => (tongue === "zh" ? "警告：" : "warning:");

/// Where the word ends that begins at a column.
function end_of_word(text, line, column) {
    const rest = (text.split("\n")[line - 1] ?? "").slice(column - 1);
    return column - 1 + (/^[\p{L}\p{N}_.']+/u.exec(rest)?.[0].length ?? 1);
}

const marks_of = (messages, text) => messages.filter(({ line }) => line > 0).map(({ kind, line, column, text: told }) =>
    ({ kind, line, column, end: column ? end_of_word(text, line, column) : 0, text: told }));

/// The report of `check` in blocks: for each claim its first line and the lines that are set in below it.
function blocks_of(stdout) {
    const blocks = [];
    for (const line of stdout.split("\n"))
        if (/^\s/.test(line)) blocks.at(-1)?.push(line.trim());
        else blocks.push([line]);
    return blocks;
}

const SIGN = { proved: "good", refuted: "refuted", undecided: "open", vacuous: "open" };

/// The mistakes of a scene, or else the verdicts on its claims.
export async function judged_scene(desk, text, tongue) {
    const claims_there = /^\s*\[\[\s*claim\s*\]\]/m.test(text);
    const verb = claims_there ? "check" : "derive";
    const also = claims_there ? ["--json-file", OBJECT] : [];
    const told = await desk.run([verb, SCENE, ...also, "--language", tongue], { [SCENE]: text });
    const messages = messages_of(told.stderr, warning_word(tongue));
    if (told.code === 3 || !claims_there || told.code > 3)
        return { faulty: told.code === 3, messages, marks: marks_of(messages, text) };
    const { claims } = JSON.parse(told.files[OBJECT]);
    const blocks = blocks_of(told.stdout);
    const judged = claims.map(({ line, verdict, equation, likely, nearest }, k) => ({
        kind: SIGN[verdict], line, column: 0, verdict: say(verdict), text: equation, more: blocks[k]?.slice(1) ?? [],
        right: verdict === "refuted" ? likely?.repair ?? nearest ?? "" : "" }));
    const marks = judged.map(({ kind, line, verdict }) => ({ kind, line, text: verdict }));
    return { faulty: false, messages: [...messages, ...judged], marks: [...marks_of(messages, text), ...marks] };
}

/// The live page of a scene, or null where the scene has mistakes.
export async function scene_page(desk, text, tongue) {
    const { code, files, stderr } = await desk.run(["report", SCENE, "-o", "page.html", "--language", tongue], { [SCENE]: text });
    if (code === 3) return null;
    if (!files["page.html"]) throw new Error(stderr.trim() || `exit code ${code}`);
    return files["page.html"];
}

const STATUS = { right: "good", right_near: "good", right_up_to_constant: "good", right_up_to_derivative: "good",
    definition: "plain", mistake: "refuted", follows: "open", unfounded: "open", undecided: "open", not_understood: "open",
    not_about_scene: "plain" };

/// A derivation, line by line: messages, marks, and the page that the program makes of it.
export async function judged_derivation(desk, scene, text, tongue) {
    const name = /\\[a-zA-Z]|\$/.test(text) ? "derivation.tex" : "derivation.md";
    const files = { [SCENE]: scene, [name]: text };
    const told = await desk.run(["check", SCENE, name, "--html", "marked.html", "--json-file", OBJECT, "--language", tongue], files);
    if (told.code >= 3) {
        const messages = messages_of(told.stderr, warning_word(tongue));
        const own = messages.filter(({ file }) => file !== SCENE);
        return { scene_faulty: own.length === 0, messages: own, marks: marks_of(own, text) };
    }
    const { lines } = JSON.parse(told.files[OBJECT]);
    const judged = lines.map(({ line, column, source, status, right, follows_from }) => ({
        kind: STATUS[status], line, column, text: source, right: status === "mistake" ? right : "", short: true,
        verdict: follows_from === null ? say(status) : say("follows_from", { n: lines[follows_from].line }) }));
    const marks = judged.map(({ kind, line, verdict }) => ({ kind, line, text: verdict }));
    return { messages: judged.filter(({ kind }) => kind !== "plain" && kind !== "good"), marks, html: told.files["marked.html"] };
}
