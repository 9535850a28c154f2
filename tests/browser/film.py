#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Films the page of a scene: film.py PROGRAM SCENE FILE.gif [SECONDS]

Opens the page in headless Chromium, steps its clock, and writes a GIF of the first screen, which README.md shows:
    tests/browser/film.py build/release/generator/alembert scenes/textbook/double_pendulum.toml docs/page.gif
Needs Debian's chromium, chromium-driver and python3-pil, as the tests do not."""

import base64
import io
import pathlib
import subprocess
import sys
import tempfile

from PIL import Image

from webdriver import Browser

WIDTH, HEIGHT, SCALE = 1200, 760, 0.62
FRAMES_A_SECOND, COLOURS = 12, 96
STEP = """const e = document.getElementById("time"); e.value = arguments[0] * e.max;
    e.dispatchEvent(new Event("input")); return document.getElementById("clock").textContent;"""


def frame(browser, part):
    """The window when the animation has come that far."""
    browser.run(STEP, part)
    picture = browser.protocol("Page.captureScreenshot")["data"]
    image = Image.open(io.BytesIO(base64.b64decode(picture))).convert("RGB")
    return image.resize((round(WIDTH * SCALE), round(HEIGHT * SCALE)), Image.Resampling.LANCZOS)


def main(program, scene, file, seconds="5"):
    duration = float(seconds)
    with tempfile.TemporaryDirectory() as folder, Browser() as browser:
        page = pathlib.Path(folder, "page.html")
        subprocess.run([program, "report", scene, "--duration", seconds, "-o", page], check=True, stdout=subprocess.DEVNULL)
        browser.resize(WIDTH, HEIGHT)
        browser.open(page.as_uri())
        browser.run("const t = document.getElementById('trace'); if (t && !t.checked) t.click();")
        count = round(FRAMES_A_SECOND * duration)
        frames = [frame(browser, k / count) for k in range(count)]
    palette = frames[count // 2].quantize(COLOURS)
    first, *rest = (one.quantize(palette=palette, dither=Image.Dither.NONE) for one in frames)
    first.save(file, save_all=True, append_images=rest, duration=round(1000 / FRAMES_A_SECOND), loop=0, optimize=True)
    size = pathlib.Path(file).stat().st_size
    print(f"{file}: {count} frames, {size} bytes")
    return 0 if size < 1_000_000 else 1


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    sys.exit(main(*sys.argv[1:]))
