// SPDX-License-Identifier: MIT
// Runs in a page, as the body of a function: what is wrong with its layout.
//   nothing is wider than the window; equations have a size; plots have axes with ticks and labels; texts of a plot do
//   not cover each other; the figure's strokes are inside it, and its letters do not cover each other; headings do not overlap
//   what follows.
const found = [];
for (const fold of document.querySelectorAll("details")) fold.open = true;
const wide = document.documentElement.clientWidth;
if (document.documentElement.scrollWidth > wide) {
  const who = Array.from(document.querySelectorAll("body *")).filter((e) => {
    for (let p = e.parentElement; p; p = p.parentElement)
      if (getComputedStyle(p).overflowX !== "visible") return false;
    return e.getBoundingClientRect().right > wide + 1;
  });
  found.push("wider than the window: " + who.slice(0, 3).map((e) => e.tagName + "." + e.getAttribute("class")).join(", "));
}
for (const e of document.querySelectorAll("math")) {
  if (matchMedia("print").matches && !e.checkVisibility()) continue;  // of the sliders, which are not printed
  const box = e.getBoundingClientRect();
  if (!(box.width > 0 && box.height > 0)) found.push("an equation without size: " + e.textContent.slice(0, 40));
}
for (const plot of document.querySelectorAll(".plot > svg")) {
  const name = plot.getAttribute("aria-label");
  if (plot.querySelectorAll(".axis-label").length !== 2) found.push(name + ": no axis labels");
  if (plot.querySelectorAll(".tick").length < 4) found.push(name + ": fewer than four ticks");
  if (!plot.querySelector(".axis-label").textContent.trim()) found.push(name + ": the x axis has no name");
  const boxes = Array.from(plot.querySelectorAll("text")).map((e) => [e.textContent, e.getBoundingClientRect()]);
  for (let i = 0; i < boxes.length; ++i)
    for (let j = i + 1; j < boxes.length; ++j) {
      const [a, p] = boxes[i], [b, q] = boxes[j];
      const x = Math.min(p.right, q.right) - Math.max(p.left, q.left);
      const y = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
      if (x > 1.5 && y > 3) found.push(name + ": '" + a + "' covers '" + b + "'");
    }
  const frame = plot.getBoundingClientRect();
  for (const [text, box] of boxes)
    if (box.left < frame.left - 2 || box.right > frame.right + 2) found.push(name + ": '" + text + "' is outside");
}
const blocks = Array.from(document.querySelectorAll("main > section, header, footer")).map((e) => [e, e.getBoundingClientRect()]);
for (let i = 0; i + 1 < blocks.length; ++i)
  if (blocks[i][0].tagName === "SECTION" && blocks[i][1].bottom > blocks[i + 1][1].top + 1 && blocks[i + 1][0].tagName === "SECTION")
    found.push("sections overlap: " + blocks[i][0].id);
const stage = document.querySelector(".stage svg");
if (stage) {
  const box = stage.getBoundingClientRect();
  for (const e of stage.querySelectorAll(".mass, .body, .bar, .rod, .pin, .ring, text")) {
    if (e.getAttribute("visibility") === "hidden") continue;
    const b = e.getBoundingClientRect();
    if (b.left < box.left - 3 || b.right > box.right + 3 || b.top < box.top - 3 || b.bottom > box.bottom + 3)
      found.push("outside the figure: " + e.getAttribute("class") + " " + e.textContent);
  }
  // What is seen of letters, from the height of an x to a little below the line: the boxes of fonts are far higher.
  const letters = Array.from(stage.querySelectorAll(".shapes text")).filter((e) => e.getAttribute("visibility") !== "hidden").map((e) => {
    const b = e.getBoundingClientRect(), place = e.getScreenCTM(), size = parseFloat(getComputedStyle(e).fontSize) * place.d;
    const line = place.d * Number(e.getAttribute("y")) + place.f;
    return { text: e.textContent, left: b.left, right: b.right, top: line - 0.5 * size, bottom: line + 0.1 * size, size };
  });
  for (let i = 0; i < letters.length; ++i)
    for (let j = i + 1; j < letters.length; ++j) {
      const p = letters[i], q = letters[j];
      const x = Math.min(p.right, q.right) - Math.max(p.left, q.left), y = Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top);
      if (x > 0.12 * p.size && y > 0.12 * p.size) found.push("in the figure '" + p.text + "' covers '" + q.text + "'");
    }
}
return found;
