// SPDX-License-Identifier: MIT
// The playground: a scene and a derivation on one side, what the program makes of them on the other.
import { Completion, choices_at } from "./completion.js";
import { Editor } from "./editor.js";
import { Frames } from "./frames.js";
import { divider, tabs } from "./layout.js";
import { show_messages } from "./messages.js";
import { derivation_colours } from "./latex.js";
import { OwnTexts } from "./own_texts.js";
import { Desk, Superseded, missing_feature, program } from "./program.js";
import { can_pack, fragment_of, texts_of } from "./share.js";
import { language, say, speak } from "./strings.js";
import { colours } from "./toml.js";
import { judged_derivation, judged_scene, scene_page } from "./verbs.js";

const by_id = (id) => document.getElementById(id);
const memory = {
    get: (key) => { try { return localStorage.getItem(`alembert.${key}`); } catch { return null; } },
    set: (key, value) => { try { localStorage.setItem(`alembert.${key}`, value); } catch { /* a private window */ } },
};

speak(memory.get("language") ?? (navigator.language.startsWith("zh") ? "zh" : "en"));

const data = fetch("data.json").then((answer) => answer.json()); // examples, schema, functions
const desks = { scene: new Desk(), page: new Desk(), derivation: new Desk() };
const page = new Frames(by_id("page"), () => say("look"));
const marked = new Frames(by_id("marked"), () => say("look"));
const found = { scene: { messages: [] }, derivation: { messages: [] }, faulty: false, example: "" };
const busy = new Map();

const own = new OwnTexts(() => list_examples());
const scene = new Editor(by_id("panel-scene"), { id: "scene", colour: colours, changed: () => edited(scene_changed) });
const derivation = new Editor(by_id("panel-derivation"), { id: "derivation", colour: derivation_colours, changed: () => edited(derivation_changed) });
let material = { schema: {}, functions: [] };
new Completion(scene, (text, offset) => choices_at(text, offset, material.schema, material.functions));
const tab = tabs(["scene", "derivation", "result"], show_tab);
divider(by_id("divide"), memory);

// What is being done ---------------------------------------------------------------------------------------------------
function state() {
    const kind = busy.size ? "working" : found.faulty ? "faulty" : found.problem ? "stopped" : "ready";
    const faults = found.scene.messages.filter(({ kind }) => kind === "bad" || kind === "refuted").length;
    document.body.dataset.state = kind;
    by_id("status").textContent = kind === "working" ? say(found.answered ? "working" : found.loaded ? "starting" : "loading")
        : found.problem ? found.problem : faults ? say("faults", { n: faults }) : say("ready");
    by_id("lamp").className = kind === "ready" && faults ? "faulty" : kind;
    by_id("note").textContent = say(tab.written() === "derivation" ? "stale_derivation" : "stale");
    by_id("note").hidden = !found.faulty || tab.written() === "derivation" && !derivation.text.trim();
    by_id("look").classList.toggle("stale", found.faulty);
}

/// Runs `work` as the only one of its name; what is superseded ends without a word.
async function only(name, work) {
    const token = {};
    busy.set(name, token);
    found.problem = "";
    const slow = setTimeout(() => { by_id("stop").hidden = busy.size === 0; }, 1500);
    state();
    try {
        await work(() => busy.get(name) === token);
    } catch (problem) {
        if (!(problem instanceof Superseded)) found.problem = say(found.answered ? "died" : "no_program", { why: problem.message });
        if (!found.answered && !(problem instanceof Superseded)) fail(found.problem);
    }
    clearTimeout(slow);
    if (busy.get(name) === token) busy.delete(name);
    if (busy.size === 0) by_id("stop").hidden = true;
    state();
}

function fail(sentence) {
    by_id("problem").textContent = sentence;
    by_id("problem").hidden = false;
}

// The scene and the derivation -----------------------------------------------------------------------------------------
const timers = {};
function soon(name, work, wait) {
    clearTimeout(timers[name]);
    busy.set(`${name}, soon`, {});
    timers[name] = setTimeout(() => {
        busy.delete(`${name}, soon`);
        work();
    }, wait);
    state();
}

/// After the reader has changed a text himself.
function edited(changed) {
    const id = own.write({ scene: scene.text, derivation: derivation.text });
    if (location.hash) history.replaceState(null, "", location.pathname + location.search);
    const name = id ? `own/${id}` : found.example;
    if (id === null) fail(say("not_kept"));
    else if (!id || found.example !== name || by_id("examples").selectedOptions[0]?.textContent !== own_title(own.get(id))) list_examples(name);
    changed(250);
}

function scene_changed(wait) {
    soon("scene", judge_scene, wait);
    desks.page.stop();
    desks.scene.stop();
}

function derivation_changed(wait) {
    soon("derivation", judge_derivation, wait);
    desks.derivation.stop();
}

function judge_scene() {
    const text = scene.text, tongue = language();
    if (!text.trim()) {
        found.scene = { messages: [{ kind: "hint", text: say("empty_scene") }] };
        scene.mark([]);
        found.faulty = true;
        show_tab();
        return state();
    }
    only("scene", async (is_mine) => {
        const judged = await judged_scene(desks.scene, text, tongue);
        if (!is_mine()) return;
        found.scene = judged;
        found.faulty = judged.faulty;
        scene.mark(judged.marks);
        show_tab();
        document.documentElement.dataset.firstAnswer ??= Math.round(performance.now());
        if (judged.faulty) {
            desks.page.stop();
            answered();
        } else if (found.answered) judge_derivation();
    });
    only("page", async (is_mine) => {
        const html = await scene_page(desks.page, text, tongue);
        if (!html || !is_mine()) return;
        await page.show(html, !found.fresh);
        found.fresh = false;
        found.html = html;
        document.documentElement.dataset.firstPage ??= Math.round(performance.now());
        if (!found.answered) judge_derivation();
        answered();
    });
}

function judge_derivation() {
    const text = derivation.text;
    if (!text.trim()) {
        found.derivation = { messages: [] };
        derivation.mark([]);
        marked.show("", false);
        show_tab();
        return state();
    }
    only("derivation", async (is_mine) => {
        const judged = await judged_derivation(desks.derivation, scene.text, text, language());
        if (!is_mine() || judged.scene_faulty) return;
        found.derivation = judged;
        derivation.mark(judged.marks);
        show_tab();
        if (judged.html) await marked.show(judged.html, true);
    });
}

/// The first answer is there: what can wait begins now.
function answered() {
    if (found.answered) return;
    found.answered = true;
    if (navigator.serviceWorker) keep_offline();
}

async function keep_offline() {
    try {
        await navigator.serviceWorker.register("service_worker.js");
        await navigator.serviceWorker.ready;
        by_id("offline").hidden = false;
    } catch { /* the server is not trusted with one (http without TLS): the page works, but not offline */ }
}

// Examples, links, languages -------------------------------------------------------------------------------------------
/// What the menu says of a text of the reader's: its title, or else its first words, and when it was changed.
function own_title({ scene, derivation, changed }) {
    const first = /^title\s*=\s*"([^"]+)"/m.exec(scene)?.[1] ?? /\S.*/.exec(scene)?.[0] ?? /\S.*/.exec(derivation)?.[0] ?? "";
    const title = first.length > 48 ? `${first.slice(0, 47)}…` : first;
    return `${title} · ${new Date(changed).toLocaleString(language(), { dateStyle: "medium", timeStyle: "short" })}`;
}

function list_examples(chosen = found.example) {
    found.example = chosen;
    const zh = language() === "zh";
    const option = (value, text) => Object.assign(document.createElement("option"), { value, textContent: text });
    const group = (label, options) => {
        const element = Object.assign(document.createElement("optgroup"), { label });
        element.append(...options);
        return element;
    };
    const shared = chosen === "shared" ? [option("shared", say("shared"))] : [];
    const written = own.list().map((text) => option(`own/${text.id}`, own_title(text)));
    const groups = (material.examples ?? []).map(({ group: [english, chinese], scenes }) =>
        group(zh ? chinese : english, scenes.map(({ name, title }) => option(name, title[zh ? 1 : 0]))));
    by_id("examples").replaceChildren(...shared, ...written.length ? [group(say("own"), written)] : [], ...groups);
    by_id("examples").value = chosen;
}

function set_texts({ scene: first, derivation: second }, name, id) {
    if (id) own.open(id);
    else own.leave();
    found.example = name;
    found.fresh = true; // the next page is another one: it begins at its head
    scene.text = first;
    derivation.text = second ?? "";
    found.derivation = { messages: [] };
    marked.show("", false);
    scene_changed(0);
}

function choose_example(name) {
    const id = /^own\/(.*)/.exec(name)?.[1];
    const known = id ? own.get(id) : material.examples.flatMap(({ scenes }) => scenes).find((one) => one.name === name);
    if (!known) return;
    set_texts(known, name, id);
    list_examples(name);
    history.replaceState(null, "", id ? location.pathname : `#example=${name}`);
}

/// The texts that the address names, or else the reader's last, or else the first example.
async function begin() {
    try {
        const named = /^#example=([\w/]+)$/.exec(location.hash)?.[1];
        if (named && material.examples.some(({ scenes }) => scenes.some(({ name }) => name === named))) return choose_example(named);
        const shared = await texts_of(location.hash);
        if (shared) {
            set_texts(shared, "shared");
            list_examples("shared");
            return tab.choose(shared.tab);
        }
    } catch (problem) {
        fail(say("bad_link", { why: problem.message }));
        return choose_example(material.examples[0].scenes[0].name);
    }
    const last = own.last();
    choose_example(last ? `own/${last}` : material.examples[0].scenes[0].name);
}

async function share() {
    const button = by_id("share");
    const told = (text) => {
        button.textContent = text;
        setTimeout(() => { button.textContent = say("share"); }, 2500);
    };
    if (!can_pack()) return fail(say("no_compression"));
    const written = tab.written();
    history.replaceState(null, "", await fragment_of({ scene: scene.text, derivation: derivation.text, tab: written }));
    try {
        await navigator.clipboard.writeText(location.href);
        told(say("copied"));
    } catch {
        told(say("shown"));
    }
}

function save() {
    const derived = tab.written() === "derivation";
    const files = tab.now() === "result" ? ["alembert.html", found.html ?? ""] : derived ? ["derivation.tex", derivation.text] : ["scene.toml", scene.text];
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([files[1]]));
    link.download = files[0];
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function show_tab() {
    const written = tab.written();
    by_id("page").hidden = written !== "scene";
    by_id("marked").hidden = written !== "derivation";
    show_messages(by_id("messages"), found[written].messages, (line, column) => {
        if (tab.now() === "result") tab.choose(written);
        (written === "scene" ? scene : derivation).go_to(line, column);
    });
    state();
}

function show_words() {
    document.title = say("title");
    for (const element of document.querySelectorAll("[data-say]")) element.textContent = say(element.dataset.say);
    by_id("language").lang = language() === "zh" ? "en" : "zh";
    scene.area.setAttribute("aria-label", say("editor_scene"));
    derivation.area.setAttribute("aria-label", say("editor_derivation"));
    scene.area.placeholder = say("scene_hint");
    derivation.area.placeholder = say("derivation_hint");
    scene.area.title = say("keys");
    by_id("messages").setAttribute("aria-label", say("messages"));
    by_id("divide").setAttribute("aria-label", say("divide"));
    by_id("look").setAttribute("aria-label", say("look"));
    list_examples();
}

by_id("examples").addEventListener("change", ({ target }) => choose_example(target.value));
by_id("share").addEventListener("click", share);
by_id("save").addEventListener("click", save);
by_id("stop").addEventListener("click", () => {
    for (const desk of Object.values(desks)) desk.stop();
    found.problem = say("stopped");
    state();
});
by_id("language").addEventListener("click", () => {
    speak(language() === "zh" ? "en" : "zh");
    memory.set("language", language());
    show_words();
    scene_changed(0);
});
addEventListener("hashchange", begin);

// The beginning --------------------------------------------------------------------------------------------------------
show_words();
const missing = missing_feature();
if (missing) {
    found.problem = say(missing);
    fail(found.problem);
}
program().then(() => {
    found.loaded = true;
    document.documentElement.dataset.loaded = Math.round(performance.now());
}, () => {});
data.then((all) => {
    material = all;
    list_examples();
    if (!missing) begin();
}, (problem) => fail(say("no_program", { why: problem.message })));
