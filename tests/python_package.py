# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of the Python package: python3 python_package.py PROGRAM, with the package on PYTHONPATH (exit 77 without NumPy).

Here are verbs, errors and expressions; python_numbers.py has what gives arrays, python_arrays.py arrays of every kind,
python_examples.py the examples and notebooks, python_every_day.py threads, forks, units and Ctrl-C."""

import ast
import glob
import inspect
import math
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import unittest
import warnings
import zipfile

sys.dont_write_bytecode = True
try:
    import numpy as np
except ImportError:
    print("NumPy is missing: the Python package is not tested")
    sys.exit(int(os.environ.get("ALEMBERT_NO_SKIP", 77)))  # a failure where test.sh has installed it

import alembert

from python_shared import NO_SKIP, PENDULUM, PROGRAM, SCENES, TESTS, program, scene_file
from python_arrays import *  # noqa: F403 (unittest finds the tests of all files here)
from python_numbers import *  # noqa: F403
from python_examples import *  # noqa: F403
from python_every_day import *  # noqa: F403


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
        with self.assertRaisesRegex(alembert.ModelError, "call it NAME.fmu"):
            alembert.Scene(file).fmu("none.zip")
        with self.assertRaisesRegex(alembert.ModelError, "expected a name that ends in .svg"):
            alembert.Scene(file).draw().save("none.png")

    def test_branches_charts_loci_and_exponents_have_pictures(self):
        hoop = alembert.Scene(scene_file("textbook/rotating_hoop.toml"))
        found = hoop.branches(("Omega", 2, 6))
        self.assertEqual(found.json, program("equilibrium", hoop.name, "--follow", "Omega=2:6"))
        self.assertIn("<svg", found.figure.svg)
        self.assertIn("Omega", found.csv.splitlines()[0])
        still = {"theta": 0, "theta'": 0}
        locus = hoop.root_locus(("Omega", 1, 5, 20), at=still)
        self.assertIn("<svg", locus.figure.svg)
        chart = hoop.stability_chart(("Omega", 1, 5, 6), ("R", 0.1, 1, 5), at=still)
        self.assertIn("<svg", chart.figure.svg)
        (largest,) = alembert.Scene(PENDULUM).exponents(1, duration=50).exponents
        self.assertLess(abs(largest), 0.2)

    def test_identify_emit_draw_and_report(self):
        file = scene_file("textbook/double_pendulum.toml")
        scene = alembert.Scene(file)
        self.assertEqual(scene.identify().json, program("identify", file))
        with tempfile.TemporaryDirectory() as folder:
            emitted = scene.emit(folder, language="c", jacobian=True)
            self.assertEqual(sorted(os.listdir(folder)), ["double_pendulum.c", "double_pendulum.h"])
            with open(emitted.files[0], encoding="utf-8") as written:
                self.assertEqual(written.read(), emitted.sources["double_pendulum.c"])
            page = os.path.join(folder, "page.html")
            alembert.Scene(PENDULUM).report(page, motion=False)
            with open(page, encoding="utf-8") as written:
                self.assertIn("<math", written.read())
        self.assertIn("<svg", scene.draw()._repr_svg_())
        written = [next(iter(scene.emit(language=one).sources)) for one in ("js", "python", "julia", "matlab", "rust", "modelica")]
        self.assertEqual(written, ["double_pendulum." + ending for ending in ("mjs", "py", "jl", "m", "rs", "mo")])
        with self.assertRaisesRegex(ValueError, "'rust'"):
            scene.emit(language="fortran")
        lines = scene.emit().sources["double_pendulum.cpp"].splitlines()
        self.assertEqual([line for line in lines if line.startswith("#include <")], [])

    def test_results_print_what_the_program_prints(self):
        judged = alembert.Scene(scene_file("textbook/rotating_hoop.toml")).stability({"theta": 0})
        self.assertIn("unstable", repr(judged))
        self.assertIn("<pre>", judged._repr_html_())

    def test_values_may_be_expressions(self):
        at = alembert.Scene(PENDULUM).eval({"theta": "pi/2", "l": 3})
        self.assertAlmostEqual(at.accelerations["theta"], -9.81 / 3, places=14)
        with self.assertRaisesRegex(alembert.ModelError, "thetta"):
            alembert.Scene(PENDULUM).eval({"thetta": 1})

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

    def test_wrong_numbers_and_ranges_are_told(self):
        scene = alembert.Scene(PENDULUM)
        for wrong, words in (({"duration": -3}, "duration=-3: expected a number of zero or more"),
                             ({"tolerance": 0}, "tolerance=0: expected a number above zero"),
                             ({"budget": -1}, "budget=-1: expected a number above zero")):
            with self.assertRaisesRegex(ValueError, words):
                scene.simulate(**wrong)
        with self.assertRaisesRegex(ValueError, "expected .name, from, to."):
            scene.branches(("l", 1))
        with self.assertRaisesRegex(alembert.ModelError, "nope"):
            scene.sweep({"nope": [1, 2]})

    def test_the_stubs_have_the_names_and_arguments_of_the_package(self):
        with open(os.path.join(os.path.dirname(alembert.__file__), "__init__.pyi"), encoding="utf-8") as file:
            stubs = {one.name: one for one in ast.parse(file.read()).body if hasattr(one, "name")}
        stubs = {name: one for name, one in stubs.items() if not name.startswith("_")}  # of fields
        self.assertEqual(set(stubs), set(alembert.__all__))
        for name, stub in stubs.items():
            ours = getattr(alembert, name)
            self.assertTrue(ours.__doc__ or issubclass(ours, alembert.Error), name)
            for method in (one for one in getattr(stub, "body", ()) if isinstance(one, ast.FunctionDef)):
                said = [one.arg for one in (*method.args.args, *method.args.kwonlyargs) if one.arg not in ("self", "cls")]
                is_there = inspect.getattr_static(ours, method.name, None)
                takes_any = method.args.vararg or method.args.kwarg
                if not takes_any and inspect.isfunction(is_there) or isinstance(is_there, classmethod):
                    has = [p for p in inspect.signature(getattr(ours, method.name)).parameters if p != "self"]
                    self.assertEqual(has, said, f"{name}.{method.name}")
                    self.assertTrue(method.name.startswith("_") or is_there.__doc__ or is_there.__func__.__doc__)

    def test_methods_take_the_options_of_their_verbs(self):
        """Every option of the program is a keyword, unless Python has another form for it; and no keyword is another's."""
        ways = {"digits", "full", "output", "json", "json_file", "strict", "language", "help", "format", "svg", "show", "html", "modes"}
        others = {"derive": {"steps", "dimensions"},  # all steps are in .steps; Scene.draw is --svg
                  "check": {"complete", "letters", "scene_from", "formalisms"},  # Scene.mark, Scene.agree
                  "eval": {"kinematics", "inertia", "identify", "inverse", "impact"},  # methods of their own
                  "equilibrium": {"vary"},  # Scene.branches
                  "stability": {"vary", "exponents", "duration", "matrices"},  # stability_chart, root_locus, linearize …
                  "emit": {"frame", "wrench", "fmu"},  # frames=[…], wrenches=[…]
                  "fmu": {"fmu"},
                  "report": {"derivation", "watch", "open"},  # of the command line
                  "simulate": {"proof"},  # Scene.prove
                  "sweep": {"vary", "vary_from", "chunk"}}
        forms = {"check": {"claims"}, "emit": {"folder", "language", "frames", "wrenches"}, "fmu": {"path"},
                 "report": {"path"}, "simulate": {"sensitivity_rows"}, "sweep": {"values", "grid", "path"}}
        for verb in ("derive agree audit check eval equilibrium linearize stability kinematics inertia identify inverse "
                     "impact emit fmu simulate sweep bench report").split():
            page = subprocess.run([PROGRAM, "--language", "en", "--man", verb], capture_output=True, text=True, check=True)
            options = {re.sub(r"^no_", "", name.replace("\\-", "_")) for name in
                       re.findall(r"^\\fB(?:\\-\w\\fR, \\fB)?\\-\\-([a-z\\-]+)\\f",
                                  page.stdout.split(".SH OPTIONS WITH")[0], re.M)}
            self.assertIn("strict", options, verb)
            keywords = set(inspect.signature(getattr(alembert.Scene, verb)).parameters) - {"self"}
            self.assertEqual(options - ways - others.get(verb, set()), keywords - forms.get(verb, set()), verb)

    def test_the_fields_of_stubs_are_those_of_the_values(self):
        hoop = alembert.Scene(scene_file("textbook/rotating_hoop.toml"))
        coin = alembert.Scene(scene_file("textbook/coin.toml"))
        with open(os.path.join(os.path.dirname(alembert.__file__), "__init__.pyi"), encoding="utf-8") as file:
            text = file.read()
        stubs = {one.name: one for one in ast.parse(text).body if isinstance(one, ast.ClassDef)}
        fields = {name: {f.target.id: ast.unparse(f.annotation) for f in stub.body if isinstance(f, ast.AnnAssign)}
                  for name, stub in stubs.items()}
        shown = [hoop.check(["theta'' = 0", "0 = 0"]), hoop.agree(), coin.audit(), hoop.stability({"theta": 0}),
                 hoop.equilibrium()]
        self.assertEqual([type(one).__name__ for one in shown],
                         ["Checked", "Agreed", "Audited", "Stability", "Equilibria"])
        for one in shown:
            for name in fields[type(one).__name__]:
                self.assertIn(name, one.json)
        for value, always, more in ((shown[0].claims[0], "_ClaimAlways", "_Claim"),
                                    (shown[2].constraints[0], "_Constraint", "_Constraint"),
                                    (shown[4].equilibria[0], "_EquilibriumAlways", "_Equilibrium")):
            self.assertLessEqual(set(fields[always]), set(value))
            self.assertLessEqual(set(value), {**fields[always], **fields[more]}.keys())
        (verdict,) = re.findall(r"_Verdict = Literal\[(.*)\]", text)
        for said in shown[0].verdicts:
            self.assertIn(f'"{said}"', verdict)
        for one in (shown[1], shown[3]):
            self.assertIn(f"'{one.verdict}'", fields[type(one).__name__]["verdict"])
        self.assertNotIn("Any", " ".join(fields["Checked"].values()))

    def test_numbers_are_in_si_units_and_pictures_in_those_of_the_scene(self):
        scene = alembert.Scene({
            "coordinates": {"x": {"initial": 30, "unit": "mm"}, "phi": {"initial": 90, "unit": "deg"}, "s": 1},
            "energy": {"kinetic": "(x'^2 + phi'^2 + s'^2)/2"}, "simulation": {"duration": 1}})
        run = scene.simulate()
        self.assertEqual(run.units, {"x": "m", "phi": "rad"})
        self.assertAlmostEqual(run["x"][-1], 0.03, 15)
        self.assertAlmostEqual(run["phi"][-1], 1.5707963267948966, 14)
        self.assertIn("phi in deg", run.plot("phi").svg)

    def test_warnings_are_warnings(self):
        wrong = {**PENDULUM, "body": [{"name": "B", "mass": 1, "position": [0, 0, 0], "frame": "F",
                                       "inertia": [1, 1, 3]}],
                 "frame": [{"name": "F", "rotate": [["x", "theta"]]}]}
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            alembert.Scene(wrong).derive()
        self.assertTrue(any(issubclass(one.category, alembert.SceneWarning) for one in said))


def libraries_beside(site):
    """A wheel with all libraries has put them beside its package: so they are where another is made of this package."""
    libraries = os.path.join(os.path.dirname(os.path.dirname(alembert.__file__)), "alembert.libs")
    if os.path.isdir(libraries):
        shutil.copytree(libraries, os.path.join(site, "alembert.libs"))


class Wheel(unittest.TestCase):
    def test_a_wheel_works_without_the_sources_and_lists_all_its_files(self):
        sys.path.insert(0, os.path.join(TESTS, "../python"))
        import backend

        backend._build = lambda: os.path.dirname(alembert.__file__)
        code = ("import alembert, os; s = alembert.Scene({'coordinates': {'x': 1}, 'parameters': {'m': 2, 'k': 8}, "
                "'particle': [{'name': 'P', 'mass': 'm', 'position': ['x', 0]}], 'forces': {'x': '-k*x'}}); "
                "print(alembert.__file__, s.simulate(duration=0.5, estimate=False)(0.5)[0], s.system().rhs(0.0, [1, 0])[1])")
        with tempfile.TemporaryDirectory() as folder:
            wheel = backend.build_wheel(folder)
            site = os.path.join(folder, "site")
            with zipfile.ZipFile(os.path.join(folder, wheel)) as archive:
                archive.extractall(site)
                libraries_beside(site)
                names = archive.namelist()
                (info,) = {name.split("/")[0] for name in names} - {"alembert"}
                record = [line.split(",")[0] for line in archive.read(f"{info}/RECORD").decode().splitlines()]
                self.assertEqual(sorted(record), sorted(names))
                metadata = backend.prepare_metadata_for_build_wheel(os.path.join(folder, "metadata"))
                with open(os.path.join(folder, "metadata", metadata, "METADATA"), encoding="utf-8") as file:
                    self.assertEqual(file.read(), archive.read(f"{info}/METADATA").decode())
            told = subprocess.run([sys.executable, "-B", "-c", code], cwd=folder, capture_output=True, text=True,
                                  env={**os.environ, "PYTHONPATH": site})  # yapf: disable
            self.assertEqual(told.returncode, 0, told.stderr)
            where, x, acceleration = told.stdout.split()
            self.assertTrue(where.startswith(site), told.stderr)
            self.assertAlmostEqual(float(x), math.cos(1), places=8)
            self.assertEqual(float(acceleration), -4)

    def test_a_project_with_the_wheel_is_installed_and_runs_its_own_tests(self):
        """examples/python_project in an environment of its own, from which nothing is downloaded."""
        sys.path.insert(0, os.path.join(TESTS, "../python"))
        import backend

        backend._build = lambda: os.path.dirname(alembert.__file__)
        try:
            import ensurepip  # noqa: F401
            import setuptools  # noqa: F401
        except ImportError as missing:
            if NO_SKIP:
                raise
            self.skipTest(str(missing))
        with tempfile.TemporaryDirectory() as folder:
            here = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

            def run(*words, **more):
                done = subprocess.run(words, cwd=folder, env=here, capture_output=True, text=True, **more)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                return done.stdout

            run(sys.executable, "-m", "venv", "--system-site-packages", "venv")
            programs = os.path.join(folder, "venv", "bin")
            here["PATH"] = programs + os.pathsep + here["PATH"]
            wheel = backend.build_wheel(folder)
            shutil.copytree(os.path.join(TESTS, "../examples/python_project"), os.path.join(folder, "project"))
            # NumPy and setuptools are this interpreter's, which may be that of a virtual environment itself.
            (site,) = glob.glob(os.path.join(folder, "venv", "lib", "python*", "site-packages"))
            with open(os.path.join(site, "others.pth"), "w", encoding="utf-8") as others:
                others.write("\n".join(sysconfig.get_path(kind) for kind in ("purelib", "platlib")) + "\n")
            run(os.path.join(programs, "pip"), "install", "--quiet", "--no-deps", "--no-index", "--no-build-isolation",
                "--ignore-installed", wheel, "./project")  # yapf: disable
            libraries_beside(site)
            self.assertEqual(run("alembert", "--version"), subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout)
            run(os.path.join(programs, "python"), "-m", "unittest", "discover", "project/tests")


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

    def test_functions_that_a_scene_leaves_open_go_there_and_back(self):
        for name in ("cam_with_follower", "central_field", "bead_on_any_curve"):
            scene = alembert.Scene(scene_file(f"functions/{name}.toml"))
            for equation in scene.derive().equations:
                self.assertTrue(scene.check(alembert.from_sympy(equation.sympy())).verdicts == ["proved"], equation.text)

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

    def test_what_the_scene_language_does_not_have_is_refused(self):
        sympy = self.sympy
        x, t = sympy.symbols("x t")
        none = (x > 1, x <= 1, sympy.Ne(x, 1), sympy.And(x > 1, t > 1), sympy.Piecewise((x, x > 0), (1, True)),
                sympy.true, sympy.Eq(x, x), sympy.I * x, sympy.oo, sympy.nan, sympy.zoo, sympy.gamma(x), sympy.sec(x),
                sympy.Integral(x, x), sympy.Matrix([x]), sympy.Symbol("a b"), sympy.Mod(x, 2), sympy.floor(x))
        for value in none:
            with self.assertRaises(ValueError, msg=str(value)):
                alembert.from_sympy(value)
        self.assertEqual(str(alembert.to_sympy("V + W", functions="V")), "W + V(t)")
        for text in ("asinh(x)", "log10(x)", "artanh(x) = 1", "cot(x)", "floor(x)"):
            with self.assertRaisesRegex(ValueError, "the scene language has no function '.*; "):
                alembert.to_sympy(text)
        with self.assertRaisesRegex(ValueError, "x > 1: an inequality cannot be written as an equation"):
            alembert.from_sympy(x > 1)
        self.assertEqual(alembert.from_sympy(sympy.Eq(x, x, evaluate=False)), "x = x")
        for value in (sympy.E * x, 0.1 * x, 1e-20 * x, sympy.Min(x, t), sympy.Abs(x)**sympy.Rational(1, 3), sympy.pi):
            there = alembert.to_sympy(alembert.from_sympy(value))
            self.assertEqual(float((there - value).subs({x: 1.7, t: 0.3})), 0)

    def test_powers_bind_as_in_the_scene_language(self):
        sympy = self.sympy
        x = sympy.Symbol("x")
        self.assertEqual(alembert.to_sympy("-x^2"), -x**2)
        self.assertEqual(alembert.to_sympy("2^3^2"), 512)
        self.assertEqual(alembert.to_sympy("x^-2"), x**-2)
        self.assertEqual(alembert.to_sympy("ln(x) + arcsin(x) + x²"), sympy.log(x) + sympy.asin(x) + x**2)
        self.assertEqual(alembert.to_sympy("0.1"), sympy.Rational(1, 10))
        for wrong in ("2x", "sin x", "(x", "", "x = "):
            with self.assertRaises(ValueError):
                alembert.to_sympy(wrong)


unittest.main(argv=sys.argv)
