#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints a tree of bodies with revolute joints, given as JSON, as a scene.

    python3 scenes/benchmark/tree.py arm7.json > arm7.toml
    alembert eval arm7.toml

The JSON has, for each body, its parent (-1 is the ground), where its joint's frame stands in the parent's (R, p), the
joint's axis, mass, mass centre and inertia (xx xy xz yy yz zz about the mass centre), along the joint's frame; and a
reference state with torques, which become the scene's initial state and forces. Rotations are written as angles about
z, y, x; the angles carry 17 digits, those of half turns are exact.
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


system = json.load(open(sys.argv[1]))
bodies, ref = system["bodies"], system["ref"]
print(f'title = "{system["name"]}"')
if "source" in system:
    print(f'source = {json.dumps(system["source"])}')
print(f'gravity = {vector(system["gravity"])}\n')
for i, b in enumerate(bodies):
    xx, xy, xz, yy, yz, zz = (number(x) for x in b["inertia"])
    parent = b["parent"]
    com = [0, 0, 0] if parent < 0 else bodies[parent]["com"]
    print(f'[[body]]\nname = "B{i + 1}"\nmass = {number(b["mass"])}')
    print(f'inertia = {{ xx = {xx}, yy = {yy}, zz = {zz}, xy = {xy}, yz = {yz}, zx = {xz} }}\n')
    print(f'[[joint]]\nname = "J{i + 1}"\ntype = "revolute"')
    print(f'parent = "{"N" if parent < 0 else f"B{parent + 1}"}"\nchild = "B{i + 1}"')
    print(f'parent_point = {vector(round(p - c, 15) for p, c in zip(b["p"], com))}')
    print(f'child_point = {vector(-c for c in b["com"])}')
    if turns := rotations(b["R"]):
        print(f"parent_rotate = [{turns}]")
    axis = {(1, 0, 0): '"x"', (0, 1, 0): '"y"', (0, 0, 1): '"z"'}.get(tuple(b["axis"]), vector(b["axis"]))
    print(f"axis = {axis}")
    q, qd = number(ref["q"][i]), number(ref["qd"][i])
    print(f'coordinates = {{ q{i + 1} = {{ initial = {q}, rate = {qd}, unit = "rad" }} }}\n')
print("[forces]")
for i, tau in enumerate(ref["tau"]):
    print(f"q{i + 1} = {number(tau)}")
