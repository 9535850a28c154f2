#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints a tree of bodies with revolute joints, given as JSON, as a scene.

    python3 scenes/benchmark/tree.py arm7.json > arm7.toml
    alembert eval arm7.toml
    python3 scenes/benchmark/tree.py arm7.json --symbols > arm7_symbols.toml

The JSON has, for each body, its parent (-1 is the ground), where its joint's frame stands in the parent's (R, p), the
joint's axis, mass, mass centre and inertia (xx xy xz yy yz zz about the mass centre), along the joint's frame; and a
reference state with torques, which become the scene's initial state and forces. Rotations are written as angles about
z, y, x; the angles carry 17 digits, those of half turns are exact. With --symbols masses, mass centres, inertias, the places of the
joints and gravity are [parameters] (m1, cx1 .. cz1, Ixx1 .. Izx1, px1 .. pz1, gx .. gz), those that are zero too.
"""
import json
import math
import sys


def number(x):
    return repr(float(x)) if x != int(x) else str(int(x))


def angle(x):
    for divisor in (1, 2):
        for k in (-2, -1, 1, 2):
            if abs(x - k * math.pi / divisor) < 1e-15:
                return f'"{"-" if k < 0 else ""}{abs(k) if abs(k) > 1 else 1}*pi/{divisor}"'
    return "0" if abs(x) < 1e-15 else number(x)


def rotations(R):
    """R = Rz(a) Ry(b) Rx(c)"""
    b = math.atan2(-R[2][0], math.hypot(R[0][0], R[1][0]))
    a, c = math.atan2(R[1][0], R[0][0]), math.atan2(R[2][1], R[2][2])
    turns = [(axis, angle(x)) for axis, x in (("z", a), ("y", b), ("x", c))]
    return ", ".join(f'["{axis}", {x}]' for axis, x in turns if x != "0")


def vector(v):
    return "[" + ", ".join(number(x) for x in v) + "]"


def letters(name, of, values):
    """[parameters] of a vector, and the vector of their names."""
    names = [f"{name}{axis}{of}" for axis in "xyz"]
    parameters.extend(zip(names, values))
    return names


def joined(list):
    return "[" + ", ".join(f'"{x}"' for x in list) + "]"


system = json.load(open(sys.argv[1]))
symbols = "--symbols" in sys.argv[2:]
bodies, ref = system["bodies"], system["ref"]
parameters, lines = [], []
title = system["name"] + (", all its parameters as symbols" if symbols else "")
print(f'title = "{title}"')
if "source" in system:
    print(f'source = {json.dumps(system["source"])}')
gravity = letters("g", "", system["gravity"]) if symbols else []
print(f'gravity = {joined(gravity) if symbols else vector(system["gravity"])}\n')
say = lines.append
centres = []
for i, b in enumerate(bodies):
    k, parent = i + 1, b["parent"]
    values = [b["inertia"][j] for j in (0, 3, 5, 1, 4, 2)]
    if symbols:
        parameters.append((f"m{k}", b["mass"]))
        centres.append(letters("c", k, b["com"]))
        names = [f"I{e}{k}" for e in ("xx", "yy", "zz", "xy", "yz", "zx")]
        parameters.extend(zip(names, values))
        mass, tensor = f'"m{k}"', [f'"{name}"' for name in names]
        place = letters("p", k, b["p"])
        parent_point = joined(place if parent < 0 else [f"{p} - {c}" for p, c in zip(place, centres[parent])])
        child_point = joined([f"-{c}" for c in centres[i]])
    else:
        com = [0, 0, 0] if parent < 0 else bodies[parent]["com"]
        mass, tensor = number(b["mass"]), [number(x) for x in values]
        parent_point = vector(round(p - c, 15) for p, c in zip(b["p"], com))
        child_point = vector(-c for c in b["com"])
    say(f'[[body]]\nname = "B{k}"\nmass = {mass}')
    say("inertia = {{ xx = {}, yy = {}, zz = {}, xy = {}, yz = {}, zx = {} }}\n".format(*tensor))
    say(f'[[joint]]\nname = "J{k}"\ntype = "revolute"')
    say(f'parent = "{"N" if parent < 0 else f"B{parent + 1}"}"\nchild = "B{k}"')
    say(f"parent_point = {parent_point}")
    say(f"child_point = {child_point}")
    if turns := rotations(b["R"]):
        say(f"parent_rotate = [{turns}]")
    axis = {(1, 0, 0): '"x"', (0, 1, 0): '"y"', (0, 0, 1): '"z"'}.get(tuple(b["axis"]), vector(b["axis"]))
    say(f"axis = {axis}")
    q, qd = number(ref["q"][i]), number(ref["qd"][i])
    say(f'coordinates = {{ q{k} = {{ initial = {q}, rate = {qd}, unit = "rad" }} }}\n')
say("[forces]")
for i, tau in enumerate(ref["tau"]):
    say(f"q{i + 1} = {number(tau)}")
if symbols:
    print("[parameters]")
    for name, value in parameters:
        print(f"{name} = {number(value)}")
    print()
print("\n".join(lines))
