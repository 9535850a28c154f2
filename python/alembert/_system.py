# SPDX-License-Identifier: GPL-2.0-or-later
"""Compiled functions of a scene over arrays of states."""

from . import _alembert
from ._results import warn


class System:
    """The compiled right-hand side of a scene: y' = f(t, y), y being coordinates, then rates (or speeds).

    Every function takes one state, or an array of states whose last axis is the state's; `t` is one number, or one
    for each state. Many states are worked on by all cores, eight at a time, while other threads of Python run.

        scipy.integrate.solve_ivp(system.rhs, (0, 10), y0, jac=system.jacobian, method="Radau")
        scipy.integrate.solve_ivp(system.rhs_of_columns, (0, 10), y0, method="Radau", vectorized=True)

    A pickled system carries its source and its parameters, and is compiled, or found in the cache, where it is read.
    """

    def __init__(self, scene, by="", jacobian=True, functions=(), frames=()):
        self._system, said = _alembert.system(scene.text, scene.name, by, jacobian, list(functions), list(frames))
        warn(said)
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

    def rhs_of_columns(self, t, y):
        """The same as `rhs` for states that are the columns of y, as `solve_ivp` wants it with vectorized=True."""
        import numpy

        return numpy.ascontiguousarray(self.rhs(t, numpy.asarray(y, dtype=float).T).T)

    def __call__(self, t, y):
        return self.rhs(t, y)


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

    def __getattr__(self, name):
        functions = self.__dict__.get("functions", {})
        if name in functions:
            return functions[name]
        raise AttributeError(f"there is no function '{name}'; there are {', '.join(functions)}")

    def __dir__(self):
        return [*super().__dir__(), *self.functions]
