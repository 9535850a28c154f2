#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Looks at each page in a folder, at the widths of a phone and of a screen: check.py FOLDER [SHOTS]

Nothing is written to the console; no dialog opens; no request leaves the page; its layout has no fault (faults.js says
which); the figure follows the time and the animation moves it; the trace and the cursors of plots are there; the view
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


def faults_of_page(browser, page, picture):
    """What is wrong with the page in a window of this size."""
    browser.open(page.resolve().as_uri())
    wrong = browser.run(FAULTS)
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
            wrong = []
            for width in (380, 1400):
                browser.resize(width, 900, dark=width == 380)
                picture = shots and os.path.join(shots, f"{page.stem}-{width}.png")
                wrong += [f"{width} px: {fault}" for fault in faults_of_page(browser, page, picture)]
            print("FAILED " if wrong else "ok     ", page.name, *("\n    " + fault for fault in wrong), sep="")
            failures += bool(wrong)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
