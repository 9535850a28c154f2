# SPDX-License-Identifier: MIT
"""Length and damping of a pendulum from a measured motion: least squares by the method of Gauss and Newton.

    fit = fitted(times, angles, {"l": 1.0, "c": 0.0})
    fit["l"], fit["c"]

One run of the motion gives the angles at all times, and their derivatives by all parameters.
"""

import sys

import alembert
import numpy as np


def scene(parameters, angle):
    """The pendulum with these parameters, from rest at this angle."""
    return alembert.Scene({
        "gravity": [0, "-g"],
        "parameters": {"g": 9.81, "m": 1.0, **parameters},
        "coordinates": {"theta": {"initial": float(angle), "unit": "rad"}},
        "particle": [{"name": "bob", "mass": "m", "position": ["l*sin(theta)", "-l*cos(theta)"]}],
        "damper": [{"along": "theta", "damping": "c"}],
    })


def fitted(times, angles, guess):
    """The parameters of `guess` with which the motion is nearest to the angles. The times are 0, h, 2 h …"""
    values = dict(guess)
    for _ in range(50):
        run = scene(values, angles[0]).simulate(times[-1], 1e-11, sample=times[1] - times[0], estimate=False, sensitivity=list(values),
                                                sensitivity_of=["theta"], sensitivity_rows=True)
        slopes = np.array(run.sensitivity["rows"])[:, 0, :]
        step = np.linalg.lstsq(slopes, angles - run["theta"], rcond=None)[0]
        for name, change in zip(values, step):
            values[name] += float(change)
        if np.max(np.abs(step)) < 1e-10:
            return values
    raise ArithmeticError("the fit does not converge from this guess")


def main():
    times, angles = np.loadtxt(sys.argv[1], delimiter=",", skiprows=1, unpack=True)
    for name, value in fitted(times, angles, {"l": 1.0, "c": 0.0}).items():
        print(f"{name} = {value:.4f}")
