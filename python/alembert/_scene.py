# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene and its verbs."""

import copy as _copy
import json as _json
import os as _os
from collections.abc import Mapping as _Mapping

from . import _alembert
from ._motion import Run, Swept
from ._results import (
    Agreed, Audited, Checked, Derivation, Drawn, Equilibria, Figure, Linearized, Marked, Result, Sources, Stability, ask, axis,
    inputs_of, listed, names_in, numbers, options_text, points_of, samples_of, values_at, warn, write)  # yapf: disable
from ._system import Robot, System
from ._toml import to_toml
from .expressions import from_sympy

#: What `Scene.emit` writes.
CODE_LANGUAGES = ("cpp", "c", "js", "python", "julia", "matlab", "rust", "modelica")
#: What `Scene.robot` takes if nothing is named.
ROBOT_FUNCTIONS = ("inverse", "mass", "bias", "gravity", "loads", "mass_inverse", "com", "com_jacobian", "momentum")


class Scene:
    """The description of a mechanical system, from a file, a text, or a dictionary of the same tables.

        Scene("pendulum.toml")
        Scene(text='[coordinates]\\ntheta = 0.3\\n…')
        Scene({"coordinates": {"theta": 0.3}, "energy": {"kinetic": "…", "potential": "…"}})

    A verb of the command line is a method with the same name and options. Where it takes `at`, that is a dictionary of
    values which replace the scene's: numbers or expressions, {"theta": "pi/2", "theta'": 0}.
    """

    _values = ()  # in place of the scene's, of what is compiled

    def __init__(self, source=None, *, text=None, name=None):
        if (source is None) == (text is None):
            raise TypeError("give a file or a dictionary, or text=…")
        if isinstance(source, _Mapping):
            text = to_toml(source)
        elif source is not None:
            name = name or _os.fspath(source)
            with open(source, encoding="utf-8", newline="") as file:
                text = file.read()
        self.text = text
        self.name = name or "scene.toml"

    @classmethod
    def from_robot(cls, path, *, loops=None, floating=False, quaternion=False, drives=False, friction=False, stops=False,
                   right_angles=False, strict=False, package=(), allow_outside=False):
        """The scene of a robot description in URDF (or another form that `import` reads); `loops` is a file of joints
        that close loops, `package` a list of folders with models. `strict` refuses a robot whose motion the scene would
        change. `.imported` says what became of its parts."""
        package = [package] if isinstance(package, (str, _os.PathLike)) else package
        options = {"floating": floating, "quaternion": quaternion, "drives": drives, "friction": friction,
                   "stops": stops, "right_angles": right_angles, "strict": strict,
                   "package": [_os.fspath(folder) for folder in package], "allow_outside": allow_outside,
                   "loops": None if loops is None else _os.fspath(loops)}  # yapf: disable
        found = ask("import", "", _os.fspath(path), options)
        stem = _os.path.splitext(_os.path.basename(_os.fspath(path)))[0]
        scene = cls(text=found._files["scene"].decode(), name=f"{stem}.toml")
        scene.imported = found
        return scene

    def _ask(self, verb, kind=Result, **options):
        return ask(verb, self.text, self.name, options, kind)

    # Derivation and proof

    def derive(self, by="", *, reactions=False, at=None):
        """The equations of motion, by the formalism named, or by the one that a teacher would choose. `at` replaces values
        of the scene, here and in the other calls: {"l": 2, "theta": 0.3}."""
        return Derivation((self.text, self.name, by, reactions, values_at(at)))

    def draw(self, at=None):
        """The figure of the scene at its initial state."""
        return self._ask("draw", lambda json, text, files: Figure(files["svg"].decode()), at=values_at(at))

    def check(self, claims=None, *, by="", at=None):
        """Claims held against the derived equations: a text with an equation a line, an equation of SymPy, or a list of
        such; the scene's own if there are none."""
        if claims is not None and not isinstance(claims, str):
            listed_claims = [claims] if hasattr(claims, "free_symbols") else claims
            claims = "\n".join(one if isinstance(one, str) else from_sympy(one) for one in listed_claims)
        return self._ask("check", Checked, claims=claims, by=by, at=values_at(at))

    def mark(self, derivation, *, letters=None, by="", at=None):
        """A whole derivation, the text of a file in LaTeX, Markdown or plain text, line by line with a verdict.
        `letters` says what its letters are called in the scene: {r"\\ell": "l"}."""
        pairs = [f"{written}={name}" for written, name in (letters or {}).items()]
        return self._ask("check", Marked, derivation=derivation, name="derivation", letters=pairs, by=by,
                         at=values_at(at))

    def audit(self, at=None):
        """Constraints: kinds, ranks, which are redundant or integrable."""
        return self._ask("audit", Audited, at=values_at(at))

    def agree(self, at=None):
        """Derives by every formalism that applies and proves them equal."""
        return self._ask("agree", Agreed, at=values_at(at))

    # One state

    def eval(self, at=None, *, by="", reactions=False, matrices=False):
        """One evaluation, at the initial state or with `at={"theta": 0.3, "theta'": 1}`; needs no compiler. With
        `matrices` there are M and C of M q'' + C q' + g = Q."""
        return self._ask("eval", at=values_at(at), by=by, reactions=reactions, matrices=matrices)

    def inverse(self, at=None, *, by=""):
        """The loads for given accelerations: `at={"q1''": 2}`."""
        return self._ask("inverse", at=values_at(at), by=by)

    def prove(self, at=None, *, by="", duration=None, sample=None):
        """Intervals that contain the true motion: `.proof["rows"]` has `time`, `low` and `high`, at the end and each
        `sample`; see `simulate --proof`."""
        return self._ask("prove", at=values_at(at), by=by, **numbers(duration=duration, sample=sample))

    def impact(self, at=None):
        """The rates after the scene's impulses."""
        return self._ask("impact", at=values_at(at))

    def kinematics(self, of=(), at=None, *, steps=False, jacobian=False):
        """Positions, velocities and accelerations of frames, bodies and points (all of them, or those named)."""
        return self._ask("kinematics", of=names_in(of), at=values_at(at), steps=steps, jacobian=jacobian)

    def inertia(self, of=(), about="", at=None):
        """Masses, centres of mass and moments of inertia of bodies (all of them, or those named)."""
        return self._ask("inertia", of=names_in(of), about=about, at=values_at(at))

    def identify(self, at=None):
        """Which combinations of masses and moments of inertia motion can show (base parameters)."""
        return self._ask("identify", at=values_at(at))

    def initial_state(self, at=None):
        """Coordinates, then rates (or speeds), at the start: as `System.rhs` takes them."""
        import numpy

        found = self.eval(at).json
        second = found["speeds"] if found.get("speeds") else found["rates"]
        return numpy.array([*found["coordinates"].values(), *second.values()], dtype=float)

    # Equilibrium and stability

    def equilibrium(self, at=None, *, by="", starts=0):
        """Where the system can stay at rest or move steadily: `equilibria`."""
        return self._ask("equilibrium", Equilibria, at=values_at(at), by=by, starts=starts)

    def branches(self, over, at=None, *, by=""):
        """Equilibria followed over a parameter: `over=("Omega", 0, 20)`; `.figure` is the bifurcation diagram."""
        return self._ask("branches", Drawn, over=axis(over), at=values_at(at), by=by)

    def linearize(self, at=None, *, by="", affine=False, along=False, duration=None, tolerance=None, sample=None):
        """Matrices and eigenvalues near an equilibrium or a steady motion. With `affine`, about any state:
        x' = A dx + B du + c, `c` besides `matrices`. With `along`, about the motion from the state: `along` is a list of
        such rows with their `time` and `x`, as many as `duration` and `sample` make."""
        return self._ask("linearize", Linearized, at=values_at(at), by=by, affine=affine, along=along,
                         **numbers(duration=duration, tolerance=tolerance, sample=sample))

    def stability(self, at=None, *, by="", period=0.0, lyapunov=""):
        """Is an equilibrium or a steady motion stable, and why? `verdict`, `by` and the rest of the command's."""
        return self._ask("stability", Stability, at=values_at(at), by=by, period=period, lyapunov=lyapunov)

    def stability_chart(self, x, y, at=None, *, by="", period=0.0):
        """Stability over two parameters, each (name, from, to) or (name, from, to, count); `.figure` is the chart."""
        return self._ask("chart", Drawn, over=[axis(x), axis(y)], at=values_at(at), by=by, period=period)

    def root_locus(self, over, at=None, *, by="", period=0.0):
        """The eigenvalues (or, with a period, multipliers) over a parameter: `over=("k", 0, 20)`; `.figure`."""
        return self._ask("locus", Drawn, over=axis(over), at=values_at(at), by=by, period=period)

    def exponents(self, count=1, at=None, *, by="", duration=1000.0):
        """Lyapunov exponents of the motion, the largest first; all of them for count=0."""
        return self._ask("exponents", Drawn, count=count, at=values_at(at), by=by, duration=duration)

    # Motion

    def simulate(self, duration=None, tolerance=None, *, method="", step=None, sample=None, max_step=None,
                 budget=10_000_000, estimate=True, reactions=False, by="", fast_math=False, poincare="", code="",
                 sensitivity=(), sensitivity_of=(), sensitivity_rows=False, regularize=False, tuning=True, at=None,
                 input=None):
        """Integrates the motion. What is not given is the scene's. With `poincare="theta1 = 0"` the result has the
        crossings of that section. `code` is "memory" or "compiled" where the choice is not left to the program. With
        `sensitivity=["theta1", "l1"]` the result has the derivatives of the state at the end by these:
        `run.sensitivity["values"][i][k]` is that of component `["of"][i]` by `["by"][k]`; `sensitivity_of` names the
        components and outputs that are wanted, and where these are few, the adjoint equations give them. With
        `regularize=True` steps are short where the potential is deep. With `tuning=False` the method is chosen by counts
        alone, as on every other machine. `at={"l": 2, "theta": 0.3}` replaces values of the scene, and
        `input={"u": "sin(t)"}`, or the name of a CSV file, gives an input that comes from outside."""
        given = numbers(duration=duration, tolerance=tolerance, step=step, sample=sample, max_step=max_step)
        return Run((self.text, self.name, by, method, list(given.values()), int(budget), estimate, reactions, fast_math,
                    poincare, code, names_in(sensitivity), names_in(sensitivity_of), sensitivity_rows, regularize, tuning,
                    values_at(at), inputs_of(input)))

    def sweep(self, values, duration=None, tolerance=None, *, grid=True, method="", step=None, max_step=None,
              budget=10_000_000, by="", threads=0, code="", fast_math=False, along=(), reduce=(), samples=None,
              sampling="sobol", seed=0, path=None, resume=False, tuning=True, at=None, input=None):
        """The ends of many motions: `values={"l1": numpy.linspace(1, 2, 100), "theta1": [0.1, 0.2]}` gives a Swept of
        shape (100, 2); with grid=False the lists have one length and are taken side by side. With `samples=1000` the
        values are ranges, {"l1": (1, 2)}, in which as many points lie; `sampling` and `seed` are the command's.
        `at` and `input` are those of `simulate`. `along=["min", "max"]` adds columns of whole motions. With `reduce=["min", "mean", 0.95]` only `statistics` are
        kept. With `path` the table is written to this file (CSV, NAME.npz, NAME.h5) and not kept in memory; what is
        done is in PATH.unfinished meanwhile, and with resume=True the same call goes on after an interruption."""
        place = None if path is None else _os.fspath(path)
        if resume and place is None:
            raise ValueError("resume=True needs path=…: what is done is kept beside this file")
        given, shape = points_of(values, grid) if samples is None else samples_of(values, samples, sampling, seed)
        given.update(at=values_at(at), input=inputs_of(input), method=method, by=by, threads=threads, code=code, budget=int(budget), fast_math=fast_math, tuning=tuning,
                     along=listed(along), reduce=listed(reduce), path=place, resume=resume,
                     **numbers(duration=duration, tolerance=tolerance, step=step, max_step=max_step))
        try:
            json, text, said, _, columns, table = _alembert.ask("sweep", self.text, self.name, options_text(given))
        except (_alembert.ModelError, _alembert.SceneError, ValueError):
            raise
        except BaseException:
            if place is not None and _os.path.exists(place + ".unfinished"):
                warn([f"{place}.unfinished has the motions that are done; the same call with resume=True goes on"])
            raise
        warn(said)
        return Swept(_json.loads(json), text, columns, table, shape)

    def bench(self, duration=None, *, method="", max_step=None, budget=10_000_000, code="", run_seconds=2.0,
              reference_seconds=30.0, peers=False, by="", tuning=True, at=None, input=None):
        """Speed against error of every method; `.figure` is the diagram. `run_seconds` is the processor time of the
        slowest runs that are of interest, `reference_seconds` that of each of the reference's methods."""
        return self._ask("bench", Drawn, at=values_at(at), input=inputs_of(input), method=method, code=code, peers=peers,
                         by=by, budget=int(budget), tuning=tuning,
                         **numbers(duration=duration, max_step=max_step, run_seconds=run_seconds,
                                   reference_seconds=reference_seconds))

    # For other programs

    def _given(self, at):
        """The scene with values in place of its own, for what is compiled of it."""
        same = _copy.copy(self)
        same._values = values_at(at)
        return same

    def system(self, by="", *, jacobian=True, at=None):
        """The compiled right-hand side, for other people's solvers."""
        return System(self._given(at), by, jacobian)

    def robot(self, functions=ROBOT_FUNCTIONS, frames=(), *, by="", at=None):
        """The compiled functions that control and planning need, over arrays of states; those of `frames` (points,
        bodies, or "P@F") too. `functions` may have "coriolis", "inverse_jacobian" and "regressor" besides."""
        return Robot(self._given(at), functions, frames, by)

    def emit(self, folder=None, *, language="cpp", standalone=False, fold=False, jacobian=False, functions=(),
             frames=(), wrenches=(), batch=False, casadi=False, by="", name="", at=None):
        """The C++ of the system, or its code in another of `CODE_LANGUAGES`: `.sources`; written into a folder if one is
        named, and then `.files`."""
        if language not in CODE_LANGUAGES:
            raise ValueError(f"language={language!r}: there are {', '.join(map(repr, CODE_LANGUAGES))}")
        place = "" if folder is None else _os.path.join(_os.fspath(folder), "")
        found = self._ask("emit", Sources, folder=place, language=language, standalone=standalone, fold=fold,
                          jacobian=jacobian, functions=names_in(functions), frames=names_in(frames), wrenches=names_in(wrenches),
                          batch=batch, casadi=casadi, by=by, name=name, at=values_at(at))
        if folder is not None:
            _os.makedirs(folder, exist_ok=True)
            for name, text in found.sources.items():
                write(place + name, text)
        return found

    def fmu(self, path, *, fmi=2, by="", at=None):
        """Writes a functional mock-up unit of FMI 2.0 or 3.0 to this file; its states, inputs, outputs, parameters."""
        path = _os.fspath(path)
        _alembert.need_form(path, "unit")
        unit = self._ask("fmu", path=path, fmi=fmi, by=by, at=values_at(at))
        write(path, unit._files["fmu"])
        return unit

    def report(self, path, *, duration=None, budget=3_000_000, motion=True, poincare="", bench=False, by="", at=None,
               input=None):
        """Writes the page of the scene, with the figure that moves, to this HTML file; with `bench`, the speed and error
        of every method too."""
        _alembert.need_form(_os.fspath(path), "page")
        page = self._ask("report", at=values_at(at), input=inputs_of(input), motion=motion, poincare=poincare, bench=bench, by=by, budget=int(budget),
                         **numbers(duration=duration))
        write(path, page._files["html"])

    def live(self, *, duration=None, budget=3_000_000, height=720, by="", at=None):
        """The page of the scene with the figure that moves and its sliders, for a notebook: a frame, or `.widget()`."""
        from ._notebook import Live
        page = self._ask("report", at=values_at(at), input=inputs_of(None), motion=True, poincare="", bench=False, by=by,
                         budget=int(budget), **numbers(duration=duration))  # yapf: disable
        return Live(page._files["html"].decode(), _os.path.splitext(_os.path.basename(self.name))[0], height)

    def _repr_latex_(self):
        return self.derive()._repr_latex_()

    def __repr__(self):
        return f"Scene({self.name!r})"
