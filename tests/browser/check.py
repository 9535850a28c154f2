#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Looks at each page in a folder, at the widths of a phone and of a screen: check.py FOLDER [SHOTS]

Nothing is written to the console; no dialog opens; no request leaves the page; its layout has no fault (faults.js says
which), in light and dark colours and in print; its first paint comes within a second; the figure follows the time and the animation moves it; the trace and the cursors of plots are there; the view
turns. Exit code 1 where something is wrong. A picture of each page is kept in the folder SHOTS."""

import os
import pathlib
import sys

from webdriver import Browser

sys.dont_write_bytecode = True
FAULTS = (pathlib.Path(__file__).parent / "faults.js").read_text(encoding="utf-8")
SHAPES = """return Array.from(document.querySelectorAll(".stage .shapes > *"))
    .map((e) => (e.getAttribute("d") || "") + e.getAttribute("cx") + e.getAttribute("cy") + e.getAttribute("x")).join("|")"""
MOVES = """const frames = JSON.parse(document.getElementById("data").textContent).figure.frames;
    return frames.some((frame) => String(frame) !== String(frames[0]));"""
MOST_PAINT = 1000
PAINT = """const tell = arguments[0];
    const look = () => {
      const paint = performance.getEntriesByName("first-contentful-paint")[0];
      if (paint) tell(paint.startTime); else requestAnimationFrame(look);
    };
    look();"""
CLOCK = "return document.getElementById('clock').textContent"
# Tells whether the clock shows something else before so many pictures have been drawn.
RUNS = """const [before, most, tell] = arguments;
    const look = (drawn) => {
      const runs = document.getElementById("clock").textContent !== before;
      if (runs || drawn === most) tell(runs); else requestAnimationFrame(() => look(drawn + 1));
    };
    look(0);"""


def has(browser, selector):
    return browser.run("return document.querySelector(arguments[0]) !== null", selector)


def faults_of_animation(browser):
    before = browser.run(SHAPES)
    browser.run("const e = document.getElementById('time'); e.value = 437; e.dispatchEvent(new Event('input'));")
    if browser.run(MOVES) and browser.run(SHAPES) == before:
        yield "the figure does not follow the time"
    time = browser.run(CLOCK)
    browser.click("#play")
    if not browser.run_until_told(RUNS, time, 300):
        yield "the animation stands still"
    browser.click("#play")
    if has(browser, "#trace"):
        if not browser.run("return document.getElementById('trace').checked"):
            browser.click("#trace")
        if not browser.run("return document.querySelector('.trace').getAttribute('d')"):
            yield "there is no trace"
    if not has(browser, ".plot .cursor"):
        yield "plots have no cursor"


def faults_of_view(browser):
    before = browser.run(SHAPES)
    browser.run("document.querySelector('.space').focus()")
    browser.press("\ue012")  # the arrow to the left
    if browser.run(SHAPES) == before:
        yield "the view does not turn"


def first_paint(browser, page, times=3):
    """Milliseconds; the least of a few attempts where the machine is busy."""
    least = float("inf")
    for _ in range(times):
        browser.open(page.resolve().as_uri())
        least = min(least, browser.run_until_told(PAINT))
        if least <= MOST_PAINT:
            break
    return least


def faults_of_looks(browser, page, dark):
    """The layout in the other colours and in print, at the start of the motion."""
    browser.open(page.resolve().as_uri())
    for name, looks in (("light" if dark else "dark", {"dark": not dark}), ("printed", {"printed": True})):
        browser.show(**looks)
        yield from ((name, fault) for fault in browser.run(FAULTS))
    browser.show(dark)


def faults_of_page(browser, page, picture):
    """What is wrong with the page in a window of this size."""
    paint = first_paint(browser, page)
    wrong = browser.run(FAULTS)
    if paint > MOST_PAINT:
        wrong.append(f"the first paint comes after {paint:.0f} ms")
    if picture:
        browser.picture(picture)
    if has(browser, "#play"):
        wrong += faults_of_animation(browser)
    if has(browser, ".space"):
        wrong += faults_of_view(browser)
    wrong += [f"console: {message}" for message in browser.console()]
    wrong += [f"asks for {url}" for url in browser.requests() if not url.startswith(("file:", "data:"))]
    wrong += [f"a dialog: {text}" for text in browser.dialogs]
    browser.dialogs.clear()
    return wrong


def main(folder, shots=""):
    failures = 0
    with Browser() as browser:
        for page in sorted(pathlib.Path(folder).glob("*.html")):
            wrong = [f"{page.stat().st_size} bytes are too many"] * (page.stat().st_size >= 2_000_000)
            for width in (380, 1400):
                browser.resize(width, 900, dark=width == 380)
                picture = shots and os.path.join(shots, f"{page.stem}-{width}.png")
                found = faults_of_page(browser, page, picture)
                wrong += [f"{width} px: {fault}" for fault in found]
                wrong += [f"{width} px, {name}: {fault}" for name, fault in faults_of_looks(browser, page, width == 380)]
            print("FAILED " if wrong else "ok     ", page.name, *("\n    " + fault for fault in wrong), sep="")
            failures += bool(wrong)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
