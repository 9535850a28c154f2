#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Executes a notebook without a window, and looks at its outputs in Chromium: run.py PACKAGE [SHOT.png]

Its cells are a scene, claims, a derivation with a mistake, the page that moves, and mistakes of each kind. In the browser the page
in its frame has the motion of `simulate`, also after a slider was moved, and answers what the widget asks.
Needs Debian's python3-nbclient, python3-ipykernel, chromium and chromium-driver; exit code 77 where one is missing, which is a failure
where test.sh has installed them."""

import json
import os
import pathlib
import shutil
import sys
import tempfile
import time

package = os.path.abspath(sys.argv[1])
try:
    import nbclient
    import nbformat
    import ipykernel  # noqa: F401
except ImportError as missing:
    print(f"there is no {missing.name} here")
    sys.exit(int(os.environ.get("ALEMBERT_NO_SKIP", 77)))
if not shutil.which("chromium") or not shutil.which("chromedriver"):
    print("there is no chromium here")
    sys.exit(int(os.environ.get("ALEMBERT_NO_SKIP", 77)))

sys.path[:0] = [package, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../browser")]
os.environ |= {"PYTHONPATH": package, "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
import alembert  # noqa: E402
from webdriver import Browser  # noqa: E402

SCENE = """gravity = [0, "-g"]
[parameters]
m = 1
l = 1.2
g = 9.81
[coordinates]
theta = 0.4
[[particle]]
name = "bob"
mass = "m"
position = ["l*sin(theta)", "-l*cos(theta)"]
[simulation]
duration = 3
"""
RIGHT, WRONG = "l*theta'' + g*sin(theta) = 0", "l*theta'' - g*sin(theta) = 0"
CELLS = [
    "%load_ext alembert",
    "%%alembert scene pendulum\n" + SCENE,
    f"%%alembert check pendulum\n{RIGHT}\n{WRONG}",
    "%%alembert mark pendulum\n$$T = \\frac12 m l^2 \\dot\\theta^2$$\n$$V = m g l \\cos\\theta$$",
    "pendulum.live()",
    "pendulum.live().widget()",
    "%%alembert scene broken\n[coordinates]\ntheta = 0.4\nphi = thetta",
    "%%alembert mark nothing\n$T = 0$",
    "%%alembert draw pendulum\nnothing",
    "pendulum.simulate(duration=1)(1.0).tolist()",
]
failures = 0


def check(right, what):
    global failures
    if not right:
        failures += 1
        print("FAILED", what)


def executed(cells):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    with tempfile.TemporaryDirectory() as folder:
        nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3", allow_errors=True,
                                resources={"metadata": {"path": folder}}).execute()  # yapf: disable
    return [cell.outputs for cell in notebook.cells]


def data(outputs, kind):
    return ["".join(output["data"][kind]) for output in outputs if kind in output.get("data", {})]


def mistake(outputs):
    """The text of the mistake that a cell ends with."""
    found = [output for output in outputs if output["output_type"] == "error"]
    return "\n".join(found[0]["traceback"]) if found else "none"


loaded, scene, claims, marked, live, widget, broken, unknown, misused, end = executed(CELLS)
check(loaded == [], f"the extension loads: {loaded}")
check(len(data(scene, "image/svg+xml")) == 1, "a scene shows its figure")
check("\\theta" in "".join(data(scene, "text/latex")), "a scene shows its equations")
text = "".join(data(claims, "text/plain"))
check("proved" in text and "refuted" in text, f"claims have verdicts: {text}")
check("mistake" in "".join(data(marked, "text/html")), "a derivation has its lines marked")
check("<iframe" in "".join(data(live, "text/html")), "the page stands in a frame")
try:
    import anywidget  # noqa: F401

    check("widget" in json.dumps(widget), "the page is a widget")
except ImportError:
    check("pip install anywidget" in mistake(widget), f"a widget says what it needs: {mistake(widget)}")
check("SceneError" in mistake(broken) and "broken.toml:3" in mistake(broken), f"a broken scene says where: {mistake(broken)}")
check("Traceback" not in mistake(broken) and "_notebook.py" not in mistake(broken), "without the calls that led there")
check("there is no scene 'nothing'" in mistake(unknown), f"an unknown scene is told: {mistake(unknown)}")
check("%%alembert scene NAME" in mistake(misused), f"what there is is told: {mistake(misused)}")
state = json.loads("".join(data(end, "text/plain")))

def until(browser, script, is_right, *arguments):
    """What the script gives as soon as that is right, or after ten seconds."""
    for _ in range(100):
        found = browser.run(script, *arguments)
        if is_right(found):
            break
        time.sleep(0.1)
    return found


def near(found):
    return bool(found) and max(abs(a - b) for a, b in zip(found, state)) < 1e-6


ASKED = """const frame = document.querySelector("iframe"), page = frame.contentWindow.alembert;
    return page ? page.state(arguments[0]) : null"""
MOVED = """const inside = document.querySelector("iframe").contentDocument, [label, share] = arguments;
    inside.getElementById("live").open = true;
    const knob = Array.from(inside.querySelectorAll(".knob")).find((k) => k.querySelector("[aria-label]").ariaLabel === label);
    const input = knob.querySelector("input");
    input.value = share < 0 ? input.value : Number(input.min) + share * (input.max - input.min);
    input.dispatchEvent(new Event("input", { bubbles: true }));"""
with tempfile.TemporaryDirectory() as folder, Browser() as browser:
    folder = pathlib.Path(folder)
    pages = [kind for outputs in (scene, marked, live) for kind in data(outputs, "image/svg+xml") + data(outputs, "text/html")]
    (folder / "notebook.html").write_text("<!DOCTYPE html><meta charset=utf-8>" + "\n".join(pages), encoding="utf-8")
    browser.resize(1200, 1500)
    browser.open((folder / "notebook.html").as_uri())
    until(browser, "return document.querySelector('iframe').contentDocument.querySelectorAll('.knob').length", bool)
    browser.run(MOVED, "m", 0.7)  # the mass of a pendulum says nothing about its motion
    found = until(browser, ASKED, near, 1.0)
    check(near(found), f"the page moves as simulate: {found}, {state}")
    if len(sys.argv) > 2:
        browser.picture(sys.argv[2])
    browser.run(MOVED, "l", 1)
    other = until(browser, ASKED, lambda found: found and not near(found), 1.0)
    check(other and not near(other), f"a slider changes the motion: {other}")
    check([line for line in browser.console() if "error" in str(line).lower()] == [], "the console is empty")

    # The widget's half in the browser, with a model that remembers what is set.
    (folder / "widget.mjs").write_text(alembert._notebook._SHOWN_BY, encoding="utf-8")
    values = {"page": alembert.Scene(text=SCENE, name="pendulum.toml").live().html, "title": "pendulum", "height": 700, "time": 0.5}
    script = (folder / "widget.mjs").read_text(encoding="utf-8").replace("export default { render };", "window.render = render;")
    (folder / "widget.html").write_text(
        "<!DOCTYPE html><meta charset=utf-8><div id=here></div><script>" + script + "</script><script>"
        f"const values = JSON.parse({json.dumps(json.dumps(values)).replace('</', '<' + chr(92) + '/')}), told = {{}};"
        "window.model = { get: (k) => values[k], set: (k, v) => { values[k] = v; }, save_changes() {},"
        "  on: (what, f) => { told[what] = f; }, change(k, v) { values[k] = v; told['change:' + k](); } };"
        "render({ model, el: document.getElementById('here') });</script>", encoding="utf-8")  # yapf: disable
    browser.open((folder / "widget.html").as_uri())
    until(browser, "return document.querySelector('iframe').contentDocument.querySelectorAll('.knob').length", bool)
    browser.run(MOVED, "m", 0.7)
    first = until(browser, "return model.get('state')", bool)
    browser.run("model.change('time', 1.0)")
    second = until(browser, "return model.get('state')", near)
    check(first and first != second, f"the widget answers: {first}, {second}")
    check(near(second), f"with the state of simulate: {second}, {state}")
print(f"{failures} failed" if failures else "the notebook is right")
sys.exit(1 if failures else 0)
