#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Drives the sliders and bodies of pages, and compares their motions with `alembert simulate`: live.py PROGRAM SCENES SHOTS

What is compared: the motion of the scene as it is, after a slider, and after another value of a parameter was typed; the place
of a dragged point with that of the pointer; that a scene with contacts or dry friction has no sliders and says why. Work is
counted in evaluations. Exit code 1 where something is wrong. Pictures are kept in the folder SHOTS, if one is named."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

from webdriver import Browser

SET = """const [label, value, typed] = arguments;
    document.getElementById("live").open = true;
    const knob = Array.from(document.querySelectorAll(".knob")).find((k) => k.querySelector("[aria-label]").ariaLabel === label);
    const [range, number] = knob.querySelectorAll("input");
    const input = typed ? number : range;
    input.value = value;
    input.dispatchEvent(new Event(typed ? "change" : "input", { bubbles: true }));
    return [Number(range.value), Number(number.value)];"""
STATE = "return [alembert.state(arguments[0]), alembert.error(arguments[0])]"
TOLD = "return document.getElementById('live-told').textContent"
HANDLES = """return Array.from(document.querySelectorAll(".grab")).map((e) => {
      const box = e.getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; })"""
SHAPES = """return Array.from(document.querySelectorAll(arguments[0] + " > *"))
    .map((e) => (e.getAttribute("d") || "") + e.getAttribute("cx") + e.getAttribute("cy")).join("|")"""
WORK = """alembert.state(1); const before = performance.now(); document.getElementById("live-back").click();
    document.querySelector(".knob input").dispatchEvent(new Event("input"));
    const start = performance.now(); alembert.state(1); return [alembert.steps(), performance.now() - start]"""


class Checker:
    def __init__(self, program, scenes, shots):
        self.program, self.scenes, self.shots, self.failures = program, pathlib.Path(scenes), shots, 0
        self.folder = tempfile.TemporaryDirectory()

    def check(self, right, what):
        if not right:
            self.failures += 1
            print("FAILED", what)

    def run(self, *arguments):
        return subprocess.run([self.program, *map(str, arguments)], check=True, capture_output=True, text=True).stdout

    def text(self, name):
        return (self.scenes / f"{name}.toml").read_text(encoding="utf-8")

    def scene(self, name, *changes):
        """A copy of a scene with these texts in place of others."""
        text = self.text(name)
        for old, new in changes:
            assert text.count(old) == 1, (name, old)
            text = text.replace(old, new)
        path = pathlib.Path(self.folder.name) / f"{pathlib.Path(name).name}.toml"
        path.write_text(text, encoding="utf-8")
        return path

    def open(self, browser, name, width=1400, dark=False):
        page = pathlib.Path(self.folder.name) / "page.html"
        self.run("report", self.scenes / f"{name}.toml", "-o", page)
        self.check(page.stat().st_size < 2_000_000, f"{name}: the page has {page.stat().st_size} bytes")
        browser.resize(width, 900, dark)
        browser.open(page.as_uri())

    def picture(self, browser, name):
        if self.shots:
            browser.picture(os.path.join(self.shots, f"live-{name}.png"))

    def compare(self, browser, name, time, changes):
        """The page's motion at a time with the program's: both by the errors that they tell, at most 1e-6."""
        told = json.loads(self.run("simulate", self.scene(name, *changes), "--duration", time, "--tolerance", "1e-12", "--json"))
        final = [*told["final"]["coordinates"].values(), *told["final"]["rates"].values()]
        state, error = browser.run(STATE, time)
        self.check(state is not None, f"{name}: the motion does not reach t = {time}: {browser.run(TOLD)}")
        if state is None:
            return
        off = max(abs(a - b) / max(1, abs(b)) for a, b in zip(state, final))
        bound = min(1e-6, error + 1e-11)
        print(f"{name} at t = {time}, {changes or 'as it is'}: off by {off:.2g}, told {error:.2g}")
        self.check(off <= bound, f"{name}: off by {off} at t = {time}, {bound} was told")


def motions(browser, checker, name, time, knobs):
    """Sets each knob in turn: (label, value, whether it is typed, the change of the scene's text)."""
    checker.open(browser, name)
    changes = []
    for label, value, typed, *change in knobs:
        shown = browser.run(SET, label, value, typed)
        checker.check(abs(shown[0] - value) < 1e-6 * max(1, abs(value)), f"{name}: {label} is {shown}, not {value}")
        changes += [tuple(change)] if change else []
        checker.compare(browser, name, time, changes)


def drags(browser, checker, name, by=None, grab=-1):
    """Drags a point of the figure: it follows the pointer, and the rest of the mechanism follows it. What has one degree of
    freedom is dragged to a place where it comes to by itself."""
    checker.open(browser, name)
    before, shapes = browser.run(HANDLES), browser.run(SHAPES, ".shapes")
    checker.check(bool(before), f"{name}: nothing can be dragged")
    x, y = before[grab]
    if by is None:
        browser.run("const e = document.getElementById('time'); e.value = 40; e.dispatchEvent(new Event('input'));")
        there = browser.run(HANDLES)[grab]
        by = (there[0] - x, there[1] - y)
        browser.run("const e = document.getElementById('time'); e.value = 0; e.dispatchEvent(new Event('input'));")
        checker.check(by[0] ** 2 + by[1] ** 2 > 100, f"{name}: the point to be dragged moves by {by} alone")
    browser.drag((x, y), [(x + by[0] * k / 5, y + by[1] * k / 5) for k in range(1, 6)], release=False)
    after = browser.run(HANDLES)[grab]
    off = ((after[0] - x - by[0]) ** 2 + (after[1] - y - by[1]) ** 2) ** 0.5
    checker.check(off < 4, f"{name}: the dragged point is {off:.1f} pixels from the pointer")
    checker.check(browser.run(SHAPES, ".shapes") != shapes, f"{name}: the figure did not follow")
    browser.release()
    checker.check(browser.run("return alembert.state(1) !== null"), f"{name}: there is no motion after dragging: {browser.run(TOLD)}")
    energy = browser.run("return alembert.energy(1)")
    checker.check(energy is None or energy["drift"] < 1e-6, f"{name}: the energy drifts: {energy}")
    print(f"{name} dragged: {off:.2f} pixels from the pointer, drift of the energy {energy and energy['drift']:.2g}")


def ghost(browser, checker, name):
    checker.open(browser, name)
    browser.run("document.getElementById('live').open = true")
    browser.click("#live-compare")
    browser.run(SET, browser.run("return document.querySelector('.knob [aria-label]').ariaLabel"), 0.5, True)
    browser.run("const e = document.getElementById('time'); e.value = 500; e.dispatchEvent(new Event('input'));")
    for _ in range(100):
        if browser.run("return Number(document.getElementById('time').value) > 499"):
            break
    pale = browser.run(SHAPES, ".ghost")
    checker.check(bool(pale) and pale != browser.run(SHAPES, ".shapes:not(.ghost)"), f"{name}: there is no ghost beside the motion")
    checker.picture(browser, f"ghost-{pathlib.Path(name).name}")
    browser.click("#live-compare")
    checker.check(not browser.run(SHAPES, ".ghost"), f"{name}: the ghost stays")
    browser.click("#live-back")
    checker.check(browser.run("return alembert.state(0)") is None, f"{name}: the way back to the scene is closed")


def work(browser, checker, name, most):
    """A second of motion takes few steps; how long they take is told."""
    checker.open(browser, name)
    steps, took = browser.run(WORK)
    print(f"{name}: {steps} steps a second of motion, {took:.0f} ms")
    checker.check(0 < steps < most, f"{name}: {steps} steps a second of motion")


def main(program, scenes, shots=""):
    checker = Checker(program, scenes, shots)
    with Browser() as browser:
        motions(browser, checker, "textbook/double_pendulum", 2,
                [("theta1", 0.5, False), ("theta1", 1.25, False, "theta1 = { initial = 0.5", "theta1 = { initial = 1.25"),
                 ("l2", 0.6, True, "l2 = { value = 0.8", "l2 = { value = 0.6"),
                 ("theta2'", -1.5, True, "theta2 = { initial = -0.2", "theta2 = { rate = -1.5, initial = -0.2")])
        motions(browser, checker, "textbook/four_bar", 2,
                [("m3", 1.5, True), ("alpha", 0.75, False, "alpha = { initial = 0.5", "alpha = { initial = 0.75"),
                 ("m2", 1.25, True, "m2 = { value = 2.0", "m2 = { value = 1.25")])
        # A pulse of 0.003 s in 10 s, as it is and where a parameter has moved it.
        motions(browser, checker, "../tests/browser/pulse", 10,
                [("m", 2.0, True, "m = { value = 1.0", "m = { value = 2.0"),
                 ("a", 7.25, True, "a = { value = 5.2345", "a = { value = 7.25")])
        drags(browser, checker, "textbook/double_pendulum", (60, -40))
        drags(browser, checker, "textbook/four_bar")
        drags(browser, checker, "textbook/rolling_disc_in_space", (40, -15))  # the view follows it
        ghost(browser, checker, "textbook/double_pendulum")
        work(browser, checker, "benchmark/trees/arm7", 2000)
        for name in ("friction/stick_slip", "textbook/bouncing_ball"):
            checker.open(browser, name)
            checker.check(browser.run("return document.getElementById('live') === null"), f"{name}: has sliders")
            checker.check("has no sliders" in browser.run("return document.getElementById('figure').textContent"),
                          f"{name}: does not say why it has no sliders")
        for fault in [*browser.console(), *(f"a dialog: {text}" for text in browser.dialogs)]:
            checker.check(False, fault)
    return 1 if checker.failures else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
