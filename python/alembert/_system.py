# SPDX-License-Identifier: GPL-2.0-or-later
"""Compiled functions of a scene over arrays of states."""

import unicodedata

from . import _alembert
from ._results import names_in, warn


class System:
    """The compiled right-hand side of a scene: y' = f(t, y), y being coordinates, then rates (or speeds).

    Every function takes one state, or an array of states whose last axis is the state's; `t` is one number, or one
    for each state. Many states are worked on by all cores, eight at a time, while other threads of Python run.

        scipy.integrate.solve_ivp(system.rhs, (0, 10), y0, jac=system.jacobian, method="Radau")
        scipy.integrate.solve_ivp(system.rhs_of_columns, (0, 10), y0, method="Radau", vectorized=True)

    Where the scene has inputs that are given from outside, `inputs` has their names, and every function takes their values as
    a last argument, one for each, which hold for this call: `system.rhs(t, y, [0.5])`. Without it they have the scene's.

    A pickled system carries its source and its parameters, and is compiled, or found in the cache, where it is read.
    """

    def __init__(self, scene, by="", jacobian=True, functions=(), frames=()):
        lists = names_in(functions), names_in(frames), list(scene._values)
        self._system, said, names = _alembert.system(scene.text, scene.name, by, jacobian, lists)
        warn(said)
        self.coordinates, self.speeds, self._parameters, self.inputs = names
        self._bind()

    def _bind(self):
        self.rhs = self._system.rhs  # directly, without a Python call between
        self.jacobian = self._system.jacobian
        self.mass_matrix = self._system.mass_matrix
        self.energy = self._system.energy
        self.dimension = self._system.dimension

    def __copy__(self):
        """A system with parameters of its own."""
        same = object.__new__(type(self))
        same.__dict__.update(self.__dict__, _system=self._system.copy())
        same._bind()
        return same

    def __deepcopy__(self, memo):
        return self.__copy__()

    @property
    def parameters(self):
        """Names, as the scene writes them, and values."""
        return {name: value for name, value in self._all().items() if name not in self.inputs}

    def _all(self):
        return dict(zip(self._parameters, self._system.parameter_values))

    def set(self, values=None, /, **more):
        """Other values for parameters: system.set(m=2, l=0.5), or system.set({"lambda": 2}) for names that are words of
        Python."""
        new = self.parameters
        for name, value in {**(values or {}), **more}.items():
            known = name if name in new else unicodedata.normalize("NFKC", name)
            if known not in new:  # Python writes identifiers in that form
                known = next((one for one in new if unicodedata.normalize("NFKC", one) == known), None)
            if known is None:
                raise KeyError(f"no parameter '{name}'; there are {', '.join(new)}")
            new[known] = float(value)
        self._system.set_parameters(list({**self._all(), **new}.values()))

    @property
    def source(self):
        """The emitted C++."""
        return self._system.source

    def rhs_of_columns(self, t, y):
        """The same as `rhs` for states that are the columns of y, as `solve_ivp` wants it with vectorized=True."""
        import numpy

        return numpy.ascontiguousarray(self.rhs(t, numpy.asarray(y, dtype=float).T).T)

    def __call__(self, t, y, inputs=None):
        return self.rhs(t, y, inputs)

    def __repr__(self):
        speeds = ", ".join(self.speeds) if self.speeds else "their rates"
        parameters = ", ".join(f"{name}={value:g}" for name, value in self.parameters.items())
        return f"{type(self).__name__}(y = {', '.join(self.coordinates)}, then {speeds}; parameters: {parameters or 'none'})"


_MATRICES = ("mass", "mass_inverse", "coriolis", "jacobian", "regressor")  # even of one row and one column


class RobotFunction:
    """A function of coordinates q, rates v and accelerations a, each with the last axis of the coordinates:

        robot.inverse(q, v, a)        # q of shape (…, n): a value of shape (…, n)
        robot.mass(q)                 # (…, n, n)

    Rates and accelerations that are left out are zero. Leading axes are broadcast against each other. `shape` is that
    of one value, `operations` the number of operations of one call.
    """

    def __init__(self, system, name, which):
        self._system = system
        self._which = which
        self.name = name
        rows, columns, self.operations = system.function_shape(which)
        self._is_matrix = columns > 1 or name.endswith(_MATRICES)
        self.shape = (rows, columns) if self._is_matrix else (rows,)

    def of(self, system):
        """The same function of another system."""
        return RobotFunction(system, self.name, self._which)

    def __call__(self, q, v=None, a=None, *, t=0.0):
        import numpy

        arrays = [None if one is None else numpy.asarray(one, dtype=float) for one in (q, v, a)]
        given = [one for one in arrays if one is not None]
        if any(one.shape != given[0].shape for one in given):
            same = iter(numpy.broadcast_arrays(*given))
            arrays = [None if one is None else next(same) for one in arrays]
        value = self._system.call(self._which, t, *arrays)
        return value if self._is_matrix else value[..., 0]

    def __repr__(self):
        return f"<{self.name}: {' × '.join(map(str, self.shape))}, {self.operations} operations>"


class Robot(System):
    """A System with the functions that control, planning and identification need (docs/commands.md, "Functions for
    robots"), each an attribute: `robot.inverse(q, v, a)`, `robot.mass(q)`, `robot.gravity(q)`, and for a frame "hand"
    `robot.hand_pose(q)`, `robot.hand_jacobian(q)`, `robot.hand_velocity(q, v)`, `robot.hand_drift(q, v)` …
    `functions` has them by name."""

    def __init__(self, scene, functions, frames=(), by=""):
        super().__init__(scene, by, False, functions, frames)
        names = self._system.functions
        self.functions = {name: RobotFunction(self._system, name, which) for which, name in enumerate(names)}

    def _bind(self):
        super()._bind()
        if "functions" in self.__dict__:
            self.functions = {name: f.of(self._system) for name, f in self.functions.items()}

    def __getattr__(self, name):
        functions = self.__dict__.get("functions", {})
        if name in functions:
            return functions[name]
        raise AttributeError(f"there is no function '{name}'; there are {', '.join(functions)}")

    def __dir__(self):
        return [*super().__dir__(), *self.functions]
