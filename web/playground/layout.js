// SPDX-License-Identifier: MIT
// Tabs that arrows move between, and the border between the two sides.

const by_id = (id) => document.getElementById(id);

/// Tabs `tab-NAME`. The last is there on narrow screens alone, where it stands for the other side.
export function tabs(names, changed) {
    let now = names[0], written = names[0];
    const choose = (name, focus = false) => {
        now = name;
        if (name !== "result") written = name;
        document.body.dataset.tab = now;
        for (const one of names) {
            const tab = by_id(`tab-${one}`);
            tab.setAttribute("aria-selected", String(one === now));
            tab.tabIndex = one === now ? 0 : -1;
            if (one !== "result") by_id(`panel-${one}`).hidden = one !== written;
        }
        if (focus) by_id(`tab-${now}`).focus();
        changed();
    };
    const seen = () => names.filter((one) => by_id(`tab-${one}`).offsetParent);
    for (const name of names) {
        const tab = by_id(`tab-${name}`);
        tab.addEventListener("click", () => choose(name));
        tab.addEventListener("keydown", ({ key }) => {
            const step = { ArrowRight: 1, ArrowLeft: -1 }[key], all = seen();
            if (step) choose(all[(all.indexOf(name) + step + all.length) % all.length], true);
        });
    }
    matchMedia("(min-width: 62rem)").addEventListener("change", ({ matches }) => { if (matches && now === "result") choose(written); });
    queueMicrotask(() => choose(now));
    return { choose, now: () => now, written: () => written };
}

/// The border that can be dragged, or moved by arrows; where it stands is remembered.
export function divider(border, memory) {
    const put = (percent) => {
        const share = Math.round(Math.min(80, Math.max(20, percent)));
        border.setAttribute("aria-valuenow", share);
        border.parentElement.style.setProperty("--share", `${share}%`);
        memory.set("share", share);
    };
    const kept = Number(memory.get("share"));
    if (kept) put(kept);
    border.addEventListener("pointerdown", (event) => {
        border.setPointerCapture(event.pointerId);
        document.body.classList.add("dragging");
        event.preventDefault();
    });
    border.addEventListener("pointermove", (event) => {
        if (!border.hasPointerCapture(event.pointerId)) return;
        const box = border.parentElement.getBoundingClientRect();
        put(100 * (event.clientX - box.left) / box.width);
    });
    border.addEventListener("lostpointercapture", () => document.body.classList.remove("dragging"));
    border.addEventListener("keydown", ({ key }) => {
        const step = { ArrowRight: 2, ArrowLeft: -2 }[key];
        if (step) put(Number(border.getAttribute("aria-valuenow")) + step);
    });
}
