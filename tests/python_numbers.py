# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of what the Python package gives as arrays: motions, sweeps, systems, robots, functions for CasADi."""

import ctypes
import math
import os
import subprocess
import tempfile
import unittest

import numpy as np

import alembert
from python_shared import NO_SKIP, PENDULUM, TESTS, program, scene_file

__all__ = ["CasadiFunctions", "Motions", "Robots", "Systems"]


class Motions(unittest.TestCase):
    def test_the_same_end_as_the_program(self):
        file = scene_file("textbook/double_pendulum.toml")
        run = alembert.Scene(file).simulate(duration=3, tolerance=1e-11)
        told = program("simulate", file, "--duration", "3", "--tolerance", "1e-11")
        self.assertEqual(run.final, told["final"])
        self.assertIsNone(run.failure)
        self.assertEqual(run.t[-1], 3)
        self.assertEqual(run["theta1"][-1], told["final"]["coordinates"]["theta1"])
        self.assertIs(run["theta1"].base is None, False)
        with self.assertRaises(ValueError):
            run.table[0, 0] = 1

    def test_the_same_sensitivity_as_the_program(self):
        file = scene_file("textbook/slider_crank.toml")
        run = alembert.Scene(file).simulate(duration=0.5, sensitivity=["alpha", "l"])
        told = program("simulate", file, "--duration", "0.5", "--sensitivity", "alpha,l")
        self.assertEqual(run.sensitivity, told["sensitivity"])
        self.assertEqual(run.sensitivity["by"], ["alpha", "l"])
        few = alembert.Scene(file).simulate(duration=0.5, sensitivity=["alpha", "l"], sensitivity_of=["x"]).sensitivity
        self.assertTrue(few["adjoint"])
        np.testing.assert_allclose(few["values"][0], run.sensitivity["values"][2], rtol=1e-8)

    def test_a_motion_has_a_state_at_any_time(self):
        # Between rows that are 1/4 s apart it is as good as the rows of a finer run.
        scene = alembert.Scene(scene_file("textbook/double_pendulum.toml"))
        coarse = scene.simulate(duration=2, tolerance=1e-11, sample=0.25, estimate=False)
        fine = scene.simulate(duration=2, tolerance=1e-11, sample=0.01, estimate=False)
        states = coarse(fine.t)
        self.assertEqual(states.shape, (len(fine.t), 4))
        for place, column in enumerate(("theta1", "theta2", "theta1'", "theta2'")):
            np.testing.assert_allclose(states[:, place], fine[column], rtol=0, atol=1e-9)
        np.testing.assert_array_equal(coarse(0.25), [coarse[c][1] for c in ("theta1", "theta2", "theta1'", "theta2'")])
        with self.assertRaisesRegex(ValueError, "there is no state at 2.5"):
            coarse(2.5)

    def test_states_between_impacts_and_on_constraints(self):
        # A ball falls freely between its impacts: y = y0 + v0 t - g t^2/2 from the row after each.
        ball = alembert.Scene(scene_file("textbook/bouncing_ball.toml")).simulate(duration=2.5, sample=2.5)
        first, second = (one["time"] for one in ball.contacts[:2])
        after, later = ball(first), ball(0.5 * (first + second))
        fall, g = 0.5 * (second - first), 9.81
        self.assertGreater(after[1], 0)  # after the impact, not before
        np.testing.assert_allclose(later, [after[0] + after[1] * fall - g * fall**2 / 2, after[1] - g * fall],
                                   rtol=0, atol=1e-8)
        crank = alembert.Scene(scene_file("textbook/slider_crank.toml")).simulate(duration=1, sample=0.5)
        x = crank(0.3)[list(crank.final["coordinates"]).index("x")]
        alpha, beta = (crank(0.3)[list(crank.final["coordinates"]).index(one)] for one in ("alpha", "beta"))
        self.assertAlmostEqual(x, 0.15 * math.cos(alpha) + 0.4 * math.cos(beta), places=11)

    def test_what_sticks_at_a_row_goes_on_sticking(self):
        # Static friction above the kinetic one: a sliding velocity of rounding alone must not let the block slip.
        block = alembert.Scene(scene_file("friction/stick_slip.toml"))
        coarse = block.simulate(duration=2, tolerance=1e-10, estimate=False)
        fine = block.simulate(duration=2, tolerance=1e-10, estimate=False, sample=0.0137)
        np.testing.assert_allclose(coarse(fine.t), fine.table[:, 1:3], rtol=0, atol=1e-9)

    def test_events_sections_files_and_pictures(self):
        scene = alembert.Scene(scene_file("textbook/double_pendulum.toml"))
        run = scene.simulate(duration=4, poincare="theta1 = 0")
        for crossing in run.poincare["crossings"]:
            self.assertAlmostEqual(run(crossing["time"])[0], 0, places=8)
        self.assertGreater(len(run.poincare["crossings"]), 1)
        self.assertIn("<svg", run.plot("theta1", "energy").svg)
        with self.assertRaisesRegex(alembert.ModelError, "thetta1"):
            run.plot("thetta1")
        with tempfile.TemporaryDirectory() as folder:
            run.save(os.path.join(folder, "run.npz"))
            with np.load(os.path.join(folder, "run.npz")) as stored:
                np.testing.assert_array_equal(stored["theta1"], run["theta1"])
            # The library for HDF5 stands beside the module, where it was built.
            if NO_SKIP or os.path.exists(os.path.join(os.path.dirname(alembert.__file__), "alembert-hdf5.so")):
                run.save(os.path.join(folder, "run.h5"))
                with open(os.path.join(folder, "run.h5"), "rb") as stored:
                    self.assertEqual(stored.read(4), b"\x89HDF")

    def test_a_sweep_has_the_shape_of_its_grid(self):
        scene = alembert.Scene(PENDULUM)
        swept = scene.sweep({"l": [1.0, 1.5, 2.0], "theta": [0.2, 0.4]}, duration=1, tolerance=1e-10)
        self.assertEqual(swept["theta'"].shape, (3, 2))
        np.testing.assert_array_equal(swept["l"], [[1, 1], [1.5, 1.5], [2, 2]])
        alone = scene.simulate(duration=1, tolerance=1e-10)
        self.assertAlmostEqual(swept["theta'"][1, 1], alone.final["rates"]["theta"], places=9)
        self.assertEqual(swept.status, ["done"] * 6)
        side = scene.sweep({"l": [1.0, 2.0], "theta": [0.2, 0.4]}, duration=1, grid=False)
        np.testing.assert_allclose(side["theta'"], [swept["theta'"][0, 0], swept["theta'"][2, 1]], atol=1e-7)
        for wrong in ({}, {"l": []}):
            with self.assertRaises(ValueError):
                scene.sweep(wrong)

    def test_rows_outlive_their_run(self):
        column = alembert.Scene(PENDULUM).simulate(duration=1)["theta"]
        self.assertAlmostEqual(column[0], 0.4)


class Systems(unittest.TestCase):
    def setUp(self):
        self.system = alembert.Scene(PENDULUM).system()

    def test_one_state_and_many(self):
        f = self.system
        one = f.rhs(0.0, [0.4, 0.1])
        self.assertAlmostEqual(one[1], -9.81 / 1.5 * math.sin(0.4), places=13)
        states = np.random.default_rng(1).normal(size=(7, 1001, 2))
        rates = f.rhs(0.0, states)
        self.assertEqual(rates.shape, states.shape)
        np.testing.assert_allclose(rates[..., 0], states[..., 1])
        np.testing.assert_allclose(rates[..., 1], -9.81 / 1.5 * np.sin(states[..., 0]), rtol=1e-14, atol=1e-14)

    def test_derivatives_mass_and_energy(self):
        f = self.system
        jacobian = f.jacobian(0.0, [0.4, 0.1])
        np.testing.assert_allclose(jacobian, [[0, 1], [-9.81 / 1.5 * math.cos(0.4), 0]], rtol=1e-14)
        np.testing.assert_allclose(f.mass_matrix(0.0, [0.4, 0.1]), [[2 * 1.5**2]])
        T, V, E = f.energy(0.0, [0.4, 0.1])
        self.assertAlmostEqual(T, 0.5 * 2 * (1.5 * 0.1)**2)
        self.assertAlmostEqual(E, T + V)

    def test_other_parameters(self):
        self.system.set(l=3)
        self.assertAlmostEqual(self.system.rhs(0.0, [0.4, 0.1])[1], -9.81 / 3 * math.sin(0.4), places=13)
        with self.assertRaises(KeyError):
            self.system.set(length=3)

    def test_a_wrong_shape_is_told(self):
        with self.assertRaisesRegex(ValueError, "2 numbers"):
            self.system.rhs(0.0, np.zeros(3))

    def test_scipy_integrates_it(self):
        try:
            from scipy.integrate import solve_ivp
        except ImportError:
            self.skipTest("SciPy is missing")
        ours = alembert.Scene(PENDULUM).simulate(duration=2, tolerance=1e-12)
        theirs = solve_ivp(self.system.rhs, (0, 2), [0.4, 0.1], method="DOP853", rtol=1e-12, atol=1e-12)
        self.assertAlmostEqual(theirs.y[0, -1], ours["theta"][-1], places=9)


class Robots(unittest.TestCase):
    def test_the_functions_of_a_pendulum_are_those_of_the_book(self):
        robot = alembert.Scene(PENDULUM).robot(frames=["P"])
        m, l, g = 2.0, 1.5, 9.81
        q, v, a = np.random.default_rng(2).normal(size=(3, 37, 1))
        np.testing.assert_allclose(robot.mass(q), np.full((37, 1, 1), m * l**2))
        np.testing.assert_allclose(robot.gravity(q), m * g * l * np.sin(q), atol=1e-13)
        np.testing.assert_allclose(robot.inverse(q, v, a), m * l**2 * a + m * g * l * np.sin(q), atol=1e-12)
        np.testing.assert_allclose(robot.com(q)[:, 0], l * np.sin(q[:, 0]), atol=1e-14)
        np.testing.assert_allclose(robot.P_velocity(q, v)[:, :2],
                                   l * v * np.hstack([np.cos(q), np.sin(q)]), atol=1e-13)
        robot.set(l=3)
        self.assertAlmostEqual(robot.mass([0.4])[0, 0], 18)
        self.assertAlmostEqual(robot.rhs(0.0, [0.4, 0.1])[1], -g / 3 * math.sin(0.4), places=13)
        with self.assertRaisesRegex(AttributeError, "there is no function 'masss'"):
            robot.masss

    def test_an_arm_from_urdf_over_arrays_of_any_shape(self):
        arm = alembert.Scene.from_robot(os.path.join(TESTS, "robots/arm6.urdf"), drives=True)
        self.assertEqual(arm.imported.bodies, 6)
        robot = arm.robot(("inverse", "mass", "bias"), frames=["tip"])
        q, v, a = np.random.default_rng(3).normal(size=(3, 5, 7, 6))
        M, h = robot.mass(q), robot.bias(q, v)
        self.assertEqual(M.shape, (5, 7, 6, 6))
        np.testing.assert_allclose(robot.inverse(q, v, a), (M @ a[..., None])[..., 0] + h, rtol=1e-11, atol=1e-11)
        np.testing.assert_allclose(robot.tip_velocity(q, v), (robot.tip_jacobian(q) @ v[..., None])[..., 0],
                                   rtol=1e-11, atol=1e-11)
        # One state is evaluated by other code than eight side by side; leading axes are broadcast.
        np.testing.assert_allclose(robot.mass(q[2, 3]), M[2, 3], rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(robot.bias(q[2, 3], v), robot.bias(np.broadcast_to(q[2, 3], v.shape), v))
        # The velocity of the frame is the difference of its place.
        small = 1e-6
        ahead, behind = (robot.tip_pose(q + s * small * v)[..., 3] for s in (1, -1))
        np.testing.assert_allclose((ahead - behind) / (2 * small), robot.tip_velocity(q, v)[..., :3], atol=1e-7)


class CasadiFunctions(unittest.TestCase):
    """The compiled file, called through the interface that CasADi's `external` uses."""

    @classmethod
    def setUpClass(cls):
        scene = alembert.Scene(PENDULUM, name="swing.toml")
        cls.driven = alembert.Scene({**PENDULUM, "forces": {"theta": "sin(3*t)"}}, name="driven.toml")
        cls.system = scene.system()
        cls.folder = tempfile.TemporaryDirectory()
        scene.emit(cls.folder.name, language="c", casadi=True, functions=["com_jacobian"])
        cls.driven.emit(cls.folder.name, language="c", casadi=True)
        library = os.path.join(cls.folder.name, "both.so")
        objects = []
        for name in ("swing", "swing_casadi", "driven", "driven_casadi"):
            objects.append(os.path.join(cls.folder.name, f"{name}.o"))
            subprocess.run(["cc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O1", "-fPIC", "-c",
                            os.path.join(cls.folder.name, f"{name}.c"), "-o", objects[-1]], check=True)  # yapf: disable
        subprocess.run(["cc", "-shared", *objects, "-lm", "-o", library], check=True)
        cls.library = ctypes.CDLL(library)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def shape(self, name, which, k):
        """The size of a matrix, whose pattern must be that of a dense one in compressed columns."""
        pattern = getattr(self.library, f"{name}_sparsity_{which}")
        pattern.restype = ctypes.POINTER(ctypes.c_longlong)
        numbers = pattern(ctypes.c_longlong(k))
        rows, columns = numbers[0], numbers[1]
        self.assertEqual(numbers[2:3 + columns], [rows * one for one in range(columns + 1)])
        self.assertEqual(numbers[3 + columns:3 + columns + rows * columns], list(range(rows)) * columns)
        return rows, columns

    def evaluated(self, name, *arguments):
        count = [getattr(self.library, f"{name}_n_{which}") for which in ("in", "out")]
        for one in count:
            one.restype = ctypes.c_longlong
        self.assertEqual(count[0](), len(arguments))
        sizes = (ctypes.c_longlong * 4)()
        places = [ctypes.byref(sizes, 8 * k) for k in range(4)]
        self.assertEqual(getattr(self.library, f"{name}_work")(*places), 0)
        self.assertEqual(list(sizes), [count[0](), count[1](), 0, 0])
        ins = []
        for k, value in enumerate(arguments):
            value = np.asfortranarray(value, dtype=float)
            self.assertEqual(value.size, math.prod(self.shape(name, "in", k)))
            ins.append(value)
        outs = [np.zeros(self.shape(name, "out", k), order="F") for k in range(count[1]())]
        pointer = ctypes.POINTER(ctypes.c_double)
        pointers = [(pointer * len(list_))(*(one.ctypes.data_as(pointer) for one in list_)) for list_ in (ins, outs)]
        self.assertEqual(getattr(self.library, name)(*pointers, None, None, 0), 0)
        return outs

    def test_values_and_names(self):
        y, p = [0.4, 0.1], [2.0, 1.5, 9.81]
        (rate,) = self.evaluated("casadi_swing_rhs", 0, y, p)
        np.testing.assert_array_equal(rate[:, 0], self.system.rhs(0.0, y))
        (jacobian,) = self.evaluated("casadi_swing_com_jacobian", 0, y, [0], p)
        np.testing.assert_allclose(jacobian[:, 0], [1.5 * math.cos(0.4), 1.5 * math.sin(0.4), 0], atol=1e-15)
        self.library.casadi_swing_rhs_name_in.restype = ctypes.c_char_p
        self.assertEqual([self.library.casadi_swing_rhs_name_in(ctypes.c_longlong(k)) for k in range(4)],
                         [b"t", b"x", b"p", None])

    def test_directional_derivatives_and_their_adjoints(self):
        y, p, dy, dp = np.array([0.4, 0.1]), np.array([2.0, 1.5, 9.81]), np.array([0.3, -0.7]), np.array([0.2, 0.1, -0.5])
        rate = self.system.rhs(0.0, y)
        (along,) = self.evaluated("fwd1_casadi_swing_rhs", 0, y, p, rate, 0, dy, dp)
        by_length, by_gravity = 9.81 / 1.5**2 * math.sin(0.4), -math.sin(0.4) / 1.5
        np.testing.assert_allclose(
            along[:, 0], self.system.jacobian(0.0, y) @ dy + [0, by_length * dp[1] + by_gravity * dp[2]], rtol=1e-13)
        seed = np.array([0.9, 1.7])
        by_t, by_y, by_p = self.evaluated("adj1_casadi_swing_rhs", 0, y, p, rate, seed)
        self.assertEqual(by_t[0, 0], 0)
        self.assertAlmostEqual(by_y[:, 0] @ dy + by_p[:, 0] @ dp, along[:, 0] @ seed, places=13)

    def test_derivatives_by_time(self):
        y, p, rate, t = np.array([0.4, 0.1]), np.array([2.0, 1.5, 9.81]), np.zeros(2), 0.7
        by_t = 3 * math.cos(3 * t) / (2 * 1.5**2)
        (along,) = self.evaluated("fwd1_casadi_driven_rhs", t, y, p, rate, 0.5, [0, 0], [0, 0, 0])
        np.testing.assert_allclose(along[:, 0], [0, 0.5 * by_t], atol=1e-9)
        back, _, _ = self.evaluated("adj1_casadi_driven_rhs", t, y, p, rate, [0.3, 2])
        self.assertAlmostEqual(back[0, 0], 2 * by_t, places=9)
