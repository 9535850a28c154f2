# SPDX-License-Identifier: MIT
"""What users of the Python package meet every day: threads, forks, units, names, notebooks, and the command line."""

import copy
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np

import alembert

from python_shared import PENDULUM, PROGRAM, scene_file

#: A pendulum whose own unit is degrees.
DEGREES = {**PENDULUM, "coordinates": {"theta": {"initial": 30, "rate": 20, "unit": "deg"}}}




class EveryDay(unittest.TestCase):
    def test_a_call_has_one_set_of_parameters_whatever_other_threads_set(self):
        system = alembert.Scene(PENDULUM).system()
        states = np.tile([0.5, 0.0], (200_000, 1))
        ended = []

        def setting():
            while not ended:
                system.set(l=1.0)
                system.set(l=2.0)

        thread = threading.Thread(target=setting)
        thread.start()
        try:
            for _ in range(20):
                self.assertEqual(len(np.unique(system.rhs(0.0, states)[:, 1])), 1)
                self.assertEqual(len(np.unique(system.jacobian(0.0, states)[:, 1, 0])), 1)
                self.assertEqual(len(np.unique(system.energy(0.0, states)[:, 2])), 1)
        finally:
            ended.append(True)
            thread.join()

    def test_a_process_forked_while_a_verb_runs_is_told(self):
        """A child of which another thread had its turn does not hang."""
        code = """if True:
            import os, threading, time, warnings
            import alembert
            warnings.simplefilter("ignore")
            scene = alembert.Scene(os.environ["SCENE"])
            thread = threading.Thread(target=lambda: scene.simulate(1e9, budget=10**12, estimate=False), daemon=True)
            thread.start()
            time.sleep(1)
            child = os.fork()
            if child == 0:
                try:
                    scene.eval()
                except RuntimeError as told:
                    os._exit(0 if "was forked while another thread was in a verb" in str(told) else 1)
                os._exit(2)
            began = time.time()
            while time.time() < began + 20:
                done, status = os.waitpid(child, os.WNOHANG)
                if done:
                    os._exit(os.waitstatus_to_exitcode(status))
                time.sleep(0.05)
            os.kill(child, 9)
            os._exit(3)
        """
        done = subprocess.run([sys.executable, "-c", code], env={**os.environ, "SCENE": scene_file("textbook/double_pendulum.toml")},
                              timeout=120, check=False)
        self.assertEqual(done.returncode, 0)

    def test_a_process_forked_between_verbs_works(self):
        scene = alembert.Scene(PENDULUM)
        expected = scene.eval().accelerations["theta"]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", DeprecationWarning)
            child = os.fork()
        if child == 0:
            os._exit(0 if alembert.Scene(PENDULUM).eval().accelerations["theta"] == expected else 1)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)

    def test_states_of_results_are_set_again_in_their_own_units(self):
        scene = alembert.Scene(DEGREES)
        run = scene.simulate(1)
        end = {**run.final["coordinates"], **{f"{name}'": value for name, value in run.final["rates"].items()}}
        for state in (end, copy.deepcopy(end), pickle.loads(pickle.dumps(end))):
            at = scene.eval(state)
            self.assertAlmostEqual(at.coordinates["theta"], run.final["coordinates"]["theta"], places=13)
            self.assertAlmostEqual(at.rates["theta"], run.final["rates"]["theta"], places=13)
        self.assertAlmostEqual(scene.eval({"theta": 30}).coordinates["theta"], np.radians(30), places=15)
        self.assertEqual(type(2 * run.final["coordinates"]["theta"]), float)
        self.assertEqual(scene.eval(scene.eval().coordinates).coordinates["theta"], scene.eval().coordinates["theta"])

    def test_progress_is_told_and_may_end_a_verb(self):
        scene, told = alembert.Scene(PENDULUM), []
        lengths = np.linspace(1, 2, 30_000)
        with alembert.progress(lambda what, part: told.append((what, part))):
            scene.sweep({"l": lengths}, duration=20, threads=1)
        self.assertTrue(told)
        self.assertTrue(all(isinstance(what, str) and 0 <= part <= 1 for what, part in told))
        self.assertGreater(max(part for _, part in told), 0.2)
        count = len(told)
        scene.sweep({"l": lengths[:10]}, duration=1)
        self.assertEqual(len(told), count)  # nobody is told any more

        def enough(what, part):
            raise StopIteration(what)

        with self.assertRaises(StopIteration), alembert.progress(enough):
            scene.sweep({"l": lengths}, duration=20, threads=1)
        self.assertEqual(len(scene.sweep({"l": [1, 2]}, duration=1)["final_theta"]), 2)

    def test_progress_is_told_of_long_runs_sensitivities_and_matrices(self):
        scene = alembert.Scene(scene_file("textbook/double_pendulum.toml"))
        for call in (lambda: scene.simulate(100000, budget=10**9, sample=100, estimate=False),
                     lambda: scene.simulate(2000, budget=10**9, sample=100, estimate=False, sensitivity=["l1"]),
                     lambda: scene.linearize(along=True, duration=200, sample=0.05)):
            told = []
            with alembert.progress(lambda what, part: told.append(part)):
                call()
            self.assertGreater(len(told), 1)
            self.assertTrue(all(0 <= part <= 1 for part in told))

    def test_one_name_may_be_a_text(self):
        scene = alembert.Scene(scene_file("textbook/crane.toml"))
        self.assertEqual(scene.inertia("load").json["of"], scene.inertia(["load"]).json["of"])
        self.assertEqual(repr(scene.kinematics("load")), repr(scene.kinematics(["load"])))
        self.assertEqual(repr(scene.kinematics("load,trolley")), repr(scene.kinematics(["load", "trolley"])))
        self.assertEqual(list(scene.robot("mass", "load").functions), list(scene.robot(["mass"], ["load"]).functions))
        self.assertEqual(scene.emit(functions="com", frames="load").sources.keys(), scene.emit(functions=["com"]).sources.keys())
        l = next(iter(scene.system().parameters))
        self.assertEqual(scene.simulate(0.1, sensitivity=l).sensitivity, scene.simulate(0.1, sensitivity=[l]).sensitivity)

    def test_a_run_that_breaks_off_says_so_where_it_is_printed(self):
        scene = alembert.Scene(text="[coordinates]\nx = 1\n[energy]\nkinetic = \"x'^2/2\"\npotential = \"-x^4\"\n")
        with warnings.catch_warnings(record=True) as said, tempfile.TemporaryDirectory() as folder:
            warnings.simplefilter("always")
            run = scene.simulate(100)
            self.assertIn("the motion broke off: ", repr(run).splitlines()[-1])
            self.assertIn("0.927", repr(run).splitlines()[-1])
            del said[:]
            scene.report(os.path.join(folder, "page.html"), duration=100)
            self.assertTrue(any("the motion broke off: " in str(one.message) for one in said))
            with self.assertRaisesRegex(alembert.ModelError, "ends in .csv, .npz, .h5"):
                run.save(os.path.join(folder, "out.xyz"))
            run.save(os.path.join(folder, "out.csv"))

    def test_systems_and_initial_states_take_values(self):
        scene = alembert.Scene(PENDULUM)
        self.assertEqual(scene.system(at={"l": 3}).parameters["l"], 3)
        self.assertEqual(scene.robot("mass", at={"l": 3}).parameters["l"], 3)
        np.testing.assert_array_equal(scene.initial_state({"theta": 0.25, "theta'": 2}), [0.25, 2])
        np.testing.assert_allclose(scene.system(at={"l": 3}).rhs(0.0, [0.5, 0.0])[1] * 2, scene.system().rhs(0.0, [0.5, 0.0])[1])

    def test_values_and_inputs_are_given_for_one_call(self):
        text = ("[parameters]\nm = 2\n[inputs]\nu = { value = 1, given = \"outside\" }\n[coordinates]\nx = 0\n[[particle]]\n"
                "name = \"P\"\nmass = \"m\"\nposition = [\"x\", 0]\n[forces]\nx = \"u\"\n[simulation]\nduration = 2\n")
        scene = alembert.Scene(text=text)
        end = lambda run: run.final["coordinates"]["x"]
        self.assertAlmostEqual(end(scene.simulate()), 1)
        self.assertAlmostEqual(end(scene.simulate(at={"m": 1, "x": 3, "x'": 1})), 3 + 2 + 2)
        self.assertAlmostEqual(end(scene.simulate(input={"u": "6*t"})), 4)
        self.assertAlmostEqual(scene.sweep({"m": [1, 2]}, input={"u": 4})["final_x"][1], 4)
        on_its_side = alembert.Scene(text=text.replace('x = "u"', 'x = "sqrt(x^2)"').replace("x = 0", "x = 1"))
        self.assertEqual(on_its_side.check("m*x'' = x").json["claims"][0]["verdict"], "proved")
        self.assertEqual(on_its_side.check("m*x'' = -x", at={"x": -1}).json["claims"][0]["verdict"], "proved")
        self.assertIn("--at m=7.0 --at x=3.0", scene.emit(at={"m": 7, "x": 3}).sources["scene.cpp"])
        system = scene.system()
        self.assertEqual((system.inputs, system.parameters), (["u"], {"m": 2}))
        self.assertEqual(list(system.rhs(0.0, [0.0, 0.0])), [0, 0.5])
        self.assertEqual(list(system.rhs(0.0, [0.0, 0.0], [5])), [0, 2.5])
        system.set(m=4)
        self.assertEqual(list(system.rhs(0.0, [0.0, 0.0])), [0, 0.25])
        again = pickle.loads(pickle.dumps(system))
        self.assertEqual(list(again.rhs(0.0, [0.0, 0.0], [8])), [0, 2])
        with self.assertRaisesRegex(ValueError, "2 values for 1 input"):
            system.rhs(0.0, [0.0, 0.0], [1, 2])

    def test_attributes_of_scenes_without_contacts_and_columns_have_names_of_their_own(self):
        scene = alembert.Scene(PENDULUM)
        self.assertEqual(scene.simulate(1).contacts, [])
        swept = scene.sweep({"theta": [0.1, 0.2]}, duration=1)
        self.assertEqual(len(set(swept.columns)), len(swept.columns))
        self.assertEqual(swept["theta"].tolist(), [0.1, 0.2])
        alone = scene.sweep({"l": [1.5], "theta": [0.2]}, duration=1)
        self.assertEqual(swept["final_theta"][1], alone["final_theta"][0, 0])
        self.assertTrue(issubclass(alembert.Error, RuntimeError))

    def test_equations_of_sympy_are_claims(self):
        try:
            import sympy
        except ImportError:
            self.skipTest("SymPy is missing")
        scene = alembert.Scene(PENDULUM)
        own = scene.derive().equations[0].sympy()
        wrong = sympy.Eq(own.lhs + 1, own.rhs)
        self.assertEqual(scene.check(own).verdicts, ["proved"])
        self.assertEqual(scene.check([own, wrong, "l*theta'' = 0"]).verdicts, ["proved", "refuted", "refuted"])

    def test_notebooks_show_marked_derivations_matrices_and_systems(self):
        scene = alembert.Scene(PENDULUM)
        marked = scene.mark("T = m*l^2*theta'^2/2\nV = m*g*l*cos(theta)\n")
        shown = marked._repr_html_()
        self.assertEqual(shown.count("<tr>"), 3)
        self.assertIn("<b>right</b>", shown.split("</tr>")[1])
        self.assertIn("<b>mistake</b>", shown.split("</tr>")[2])
        self.assertIn("correct: V = -m*g*l*cos(theta)", shown.split("</tr>")[2])
        linearized = scene.linearize({"theta": 0, "theta'": 0})
        self.assertIn("<mtable>", linearized._repr_html_())
        self.assertIn(f"<mn>{linearized.matrices['K'][0][0]:.6g}</mn>", linearized._repr_html_())
        self.assertEqual(repr(scene.system()), "System(y = theta, then their rates; parameters: m=2, l=1.5, g=9.81)")

    def test_ctrl_c_ends_every_verb_at_once(self):
        """Where nobody looked for it, each of these verbs would go on for minutes."""
        chain = {"gravity": [0, "-g"], "parameters": {"g": 9.81}, "coordinates": {}, "particle": []}
        for k in range(60):
            chain["parameters"][f"l{k}"] = chain["parameters"][f"m{k}"] = 1.0
            chain["coordinates"][f"q{k}"] = 0.1
            chain["particle"].append({"name": f"p{k}", "mass": f"m{k}", "position": [f"l{k}*sin(q{k})", f"-l{k}*cos(q{k})"],
                                      **({"from": f"p{k - 1}"} if k else {})})
        rest = {f"q{k}": 0 for k in range(60)}
        heard = lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)  # what runs in the background may ignore it
        for verb, scene in (("simulate(1e6, sensitivity=['l'], budget=10**12, sample=1e4, estimate=False)", PENDULUM),
                            ("simulate(1e7, budget=10**12, estimate=False)", PENDULUM), (f"stability({rest})", chain), ("fmu('unit.fmu')", chain),
                            ("agree()", chain), ("equilibrium(starts=10**6)", chain), ("emit(jacobian=True)", chain)):
            code = f"import alembert\nscene = alembert.Scene({scene!r})\nprint('go', flush=True)\nscene.{verb}\n"
            with tempfile.TemporaryDirectory() as folder, subprocess.Popen(
                    [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=folder,
                    preexec_fn=heard) as child:
                child.stdout.readline()
                time.sleep(1)
                if child.poll() is None:
                    child.send_signal(signal.SIGINT)
                    told = child.communicate(timeout=60)[1]
                    self.assertIn("KeyboardInterrupt", told, verb)
                else:
                    child.communicate()

    def test_ctrl_c_ends_a_compiler_and_branches(self):
        """The compiler would go on for ten seconds, and the branches for minutes."""
        chain = {"gravity": [0, "-g"], "parameters": {"g": 9.81}, "coordinates": {}, "particle": []}
        for k in range(14):
            chain["parameters"][f"l{k}"] = 1.0
            chain["coordinates"][f"q{k}"] = 0.1
            chain["particle"].append({"name": f"p{k}", "mass": 1, "position": [f"l{k}*sin(q{k})", f"-l{k}*cos(q{k})"],
                                      **({"from": f"p{k - 1}"} if k else {})})
        heard = lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)
        for verb, wait in (("system()", 3), ("branches(('l0', 0.1, 20))", 3)):
            code = f"import alembert\nscene = alembert.Scene({chain!r})\nprint('go', flush=True)\nscene.{verb}\n"
            with tempfile.TemporaryDirectory() as folder, subprocess.Popen(
                    [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=folder,
                    env={**os.environ, "XDG_CACHE_HOME": folder}, preexec_fn=heard) as child:
                child.stdout.readline()
                time.sleep(wait)
                self.assertIsNone(child.poll(), verb)
                began = time.monotonic()
                child.send_signal(signal.SIGINT)
                self.assertIn("KeyboardInterrupt", child.communicate(timeout=60)[1], verb)
                self.assertLess(time.monotonic() - began, 2, verb)

    def test_sensitivities_at_all_rows_are_those_of_their_ends(self):
        scene = alembert.Scene(PENDULUM)
        of = scene.simulate(2, 1e-11, sample=0.5, sensitivity=["l", "theta"], sensitivity_rows=True).sensitivity
        self.assertEqual(of["times"], [0, 0.5, 1, 1.5, 2])
        self.assertEqual(np.shape(of["rows"]), (5, 2, 2))
        np.testing.assert_allclose(of["rows"][0], [[0, 1], [0, 0]], atol=1e-15)
        self.assertEqual(of["rows"][-1], of["values"])
        for k in (1, 2, 3):
            alone = scene.simulate(of["times"][k], 1e-11, sensitivity=["l", "theta"]).sensitivity
            np.testing.assert_allclose(of["rows"][k], alone["values"], rtol=1e-8)

    def test_warnings_are_those_of_the_users_line(self):
        scene = alembert.Scene({**PENDULUM, "coordinates": {"theta": {"initial": 1, "unit": "furlong"}}})
        for call in (scene.eval, scene.derive, scene.audit, scene.system, lambda: scene.simulate(0.1), lambda: scene.check("theta = 0"),
                     lambda: scene.sweep({"l": [1]}, duration=0.1)):
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                call()
            self.assertTrue(said)
            for one in said:
                self.assertEqual(one.filename, __file__)

    def test_the_package_is_the_command_line_too(self):
        here = {**os.environ, "PYTHONPATH": os.path.dirname(os.path.dirname(alembert.__file__))}
        with tempfile.TemporaryDirectory() as folder:
            for words in (["derive", scene_file("textbook/double_pendulum.toml"), "--steps"], ["--version"], ["derive", "missing.toml"],
                          ["check", scene_file("textbook/double_pendulum.toml"), "--json"]):
                ours = subprocess.run([sys.executable, "-m", "alembert", *words], capture_output=True, cwd=folder, env=here, check=False)
                theirs = subprocess.run([PROGRAM, *words], capture_output=True, cwd=folder, check=False)
                self.assertEqual((ours.returncode, ours.stdout, ours.stderr), (theirs.returncode, theirs.stdout, theirs.stderr))
