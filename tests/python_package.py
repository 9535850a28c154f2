# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of the Python package: python3 python_package.py PROGRAM, with the package on PYTHONPATH (exit 77 without NumPy)."""

import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
import warnings

try:
    import numpy as np
except ImportError:
    print("NumPy is missing: the Python package is not tested")
    sys.exit(77)

import alembert

PROGRAM = os.path.abspath(sys.argv.pop(1))
SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../scenes")

PENDULUM = {
    "gravity": [0, "-g"],
    "parameters": {"m": 2.0, "l": 1.5, "g": 9.81},
    "coordinates": {"theta": {"initial": 0.4, "rate": 0.1}},
    "particle": [{"name": "P", "mass": "m", "position": ["l*sin(theta)", "-l*cos(theta)"]}],
}


def scene_file(name):
    return os.path.join(SCENES, name)


def program(*arguments):
    return json.loads(subprocess.run([PROGRAM, *arguments, "--json"], capture_output=True, text=True).stdout)


class Verbs(unittest.TestCase):
    def test_the_equation_of_a_pendulum_from_a_dictionary(self):
        (equation,) = alembert.Scene(PENDULUM).derive().equations
        self.assertTrue(alembert.Scene(PENDULUM).check(equation.text))
        self.assertTrue(alembert.Scene(PENDULUM).check("theta'' + g/l*sin(theta) = 0"))
        self.assertEqual(alembert.Scene(PENDULUM).check("theta'' - g/l*sin(theta) = 0").verdicts, ["refuted"])

    def test_verbs_give_the_json_of_the_program(self):
        file = scene_file("textbook/double_pendulum.toml")
        scene = alembert.Scene(file)
        self.assertEqual(scene.derive(by="kane").json, program("derive", file, "--by", "kane"))
        self.assertEqual(scene.check().json["claims"], program("check", file)["claims"])
        self.assertEqual(scene.audit().json, program("audit", file))
        at = {"theta1": 0.3, "theta2'": 1.0}
        self.assertEqual(scene.eval(at).json, program("eval", file, "--at", "theta1=0.3", "theta2'=1"))
        self.assertEqual(scene.agree().verdict, "proved")
        still = scene.linearize({"theta1": 0, "theta2": 0, "theta1'": 0, "theta2'": 0, "t": 0})
        self.assertEqual(len(still.eigenvalues), 4)

    def test_stability_equilibria_kinematics_and_inertia(self):
        file = scene_file("textbook/rotating_hoop.toml")
        scene = alembert.Scene(file)
        self.assertEqual(scene.stability({"theta": 0}).json, program("stability", file, "--at", "theta=0"))
        self.assertEqual(scene.equilibrium(starts=30).json, program("equilibrium", file, "--starts", "30"))
        pendulum = alembert.Scene(PENDULUM)
        velocity = pendulum.kinematics(["P"]).points["P"]["values"]["velocity"]
        np.testing.assert_allclose(velocity, [0.15 * math.cos(0.4), 0.15 * math.sin(0.4), 0])
        bodies = scene_file("textbook/gyrocompass.toml")
        self.assertEqual(alembert.Scene(bodies).inertia(["rotor"]).json, program("inertia", bodies, "--of", "rotor"))

    def test_functional_mock_up_unit(self):
        file = scene_file("textbook/cart_pole.toml")
        with tempfile.TemporaryDirectory() as folder:
            ours, theirs = os.path.join(folder, "a.fmu"), os.path.join(folder, "b.fmu")
            unit = alembert.Scene(file).fmu(ours, fmi=3)
            said = program("fmu", file, "-o", theirs, "--fmi", "3")
            self.assertEqual({**unit.json, "file": theirs}, said)
            with open(ours, "rb") as one, open(theirs, "rb") as other:
                self.assertEqual(one.read(), other.read())
        with self.assertRaises(ValueError):
            alembert.Scene(file).fmu("none.fmu", fmi=1)

    def test_formulas_for_notebooks(self):
        derivation = alembert.Scene(PENDULUM).derive()
        self.assertIn("\\theta", derivation._repr_latex_())
        self.assertIn("<math", derivation._repr_html_())

    def test_errors_are_exceptions_with_their_place(self):
        with self.assertRaises(alembert.SceneError) as caught:
            alembert.Scene(text='[coordinates]\nx = "a"\n', name="wrong.toml").derive()
        self.assertIn("wrong.toml:2:", str(caught.exception))
        self.assertEqual(caught.exception.diagnostics[0][0], 2)
        with self.assertRaises(alembert.ModelError):
            alembert.Scene(PENDULUM).derive(by="nonsense")

    def test_warnings_are_warnings(self):
        wrong = {**PENDULUM, "body": [{"name": "B", "mass": 1, "position": [0, 0, 0], "frame": "F",
                                       "inertia": [1, 1, 3]}],
                 "frame": [{"name": "F", "rotate": [["x", "theta"]]}]}
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            alembert.Scene(wrong).derive()
        self.assertTrue(any(issubclass(one.category, alembert.SceneWarning) for one in said))


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


class Expressions(unittest.TestCase):
    def setUp(self):
        try:
            import sympy
        except ImportError:
            self.skipTest("SymPy is missing")
        self.sympy = sympy

    def test_an_equation_goes_there_and_back(self):
        scene = alembert.Scene(scene_file("textbook/double_pendulum.toml"))
        for equation in scene.derive().equations:
            self.assertTrue(scene.check(alembert.from_sympy(equation.sympy())))

    def test_sympy_derives_the_same_pendulum(self):
        sympy = self.sympy
        t, m, l, g = sympy.symbols("t m l g")
        theta = sympy.Function("theta")(t)
        L = m * l**2 * theta.diff(t)**2 / 2 + m * g * l * sympy.cos(theta)
        left = L.diff(theta.diff(t)).diff(t) - L.diff(theta)
        self.assertTrue(alembert.Scene(PENDULUM).check(alembert.from_sympy(sympy.Eq(left, 0))))

    def test_the_formalism_of_the_guide_is_proved(self):
        def block(page, language, which):
            with open(os.path.join(SCENES, "../docs", page), encoding="utf-8") as file:
                return file.read().split(f"```{language}\n")[which].split("```")[0]

        scene = block("scene-language.md", "toml", 1)
        force = re.search(r"\[\[force\]\]\n(.+\n)+", scene).group()
        code = block("guide.md", "python", -1).replace('Scene("cart.toml")', "Scene(text=cart)")
        names = {"cart": scene.replace(force, "")}
        exec(code, names)
        self.assertEqual(names["scene"].check(names["claims"]).verdicts, ["proved", "proved"])

    def test_powers_bind_as_in_the_scene_language(self):
        sympy = self.sympy
        x = sympy.Symbol("x")
        self.assertEqual(alembert.to_sympy("-x^2"), -x**2)
        self.assertEqual(alembert.to_sympy("2^3^2"), 512)
        self.assertEqual(alembert.to_sympy("x^-2"), x**-2)
        self.assertEqual(alembert.to_sympy("0.1"), sympy.Rational(1, 10))
        for wrong in ("2x", "sin x", "(x", "", "x = "):
            with self.assertRaises(ValueError):
                alembert.to_sympy(wrong)


unittest.main(argv=sys.argv)
