#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints a chain of N rods as a scene: python3 chain.py N [--points] [--torques] > chain.toml

Rod k hangs from the end J of rod k-1 and is turned against it by q_k about z; y points down. The rods are uniform;
with --points they have no mass, and a particle sits at the end of each. With --torques the parameter tauK turns joint K.
"""

import sys

HEAD = """title  = "Chain of {n} {kind}"
source = "benchmark, written by scenes/benchmark/chain.py"
gravity = [0, "g"]                  # y points down

[parameters]
m = {{ value = 1.0, unit = "kg" }}
l = {{ value = 1.0, unit = "m", about = "each rod" }}
g = {{ value = 9.81, unit = "m/s^2" }}

[coordinates]
"""

FRAME = """
[[frame]]
name = "R{k}"
parent = "{parent}"
rotate = [["z", "q{k}"]]

[[point]]
name = "J{k}"
from = "{joint}"
offset = [0, "l"]
axes = "R{k}"
"""

ROD = """
[[body]]
name = "rod{k}"
mass = "m"
frame = "R{k}"
from = "{joint}"
position = [0, "l/2"]
axes = "R{k}"
inertia = "m*l^2/12"
"""

PARTICLE = """
[[particle]]
name = "P{k}"
mass = "m"
at = "J{k}"
"""

TAIL = """
[simulation]
duration = 5.0
tolerance = 1e-10
"""


def chain(n, points, torques):
    text = HEAD.format(n=n, kind="particles on massless rods" if points else "uniform rods")
    if torques:
        parameters = "".join(f'tau{k} = {{ value = 0.0, unit = "N*m" }}\n' for k in range(1, n + 1))
        text = text.replace("\n[coordinates]", parameters + "\n[coordinates]")
    for k in range(1, n + 1):
        text += f"q{k} = {0.3 / k:.6g}\n"
    for k in range(1, n + 1):
        names = {"k": k, "parent": f"R{k - 1}" if k > 1 else "N", "joint": f"J{k - 1}" if k > 1 else "O"}
        text += (FRAME + (PARTICLE if points else ROD)).format(**names)
    if torques:
        text += "\n[forces]\n" + "".join(f'q{k} = "tau{k}"\n' for k in range(1, n + 1))
    return text + TAIL


def main(arguments):
    numbers = [a for a in arguments if a not in ("--points", "--torques")]
    if len(numbers) != 1 or not (numbers[0].isascii() and numbers[0].isdigit()) or int(numbers[0]) < 1:
        sys.exit("usage: chain.py N [--points] [--torques], N a whole number from 1 on")
    sys.stdout.write(chain(int(numbers[0]), "--points" in arguments, "--torques" in arguments))


if __name__ == "__main__":
    main(sys.argv[1:])
