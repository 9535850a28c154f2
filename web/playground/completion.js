// SPDX-License-Identifier: MIT
// Completion in the scene: tables, keys and words from the schema of scenes, names from the scene itself.
import { around, names_of } from "./toml.js";
import { say } from "./strings.js";

/// The schemas that one can be: references followed, alternatives side by side.
function forms(schema, root) {
    if (!schema || typeof schema !== "object") return [];
    const found = [schema];
    if (schema.$ref) found.push(...forms(root.definitions[schema.$ref.split("/").at(-1)], root));
    for (const how of ["allOf", "anyOf", "oneOf"]) for (const one of schema[how] ?? []) found.push(...forms(one, root));
    return found;
}

function step(schemas, key, root) {
    return schemas.flatMap((one) => {
        const next = one.properties?.[key] ?? (typeof one.additionalProperties === "object" ? one.additionalProperties : null);
        return forms(next, root);
    }).flatMap((one) => (one.items ? [one, ...forms(one.items, root)] : [one]));
}

function keys_of(schemas) {
    const found = new Map();
    for (const one of schemas)
        for (const [name, what] of Object.entries(one.properties ?? {})) if (!found.has(name)) found.set(name, what);
    return found;
}

/// What may be written at a place: `{from, choices: [{label, insert, about}]}`.
export function choices_at(text, offset, schema, functions) {
    const place = around(text, offset);
    const word = /[\p{L}_][\p{L}\p{N}_.]*'*$/u.exec(text.slice(0, offset))?.[0] ?? "";
    const from = offset - word.length;
    const about = (what) => forms(what, schema).map((one) => one.description).find(Boolean) ?? "";
    const root = forms(schema, schema);
    let choices = [];
    if (place.kind === "comment") return { from, choices };
    if (place.kind === "table") {
        const brackets = /\[\[$/.test(text.slice(0, from)) ? 2 : 1;
        for (const [name, what] of keys_of(root)) {
            const list = forms(what, schema).some((one) => one.type === "array" && forms(one.items, schema).some((item) => item.properties));
            const tables = forms(what, schema).some((one) => one.type === "object");
            if (brackets === 2 ? list : tables || list)
                choices.push({ label: name, insert: name + "]".repeat(brackets), about: about(what) });
        }
        return { from, word, choices, closing: /^\]*/.exec(text.slice(offset))[0].length };
    }
    let here = root;
    for (const key of [...place.table, ...place.keys]) here = step(here, key, schema);
    if (place.kind === "key") {
        for (const [name, what] of keys_of(here)) {
            if (place.table.length === 0 && forms(what, schema).some((one) => one.type === "object" || forms(one.items, schema).some((item) => item.properties))) continue;
            choices.push({ label: name, insert: `${name} = `, about: about(what) });
        }
        return { from, word, choices };
    }
    const value = step(here, place.key, schema);
    const quote = place.kind === "text" ? "" : '"';
    for (const one of value)
        for (const name of one.enum ?? []) choices.push({ label: String(name), insert: typeof name === "string" ? `${quote}${name}${quote}` : String(name), about: "" });
    if (place.kind === "value") {
        if (value.some((one) => one.type === "boolean")) for (const name of ["true", "false"]) choices.push({ label: name, insert: name, about: "" });
        return { from, word, choices };
    }
    if (choices.length === 0) {
        const { quantities, things } = names_of(text);
        for (const name of [...quantities, ...things]) choices.push({ label: name, insert: name, about: "" });
        for (const name of functions) choices.push({ label: name, insert: `${name}(`, about: "" });
    }
    return { from, word, choices };
}

/// The list under the caret: arrows choose, Enter or Tab takes, Escape closes.
export class Completion {
    #editor;
    #list;
    #find;
    #found = null;
    #chosen = 0;

    /// `find(text, offset)` gives what may be written at a place.
    constructor(editor, find) {
        this.#editor = editor;
        this.#find = find;
        this.#list = document.createElement("ul");
        this.#list.className = "choices";
        this.#list.id = `${editor.area.id}-choices`;
        this.#list.setAttribute("role", "listbox");
        this.#list.hidden = true;
        document.body.append(this.#list);
        const area = editor.area;
        area.setAttribute("aria-autocomplete", "list");
        area.setAttribute("aria-controls", this.#list.id);
        area.addEventListener("input", (event) => {
            if (event.inputType === "insertText" || event.inputType === "deleteContentBackward" || event.inputType === "insertCompositionText") this.open(false);
            else this.close();
        });
        area.addEventListener("keydown", (event) => this.#key(event), true);
        area.addEventListener("blur", () => this.close());
        area.addEventListener("pointerdown", () => this.close());
        editor.place.addEventListener("scroll", () => this.close());
        this.#list.addEventListener("pointerdown", (event) => {
            event.preventDefault();
            const item = event.target.closest("li");
            if (item) this.#take(Number(item.dataset.k));
        });
    }

    get is_open() {
        return !this.#list.hidden;
    }

    /// Shows what fits. Unasked, only after the first letter of a word, or the brackets of a table.
    open(asked) {
        const { text, area } = this.#editor;
        const offset = area.selectionStart;
        if (offset !== area.selectionEnd) return this.close();
        const found = this.#find(text, offset);
        const word = (found.word ?? "").toLowerCase();
        const begins = found.choices.filter(({ label }) => label.toLowerCase().startsWith(word) && label !== found.word);
        const others = found.choices.filter(({ label }) => !label.toLowerCase().startsWith(word) && word.length > 1 && label.toLowerCase().includes(word));
        found.choices = [...begins, ...others].slice(0, 60);
        const header = /^\s*\[\[?$/m.test(text.slice(text.lastIndexOf("\n", offset - 1) + 1, offset));
        if (found.choices.length === 0 || (!asked && !word && !header)) return this.close();
        this.#found = { ...found, to: offset + (found.closing ?? 0) };
        this.#list.replaceChildren(...found.choices.map(({ label, about }, k) => {
            const item = document.createElement("li");
            item.id = `${this.#list.id}-${k}`;
            item.dataset.k = k;
            item.setAttribute("role", "option");
            item.append(Object.assign(document.createElement("b"), { textContent: label }),
                Object.assign(document.createElement("span"), { textContent: about }));
            return item;
        }));
        this.#list.setAttribute("aria-label", say("choices"));
        this.#list.hidden = false;
        this.#choose(0);
        this.#put(this.#editor.place_of(found.from));
    }

    #put({ left, top, bottom }) {
        const { width, height } = this.#list.getBoundingClientRect();
        const below = bottom + height + 4 < innerHeight || top < height;
        this.#list.style.left = `${Math.max(4, Math.min(left, innerWidth - width - 4))}px`;
        this.#list.style.top = `${below ? bottom + 2 : top - height - 2}px`;
    }

    close() {
        this.#list.hidden = true;
        this.#editor.area.removeAttribute("aria-activedescendant");
    }

    #choose(k) {
        const items = this.#list.children;
        items[this.#chosen]?.removeAttribute("aria-selected");
        this.#chosen = (k + items.length) % items.length;
        items[this.#chosen].setAttribute("aria-selected", "true");
        items[this.#chosen].scrollIntoView({ block: "nearest" });
        this.#editor.area.setAttribute("aria-activedescendant", items[this.#chosen].id);
    }

    #take(k) {
        const { from, to, choices } = this.#found;
        this.close();
        this.#editor.replace(from, to, choices[k].insert);
        this.close();
    }

    #key(event) {
        if (event.key === " " && event.ctrlKey) {
            event.preventDefault();
            return this.open(true);
        }
        if (!this.is_open || event.isComposing) return;
        const step = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8 }[event.key];
        if (step) this.#choose(this.#chosen + step);
        else if (event.key === "Enter" || event.key === "Tab") this.#take(this.#chosen);
        else if (event.key === "Escape") this.close();
        else return;
        event.preventDefault();
        event.stopImmediatePropagation();
    }
}
