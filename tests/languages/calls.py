# SPDX-License-Identifier: MIT
"""Calls the functions of an emitted module of Python: calls.py MODULE calls.txt. The form of the calls is that of
straight_line.py."""

import importlib
import os
import sys

import numpy

sys.path.insert(0, os.getcwd())
module = importlib.import_module(sys.argv[1])
earlier = {}
for line in open(sys.argv[2], encoding="utf-8"):
    name, to, sizes, *arguments = line.split("|")
    values = [earlier[a.strip()[1:]] if a.strip().startswith("=")
              else numpy.array(a.strip()[1:-1].split(), dtype=float) if a.strip().startswith("[") else float(a)
              for a in arguments]  # fmt: skip
    before = [numpy.array(value) for value in values]
    results = getattr(module, name)(*values)
    results = results if isinstance(results, tuple) else (results,)
    assert all(numpy.array_equal(a, b, equal_nan=True) for a, b in zip(before, values)), f"{name} changed an argument"
    assert name == "prepare" or [len(result) for result in results] == [int(size) for size in sizes.split()], name
    earlier[to] = results[0]
    if name != "prepare":
        print(" ".join(repr(float(x)) for result in results for x in result))
