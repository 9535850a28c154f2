# SPDX-License-Identifier: MIT
"""A loop that is closed outside of the program: a controller in Python, which sets the force of a crane's drive a thousand
times a second, and the crane's compiled equations, which take it as an input from outside.

    PYTHONPATH=build/release/python python3 examples/closed_loop.py
"""

import os

import numpy as np

import alembert

scene = alembert.Scene(os.path.join(os.path.dirname(os.path.abspath(__file__)), "crane.toml"))
crane = scene.system()
print("inputs from outside:", ", ".join(crane.inputs))


def controlled(y):
    """The force that brings the trolley to x = 2 and the rope to rest."""
    x, theta, v, turn = y
    return 80 * (2 - x) - 180 * v + 450 * theta - 100 * turn


def step(t, y, force, h):
    """Runge's and Kutta's method; the force is held."""
    a = crane.rhs(t, y, force)
    b = crane.rhs(t, y + h / 2 * a, force)
    c = crane.rhs(t, y + h / 2 * b, force)
    d = crane.rhs(t, y + h * c, force)
    return y + h / 6 * (a + 2 * b + 2 * c + d)


y, h = scene.initial_state(), 0.001
largest = 0.0
for k in range(20_000):
    force = np.array([controlled(y)])
    largest = max(largest, abs(force[0]))
    y = step(k * h, y, force, h)
print(f"the trolley is {abs(2 - y[0]):.3f} m from its goal, the rope {abs(y[1]):.3f} rad from the vertical")
print(f"the largest force was {largest:.0f} N")

# The same force held from the start to the end, as the program integrates it.
run = scene.simulate(duration=1, input={"F": "10"})
y = scene.initial_state()
for k in range(1000):
    y = step(k * h, y, np.array([10.0]), h)
print(f"a constant force gives the same motion: {abs(y - run(1)).max() < 1e-9}")
