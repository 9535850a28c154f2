# SPDX-License-Identifier: GPL-2.0-or-later
"""Equations of motion: derived, proved, and integrated by specialized C++.

    import alembert

    scene = alembert.Scene("double_pendulum.toml")
    scene.derive(by="lagrange")                 # shown as formulas in a notebook
    scene.check("m*l^2*theta'' + m*g*l*sin(theta) = 0").verdicts
    run = scene.simulate(duration=10, tolerance=1e-12)
    run["theta1"], run.t                        # NumPy arrays, not copied
    f = scene.system()
    f.rhs(0.0, [0.5, -0.2, 0, 0])               # for scipy.integrate and others

What a verb gives is the JSON object of the command of the same name (docs/commands.md) as attributes and as
`.json`. Errors are exceptions with the text that the program prints: SceneError (with `.diagnostics`: line, column,
message), ModelError, IntegrationError, EnvironmentFailure, all of them Error.
"""

import json as _json
import os as _os
import warnings as _warnings

from . import _alembert
from ._alembert import EnvironmentFailure, Error, IntegrationError, ModelError, SceneError
from ._toml import to_toml
from .expressions import from_sympy, to_sympy

__version__ = _alembert.version
__all__ = [
    "Derivation", "EnvironmentFailure", "Equation", "Error", "IntegrationError", "ModelError", "Result", "Run",
    "Scene", "SceneError", "SceneWarning", "System", "from_sympy", "to_sympy",
]  # yapf: disable


class SceneWarning(UserWarning):
    """Something about a scene that is no error: redundant constraints, an inertia that no body can have."""


def _taken(answer):
    text, said = answer
    for one in said:
        _warnings.warn(one.strip(), SceneWarning, stacklevel=4)
    return _json.loads(text)


class Result:
    """A JSON object of the program: its fields are attributes, `.json` is the whole."""

    def __init__(self, json):
        self.json = json

    def __getattr__(self, name):
        json = self.__dict__.get("json", {})
        if name in json:
            return json[name]
        raise AttributeError(f"there is no '{name}' here; there are {', '.join(json)}")

    def __dir__(self):
        return [*super().__dir__(), *self.json]

    def __repr__(self):
        return f"{type(self).__name__}({', '.join(self.json)})"


class Checked(Result):
    """Claims and their verdicts."""

    @property
    def verdicts(self):
        """"proved", "refuted", "undecided" or "vacuous", in the order of the claims."""
        return [claim["verdict"] for claim in self.json["claims"]]

    def __bool__(self):
        """True if every claim is proved."""
        return all(verdict == "proved" for verdict in self.verdicts)


class Equation:
    """One equation of motion: `text` (a valid claim), `latex`, `sympy()`."""

    def __init__(self, text, latex):
        self.text = text
        self.latex = latex

    def _repr_latex_(self):
        return f"$\\displaystyle {self.latex}$"

    def __repr__(self):
        return self.text

    def sympy(self):
        """The same as sympy.Eq; coordinates are functions of the symbol t."""
        return to_sympy(self.text)


class Derivation(Result):
    """Equations of motion by one formalism. A notebook shows them as formulas."""

    def __init__(self, derived):
        super().__init__(_taken(derived.json()))
        self._derived = derived

    @property
    def equations(self):
        """A list of Equation."""
        return [Equation(one["text"], one["latex"]) for one in self.json["equations"]]

    def page(self, format="text", steps=False):
        """The whole derivation as text, latex or mathml; with `steps` all that leads to the equations."""
        return self._derived.page(format, steps)

    def _repr_latex_(self):
        lines = " \\\\\n".join(one.latex for one in self.equations)
        return f"$$\\begin{{gathered}}\n{lines}\n\\end{{gathered}}$$"

    def _repr_html_(self):
        return self.page("mathml")

    def __repr__(self):
        return self.page("text")


class Run(Result):
    """A motion: the table of rows as NumPy arrays that are views, not copies.

    `run.t`, `run["theta1"]`, `run["theta1'"]`, `run.table` (rows × columns), `run.columns`. The attributes are
    those of the JSON object of `simulate`: `final`, `events`, `contacts`, `error_estimate` and so on. A motion that
    broke off has `failure` (a text); what was computed until then is there.
    """

    def __init__(self, run):
        super().__init__(_taken(run.json()))
        self._run = run
        self.columns = run.columns
        self.table = run.table
        self.failure = run.failure

    @property
    def t(self):
        """Times of the rows, in seconds."""
        return self["t"]

    def __getitem__(self, column):
        try:
            return self.table[:, self.columns.index(column)]
        except ValueError:
            raise KeyError(f"no column '{column}'; there are {', '.join(self.columns)}") from None

    def __repr__(self):
        return self._run.text()


class System:
    """The compiled right-hand side of a scene: y' = f(t, y), y being coordinates, then rates (or speeds).

    Every function takes one state, or an array of states whose last axis is the state's; `t` is one number, or one
    for each state. Many states are worked on by all cores, eight at a time.
    """

    def __init__(self, scene, by="", jacobian=True):
        self._system = _alembert.system(scene.text, scene.name, by, jacobian)
        self.rhs = self._system.rhs  # directly, without a Python call between
        self.jacobian = self._system.jacobian
        self.mass_matrix = self._system.mass_matrix
        self.energy = self._system.energy
        self.dimension = self._system.dimension
        self.coordinates = self._system.coordinates
        self.speeds = self._system.speeds

    @property
    def parameters(self):
        """Names and values."""
        return dict(zip(self._system.parameter_names, self._system.parameter_values))

    def set(self, **values):
        """Other values for parameters: system.set(m=2, l=0.5)."""
        new = self.parameters
        for name, value in values.items():
            if name not in new:
                raise KeyError(f"no parameter '{name}'; there are {', '.join(new)}")
            new[name] = float(value)
        self._system.set_parameters(list(new.values()))

    @property
    def source(self):
        """The emitted C++."""
        return self._system.source

    def __call__(self, t, y):
        return self.rhs(t, y)


class Scene:
    """The description of a mechanical system, from a file, a text, or a dictionary of the same tables.

        Scene("pendulum.toml")
        Scene(text='[coordinates]\\ntheta = 0.3\\n…')
        Scene({"coordinates": {"theta": 0.3}, "energy": {"kinetic": "…", "potential": "…"}})
    """

    def __init__(self, source=None, *, text=None, name=None):
        if (source is None) == (text is None):
            raise TypeError("give a file or a dictionary, or text=…")
        if isinstance(source, dict):
            text = to_toml(source)
        elif source is not None:
            name = name or _os.fspath(source)
            with open(source, encoding="utf-8", newline="") as file:
                text = file.read()
        self.text = text
        self.name = name or "scene.toml"

    def derive(self, by="", *, reactions=False):
        """The equations of motion, by the formalism named, or by the one that a teacher would choose."""
        return Derivation(_alembert.derive(self.text, self.name, by, reactions))

    def check(self, claims=None, *, by=""):
        """Claims held against the derived equations: a text with an equation a line, or the scene's own."""
        if claims is not None and not isinstance(claims, str):
            claims = "\n".join(claims)
        return Checked(_taken(_alembert.check(self.text, self.name, claims, by)))

    def audit(self):
        """Constraints: kinds, ranks, which are redundant or integrable."""
        return Result(_taken(_alembert.audit(self.text, self.name)))

    def agree(self):
        """Derives by every formalism that applies and proves them equal."""
        return Result(_taken(_alembert.agree(self.text, self.name)))

    def impact(self):
        """Velocities after the scene's impulses."""
        return Result(_taken(_alembert.impact(self.text, self.name)))

    def eval(self, at=None, *, by="", reactions=False):
        """One evaluation, at the initial state or with `at={"theta": 0.3, "theta'": 1}`; needs no compiler."""
        return Result(_taken(_alembert.evaluate(self.text, self.name, at or {}, by, reactions)))

    def inverse(self, at=None, *, by=""):
        """The loads for given accelerations: `at={"q1''": 2}`."""
        return Result(_taken(_alembert.inverse(self.text, self.name, at or {}, by)))

    def linearize(self, at=None, *, by=""):
        """Matrices and eigenvalues near an equilibrium or a steady motion."""
        return Result(_taken(_alembert.linearize(self.text, self.name, at or {}, by)))

    def stability(self, at=None, *, by="", period=0.0, lyapunov=""):
        """Is an equilibrium or a steady motion stable, and why? `verdict`, `by` and the rest of the command's."""
        return Result(_taken(_alembert.stability(self.text, self.name, at or {}, by, period, lyapunov)))

    def equilibrium(self, at=None, *, by="", starts=0):
        """Where the system can stay at rest or move steadily: `equilibria`."""
        return Result(_taken(_alembert.equilibrium(self.text, self.name, at or {}, by, starts)))

    def kinematics(self, of=(), at=None, *, steps=False):
        """Positions, velocities and accelerations of frames, bodies and points (all of them, or those named)."""
        return Result(_taken(_alembert.kinematics(self.text, self.name, list(of), at or {}, steps)))

    def inertia(self, of=(), about="", at=None):
        """Masses, centres of mass and moments of inertia of bodies (all of them, or those named)."""
        return Result(_taken(_alembert.inertia(self.text, self.name, list(of), about, at or {})))

    def fmu(self, path, *, fmi=2, by=""):
        """Writes a functional mock-up unit of FMI 2.0 or 3.0 to this file; its states, inputs, outputs, parameters."""
        if fmi not in (2, 3):
            raise ValueError(f"fmi={fmi!r}: there are the versions 2 and 3")
        path = _os.fspath(path)
        archive, *answer = _alembert.fmu(self.text, self.name, by, fmi, path)
        with open(path, "wb") as file:
            file.write(archive)
        return Result(_taken(answer))

    def simulate(self, duration=None, tolerance=None, *, method="", step=None, sample=None, max_step=None,
                 budget=10_000_000, estimate=True, reactions=False, by=""):
        """Integrates the motion. What is not given is the scene's."""
        given = [-1.0 if value is None else float(value) for value in (duration, tolerance, step, sample, max_step)]
        return Run(_alembert.simulate(self.text, self.name, by, method, *given, budget, estimate, reactions))

    def system(self, by="", *, jacobian=True):
        """The compiled right-hand side, for other people's solvers."""
        return System(self, by, jacobian)

    def initial_state(self):
        """Coordinates, then rates (or speeds), at the start: as `System.rhs` takes them."""
        import numpy

        at = self.eval().json
        second = at["speeds"] if at.get("speeds") else at["rates"]
        return numpy.array([*at["coordinates"].values(), *second.values()], dtype=float)

    def _repr_latex_(self):
        return self.derive()._repr_latex_()

    def __repr__(self):
        return f"Scene({self.name!r})"
