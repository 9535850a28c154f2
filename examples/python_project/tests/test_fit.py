# SPDX-License-Identifier: MIT
"""The fit finds the pendulum again from whose motion the measured angles are, which is integrated here by itself."""

import os
import subprocess
import unittest

import numpy as np
from pendulum_fit import fitted

LENGTH, DAMPING = 0.73, 0.12


def motion(times, angle, steps=2000):
    """The classical method of Runge and Kutta, with so many steps between two rows."""
    def rate(y):
        return np.array([y[1], -9.81 / LENGTH * np.sin(y[0]) - DAMPING / LENGTH**2 * y[1]])

    y, h, rows = np.array([angle, 0.0]), (times[1] - times[0]) / steps, [angle]
    for _ in range(len(times) - 1):
        for _ in range(steps):
            a = rate(y)
            b = rate(y + h / 2 * a)
            c = rate(y + h / 2 * b)
            y = y + h / 6 * (a + 2 * b + 2 * c + rate(y + h * c))
        rows.append(y[0])
    return np.array(rows)


class Fit(unittest.TestCase):
    def test_the_parameters_of_a_motion_without_noise_are_found(self):
        times = np.linspace(0, 2, 26)
        found = fitted(times, motion(times, 1.2, 200), {"l": 0.9, "c": 0.0})
        self.assertAlmostEqual(found["l"], LENGTH, places=8)  # the method above errs by 1e-10
        self.assertAlmostEqual(found["c"], DAMPING, places=8)

    def test_the_command_fits_a_file(self):
        measured = os.path.join(os.path.dirname(__file__), "measured.csv")
        printed = subprocess.run(["pendulum-fit", measured], capture_output=True, text=True, check=True).stdout
        values = dict(line.split(" = ") for line in printed.splitlines())
        self.assertLess(abs(float(values["l"]) - LENGTH), 0.01)  # the angles are off by 0.005 rad
        self.assertLess(abs(float(values["c"]) - DAMPING), 0.02)


if __name__ == "__main__":
    unittest.main()
