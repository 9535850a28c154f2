# SPDX-License-Identifier: GPL-2.0-or-later
"""Motions as arrays: one motion, or many."""

import json as _json
import os as _os

from . import _alembert
from ._results import Figure, Result, warn, write


class Run(Result):
    """A motion: the table of rows as NumPy arrays that are views, not copies.

    `run.t`, `run["theta1"]`, `run["theta1'"]`, `run.table` (rows × columns), `run.columns`. `run(t)` is the state at any
    time, or at each of an array of times. The attributes are those of the JSON object of `simulate`: `final`, `events`,
    `contacts`, `error_estimate` and so on. A motion that broke off has `failure` (a text); what was computed until then
    is there. A pickled motion has its table and all attributes; what needs the program, `run(t)`, `plot` and `save`,
    integrates it again when it is first asked for.
    """

    def __init__(self, asked):
        run = _alembert.simulate(*asked)
        json, said = run.json()
        warn(said)
        super().__init__(_json.loads(json))
        self._asked = asked
        self._run = run
        self.columns = run.columns
        self.table = run.table
        self.failure = run.failure
        if self.failure:
            warn([f"the motion broke off: {self.failure}"])

    def __getstate__(self):
        return {**self.__dict__, "_run": None, "_text": repr(self)}

    def __setstate__(self, state):
        self.__dict__.update(state)
        self.table.flags.writeable = False

    def __copy__(self):
        same = object.__new__(type(self))
        same.__dict__.update(self.__dict__)
        return same

    def _alive(self):
        """The motion in the program."""
        if self._run is None:
            self._run = _alembert.simulate(*self._asked)
        return self._run

    @property
    def t(self):
        """Times of the rows, in seconds."""
        return self["t"]

    @property
    def contacts(self):
        """What happened at contacts and where friction sticks; empty for a scene without."""
        return self.json.get("contacts", [])

    @property
    def units(self):
        """The SI units of coordinates and speeds by name, of those that have one; their rates are in these over s. All
        numbers are in SI units, whatever the units of the scene; plots and printed text have those."""
        return self.json.get("units", {})

    def __getitem__(self, column):
        try:
            return self.table[:, self.columns.index(column)]
        except ValueError:
            raise KeyError(f"no column '{column}'; there are {', '.join(self.columns)}") from None

    def __call__(self, t):
        """The state at the time t between the first row and the last: coordinates, then rates (or speeds), as
        `System.rhs` takes them. For an array of times an array with one more axis. Where rates jump it is the state
        after the jump. The error is that of the rows: the motion is integrated from the row before t."""
        return self._alive().states_at(t)

    def plot(self, *columns):
        """A Figure of these columns over time; of all coordinates if none is named."""
        return Figure(self._alive().plot(list(columns)))

    def save(self, path):
        """Writes the table as CSV, or as NAME.npz (NumPy) or NAME.h5 (HDF5), as `simulate -o` does."""
        ending = _os.path.splitext(_os.fspath(path))[1].lower()
        if ending not in ("", ".csv", ".txt", ".dat", ".npz", ".h5", ".hdf5"):
            raise _alembert.ModelError(f"'{_os.fspath(path)}': a table is written; expected a name that ends in .csv, .npz, .h5")
        write(path, self._alive().file(_os.fspath(path)))

    def _repr_html_(self):
        return super()._repr_html_() + self.plot().svg

    def __repr__(self):
        return self._text if self._run is None else self._run.text()


class Swept(Result):
    """Many motions: `swept["theta1"]` is an array of the ends, in the shape of the grid; so are the varied quantities,
    "t" and "energy_drift" (or "work_balance"), and what was asked for along motions ("min_theta1"). Where "theta1" is
    varied, its end is "final_theta1". `status` is "done", "stopped" or why a motion failed, one after the other. A sweep
    that was reduced has `statistics` instead, and one that was written has its table in `file`."""

    def __init__(self, json, text, columns, table, shape):
        super().__init__(json, text)
        # The end of a quantity that is varied itself has a name of its own.
        self.columns = [f"final_{name}" if name in columns[:k] else name for k, name in enumerate(columns)]
        self.table = table
        self._shape = shape

    @property
    def statistics(self):
        """By quantity and statistic: `swept.statistics["final_theta1"]["max"]`, with the number of `motions`."""
        if "reduced" not in self.json:
            raise AttributeError("there are no statistics without reduce=…")
        return {row["name"]: {key: value for key, value in row.items() if key != "name"}
                for row in self.json["reduced"]}  # yapf: disable

    def __getitem__(self, column):
        if "reduced" in self.json or "file" in self.json:
            raise KeyError(f"no column '{column}': the rows are " +
                           ("reduced to `statistics`" if "reduced" in self.json else f"in {self.json['file']}"))
        ends = {f"final_{name}": k for k, name in enumerate(self.columns)}  # the last of a name, which may vary too
        if column not in (*self.columns, *ends):
            raise KeyError(f"no column '{column}'; there are {', '.join(self.columns)}")
        place = self.columns.index(column) if column in self.columns else ends[column]
        return self.table[:, place].reshape(self._shape)
