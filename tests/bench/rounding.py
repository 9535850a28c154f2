#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Rounding of emitted right-hand sides at states along hard motions, against values in 50 digits.

    rounding.py ALEMBERT [SCENE …]

Without scenes those below. The states are the rows of `simulate`. The text of the emitted file is evaluated once more with
decimals of 50 digits, constants of the parameters included, and the emitted file itself is compiled and called. Two
numbers for each scene, relative to the largest acceleration of the motion: the largest error, and the largest mean of
an acceleration's error over all states. Roundings that change from step to step cancel in the mean; what is left acts
like another force. Only for files without speeds of their own, whose functions are sin, cos and sqrt.
"""

import ctypes
import decimal
import os
import re
import subprocess
import sys
import tempfile
from decimal import Decimal

decimal.getcontext().prec = 60
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
SCENES = ("flyball_governor stiff_spring_pendulum slider_crank pleiades kepler double_pendulum_chaotic heavy_top_sleeping "
          "outer_solar_system").split()


class Pair:
    def __init__(self, angles):
        both = [sine_and_cosine(angle) for angle in angles]
        self.sine, self.cosine = [one[0] for one in both], [one[1] for one in both]

    def __iter__(self):
        return iter((self.sine[0], self.cosine[0]))


def sine_and_cosine(x):
    """By the power series of a quarter of a thousandth of the angle, doubled again."""
    doublings = 12
    z = x / 2**doublings
    s, c, term, k = Decimal(0), Decimal(0), Decimal(1), 0
    while abs(term) > Decimal(10) ** -70 or k < 4:
        if k % 2 == 0:
            c += term if k % 4 == 0 else -term
        else:
            s += term if k % 4 == 1 else -term
        k += 1
        term = term * z / k
    for _ in range(doublings):
        s, c = 2 * s * c, c * c - s * s
    return s, c


NAMES = {"Real": lambda x: x if isinstance(x, Decimal) else Decimal(x), "sincos": lambda *x: Pair(x),
         "sin": lambda x: sine_and_cosine(x)[0], "cos": lambda x: sine_and_cosine(x)[1], "sqrt": lambda x: x.sqrt()}


def translated(text, name):
    """The body of a function of the emitted file as Python."""
    found = re.search(r"void " + name + r"\([^)]*\) \{\n(.*?)\n\}", text, re.S)
    body = re.sub(r"//[^\n]*", "", found.group(1) if found else "")
    lines = []
    for statement in " ".join(body.split()).split(";"):
        statement = re.sub(r"\[\[[^\]]*\]\]", "", statement).strip()
        statement = re.sub(r"^const Real ?&?", "", statement).replace("&", "")
        statement = re.sub(r"^const auto \[([^\]]*)\]", r"\1", statement)
        statement = re.sub(r"^const auto ", "", statement)
        statement = re.sub(r"Real\(([^()]*)\)", r"Real('\1')", statement)
        depth, start, parts = 0, 0, []
        if re.match(r"\w+ = .*, \w+ = ", statement):  # several declarations in one
            for k, letter in enumerate(statement):
                depth += (letter in "([") - (letter in ")]")
                if letter == "," and depth == 0:
                    parts.append(statement[start:k].strip())
                    start = k + 1
        lines += [*parts, statement[start:].strip()]
    return compile("\n".join(line for line in lines if line), name, "exec")


class Table(ctypes.Structure):
    _fields_ = ([(name, ctypes.c_int) for name in
                 "abi coordinates speeds parameters constants outputs events constraints".split()]
                + [(name, ctypes.c_void_p) for name in "scene formulation coordinate_names speed_names".split()]
                + [("parameter_names", ctypes.POINTER(ctypes.c_char_p)), ("output_names", ctypes.c_void_p),
                   ("event_names", ctypes.c_void_p), ("parameter_values", ctypes.POINTER(ctypes.c_double)),
                   ("prepare", ctypes.CFUNCTYPE(None, ctypes.POINTER(ctypes.c_double))),
                   ("rhs", ctypes.CFUNCTYPE(None, ctypes.c_double, *[ctypes.POINTER(ctypes.c_double)] * 3))])


def measured(program, scene, folder):
    name = os.path.basename(scene)[:-5]
    run = lambda *command: subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    run(program, "emit", scene, "-o", folder)
    source, rows = os.path.join(folder, name + ".cpp"), os.path.join(folder, name + ".csv")
    run(program, "simulate", scene, "--no-estimate", "-o", rows)
    run(os.environ.get("CXX", "g++"), "-std=c++20", "-O2", "-march=native", "-ffp-contract=fast", "-fno-math-errno",
        "-fno-trapping-math", "-shared", "-fPIC", source, "-o", source[:-4] + ".so")
    library = ctypes.CDLL(source[:-4] + ".so")
    library.alembert_solver.restype = ctypes.POINTER(Table)
    table = library.alembert_solver().contents
    text = open(source).read()
    n, count = table.coordinates, table.parameters + table.constants
    prepare, rhs = translated(text, "prepare"), translated(text, "rhs")
    values = [table.parameter_values[k] for k in range(table.parameters)]
    par = (ctypes.c_double * max(1, count))(*values)
    table.prepare(par)
    exact_par = [Decimal(value) for value in values] + [Decimal(0)] * table.constants
    exec(prepare, dict(NAMES, par=exact_par))
    worst, largest, sums, states = 0.0, 0.0, [0.0] * n, 0
    for line in open(rows).read().split("\n")[1:]:
        if not line:
            continue
        numbers = [float(x) for x in line.split(",")]
        t, state = numbers[0], numbers[1:1 + 2 * n]
        rate, exact = (ctypes.c_double * (2 * n))(), [Decimal(0)] * (2 * n)
        table.rhs(t, (ctypes.c_double * (2 * n))(*state), par, rate)
        exec(rhs, dict(NAMES, par=exact_par, state=[Decimal(x) for x in state], rate=exact, t=Decimal(t)))
        for i in range(n):
            error = float(Decimal(rate[n + i]) - exact[n + i])
            worst, largest = max(worst, abs(error)), max(largest, abs(rate[n + i]))
            sums[i] += error
        states += 1
    return worst / largest, max(map(abs, sums)) / states / largest


def main():
    program, scenes = sys.argv[1], sys.argv[2:] or [f"{ROOT}/scenes/benchmark/{name}.toml" for name in SCENES]
    print(f"{'rounding along the motion':28} {'largest':>9} {'mean':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for scene in scenes:
            try:
                worst, mean = measured(program, scene, folder)
                print(f"{os.path.basename(scene)[:-5]:28} {worst:9.1e} {mean:9.1e}", flush=True)
            except (subprocess.CalledProcessError, AttributeError, SyntaxError, NameError, ValueError) as error:
                print(f"{os.path.basename(scene)[:-5]:28} left out: {error}")


main()
