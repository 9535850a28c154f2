#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the cells of the notebooks in examples/notebooks and compares what they give with the stored outputs.

    PYTHONPATH=build/release/python python3 tests/notebooks.py            # names what is stale
    PYTHONPATH=build/release/python python3 tests/notebooks.py --update   # stores the outputs

The cells of a notebook run in this process, one after the other, as Jupyter runs them: what is printed, and the value of
the last expression with its pictures and formulas, are the outputs of a cell. Numbers with a point are compared to six
digits, because compilers round differently.
"""

import ast
import contextlib
import glob
import io
import json
import os
import re
import sys

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../examples/notebooks")
NUMBER = re.compile(r"-?\d+\.\d+(?:e[-+]?\d+)?")


def notebooks():
    return sorted(glob.glob(os.path.join(FOLDER, "*.ipynb")))


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def lines(text):
    return text.splitlines(keepends=True)


def shown(value):
    """What a page with this notebook shows of a value: a picture, or a formula, or a table, and its text."""
    for method, kind in (("_repr_svg_", "image/svg+xml"), ("_repr_latex_", "text/latex"), ("_repr_html_", "text/html")):
        if hasattr(value, method):
            return {kind: lines(getattr(value, method)()), "text/plain": lines(repr(value))}
    return {"text/plain": lines(repr(value))}


def outputs_of(source, names, count):
    """The outputs of one cell, as a notebook stores them."""
    outputs, printed = [], io.StringIO()
    names["display"] = lambda value: outputs.append({"data": shown(value), "metadata": {}, "output_type": "display_data"})
    body = ast.parse(source).body
    last = body.pop() if body and isinstance(body[-1], ast.Expr) else None
    with contextlib.redirect_stdout(printed):
        exec(compile(ast.Module(body, []), f"cell {count}", "exec"), names)
        value = eval(compile(ast.Expression(last.value), f"cell {count}", "eval"), names) if last else None
    if printed.getvalue():
        outputs.insert(0, {"name": "stdout", "output_type": "stream", "text": lines(printed.getvalue())})
    if value is not None:
        outputs.append({"data": shown(value), "execution_count": count, "metadata": {}, "output_type": "execute_result"})
    return outputs


def run(notebook):
    """The same notebook with the outputs that its cells give now."""
    names, count = {"__name__": "__main__"}, 0
    result = json.loads(json.dumps(notebook))
    for cell in result["cells"]:
        if cell["cell_type"] == "code":
            count += 1
            cell["execution_count"] = count
            cell["outputs"] = outputs_of("".join(cell["source"]), names, count)
    return result


def alike(stored, now):
    """Are these outputs the same, numbers to six digits?"""
    one, other = (json.dumps(outputs, sort_keys=True) for outputs in (stored, now))
    if NUMBER.split(one) != NUMBER.split(other):
        return False
    pairs = zip(map(float, NUMBER.findall(one)), map(float, NUMBER.findall(other)))
    return all(abs(a - b) <= 1e-6 * max(1, abs(a)) for a, b in pairs)


def stale(path):
    """The cells, counted from 1, whose stored outputs are not those that they give now."""
    stored = read(path)
    now = run(stored)
    pairs = [(a, b) for a, b in zip(stored["cells"], now["cells"]) if a["cell_type"] == "code"]
    return [k for k, (a, b) in enumerate(pairs, 1) if not alike(a["outputs"], b["outputs"])]


def main():
    wrong = 0
    for path in notebooks():
        if sys.argv[1:] == ["--update"]:
            updated = json.dumps(run(read(path)), indent=1, ensure_ascii=False) + "\n"
            with open(path, "w", encoding="utf-8") as file:
                file.write(updated)
        elif cells := stale(path):
            print(f"{os.path.basename(path)}: the outputs of cells {cells} are stale; tests/notebooks.py --update renews them")
            wrong = 1
    return wrong


if __name__ == "__main__":
    sys.exit(main())
