// SPDX-License-Identifier: MIT
// A text area, under which the same text stands in colours, with line numbers and marks. The text below gives the height,
// so that the place around both scrolls, and the browser keeps the caret in view.

const escaped = (text) => text.replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);

/// A line in pieces: `spans` are [from, to, class], later ones over earlier ones.
function pieces(line, spans) {
    const cuts = new Set([0, line.length]);
    for (const [from, to] of spans) cuts.add(Math.min(from, line.length)).add(Math.min(to, line.length));
    const places = [...cuts].sort((a, b) => a - b);
    let html = "";
    for (let k = 0; k + 1 < places.length; ++k) {
        const [from, to] = [places[k], places[k + 1]];
        const classes = spans.filter((span) => span[0] <= from && span[1] >= to).map((span) => span[2]);
        const text = escaped(line.slice(from, to));
        html += classes.length ? `<span class="${classes.join(" ")}">${text}</span>` : text;
    }
    return html;
}

export class Editor {
    #under;
    #marks = new Map();
    #colour;
    #drawn = [];

    /// `place` is empty. `colour` gives for all lines their spans; `changed` is called after each change of the text.
    constructor(place, { id, colour, changed }) {
        place.classList.add("editor");
        place.innerHTML = `<div class="sheet"><div class="under" aria-hidden="true"></div>
            <textarea id="${id}" spellcheck="false" autocapitalize="off" autocomplete="off" autocorrect="off"></textarea></div>`;
        this.place = place;
        this.area = place.querySelector("textarea");
        this.#under = place.querySelector(".under");
        this.#colour = colour;
        this.area.addEventListener("input", () => {
            this.#follow();
            this.draw();
            changed();
        });
        this.#before = "";
        this.draw();
    }

    #before;

    get text() {
        return this.area.value;
    }

    /// Another text, which is no change by the reader.
    set text(text) {
        this.area.value = text;
        this.area.setSelectionRange(0, 0);
        this.#before = this.area.value;
        this.#marks.clear();
        this.place.scrollTop = 0;
        this.draw();
    }

    /// Marks stay at their lines while lines above them come and go; those of a line that is changed go.
    #follow() {
        const before = this.#before.split("\n"), now = this.text.split("\n");
        this.#before = this.text;
        const most = Math.min(before.length, now.length), more = now.length - before.length;
        let head = 0, tail = 0;
        while (head < most && before[head] === now[head]) ++head;
        while (tail < most - head && before.at(-1 - tail) === now.at(-1 - tail)) ++tail;
        const moved = new Map();
        for (const [line, marks] of this.#marks)
            if (line <= head) moved.set(line, marks);
            else if (line > before.length - tail) moved.set(line + more, marks);
        this.#marks = moved;
    }

    /// Marks: `{line, column, end, kind, text}`, lines from 1, columns from 1 in characters; without a column the line's number
    /// alone is marked. `text` stands behind the line.
    mark(marks) {
        this.#marks = new Map();
        for (const one of marks) {
            if (!this.#marks.has(one.line)) this.#marks.set(one.line, []);
            this.#marks.get(one.line).push(one);
        }
        this.draw();
    }

    draw() {
        const lines = this.text.split("\n"), colours = this.#colour(lines);
        const drawn = lines.map((line, k) => this.#line(line, colours[k], this.#marks.get(k + 1) ?? []));
        const under = this.#under;
        while (under.childElementCount > drawn.length) under.lastElementChild.remove();
        for (let k = 0; k < drawn.length; ++k) {
            const element = under.children[k] ?? under.appendChild(document.createElement("div"));
            if (this.#drawn[k] === drawn[k] && element.dataset.n) continue;
            const [kind, html] = drawn[k].split("\u0000");
            element.className = kind;
            element.dataset.n = k + 1;
            element.innerHTML = html;
        }
        this.#drawn = drawn;
    }

    #line(line, spans, marks) {
        const all = [...spans];
        for (const { column, end, kind } of marks)
            if (column) all.push([column - 1, Math.max(end ?? column, column), `mark ${kind}`]);
        const kind = marks[0] ? `line has-${marks[0].kind}` : "line";
        const told = marks.find((one) => one.text);
        const behind = told ? `<span class="told ${told.kind}" data-told="${escaped(told.text)}"></span>` : "";
        return `${kind}\u0000${pieces(line, all) || "\u200b"}${behind}`;
    }

    /// Where on the screen a place of the text is.
    place_of(offset) {
        const before = this.text.slice(0, offset).split("\n");
        const element = this.#under.children[before.length - 1];
        let left = before.at(-1).length;
        const walk = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
        const range = document.createRange();
        for (let node = walk.nextNode(); node; node = walk.nextNode()) {
            if (left > node.length) {
                left -= node.length;
                continue;
            }
            range.setStart(node, left);
            range.collapse(true);
            const box = range.getBoundingClientRect();
            if (box.height) return box;
        }
        return element.getBoundingClientRect();
    }

    /// Puts `text` in place of what is between two places, as if it were typed: it can be undone.
    replace(from, to, text) {
        this.area.focus();
        this.area.setSelectionRange(from, to);
        if (!document.execCommand("insertText", false, text)) {
            this.area.setRangeText(text, from, to, "end");
            this.area.dispatchEvent(new Event("input"));
        }
    }

    /// Brings a line into view, with the caret there.
    go_to(line, column = 1) {
        const lines = this.text.split("\n");
        const offset = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0) + column - 1;
        this.area.focus({ preventScroll: true });
        this.area.setSelectionRange(offset, offset);
        this.#under.children[line - 1]?.scrollIntoView({ block: "nearest" });
    }
}
