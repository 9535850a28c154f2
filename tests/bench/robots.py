#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes robots of 20 to 40 joints as URDF, for measurements of counts: robots.py FOLDER

humanoid32: waist and neck of three joints, arms of seven, legs of six, axes at right angles.
tree20, tree30, tree40: the parent of each link is one of the three (four) before it; axes at right angles.
oblique20: the same with 20 joints, turned by arbitrary angles and with arbitrary offsets. chain20: such a chain.
"""
import pathlib
import random
import sys

X, Y, Z = "1 0 0", "0 1 0", "0 0 1"


def link(k, dice):
    m = dice.uniform(0.5, 5)
    c = [round(dice.uniform(-0.05, 0.05), 4), round(dice.uniform(-0.05, 0.05), 4), round(dice.uniform(-0.15, 0.15), 4)]
    i = [round(dice.uniform(0.02, 0.03) * m, 5) for _ in range(3)]
    o = [round(dice.uniform(-0.001, 0.001) * m, 6) for _ in range(3)]
    return (f'<link name="l{k}"><inertial><mass value="{m:.3f}"/><origin xyz="{c[0]} {c[1]} {c[2]}"/>'
            f'<inertia ixx="{i[0]}" iyy="{i[1]}" izz="{i[2]}" ixy="{o[0]}" ixz="{o[1]}" iyz="{o[2]}"/>'
            "</inertial></link>")


def urdf(name, joints):
    """joints: (parent, axis, origin, angles) of each link from the first on."""
    dice = random.Random(name)
    lines = [f'<robot name="{name}">', link(0, dice)]
    for k, (parent, axis, origin, angles) in enumerate(joints, 1):
        lines.append(link(k, dice))
        lines.append(f'<joint name="j{k}" type="continuous"><origin xyz="{origin}" rpy="{angles}"/>'
                     f'<parent link="l{parent}"/><child link="l{k}"/><axis xyz="{axis}"/>'
                     f'<dynamics damping="{round(dice.uniform(0.1, 1), 2)}"/></joint>')
    return "\n".join(lines + ["</robot>\n"])


def humanoid():
    joints = []

    def limb(at, *steps):
        for axis, origin in steps:
            joints.append((at, axis, origin, "0 0 0"))
            at = len(joints)
        return at

    chest = limb(0, (Z, "0 0 0.1"), (Y, "0 0 0.05"), (X, "0 0 0"))
    limb(chest, (Z, "0 0 0.45"), (Y, "0 0 0.05"), (X, "0 0 0"))
    for s in (1, -1):
        limb(chest, (Y, f"0 {0.2 * s} 0.35"), (X, "0 0 0"), (Z, f"0 {0.05 * s} 0"), (Y, "0.02 0 -0.28"),
             (Z, "-0.02 0 -0.1"), (Y, "0 0 -0.15"), (X, "0 0 0"))
    for s in (1, -1):
        limb(0, (Z, f"0 {0.1 * s} -0.05"), (X, "0 0 0"), (Y, "0 0 0"), (Y, "0 0 -0.38"), (Y, "0 0 -0.36"),
             (X, "0 0 0"))
    return joints


def tree(n, spread, oblique):
    dice = random.Random(n + spread)
    joints = []
    for k in range(1, n + 1):
        parent, axis = max(0, k - dice.randint(1, spread)), dice.choice([X, Y, Z])
        if oblique:
            origin = " ".join(str(round(dice.uniform(-0.3, 0.3), 3)) for _ in range(3))
            angles = " ".join(str(round(dice.uniform(-1.5, 1.5), 3)) for _ in range(3))
        else:
            origin, angles = dice.choice(["0.3 0 0", "0 0.25 0", "0 0 -0.3", "0.1 0 0.2"]), "0 0 0"
        joints.append((parent, axis, origin, angles))
    return joints


folder = pathlib.Path(sys.argv[1])
for name, joints in {"humanoid32": humanoid(), "tree20": tree(20, 3, False), "tree30": tree(30, 4, False),
                     "tree40": tree(40, 4, False), "oblique20": tree(20, 3, True),
                     "chain20": tree(20, 1, True)}.items():
    (folder / f"{name}.urdf").write_text(urdf(name, joints))
