#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints N four-bar linkages side by side as a scene: python3 four_bars.py N > four_bars.toml

A02 of the MBS benchmark (Gonzalez, Dopico, Lugris, Cuadrado, Multibody System Dynamics 16, 2006): N + 1 cranks on pins a metre
apart, N couplers, all of 1 m and 1 kg. One degree of freedom, N + 1 for a moment when everything lies flat. It starts upright with
B0 at 1 m/s. As the cranks stay parallel it moves as a pendulum, ((N+1)/3 + N) theta'' = -g ((N+1)/2 + N) sin(theta), theta from
the hanging position: the digits to hold it against.
"""

import sys

HEAD = """title  = "{n} four-bar linkages side by side"
source = "A02 of the MBS benchmark, written by scenes/benchmark/four_bars.py"
gravity = [0, "-g"]                 # y points up

[parameters]
g = 9.81

[coordinates]
"""

CRANK = """
[[frame]]
name = "C{k}"
rotate = [["z", "q{k}"]]

[[point]]
name = "A{k}"
offset = [{k}, 0]

[[point]]
name = "B{k}"
from = "A{k}"
offset = [0, 1]
axes = "C{k}"

[[body]]
name = "crank{k}"
mass = 1
inertia = "1/12"
frame = "C{k}"
from = "A{k}"
position = [0, 0.5]
axes = "C{k}"
"""

COUPLER = """
[[frame]]
name = "D{k}"
rotate = [["z", "p{k}"]]

[[point]]
name = "E{k}"
from = "B{k}"
offset = [1, 0]
axes = "D{k}"

[[body]]
name = "coupler{k}"
mass = 1
inertia = "1/12"
frame = "D{k}"
from = "B{k}"
position = [0.5, 0]
axes = "D{k}"

[[constraint]]
name = "x{k}"
holonomic = "dot(pos(E{k}), ex(N)) - dot(pos(B{j}), ex(N))"

[[constraint]]
name = "y{k}"
holonomic = "dot(pos(E{k}), ey(N)) - dot(pos(B{j}), ey(N))"
"""

TAIL = """
[simulation]
duration = 10
tolerance = 1e-10
"""


def four_bars(n):
    text = HEAD.format(n=n)
    for k in range(n + 1):
        text += f"q{k} = {{ initial = 0, rate = -1, unit = \"rad\" }}\n"
    for k in range(n):
        text += f"p{k} = 0\n"
    for k in range(n + 1):
        text += CRANK.format(k=k)
    for k in range(n):
        text += COUPLER.format(k=k, j=k + 1)
    return text + TAIL


if __name__ == "__main__":
    if len(sys.argv) != 2 or not (sys.argv[1].isascii() and sys.argv[1].isdigit()) or int(sys.argv[1]) < 1:
        sys.exit("usage: four_bars.py N, N a whole number from 1 on")
    sys.stdout.write(four_bars(int(sys.argv[1])))
