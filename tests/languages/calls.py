# SPDX-License-Identifier: MIT
"""Calls the functions of an emitted module of Python: calls.py MODULE calls.txt [jax]. The form of the calls is that of
straight_line.py."""

import importlib
import os
import sys

import numpy

sys.path.insert(0, os.getcwd())
module = importlib.import_module(sys.argv[1])
traced = {}


def called(name, values):
    if len(sys.argv) < 4:
        return getattr(module, name)(*values)
    import jax

    jax.config.update("jax_enable_x64", True)
    function = traced.setdefault(name, jax.jit(getattr(module, name)))
    return function(*[jax.numpy.asarray(value) for value in values])


earlier = {}
for line in open(sys.argv[2], encoding="utf-8"):
    name, to, sizes, *arguments = line.split("|")
    values = [earlier[a.strip()[1:]] if a.strip().startswith("=")
              else numpy.array(a.strip()[1:-1].split(), dtype=float) if a.strip().startswith("[") else float(a)
              for a in arguments]  # fmt: skip
    before = [numpy.array(value) for value in values]
    results = called(name, values)
    results = results if isinstance(results, tuple) else (results,)
    assert all(numpy.array_equal(a, b, equal_nan=True) for a, b in zip(before, values)), f"{name} changed an argument"
    assert name == "prepare" or [len(result) for result in results] == [int(size) for size in sizes.split()], name
    earlier[to] = results[0]
    if name != "prepare":
        print(" ".join(repr(float(x)) for result in results for x in result))
