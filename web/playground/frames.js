// SPDX-License-Identifier: MIT
// Shows pages of the program, each in a frame of its own: the next one is built behind the present one and takes its
// place, with the same part in view and the same folds open, so nothing flickers and no old script goes on.

export class Frames {
    #place;
    #title;
    #shown = null;
    #number = 0;

    constructor(place, title) {
        this.#place = place;
        this.#title = title;
    }

    /// Where a reader is in the page that is shown.
    #reading() {
        const inside = this.#shown?.contentDocument;
        if (!inside?.body) return {};
        const open = Array.from(inside.querySelectorAll("details"), (fold) => fold.open);
        return { scroll: this.#shown.contentWindow.scrollY, open };
    }

    /// Shows this page. With `keep`, the reader stays where he is in it. Ends when the page is there.
    show(html, keep) {
        const number = ++this.#number;
        const next = document.createElement("iframe");
        next.title = this.#title();
        next.className = "coming";
        next.src = "frame.html";
        return new Promise((resolve) => {
            const told = ({ source, data }) => {
                if (source !== next.contentWindow) return;
                if (data.ready) next.contentWindow.postMessage({ html, number, ...(keep ? this.#reading() : {}) }, location.origin);
                if (data.shown === undefined) return;
                removeEventListener("message", told);
                if (number === this.#number) {
                    this.#shown?.remove();
                    this.#shown = next;
                    next.className = "";
                } else next.remove();
                resolve();
            };
            addEventListener("message", told);
            this.#place.append(next);
        });
    }
}
