// SPDX-License-Identifier: MIT
// What the reader has written: the last twenty texts, each with its date, under a key of its own in the browser's storage.
// A window writes in the texts that it has begun, or has opened while no other window had them: so no two write in the same.

const KEY = "alembert.text.";
const MOST = 20;
const SHORT = 40; // characters that nobody misses

const PARTS = ["scene", "derivation"];

/// Whether a change takes more than half of a text away at once, as choosing all and typing does.
function replaces(before, now) {
    const most = Math.min(before.length, now.length);
    let head = 0, tail = 0;
    while (head < most && before[head] === now[head]) ++head;
    while (tail < most - head && before.at(-1 - tail) === now.at(-1 - tail)) ++tail;
    return before.length > SHORT && 2 * (head + tail) < before.length;
}

/// Storage that may be missing, as in a private window, or full.
function stored(work, otherwise = null) {
    try { return work(localStorage, sessionStorage); } catch { return otherwise; }
}

function read(key) {
    const value = stored((storage) => JSON.parse(storage.getItem(key)));
    return typeof value?.scene === "string" ? { derivation: "", ...value } : null;
}

export class OwnTexts {
    #id = null; // the text in which this window writes
    #before = null; // what it was before this change,
    #longest = null; // and when its scene, and its derivation, were longest,
    #is_rest = false; // since it was the rest of another
    #give_back = null;

    /// `changed` is called after another window has changed what is kept.
    constructor(changed) {
        addEventListener("storage", ({ key }) => { if (key === null || key.startsWith(KEY)) changed(); });
        const former = read("alembert.own"); // the one text that was kept before there were twenty
        if (former && this.#put("former", { ...former, changed: Date.now() })) stored((storage) => storage.removeItem("alembert.own"));
    }

    /// All of them, `{id, scene, derivation, changed}`, the newest first.
    list() {
        const keys = stored((storage) => Array.from(storage, (_, k) => storage.key(k)).filter((key) => key.startsWith(KEY)), []);
        return keys.map((key) => ({ id: key.slice(KEY.length), ...read(key) })).filter((one) => one.changed)
            .sort((a, b) => b.changed - a.changed);
    }

    get(id) {
        return read(KEY + id);
    }

    /// The text with which this window goes on: the one that it had when it was loaded again, or else the newest.
    last() {
        const all = this.list(), here = stored((_, window) => window.getItem("alembert.text"));
        return (all.find(({ id }) => id === here) ?? all[0])?.id;
    }

    /// What is written from now on belongs to this text as it is kept, unless another window has it.
    open(id) {
        this.leave();
        const given_back = new AbortController(), text = this.get(id);
        this.#give_back = given_back;
        navigator.locks?.request(KEY + id, { signal: given_back.signal }, () => {
            const is_same = text && PARTS.every((part) => text?.[part] === this.get(id)?.[part]);
            if (given_back.signal.aborted || this.#id && this.#id !== id || !this.#id && !is_same) return null;
            if (!this.#id) this.#begin(id, text);
            return new Promise((give_back) => { given_back.signal.addEventListener("abort", give_back); });
        }).catch(() => { /* given back before it was had, or there are no locks without storage */ });
        stored((_, window) => window.setItem("alembert.text", id));
    }

    /// What is written from now on is a text of its own.
    leave() {
        this.#give_back?.abort();
        this.#id = this.#before = this.#longest = this.#give_back = null;
        this.#is_rest = false;
    }

    /// Keeps `{scene, derivation}`: the name of the text, "" where there is nothing to keep, null where it cannot be kept.
    write({ scene, derivation }) {
        const now = { scene, derivation, changed: Date.now() };
        const is_rest = this.#part(now);
        if (PARTS.every((part) => !now[part].trim())) {
            if (this.#id && PARTS.every((part) => this.#longest[part][part].length <= SHORT)) this.#remove(this.#id);
            return "";
        }
        if (!this.#id) {
            const id = `${Date.now().toString(36)}-${Math.random().toString(36).slice(2)}`;
            this.open(id);
            this.#begin(id, now);
            this.#is_rest = is_rest;
        }
        this.#is_rest &&= PARTS.every((part) => now[part].length <= this.#before[part].length);
        for (const part of PARTS)
            if (this.#is_rest || now[part].length >= this.#longest[part][part].length) this.#longest[part] = now;
        this.#before = now;
        return this.#put(this.#id, now) ? this.#id : null;
    }

    #begin(id, text) {
        this.#id = id;
        this.#before = text;
        this.#longest = { scene: text, derivation: text };
    }

    /// A text of which more than half is gone, at once or letter by letter, stays as it was: the rest is another, which is told.
    #part(now) {
        if (!this.#id) return false;
        const replaced = PARTS.some((part) => replaces(this.#before[part], now[part]));
        const shorter = PARTS.find((part) => this.#longest[part][part].length > SHORT && 2 * now[part].length < this.#longest[part][part].length);
        if (!replaced && !shorter) return false;
        if (!replaced) this.#put(this.#id, this.#longest[shorter]);
        this.leave();
        return true;
    }

    /// Keeps a text, and of all that are kept the last twenty, each once; where there is no room, fewer.
    #put(id, text) {
        const is_new = !this.get(id), value = JSON.stringify(text), given_up = [];
        const put = (id, value) => stored((storage) => { storage.setItem(KEY + id, value); return true; }, false);
        while (!put(id, value)) {
            const oldest = this.list().filter((one) => one.id !== id).at(-1);
            if (!oldest) {
                for (const { id, ...text } of given_up) put(id, JSON.stringify(text));
                return false;
            }
            given_up.push(oldest);
            this.#remove(oldest.id);
        }
        if (!is_new) return true;
        const seen = new Set();
        for (const one of this.list()) {
            const contents = JSON.stringify([one.scene, one.derivation]);
            if (seen.has(contents) || seen.size === MOST) this.#remove(one.id);
            else seen.add(contents);
        }
        return true;
    }

    #remove(id) {
        stored((storage) => storage.removeItem(KEY + id));
    }
}
