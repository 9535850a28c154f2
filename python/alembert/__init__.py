# SPDX-License-Identifier: GPL-2.0-or-later
"""Equations of motion: derived, proved, and integrated by specialized C++.

    import alembert

    scene = alembert.Scene("double_pendulum.toml")
    scene.derive(by="lagrange")                 # shown as formulas in a notebook
    scene.check("m*l^2*theta'' + m*g*l*sin(theta) = 0").verdicts
    run = scene.simulate(duration=10, tolerance=1e-12)
    run["theta1"], run.t, run(1.2345)           # NumPy arrays; the state at any time
    f = scene.system()
    f.rhs(0.0, [0.5, -0.2, 0, 0])               # for scipy.integrate and others

What a verb gives is the JSON object of the command of the same name (docs/commands.md) as attributes and as
`.json`. Errors are exceptions with the text that the program prints: SceneError (with `.diagnostics`: line, column,
message), ModelError, IntegrationError (with `.time` and `.state`), EnvironmentFailure, all of them Error.
"""

from . import _alembert
from ._alembert import EnvironmentFailure, Error, IntegrationError, ModelError, SceneError
from ._motion import Run, Swept
from ._notebook import Live, load_ipython_extension
from ._results import (
    Agreed, Audited, Checked, Derivation, Drawn, Equation, Equilibria, Figure, Linearized, Marked, Result, SceneWarning,
    SINumber, Sources, Stability, progress)  # yapf: disable
from ._scene import Scene
from ._system import Robot, RobotFunction, System
from .expressions import from_sympy, to_sympy

__version__ = _alembert.version
__all__ = [
    "Agreed", "Audited", "Checked", "Derivation", "Drawn", "EnvironmentFailure", "Equation", "Equilibria", "Error",
    "Figure", "IntegrationError", "Linearized", "Live", "Marked", "ModelError", "Result", "Robot", "RobotFunction", "Run", "SINumber",
    "Scene", "SceneError", "SceneWarning", "Sources", "Stability", "Swept", "System", "from_sympy", "progress",
    "to_sympy",
]  # yapf: disable
for _name in __all__:  # where users find them, and where pickles look for them
    globals()[_name].__module__ = "alembert"
