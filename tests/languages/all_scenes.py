#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Emits scenes in Python, Julia, MATLAB, Rust and Modelica, and compares the right-hand side of each near its initial state with that
of NumPy: all_scenes.py PROGRAM SCENE...

Julia and Modelica are evaluated by straight_line.py, MATLAB by Octave where it is there; all files of Rust are compiled in one crate
without std where rustc is there. Scenes that have no code (functions left open) are passed over. A second each; exit code 1
where a file does not agree."""

import importlib
import math
import os
import shutil
import subprocess
import sys
import tempfile

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
program, scenes = os.path.abspath(sys.argv[1]), [os.path.abspath(scene) for scene in sys.argv[2:]]
failures, modules = 0, []
sys.dont_write_bytecode = True
numpy.seterr(all="ignore")


def wrong(what):
    global failures
    failures += 1
    print("FAILED", what)


def said(*words):
    return subprocess.run(words, capture_output=True, text=True)


def agrees(found, expected):
    largest = max([abs(x) for x in expected if not math.isnan(x)], default=0)
    return len(found) == len(expected) and all(
        math.isnan(a) and math.isnan(b) or abs(a - b) <= 1e-12 * largest for a, b in zip(found, expected))


def compare(name):
    module = importlib.import_module(name)
    state = numpy.array(module.initial_state or [0.1] * (len(module.coordinate_names) + len(module.speed_names)))
    state += 0.01 * numpy.arange(1, len(state) + 1)
    arguments = [module.initial_time + 0.1, state, module.defaults()]
    if hasattr(module, "input_values"):
        arguments.append(numpy.array(module.input_values))
    expected = module.rhs(*arguments).tolist()
    texts = [f"[{' '.join(map(repr, a.tolist()))}]" if isinstance(a, numpy.ndarray) else repr(a) for a in arguments]
    with open("calls.txt", "w", encoding="utf-8") as file:
        file.write(f"rhs|rhs|{len(state)}|" + "|".join(texts) + "\n")
    ways = [("python3", "-B", f"{HERE}/straight_line.py", "julia", f"{name}.jl", "calls.txt"),
            ("python3", "-B", f"{HERE}/straight_line.py", "modelica", f"{name}.mo", "calls.txt")]  # yapf: disable
    if shutil.which("octave-cli"):
        ways.append(("octave-cli", "--norc", f"{HERE}/calls.m", name, "calls.txt"))
    for way in ways:
        run = said(*way)
        try:
            found = [float(word) for word in run.stdout.split()]
        except ValueError:
            found = []
        if not agrees(found, expected):
            wrong(f"{name}: {' '.join(way)}: {found}, expected {expected}; {run.stderr[:500]}")


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    sys.path.insert(0, folder)
    for scene in scenes:
        name = os.path.splitext(os.path.basename(scene))[0]
        if name in modules:
            continue
        runs = [said(program, "emit", scene, "-o", ".", "--language", one) for one in ("python", "julia", "matlab", "rust", "modelica")]
        if any(run.returncode for run in runs):
            if not all("leaves" in run.stderr and "open" in run.stderr for run in runs):
                wrong(f"{scene}: {[run.stderr[:200] for run in runs]}")
            continue
        modules.append(name)
        compare(name)
    if shutil.which("rustc"):
        with open("all.rs", "w", encoding="utf-8") as file:
            file.write("#![no_std]\n" + "".join(f"pub mod {name};\n" for name in modules))
        run = said("rustc", "--edition", "2018", "--crate-type", "rlib", "--emit=metadata", "-D", "warnings", "all.rs")
        if run.returncode:
            wrong(f"Rust: {run.stderr[:2000]}")
print(f"{len(modules)} scenes, {failures} failed")
sys.exit(1 if failures else 0)
