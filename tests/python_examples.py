# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of the examples in Python: each prints what is expected, and the stored outputs of the notebooks are fresh."""

import contextlib
import importlib.util
import io
import os
import runpy
import sys
import tempfile
import unittest

import notebooks
from python_shared import EXAMPLES, NO_SKIP

__all__ = ["Examples", "Notebooks"]


def printed(name, *arguments):
    """What a program of examples/ prints, run in this process."""
    told, before = io.StringIO(), sys.argv
    sys.argv = [name, *arguments]
    try:
        with contextlib.redirect_stdout(told):
            runpy.run_path(os.path.join(EXAMPLES, name), run_name="__main__")
    except SystemExit as end:
        assert not end.code
    finally:
        sys.argv = before
    return told.getvalue()


class Examples(unittest.TestCase):
    @unittest.skipIf(importlib.util.find_spec("scipy") is None and not NO_SKIP, "SciPy is missing")
    def test_scipy_integrates_solves_and_fits(self):
        self.assertEqual(printed("with_scipy.py"),
                         "Radau and alembert differ by less than 1e-6: True\n"
                         "at rest at theta = 1.234905, and stable there: True\n"
                         "the length is 0.83 m\n")  # yapf: disable

    def test_functions_for_casadi_are_compiled(self):
        with tempfile.TemporaryDirectory() as folder:
            told = printed("with_casadi.py", folder)
        self.assertTrue(told.startswith("compiled: crane.c, crane.h, crane_casadi.c\n"), told)

    def test_a_loop_is_closed_outside_of_the_program(self):
        self.assertEqual(printed("closed_loop.py"),
                         "inputs from outside: F\n"
                         "the trolley is 0.000 m from its goal, the rope 0.000 rad from the vertical\n"
                         "the largest force was 160 N\n"
                         "a constant force gives the same motion: True\n")  # yapf: disable

    def test_an_arm_follows_its_circle(self):
        self.assertEqual(printed("arm.py"),
                         "without a load the hand is 0 mm from the circle\n"
                         "with 1 kg in the hand it is 67 mm away\n"
                         "after the model has learned of it, 0 mm\n"
                         "the largest torque of gravity on this grid is 29.4 N m\n")  # yapf: disable


class Notebooks(unittest.TestCase):
    def test_stored_outputs_are_what_the_cells_give(self):
        self.assertEqual(len(notebooks.notebooks()), 6)
        for path in notebooks.notebooks():
            self.assertEqual(notebooks.stale(path), [], os.path.basename(path))

    def test_a_stale_output_is_found(self):
        old = [{"name": "stdout", "output_type": "stream", "text": ["x = 1.500000\n"]}]
        for text, same in (("x = 1.5000001\n", True), ("x = 1.5001\n", False), ("y = 1.500000\n", False)):
            self.assertEqual(notebooks.alike(old, [{**old[0], "text": [text]}]), same)
