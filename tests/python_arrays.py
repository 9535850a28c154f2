# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of every function of the package that takes or gives arrays, with arrays of every kind, against the same numbers
in Python's lists and in closed form. tests/wheel.sh runs them with NumPy 1 and with NumPy 2."""

import math
import struct
import unittest

import numpy as np

import alembert
from python_shared import PENDULUM

__all__ = ["Arrays"]

STATES = [[0.5, 0.25], [-0.75, 1.0], [1.25, -0.5], [2.0, 0.0]]  # exact as numbers of four bytes, too
WHOLE = [[1, 2], [-3, 4], [0, -1], [2, 0]]


def rates(state):
    return [state[1], -9.81 / 1.5 * math.sin(state[0])]


def partials(state):
    return [[0, 1], [-9.81 / 1.5 * math.cos(state[0]), 0]]


def energies(state):
    kinetic, potential = 0.5 * 2 * (1.5 * state[1])**2, -2 * 9.81 * 1.5 * math.cos(state[0])
    return [kinetic, potential, kinetic + potential]


def unaligned(values):
    """An array that begins at an odd address."""
    flat = [x for row in values for x in row]
    memory = b"x" + struct.pack(f"{len(flat)}d", *flat)
    return np.frombuffer(memory, dtype=np.float64, offset=1).reshape(len(values), -1)


def read_only(values):
    array = np.array(values, dtype=float)
    array.setflags(write=False)
    return array


def forms_of(values):
    """The same numbers as lists and as arrays of every kind."""
    array = np.array(values, dtype=float)
    wide = np.zeros((2 * len(values), 3 * len(values[0])))
    wide[::2, ::3] = array
    return {
        "lists": [list(row) for row in values],
        "tuples": tuple(tuple(row) for row in values),
        "arrays in a list": [np.array(row) for row in values],
        "float64": array,
        "float32": array.astype(np.float32),
        "long double": array.astype(np.longdouble),
        "big-endian": array.astype(">f8"),
        "objects": array.astype(object),
        "by columns": np.asfortranarray(array),
        "a part of a larger one": wide[::2, ::3],
        "backwards": array[::-1][::-1].copy()[::-1][::-1],
        "transposed": np.ascontiguousarray(array.T).T,
        "read-only": read_only(values),
        "unaligned": unaligned(values),
    }


class Arrays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = alembert.Scene(PENDULUM)
        cls.system = cls.scene.system()
        cls.robot = cls.scene.robot(["inverse", "mass", "gravity"])

    def near(self, given, wanted):
        """The same shape and numbers, and nothing but an array of its own numbers behind it."""
        self.assertIs(type(given), np.ndarray)
        self.assertEqual(given.dtype, np.float64)
        wanted = np.array(wanted, dtype=float, order="C")
        self.assertEqual(given.shape, wanted.shape)
        self.assertTrue(given.flags.c_contiguous)
        if given.size:
            self.assertEqual(given.strides, wanted.strides)
        for one, other in zip(given.ravel().tolist(), wanted.ravel().tolist()):
            self.assertAlmostEqual(one, other, delta=1e-12 * max(1, abs(other)))

    def functions(self):
        f = self.system
        return {f.rhs: rates, f.jacobian: partials, f.mass_matrix: lambda _: [[2 * 1.5**2]], f.energy: energies, f: rates}

    def test_one_state_in_every_form(self):
        for function, expected in self.functions().items():
            for values in (STATES, WHOLE):
                for name, form in forms_of(values).items():
                    for row, state in zip(form, values):
                        with self.subTest(function=function, form=name):
                            self.near(function(0.0, row), expected(state))

    def test_many_states_in_every_form(self):
        for function, expected in self.functions().items():
            for values in (STATES, WHOLE):
                wanted = [expected(state) for state in values]
                for name, form in forms_of(values).items():
                    with self.subTest(function=function, form=name):
                        self.near(function(0.0, form), wanted)
                whole = np.array(values, dtype=float)
                self.near(function(0.0, whole[::-1]), wanted[::-1])
                self.near(function(0.0, whole[1:2]), wanted[1:2])
                self.near(function(0.0, whole.reshape(2, 1, 2, 2)), np.reshape(wanted, (2, 1, 2) + np.shape(wanted)[1:]))
            shape = np.shape(expected(STATES[0]))
            self.assertEqual(function(0.0, np.zeros((0, 2))).shape, (0, *shape))
            self.assertEqual(function(0.0, np.zeros((3, 0, 2))).shape, (3, 0, *shape))

    def test_whole_numbers_and_times_of_every_kind(self):
        driven = alembert.Scene({
            "coordinates": {"x": 1},
            "particle": [{"name": "P", "mass": 2, "position": ["x", 0]}],
            "forces": {"x": "4*t - 2*x"},
        }).system()  # yapf: disable
        state = np.array([0.5, 0.25])
        for t in (3, 3.0, np.float64(3), np.float32(3), np.int64(3), np.array(3), np.array(3.0), np.array([3.0]), [3], True + 2):
            with self.subTest(t=t, kind=type(t)):
                self.near(driven.rhs(t, state), [0.25, 5.5])
                self.near(driven.rhs(t, state[None]), [[0.25, 5.5]])
                self.near(driven.rhs(t, np.array([[1, 2], [3, 4]], dtype=np.int32)), [[2, 5], [4, 3]])
        for times in ([1, 2], (1.0, 2.0), np.array([1, 2]), np.array([1, 2], dtype=np.float32), np.array([1.0, 0, 2, 0])[::2]):
            with self.subTest(times=times):
                self.near(driven.rhs(times, [[1, 2], [3, 4]]), [[2, 1], [4, 1]])
        for wrong, words in ((None, "None"), ([1.0, 2, 3], "3 times for 2 states")):
            with self.assertRaisesRegex(ValueError, words):
                driven.rhs(wrong, [[1, 2], [3, 4]])
        for wrong in (0.5, np.array(0.5), [1.0, 2, 3], np.zeros((2, 3))):
            with self.assertRaisesRegex(ValueError, "2 numbers"):
                driven.rhs(0.0, wrong)

    def test_states_as_columns(self):
        wanted = np.array([rates(state) for state in STATES]).T
        for name, form in forms_of(STATES).items():
            with self.subTest(form=name):
                columns = np.asarray(form).T
                self.near(self.system.rhs_of_columns(0.0, columns), wanted)
                self.near(self.system.rhs_of_columns(0.0, columns[:, 0]), wanted[:, 0])

    def test_more_states_than_a_core_takes(self):
        states = np.random.default_rng(3).normal(size=(9001, 2))
        for function, expected in self.functions().items():
            self.near(function(0.0, states), [expected(state) for state in states.tolist()])

    def test_functions_of_robots_in_every_form(self):
        robot, inertia = self.robot, 2 * 1.5**2
        q, v, a = ([[row[0]] for row in STATES], [[row[1]] for row in STATES], [[0.5], [0.25], [-1.0], [2.0]])
        load = [[inertia * a_ + 2 * 9.81 * 1.5 * math.sin(q_)] for (q_,), (a_,) in zip(q, a)]
        for name in forms_of(q):
            with self.subTest(form=name):
                given = [forms_of(values)[name] for values in (q, v, a)]
                self.near(np.ascontiguousarray(robot.inverse(*given)), load)
                self.near(robot.mass(given[0]), [[[inertia]]] * 4)
                for k in range(4):
                    self.near(np.ascontiguousarray(robot.inverse(*(one[k] for one in given))), load[k])
                    self.near(robot.mass(given[0][k]), [[inertia]])
        self.near(np.ascontiguousarray(robot.gravity(np.zeros((0, 1)))), np.zeros((0, 1)))

    def test_motions_and_sweeps(self):
        run = self.scene.simulate(duration=1, tolerance=1e-12, sample=0.25)
        self.assertEqual([len(run["theta"]), run.t.tolist()], [5, [0, 0.25, 0.5, 0.75, 1]])
        theta, rate = run["theta"].tolist(), run["theta'"].tolist()
        self.assertEqual(run["theta"].dtype, np.float64)
        self.assertFalse(run["theta"].flags.writeable)
        for k, t in enumerate(run.t):  # the energy is kept, row by row
            self.assertAlmostEqual(energies([theta[k], rate[k]])[2], energies([0.4, 0.1])[2], places=9)
            for form in (t, float(t), np.float32(t), np.array(t), [t], np.array([[t]]), np.array([0, t])[1:]):
                given = run(form)
                self.assertEqual(given.shape, (*np.shape(form), 2))
                np.testing.assert_allclose(given.ravel(), [theta[k], rate[k]], atol=1e-9)
        np.testing.assert_allclose(run(run.t[::-2]), np.column_stack([theta, rate])[::-2], atol=1e-9)
        self.near(self.scene.initial_state(), [0.4, 0.1])
        lengths = [1.0, 1.5]
        for form in (lengths, tuple(lengths), np.array(lengths), np.array(lengths, dtype=np.float32), np.array([1.0, 0, 1.5])[::2]):
            swept = self.scene.sweep({"l": form, "theta": [0.25, 0.5]}, duration=1, tolerance=1e-10)
            self.assertEqual(swept["l"].tolist(), [[1, 1], [1.5, 1.5]])
            self.assertEqual(swept["theta"].tolist(), [[0.25, 0.5], [0.25, 0.5]])
            alone = alembert.Scene({**PENDULUM, "coordinates": {"theta": {"initial": 0.5, "rate": 0.1}}})
            end = alone.simulate(duration=1, tolerance=1e-10).final["coordinates"]["theta"]
            self.assertAlmostEqual(swept["final_theta"][1, 1], end, places=8)
