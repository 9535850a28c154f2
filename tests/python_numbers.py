# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of what the Python package gives as arrays: motions, sweeps, systems, robots, functions for CasADi."""

import copy
import ctypes
import importlib.util
import math
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import alembert
from python_shared import NO_SKIP, PENDULUM, TESTS, program, scene_file

__all__ = ["CasadiFunctions", "Copies", "Motions", "NamesOfTheScene", "Robots", "Systems", "Threads"]


def read(path):
    with open(path, "rb") as file:
        return file.read()


def copied(value):
    return pickle.loads(pickle.dumps(value))


class Copies(unittest.TestCase):
    def test_a_motion_goes_to_another_process_and_back(self):
        scene = alembert.Scene(scene_file("textbook/bouncing_ball.toml"))
        run = scene.simulate(duration=2.5, sample=0.5, poincare="y = 0.2")
        for same in (copied(run), copy.copy(run), copy.deepcopy(run)):
            self.assertEqual(same.json, run.json)
            self.assertEqual(same.columns, run.columns)
            np.testing.assert_array_equal(same.table, run.table)
            self.assertEqual(repr(same), repr(run))
            with self.assertRaises(ValueError):
                same.table[0, 0] = 1
            times = np.linspace(0, run.t[-1], 20)
            np.testing.assert_array_equal(same(times), run(times))
            self.assertEqual(same.plot("y").svg, run.plot("y").svg)
        self.assertEqual(copied(scene).text, scene.text)

    def test_systems_keep_their_parameters(self):
        scene = alembert.Scene(PENDULUM)
        f = scene.system()
        f.set(l=0.7)
        y = [0.3, 0.2]
        for same in (copied(f), copy.deepcopy(f)):
            self.assertEqual(same.parameters, f.parameters)
            np.testing.assert_array_equal(same.rhs(0.0, y), f.rhs(0.0, y))
            same.set(l=3)
            self.assertEqual(f.parameters["l"], 0.7)
            self.assertAlmostEqual(same.rhs(0.0, y)[1], -9.81 / 3 * math.sin(0.3), places=14)
        self.assertEqual(copied(f.rhs)(0.0, y)[1], f.rhs(0.0, y)[1])
        arm = alembert.Scene.from_robot(os.path.join(TESTS, "robots/arm6.urdf"))
        robot = arm.robot(("mass", "gravity"))
        q = np.linspace(0, 1, 6)
        np.testing.assert_array_equal(copied(robot).mass(q), robot.mass(q))
        np.testing.assert_array_equal(copied(robot.gravity)(q), robot.gravity(q))
        self.assertEqual(copied(arm).imported.json, arm.imported.json)

    def test_results_derivations_figures_and_errors_are_copied(self):
        scene = alembert.Scene(PENDULUM)
        for value in (scene.check("theta'' + g/l*sin(theta) = 0"), scene.agree(), scene.eval(), scene.derive()):
            same = copied(value)
            self.assertEqual((same.json, repr(same)), (value.json, repr(value)))
        self.assertEqual(copied(scene.draw()).svg, scene.draw().svg)
        swept = scene.sweep({"theta": [0.1, 0.2]}, duration=0.5)
        np.testing.assert_array_equal(copied(swept)["theta"], swept["theta"])
        with self.assertRaises(alembert.SceneError) as caught:
            alembert.Scene(text="[coordinates]\nx = true\n").derive()
        same = copied(caught.exception)
        self.assertEqual((str(same), same.diagnostics), (str(caught.exception), caught.exception.diagnostics))


class Threads(unittest.TestCase):
    def test_other_threads_go_on_during_a_call(self):
        """A thread asks for the interpreter once in 1000 s and gives it up at each turn of its loop. It can count while
        the main thread is in a call only if the call gives up the interpreter."""
        scene = alembert.Scene(scene_file("textbook/double_pendulum.toml"))
        calls = {
            "simulate": lambda: scene.simulate(duration=2000),
            "sweep": lambda: scene.sweep({"theta1": np.linspace(0, 1, 4000)}, duration=10),
            "agree": scene.agree,
            "derive": scene.derive,
            "check": scene.check,
        }
        count, over = [0], []

        def count_on():
            while not over:
                count[0] += 1
                time.sleep(0)

        counting = threading.Thread(target=count_on)
        interval = sys.getswitchinterval()
        try:
            sys.setswitchinterval(1000)
            counting.start()
            for name, call in calls.items():
                for _ in range(50):
                    before = count[0]
                    call()
                    if count[0] > before:
                        break
                else:
                    self.fail(f"during {name} no other thread runs")
        finally:
            over.append(True)
            sys.setswitchinterval(interval)
            counting.join()

    def test_threads_that_ask_at_the_same_time_get_what_one_gets(self):
        scenes = [alembert.Scene(scene_file(f"textbook/{name}.toml"))
                  for name in ("double_pendulum", "slider_crank", "coin", "rotating_hoop")]

        def ask(scene):
            run = scene.simulate(duration=0.5)
            return [scene.derive().json["equations"], scene.eval().json, run.final, run(0.25).tolist(),
                    scene.check().verdicts]

        alone = [ask(scene) for scene in scenes]
        found = [[None] * 3 for _ in scenes]

        def ask_again(which, turn):
            found[which][turn] = ask(scenes[which])

        threads = [threading.Thread(target=ask_again, args=(which, turn))
                   for turn in range(3) for which in range(len(scenes))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for one, others in zip(alone, found):
            self.assertEqual(others, [one] * 3)

    def test_a_signal_ends_a_call(self):
        class Stopped(Exception):
            pass

        def stop(_number, _frame):
            raise Stopped

        scene = alembert.Scene(scene_file("textbook/double_pendulum.toml"))
        former = signal.signal(signal.SIGUSR1, stop)
        try:
            for call in (lambda: scene.simulate(duration=1e7, budget=10**12),
                         lambda: scene.sweep({"theta1": np.linspace(0, 1, 10**5)}, duration=200)):
                timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGUSR1))
                timer.start()
                with self.assertRaises(Stopped):
                    call()
                timer.join()
        finally:
            signal.signal(signal.SIGUSR1, former)


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
                if not NO_SKIP and importlib.util.find_spec("h5py") is None:
                    self.skipTest("h5py is missing")
                import h5py

                with h5py.File(os.path.join(folder, "run.h5"), "r") as stored:
                    np.testing.assert_array_equal(stored["theta1"][()], run["theta1"])

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

    def test_a_sweep_is_that_of_the_program(self):
        scene = alembert.Scene(PENDULUM)
        values = {"l": [1.0, 1.5, 2.0], "theta": [0.25, 0.5]}
        with tempfile.TemporaryDirectory() as folder:
            file, told, table = (os.path.join(folder, name) for name in ("scene.toml", "told.csv", "table.csv"))
            with open(file, "w", encoding="utf-8") as out:
                out.write(scene.text)
            vary = ("--vary", "l=1:2:3", "--vary", "theta=0.25:0.5:2", "--duration", "1")
            program("sweep", file, *vary, "--along", "min,max", "-o", told)
            swept = scene.sweep(values, duration=1, along=["min", "max"], path=table)
            self.assertEqual(read(table), read(told))
            self.assertEqual((swept.members, swept.failed, swept.file), (6, 0, table))
            self.assertRaisesRegex(KeyError, "table.csv", lambda: swept["theta"])
            self.assertEqual(sorted(os.listdir(folder)), ["scene.toml", "table.csv", "told.csv"])
            rows = scene.sweep(values, duration=1, along="min,max")
            with open(told, encoding="utf-8") as stored:
                lines = [line.split(",") for line in stored.read().splitlines()]
            for name in ("min_theta", "max_theta'"):
                np.testing.assert_array_equal(rows[name].ravel(), [float(line[lines[0].index(name)]) for line in lines[1:]])

            told = program("sweep", file, *vary, "--reduce", "min,mean,median,0.9")["reduced"]
            reduced = scene.sweep(values, duration=1, reduce=["min", "mean", "median", 0.9])
            self.assertEqual(reduced.reduced, told)
            self.assertEqual(reduced.statistics["final_theta"]["q0.9"], told[1]["q0.9"])
            rows = scene.sweep(values, duration=1)  # with extremes along motions it is another method
            self.assertEqual(rows["final_theta"].min(), reduced.statistics["final_theta"]["min"])
            self.assertRaises(AttributeError, lambda: rows.statistics)
            self.assertRaises(KeyError, lambda: reduced["theta"])

            samples = ("--samples", "20", "--sampling", "latin", "--seed", "5")
            told = program("sweep", file, "--vary", "l=1:2", "--vary", "theta=0.25:0.5", "--duration", "1", *samples)
            swept = scene.sweep({"l": (1, 2), "theta": (0.25, 0.5)}, duration=1, samples=20, sampling="latin", seed=5)
            np.testing.assert_array_equal(swept["final_theta"], [row["final"]["coordinates"]["theta"] for row in told["rows"]])
            self.assertEqual((swept.samples, swept.sampling, swept.seed), (20, "latin", 5))

        for wrong, kind, words in (({"resume": True}, ValueError, "needs path"),
                                   ({"reduce": "most"}, alembert.ModelError, "'most' is no statistic"),
                                   ({"along": ["last"]}, alembert.ModelError, "expected min, max or mean"),
                                   ({"path": "x.png"}, alembert.ModelError, "x.png"),
                                   ({"samples": 4}, ValueError, "without a count|expected .name, from, to")):
            with self.assertRaisesRegex(kind, words):
                scene.sweep({"l": [1.0, 1.5, 2.0, 2.5]}, duration=1, **wrong)
        for wrong, kind, words in (({"samples": 0}, ValueError, "samples=0"), ({"seed": -1}, ValueError, "seed=-1"),
                                   ({"sampling": "dice"}, alembert.ModelError, "'dice' is no way to sample")):
            with self.assertRaisesRegex(kind, words):
                scene.sweep({"l": (1, 2)}, duration=1, **{"samples": 4, **wrong})

    def test_a_sweep_goes_on_after_an_interruption(self):
        class Stopped(Exception):
            pass

        def stop(_number, _frame):
            raise Stopped

        def stop_when_something_is_done():
            while not os.path.exists(kept) or os.path.getsize(kept) < 100:
                time.sleep(0.002)
            os.kill(os.getpid(), signal.SIGUSR1)

        scene = alembert.Scene(PENDULUM)
        with tempfile.TemporaryDirectory() as folder:
            quiet, table = os.path.join(folder, "quiet.csv"), os.path.join(folder, "table.csv")
            kept = table + ".unfinished"
            wishes = {"values": {"theta": np.linspace(0.1, 2, 800)}, "duration": 1500, "tolerance": 1e-12}
            scene.sweep(**wishes, path=quiet)
            former = signal.signal(signal.SIGUSR1, stop)
            stopping = threading.Thread(target=stop_when_something_is_done)
            try:
                stopping.start()
                with self.assertWarnsRegex(alembert.SceneWarning, "resume=True"), self.assertRaises(Stopped):
                    scene.sweep(**wishes, path=table)
                stopping.join()
            finally:
                signal.signal(signal.SIGUSR1, former)
            self.assertTrue(os.path.exists(kept))
            self.assertFalse(os.path.exists(table))
            with self.assertRaisesRegex(alembert.ModelError, "belongs to another sweep"):
                scene.sweep({"theta": [0.1]}, path=table, resume=True)
            swept = scene.sweep(**wishes, path=table, resume=True)
            self.assertGreater(swept.resumed, 0)
            self.assertEqual(read(table), read(quiet))
            self.assertFalse(os.path.exists(kept))

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

    def test_states_may_be_columns(self):
        f = self.system
        states = np.random.default_rng(2).normal(size=(2, 37))
        np.testing.assert_array_equal(f.rhs_of_columns(0.0, states), f.rhs(0.0, states.T).T)
        np.testing.assert_array_equal(f.rhs_of_columns(0.0, states[:, 3]), f.rhs(0.0, states[:, 3]))
        try:
            from scipy.integrate import solve_ivp
        except ImportError:
            self.skipTest("SciPy is missing")
        ours = alembert.Scene(PENDULUM).simulate(duration=2, tolerance=1e-12)
        for method in ("Radau", "BDF"):
            theirs = solve_ivp(f.rhs_of_columns, (0, 2), [0.4, 0.1], method=method, vectorized=True, rtol=1e-9, atol=1e-11)
            self.assertAlmostEqual(theirs.y[0, -1], ours["theta"][-1], places=6)

    def test_matrices_along_a_motion(self):
        near = alembert.Scene(PENDULUM).linearize(along=True, duration=1, sample=0.25)
        self.assertEqual([row["time"] for row in near.along], [0, 0.25, 0.5, 0.75, 1])
        for row in near.along:
            np.testing.assert_allclose(row["A"], self.system.jacobian(0.0, row["x"]), rtol=1e-12)
            np.testing.assert_allclose(row["c"], self.system.rhs(0.0, row["x"]), rtol=1e-12)
        with self.assertRaisesRegex(ValueError, "sample=nan: expected a finite number"):
            alembert.Scene(PENDULUM).linearize(along=True, sample=math.nan)

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
        robot = arm.robot(("inverse", "mass", "bias", "coriolis"), frames=["tip"])
        q, v, a = np.random.default_rng(3).normal(size=(3, 5, 7, 6))
        M, h = robot.mass(q), robot.bias(q, v)
        C, change = robot.coriolis(q, v), (robot.mass(q + 1e-5 * v) - robot.mass(q - 1e-5 * v)) / 2e-5
        skew = change - 2 * C
        np.testing.assert_allclose(skew, -np.swapaxes(skew, -1, -2), atol=1e-7)
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

    def test_derivatives_of_the_adjoint_are_those_that_hessians_need(self):
        for name, t, accuracy in (("swing", 0.0, 1e-9), ("driven", 0.7, 2e-8)):
            y, p, seed = np.array([0.4, 0.1]), np.array([2.0, 1.5, 9.81]), np.array([0.9, 1.7])
            dt, dy, dp, dseed = 0.5, np.array([0.3, -0.7]), np.array([0.2, 0.1, -0.5]), np.array([0.4, -1.1])
            none = np.zeros(2)
            adjoint = lambda s: self.evaluated(f"adj1_casadi_{name}_rhs", t + s * dt, y + s * dy, p + s * dp, none,
                                               seed + s * dseed)
            h = 1e-3  # of order 4, as what they give by time is
            expected = [(8 * (a - b) - (c - d)) / (12 * h)
                        for a, b, c, d in zip(*(adjoint(s * h) for s in (1, -1, 2, -2)))]
            found = self.evaluated(f"fwd1_adj1_casadi_{name}_rhs", t, y, p, none, seed, 0, none, np.zeros(3),
                                   dt, dy, dp, none, dseed)
            for one, other in zip(found, expected):
                np.testing.assert_allclose(one, other, atol=accuracy)

class NamesOfTheScene(unittest.TestCase):
    """A system's parameters are called as the scene calls them, not as the emitted C++ does."""

    def pendulum(self, length):
        return alembert.Scene(text=f"""gravity = [0, "-g"]
[parameters]
g = 9.81
"{length}" = 1.0
[coordinates]
theta = 0.5
[[particle]]
name = "b"
mass = 1
position = ["{length}*sin(theta)", "-{length}*cos(theta)"]
""")

    def test_parameters_have_the_names_of_the_scene(self):
        for name in ("l", "lambda", "int", "\u03bc", "rows", "class"):
            with self.subTest(name=name):
                system = self.pendulum(name).system()
                self.assertEqual(list(system.parameters), ["g", name])
                system.set({name: 2.0})
                self.assertAlmostEqual(system.rhs(0, [0.5, 0])[1], -9.81 / 2 * math.sin(0.5), places=14)
                system.set(**{name: 4.0})
                self.assertEqual(system.parameters[name], 4.0)
        with self.assertRaisesRegex(KeyError, "no parameter 'q'; there are g, l"):
            self.pendulum("l").system().set(q=1)

    def test_a_copied_system_has_parameters_of_its_own(self):
        system = self.pendulum("l").system()
        for same in (copy.copy(system), copy.deepcopy(system)):
            same.set(l=2.0)
            self.assertEqual((system.parameters["l"], same.parameters["l"]), (1.0, 2.0))
            self.assertAlmostEqual(same.rhs(0, [0.5, 0])[1], system.rhs(0, [0.5, 0])[1] / 2, places=14)
        robot = self.pendulum("l").robot(("mass",))
        same = copy.copy(robot)
        same.set(l=2.0)
        self.assertEqual((robot.mass([0.5])[0, 0], same.mass([0.5])[0, 0]), (1.0, 4.0))

    def test_contacts_that_are_left_out_are_told(self):
        ball = alembert.Scene(scene_file("textbook/bouncing_ball.toml"))
        with self.assertWarnsRegex(alembert.SceneWarning, "contacts, dry friction"):
            ball.system()

    def test_a_run_that_breaks_off_warns(self):
        scene = alembert.Scene(text='[coordinates]\nx = 1\n[energy]\nkinetic = "x\'^2/2"\npotential = "-x^4"')
        with self.assertWarnsRegex(alembert.SceneWarning, "broke off"):
            self.assertIsNotNone(scene.simulate(100).failure)
