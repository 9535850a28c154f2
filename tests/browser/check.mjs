// SPDX-License-Identifier: MIT
// node check.mjs FOLDER [SHOTS]: looks at each page in the folder, at the widths of a phone and of a screen.
//   nothing is written to the console; no request leaves the page; nothing is wider than the window;
//   equations have a size; plots have axes with ticks and labels; texts of a plot do not cover each other;
//   the figure's strokes are inside it; the animation moves it; headings do not overlap what follows.
import fs from "node:fs";
import path from "node:path";
import { chromium } from "playwright-core";

const [folder, shots] = process.argv.slice(2);
const pages = fs.readdirSync(folder).filter((name) => name.endsWith(".html")).sort();
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync"],
});
let failures = 0;

// Runs in the page: what is wrong with its layout.
function faults() {
  const found = [];
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
    if (e.closest("details:not([open])")) continue;
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
  }
  return found;
}

const shapes = () => Array.from(document.querySelectorAll(".stage .shapes > *")).map((e) =>
  (e.getAttribute("d") || "") + e.getAttribute("cx") + e.getAttribute("cy") + e.getAttribute("x")).join("|");

for (const name of pages) {
  const wrong = [];
  for (const width of [380, 1400]) {
    const page = await browser.newPage({ viewport: { width, height: 900 }, colorScheme: width === 380 ? "dark" : "light" });
    page.on("console", (message) => wrong.push("console: " + message.text()));
    page.on("pageerror", (error) => wrong.push("error: " + error.message));
    page.on("dialog", (dialog) => { wrong.push("a dialog: " + dialog.message()); dialog.dismiss(); });
    page.on("request", (request) => { if (!request.url().startsWith("file:")) wrong.push("asks for " + request.url()); });
    await page.goto("file://" + path.join(path.resolve(folder), name));
    wrong.push(...(await page.evaluate(faults)).map((fault) => width + " px: " + fault));
    if (shots) await page.screenshot({ path: path.join(shots, name.replace(".html", "-" + width + ".png")), fullPage: true });
    if (await page.locator("#play").count()) {
      const before = await page.evaluate(shapes);
      await page.locator("#time").evaluate((e) => { e.value = 437; e.dispatchEvent(new Event("input")); });
      const there = await page.evaluate(shapes);
      const moves = await page.evaluate(() => {
        const frames = JSON.parse(document.getElementById("data").textContent).figure.frames;
        return frames.some((frame) => String(frame) !== String(frames[0]));
      });
      if (moves && there === before) wrong.push(width + " px: the figure does not follow the time");
      const t = await page.locator("#clock").textContent();
      await page.locator("#play").click();
      await page.waitForTimeout(400);
      if ((await page.locator("#clock").textContent()) === t) wrong.push(width + " px: the animation stands still");
      await page.locator("#play").click();
      await page.locator("#trace").check();
      if (!(await page.locator(".trace").first().getAttribute("d"))) wrong.push("there is no trace");
      if (await page.locator(".plot .cursor").count() === 0) wrong.push("plots have no cursor");
    }
    if (await page.locator(".space").count()) {
      const before = await page.evaluate(shapes);
      await page.locator(".space").focus();
      await page.keyboard.press("ArrowLeft");
      if ((await page.evaluate(shapes)) === before) wrong.push("the view does not turn");
    }
    await page.close();
  }
  console.log((wrong.length ? "FAILED " : "ok     ") + name);
  for (const fault of wrong) console.log("    " + fault);
  failures += wrong.length ? 1 : 0;
}
await browser.close();
process.exit(failures ? 1 : 0);
