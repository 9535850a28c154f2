#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads every equation back from its MathML and holds it against the one in plain text: mathml.py PROGRAM [SCENE...]

`derive --steps --format mathml` and the page of `report` show the same equations, in the same order, as `derive --steps` in text,
whose equations are claims that other tests prove. Both sides of each are calculated at random values of all letters, the text by
Python's own reader of expressions, the MathML by the reader in this file, which shares nothing with the program. Exit code 1 where
a value differs, a side is missing, or something cannot be read. Without scenes: those of the repository, the pages of a tenth."""

import ast
import concurrent.futures
import functools
import html
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
GREEK = dict(zip(
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho sigma tau upsilon phi chi psi omega "
    "Gamma Delta Theta Lambda Xi Pi Sigma Upsilon Phi Psi Omega".split(),
    "αβγδεζηθικλμνξοπρστυφχψω" "ΓΔΘΛΞΠΣΥΦΨΩ"))
FUNCTIONS = {
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "arcsin": math.asin, "arccos": math.acos, "arctan": math.atan,
    "asin": math.asin, "acos": math.acos, "atan": math.atan, "atan2": math.atan2, "sinh": math.sinh, "cosh": math.cosh,
    "tanh": math.tanh, "exp": math.exp, "ln": math.log, "log": math.log, "sqrt": math.sqrt, "abs": abs,
    "sgn": lambda x: math.copysign(1, x), "csgn": lambda x: math.copysign(1, x), "sign": lambda x: math.copysign(1, x),
    "min": min, "max": max, "minimum": min, "maximum": max, "step": lambda x: float(x > 0)}
DOTS = {"˙": 1, "¨": 2, "⃛": 3, "⃜": 4}


class NotRead(Exception):
    """What this file has no reading for; it is counted, and more than a few fail the test."""


def value_of(stem, index, dots):
    """The random value of a letter: the same wherever it stands."""
    if (stem, index, dots) == ("π", "", 0):
        return math.pi
    return 0.3 + 1.1 * random.Random(zlib.crc32(f"{stem}|{index}|{dots}".encode())).random()


# The equations in text ----------------------------------------------------------------------------------------------

def lettering(name):
    stem, bar, index = (name[0] + name[1:].split("_", 1)[0], "_" in name[1:], name[1:].split("_", 1)[-1])
    index = index if bar else ""
    digits = re.search(r"(?<=.)\d+$", stem)
    if digits:
        stem = stem[:digits.start()]
        index = digits[0] + ("," + index if index else "")
    return GREEK.get(stem, stem), GREEK.get(index, index)


def text_value(text):
    names = {}

    def name(found):
        key = f"v{len(names)}"
        names[key] = value_of(*lettering(found[1]), len(found[2]))
        return key

    words = re.sub(r"([^\W\d]\w*)('*)(?!\w*\()", name, text).replace("^", "**")
    tree = ast.parse(words.strip(), mode="eval")
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and node.func.id not in FUNCTIONS:
            raise NotRead(node.func.id)
    return eval(compile(tree, text, "eval"), {"__builtins__": {}}, {**FUNCTIONS, **names})  # numbers and + - * / ** alone


# The equations in MathML --------------------------------------------------------------------------------------------

def plain(element):
    return "".join(element.itertext())


def letter(element):
    """Stem, index and dots of <mi>, <mover>, <msub>; nothing for anything else."""
    if element.tag == "mi":
        return element.text, "", 0
    if element.tag == "mover" and plain(element[1]) in DOTS:
        return plain(element[0]), "", DOTS[plain(element[1])]
    if element.tag == "msub" and (stem := letter(element[0])) and not stem[1]:
        return stem[0], plain(element[1]), stem[2]
    return None


def raised(base, exponent):
    return read(base) ** read(exponent)


def argument_of(items, k):
    """What the function sign at k is applied to, and the place behind it; the arguments of one in brackets apart."""
    k += 1
    while items[k].tag == "mspace":
        k += 1
    inside = list(items[k])
    if items[k].tag == "mrow" and inside and plain(inside[0]) == "(":
        parts, part = [], []
        for item in inside[1:-1]:
            if plain(item) == "," and item.tag == "mo":
                parts.append(part)
                part = []
            else:
                part.append(item)
        return [row(p) for p in parts + [part]], k + 1
    return [read(items[k])], k + 1


def called(items, k):
    """The value of a function with its argument, and the place behind; nothing if there is none at k."""
    applied = k + 1 < len(items) and items[k + 1].tag == "mo" and plain(items[k + 1]) == "\u2061"
    if not applied:
        return None
    arguments, after = argument_of(items, k + 1)
    head = items[k]
    power = 1
    if head.tag == "msup" and head[0].tag == "mi" and head[0].text in FUNCTIONS:
        power, head = read(head[1]), head[0]
    if head.tag == "mi" and head.text in FUNCTIONS:
        return FUNCTIONS[head.text](*arguments) ** power, after
    if (known := letter(head)) and plain(items[k + 2]) == "(t)":
        return value_of(*known), after  # an input, F(t)
    raise NotRead("the function " + plain(head))


def row(items):
    """A sum of products."""
    items = [item for item in items if item.tag != "mspace"]
    if items and items[0].tag == "mo" and plain(items[0]) in "(|":
        inside = row(items[1:-1])
        return abs(inside) if plain(items[0]) == "|" else inside
    total, product, sign, k = 0.0, None, 1, 0
    while k < len(items):
        item, mark = items[k], plain(items[k]) if items[k].tag == "mo" else ""
        if mark in ("+", "\u2212"):
            total, product = total + (sign * product if product is not None else 0), None
            sign = 1 if mark == "+" else -1
        elif mark in ("\u2062", "\u22c5"):
            pass
        elif mark:
            raise NotRead("the sign " + mark)
        else:
            found = called(items, k)
            value, k = found if found else (read(item), k + 1)
            product = value if product is None else product * value
            continue
        k += 1
    if product is None:
        return math.nan  # nothing stands there
    return total + sign * product


def read(element):
    if (known := letter(element)) is not None:
        return value_of(*known)
    if element.tag == "mn":
        return float(element.text)
    if element.tag == "mrow":
        return row(list(element))
    if element.tag == "mfrac":
        return read(element[0]) / read(element[1])
    if element.tag == "msqrt":
        return math.sqrt(row(list(element)))
    if element.tag == "msup" and plain(element[0]) == "e" and element[0].get("mathvariant") == "normal":
        return math.exp(read(element[1]))
    if element.tag == "msup":
        return raised(element[0], element[1])
    if element.tag == "msubsup":
        stem = letter(element[0])
        return value_of(stem[0], plain(element[1]), stem[2]) ** read(element[2])
    if element.tag == "mo" and element.text.strip("0123456789/.") == "":
        return float(element.text)
    raise NotRead(element.tag + " " + plain(element))


# What is compared ---------------------------------------------------------------------------------------------------

def equations_of_text(text):
    return [tuple(line.strip().split(" = ", 1)) for line in text.splitlines() if line.startswith("  ") and " = " in line]


def equations_of_mathml(text):
    table = ElementTree.fromstring(re.sub(r' xmlns="[^"]*"', "", text))
    return [(list(r[0]), list(r[2])) for r in table.iter("mtr") if len(r) == 3]


def equations_of_page(text):
    """The sides of all <math class="lines"> with one equals sign; <mrow>s are where the line may be broken."""
    for found in re.findall(r'<math class="lines".*?</math>', text):
        items = [child for group in ElementTree.fromstring(html.unescape(found.replace("&lt;", "&amp;lt;"))) for child in group]
        at = [k for k, item in enumerate(items) if item.tag == "mo" and item.text == "="]
        if len(at) != 1:
            raise NotRead(f"{len(at)} equals signs")
        yield items[:at[0]], items[at[0] + 1:]


def near(a, b):
    return abs(a - b) <= 1e-9 * max(1, abs(a), abs(b))


def same(side, text):
    """Whether a side in MathML is the expression in text; a side that is missing is never."""
    if not side:
        return False
    return near(row(side), text_value(text))


def is_expression(text):
    return not re.search(r" of |^d\w+/d\(|^d/dt d|^[QF]\*?\(|^gap|^w_|^omega_|^\w+\*$|\bx\b.*\bx\b r", text)


def run(program, *words):
    return subprocess.run([program, *words], capture_output=True, text=True, check=False, timeout=120)


def faults_of(program, scene, with_page):
    name, wrong, read_count, not_read = os.path.relpath(scene, ROOT), [], 0, []
    plain_text = run(program, "derive", scene, "--steps", "--full")
    if plain_text.returncode:
        return name, wrong, 0, not_read
    texts = equations_of_text(plain_text.stdout)
    maths = equations_of_mathml(run(program, "derive", scene, "--steps", "--full", "--format", "mathml").stdout)
    if len(maths) != len(texts):
        wrong.append(f"{len(texts)} equations in text, {len(maths)} in MathML")
    for (left, right), (plain_left, plain_right) in zip(maths, texts):
        for side, text in ((left, plain_left), (right, plain_right)):
            if side is left and not is_expression(text):
                continue
            try:
                read_count += 1
                if not same(side, text):
                    wrong.append(f"{text}: is not what stands in the MathML")
            except (NotRead, SyntaxError, AttributeError) as unknown:
                not_read.append(f"{text}: {unknown}")
            except (ValueError, ZeroDivisionError, OverflowError):
                pass  # the random values lie outside of what a function is defined for
    if with_page:
        values = set()
        for left, right in texts:
            try:
                values.add(round(text_value(left) - text_value(right), 7))
            except (NotRead, SyntaxError, AttributeError, ValueError, ZeroDivisionError, OverflowError):
                pass
        with tempfile.TemporaryDirectory() as folder:
            page = os.path.join(folder, "page.html")
            run(program, "report", scene, "--duration", "0.01", "--budget", "2000", "-o", page)
            text = pathlib.Path(page).read_text(encoding="utf-8")
        if found := re.search(r"&lt;/?(?:code|p|math|mi|mo|mrow|span|strong)&gt;|&amp;#39;", text):
            wrong.append(f"page: markup became text: {text[max(0, found.start() - 40):found.end() + 40]}")
        first = re.search(r'<section id="equations".*?</section>', text, re.S)[0]
        for left, right in equations_of_page(first):
            try:
                read_count += 1
                if not any(near(row(left) - row(right), value) or abs(row(left) - row(right) - value) < 1e-6 for value in values):
                    wrong.append("page: " + "".join(plain(e) for e in left + right) + " is no equation of derive")
            except NotRead as unknown:
                not_read.append(f"page: {unknown}")
    return name, wrong, read_count, not_read


def main(program, *scenes):
    chosen = list(scenes) or sorted(map(str, [*ROOT.glob("scenes/textbook/*.toml"), *ROOT.glob("scenes/gallery/*.toml")]))
    look = functools.partial(faults_of, program)
    failed, count, unread = 0, 0, []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        pages = [bool(scenes) or k % 10 == 0 for k in range(len(chosen))]
        for name, wrong, read_count, not_read in pool.map(look, chosen, pages):
            failed += bool(wrong)
            count += read_count
            unread += [f"{name}: {what}" for what in not_read]
            for fault in wrong:
                print(f"FAILED {name}: {fault}")
    print(f"{count} sides of equations read back from MathML, {len(unread)} have no reading here")
    for what in unread[:20]:
        print("  " + what)
    return 1 if failed or 50 * len(unread) > count or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
