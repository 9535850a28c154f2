// SPDX-License-Identifier: MIT
// The list of messages below an editor: each goes to its place.
import { say } from "./strings.js";

const element = (name, className, text = "") => Object.assign(document.createElement(name), { className, textContent: text });
const SIGNS = { bad: "✕", refuted: "✕", warn: "!", good: "✓", open: "?", plain: "·", hint: "→" };

function item({ kind, line, column, verdict, text, right, more = [], short }, go) {
    const entry = element("li", `message ${kind}${short ? " short" : ""}`);
    const sign = element("span", "sign", SIGNS[kind]);
    sign.setAttribute("aria-hidden", "true");
    const head = element(line ? "button" : "span", "head");
    if (line) {
        head.type = "button";
        head.addEventListener("click", () => go(line, column || 1));
    }
    if (line) head.append(element("span", "where", say("line", { n: line })), " ");
    const word = verdict ?? (kind === "warn" ? say("warning") : kind === "bad" ? say("mistake_word") : "");
    if (word) head.append(element("span", "verdict", word), " ");
    head.append(element(verdict ? "code" : "span", "what", text));
    entry.append(sign, head);
    if (right && !more.length) entry.append(element("code", "right", right));
    for (const one of more) entry.append(element("span", "more", one));
    return entry;
}

export function show_messages(list, messages, go) {
    const hurt = (one) => ["bad", "refuted"].includes(one.kind) ? 0 : one.kind === "open" ? 1 : one.kind === "warn" ? 2 : 3;
    const sorted = [...messages].sort((a, b) => hurt(a) - hurt(b) || a.line - b.line);
    list.replaceChildren(...sorted.map((one) => item(one, go)));
    list.hidden = messages.length === 0;
}
