# SPDX-License-Identifier: GPL-2.0-or-later
"""What verbs give: JSON objects with attributes, claims with verdicts, derivations, pictures."""

import contextlib as _contextlib
import html as _html
import itertools as _itertools
import json as _json
import math as _math
import os as _os
import sys as _sys
import warnings as _warnings

from . import _alembert
from .expressions import to_sympy


class SceneWarning(UserWarning):
    """Something about a scene that is no error: redundant constraints, an inertia that no body can have."""


def warn(said):
    """Warnings of the program become warnings of the line that called the package."""
    frame, level = _sys._getframe(), 1
    while frame is not None and _os.path.dirname(frame.f_code.co_filename) == _os.path.dirname(__file__):
        frame, level = frame.f_back, level + 1
    for one in said:
        _warnings.warn(one.strip(), SceneWarning, stacklevel=level)


def write(path, content):
    """Writes bytes or text to the file of that name."""
    with open(_os.fspath(path), "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())


class SINumber(float):
    """A number that a result gives in a unit of the SI, which it knows: `at=result.coordinates` sets the same state in a
    scene whose own unit is degrees. In arithmetic it is a plain number."""

    def __new__(cls, value, unit):
        self = super().__new__(cls, value)
        self.unit = unit
        return self

    def __getnewargs__(self):
        return float(self), self.unit


def _with_units(json, units):
    """The numbers of coordinates, rates and speeds of a state know their units."""
    for kind, over in (("coordinates", ""), ("rates", "/s"), ("speeds", "")):
        values = json.get(kind)
        if not isinstance(values, dict):
            continue
        for name, value in values.items():
            if name in units and isinstance(value, float):
                unit = units[name]
                values[name] = SINumber(value, f"({unit}){over}" if over and not unit.isalpha() else unit + over)


def values_at(at):
    """`{"theta": 0.3, "m": "pi/2"}` as the NAME=VALUE of the command line."""
    def text(value):
        if isinstance(value, SINumber):
            return f"{float(value)!r} {value.unit}"
        return value if isinstance(value, str) else repr(float(value))

    return [f"{name}={text(value)}" for name, value in (at or {}).items()]


def inputs_of(given):
    """`{"u": "sin(t)"}`, or a CSV file, as the NAME=… of the command line."""
    return [f"{name}={how if isinstance(how, str) else repr(float(how)) if isinstance(how, (int, float)) else _os.fspath(how)}"
            for name, how in (given or {}).items()]


def axis(over):
    """(name, from, to) or (name, from, to, count) as the program takes it."""
    try:
        name, first, last, *count = over
        if not isinstance(name, str) or len(count) > 1:
            raise ValueError
        return [name, float(first), float(last), *map(int, count)]
    except (TypeError, ValueError):
        raise ValueError(f"{over!r}: expected (name, from, to) or (name, from, to, count)") from None


def names_in(given):
    """["A", "P"]; "A" alone, or "A,P" as the command line takes it."""
    if isinstance(given, str):
        return [one.strip() for one in given.split(",")] if given else []
    return list(given)


def numbers(**given):
    """Options as numbers, which the program checks; what is None is the scene's."""
    return {name: None if value is None else float(value) for name, value in given.items()}


def listed(words):
    """["min", 0.95], or "min,0.95", as the command line takes it."""
    return words if isinstance(words, str) else ",".join(map(str, words))


def points_of(values, grid):
    """The points of a sweep one after the other, as the program takes them, and their shape."""
    import numpy

    lists = [numpy.asarray(one, dtype=float).ravel().tolist() for one in values.values()]
    shape = tuple(map(len, lists)) if grid else (len(lists[0]) if lists else 0,)
    empty = [name for name, one in zip(values, lists) if not one]
    if empty:  # of which the program tells
        values, lists, shape = {empty[0]: ()}, [[]], (0,)
    if not grid and any(len(one) != len(lists[0]) for one in lists):
        raise ValueError("with grid=False every quantity needs as many values as the others")
    points = [x for point in (_itertools.product(*lists) if grid else zip(*lists)) for x in point]
    return {"names": list(values), "points": points}, shape


def samples_of(ranges, samples, sampling, seed):
    """The same for points that lie in ranges."""
    if not ranges:
        raise ValueError("with samples=… the values are ranges: {name: (from, to)}")
    over = [axis((name, *ends)) for name, ends in ranges.items()]
    if any(len(one) != 3 for one in over):
        raise ValueError("with samples=… every range is (from, to), without a count")
    return {"over": over, "samples": samples, "sampling": sampling, "seed": seed}, (samples,)


def _as_json(value):
    """JSON has no number for what is not finite: it becomes a text, which the program reads and refuses."""
    if isinstance(value, dict):
        return {name: _as_json(one) for name, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_as_json(one) for one in value]
    return repr(value) if isinstance(value, float) and not _math.isfinite(value) else value


def options_text(options):
    """Options as the program reads them (verbs.hpp); those that are None are left out."""
    given = {name: value for name, value in options.items() if value is not None}
    try:
        return _json.dumps(given, allow_nan=False)
    except ValueError:
        return _json.dumps(_as_json(given), allow_nan=False)


class Figure:
    """A picture. Notebooks show it; `svg` is its text, `save("file.svg")` writes it."""

    def __init__(self, svg):
        self.svg = svg

    def _repr_svg_(self):
        return self.svg

    def save(self, path):
        """Writes the picture to an SVG file."""
        _alembert.need_form(_os.fspath(path), "picture")
        write(path, self.svg)

    def __repr__(self):
        return f"Figure({len(self.svg)} characters of SVG)"


class Result:
    """A JSON object of the program: its fields are attributes, `.json` is the whole, printing shows the page that the
    command prints."""

    def __init__(self, json, text="", files=None):
        for state in (json, json.get("final")):
            if isinstance(state, dict):
                _with_units(state, json.get("units", {}))
        self.json = json
        self._text = text
        self._files = files or {}

    def __getattr__(self, name):
        json = self.__dict__.get("json", {})
        if name in json:
            return json[name]
        raise AttributeError(f"there is no '{name}' here; there are {', '.join(json)}")

    def __dir__(self):
        return [*super().__dir__(), *self.json]

    def __repr__(self):
        return self._text.rstrip("\n") or f"{type(self).__name__}({', '.join(self.json)})"

    def _repr_html_(self):
        return f"<pre>{_html.escape(repr(self))}</pre>"


class Checked(Result):
    """Claims and their verdicts."""

    @property
    def verdicts(self):
        """"proved", "refuted", "undecided" or "vacuous", in the order of the claims."""
        return [claim["verdict"] for claim in self.json["claims"]]

    def __bool__(self):
        """True if every claim is proved."""
        return all(verdict == "proved" for verdict in self.verdicts)


class Marked(Result):
    """A derivation, line by line with a verdict."""

    @property
    def statuses(self):
        """"right", "mistake", "follows" …, one for each equality in reading order."""
        return [line["status"] for line in self.json["lines"]]

    @property
    def html(self):
        """The marked derivation as a page."""
        return self._files["html"].decode()

    def save(self, path):
        """Writes the page to an HTML file."""
        _alembert.need_form(_os.fspath(path), "page")
        write(path, self.html)

    def _repr_html_(self):
        """A row for each line; `.html` is the page with the whole text."""
        def row(line):
            status, colour = line["status"].replace("_", " "), {"right": "#00664b", "mistake": "#a63c00"}.get(line["status"], "#595959")
            said = " ".join(part for part in (line.get("right") and f"correct: {line['right']}", line.get("reason")) if part)
            return (f"<tr><td>{line['line']}</td><td style='color:{colour}'><b>{status}</b></td>"
                    f"<td style='text-align:left'><code>{_html.escape(line['source'])}</code></td>"
                    f"<td style='text-align:left'>{_html.escape(said)}</td></tr>")

        rows = "".join(map(row, self.json["lines"]))
        return f"<table><tr><th>line</th><th>status</th><th>source</th><th></th></tr>{rows}</table>{super()._repr_html_()}"

    def __bool__(self):
        """True if there is no mistake."""
        return self.json["first_mistake"] is None


class Agreed(Result):
    """Formalisms that were compared: `verdict`, and how it was found."""


class Audited(Result):
    """Constraints: kinds, ranks, which are redundant or integrable."""


class Stability(Result):
    """A `verdict` about stability, with its `reason`."""


class Equilibria(Result):
    """Equilibria and steady motions, each with its coordinates and what is known of its stability."""


class Linearized(Result):
    """Matrices and eigenvalues; a notebook shows them as formulas."""

    def _repr_html_(self):
        matrices = self.json.get("matrices")
        if not isinstance(matrices, dict):
            return super()._repr_html_()
        shown = " ".join(_matrix(name, rows) for name, rows in matrices.items() if rows and rows[0])
        return f"<div>{shown}</div>{super()._repr_html_()}"


def _matrix(name, rows):
    """A matrix as MathML."""
    def entry(value):
        return f"<mtd><mn>{_html.escape(value if isinstance(value, str) else f'{value:.6g}')}</mn></mtd>"

    table = "".join(f"<mtr>{''.join(map(entry, row))}</mtr>" for row in rows)
    return (f'<math display="block"><mi>{_html.escape(name)}</mi><mo>=</mo><mrow><mo>(</mo><mtable>{table}</mtable>'
            "<mo>)</mo></mrow></math>")


class Drawn(Result):
    """A result with a picture and a table: branches of equilibria, a chart of stability, a root locus, a benchmark."""

    @property
    def figure(self):
        """The picture, a Figure."""
        if "svg" not in self._files:
            raise AttributeError("there is no picture of this")
        return Figure(self._files["svg"].decode())

    @property
    def csv(self):
        """The table as text, as `-o FILE.csv` writes it."""
        return self._files["csv"].decode()

    def _repr_html_(self):
        return self.figure.svg if "svg" in self._files else super()._repr_html_()


class Sources(Result):
    """Emitted files: `sources` has their texts by name."""

    @property
    def sources(self):
        return {name: text.decode() for name, text in self._files.items()}


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

    def __init__(self, asked):
        derived = _alembert.derive(*asked)
        json, said = derived.json()
        warn(said)
        super().__init__(_json.loads(json))
        self._asked = asked
        self._derived = derived

    def __getstate__(self):
        return {**self.__dict__, "_derived": None}

    def _alive(self):
        """The derivation in the program, which one that was pickled does not have: it is derived again."""
        if self._derived is None:
            self._derived = _alembert.derive(*self._asked)
        return self._derived

    @property
    def equations(self):
        """A list of Equation."""
        return [Equation(one["text"], one["latex"]) for one in self.json["equations"]]

    def page(self, format="text", steps=False):
        """The whole derivation as text, latex or mathml; with `steps` all that leads to the equations."""
        return self._alive().page(format, steps)

    def _repr_latex_(self):
        lines = " \\\\\n".join(one.latex for one in self.equations)
        return f"$$\\begin{{gathered}}\n{lines}\n\\end{{gathered}}$$"

    def _repr_html_(self):
        return self.page("mathml")

    def __repr__(self):
        return self.page("text")


@_contextlib.contextmanager
def progress(told):
    """Tells what the verbs of this thread do, up to twenty times a second: `told(what, part)` with the task and the part of it
    that is done, from 0 to 1. An exception that it raises ends the verb.

        with alembert.progress(lambda what, part: print(f"{what}: {part:.0%}")):
            scene.sweep({"l": numpy.linspace(1, 2, 10_000)})
    """
    before = _alembert.listen(told)
    try:
        yield
    finally:
        _alembert.listen(before)


def ask(verb, text, file, options, kind=Result):
    """The value of a verb (verbs.hpp); `options` that are None are left out."""
    json, page, said, files, _, _ = _alembert.ask(verb, text, file, options_text(options))
    warn(said)
    return kind(_json.loads(json), page, files)
