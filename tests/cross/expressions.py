# SPDX-License-Identifier: MIT
"""Expressions of the scene language in numbers of 60 digits, with their first and second derivatives.

A text is turned into a Python expression over the names of an environment. Its value may be a Jet: a number with its
gradient and its second derivatives by variables that are counted from 0. This is a second reading of the language, which
shares nothing with the program.
"""

import re

import mpmath
from mpmath import mpf

mpmath.mp.dps = 60


class NotRead(Exception):
    """The text holds something that this reading does not know."""


class Jet:
    """Value, gradient {i: d/dx_i} and second derivatives {(i, j): d2/dx_i dx_j, i <= j}; what is missing is 0."""

    __slots__ = ("value", "first", "second")

    def __init__(self, value, first=None, second=None):
        self.value = value
        self.first = first or {}
        self.second = second or {}

    @staticmethod
    def variable(value, index):
        return Jet(mpf(value), {index: mpf(1)})

    def through(self, value, slope, bend):
        """f of this, from f, f' and f'' at its value."""
        first = {i: slope * d for i, d in self.first.items()}
        second = {key: slope * d for key, d in self.second.items()}
        if bend:
            indices = sorted(self.first)
            for at, i in enumerate(indices):
                for j in indices[at:]:
                    second[i, j] = second.get((i, j), 0) + bend * self.first[i] * self.first[j]
        return Jet(value, first, second)

    def __neg__(self):
        return self.through(-self.value, mpf(-1), 0)

    def __add__(self, other):
        other = jet(other)
        return Jet(self.value + other.value, _sum(self.first, other.first), _sum(self.second, other.second))

    __radd__ = __add__

    def __sub__(self, other):
        return self + -jet(other)

    def __rsub__(self, other):
        return jet(other) + -self

    def __mul__(self, other):
        other = jet(other)
        first, second = {}, {}
        for a, b in ((self, other), (other, self)):
            for i, d in a.first.items():
                first[i] = first.get(i, 0) + d * b.value
            for key, d in a.second.items():
                second[key] = second.get(key, 0) + d * b.value
        for i, a in self.first.items():
            for j, b in other.first.items():
                key = (i, j) if i <= j else (j, i)
                second[key] = second.get(key, 0) + (2 * a * b if i == j else a * b)
        return Jet(self.value * other.value, first, second)

    __rmul__ = __mul__

    def __truediv__(self, other):
        return self * jet(other) ** -1

    def __rtruediv__(self, other):
        return jet(other) * self ** -1

    def __pow__(self, power):
        power = jet(power)
        if power.first:
            return exp(power * log(self))
        p, x = power.value, self.value
        if p == 0:
            return Jet(mpf(1))
        whole = p == int(p)
        raised = (lambda n: x ** int(n)) if whole else (lambda n: x ** n)
        bend = p * (p - 1)
        return self.through(raised(p), p * raised(p - 1) if p != 1 else mpf(1), bend * raised(p - 2) if bend else 0)

    def __rpow__(self, base):
        return jet(base) ** self


def _sum(a, b):
    total = dict(a)
    for key, d in b.items():
        total[key] = total.get(key, 0) + d
    return total


def jet(value):
    return value if isinstance(value, Jet) else Jet(mpf(value))


def _of(f, slope, bend):
    def applied(x):
        x = jet(x)
        return x.through(f(x.value), slope(x.value), bend(x.value) if x.first else 0)

    return applied


sin = _of(mpmath.sin, mpmath.cos, lambda x: -mpmath.sin(x))
cos = _of(mpmath.cos, lambda x: -mpmath.sin(x), lambda x: -mpmath.cos(x))
tan = _of(mpmath.tan, lambda x: mpmath.sec(x) ** 2, lambda x: 2 * mpmath.tan(x) * mpmath.sec(x) ** 2)
asin = _of(mpmath.asin, lambda x: (1 - x * x) ** mpf(-0.5), lambda x: x * (1 - x * x) ** mpf(-1.5))
acos = _of(mpmath.acos, lambda x: -((1 - x * x) ** mpf(-0.5)), lambda x: -x * (1 - x * x) ** mpf(-1.5))
atan = _of(mpmath.atan, lambda x: 1 / (1 + x * x), lambda x: -2 * x / (1 + x * x) ** 2)
sinh = _of(mpmath.sinh, mpmath.cosh, mpmath.sinh)
cosh = _of(mpmath.cosh, mpmath.sinh, mpmath.cosh)
tanh = _of(mpmath.tanh, lambda x: mpmath.sech(x) ** 2, lambda x: -2 * mpmath.tanh(x) * mpmath.sech(x) ** 2)
exp = _of(mpmath.exp, mpmath.exp, mpmath.exp)
log = _of(mpmath.log, lambda x: 1 / x, lambda x: -1 / x**2)
sqrt = _of(mpmath.sqrt, lambda x: 1 / (2 * mpmath.sqrt(x)), lambda x: -1 / (4 * mpmath.sqrt(x) ** 3))
absolute = _of(abs, mpmath.sign, lambda x: mpf(0))
sign = _of(mpmath.sign, lambda x: mpf(0), lambda x: mpf(0))


def least(*values):
    return min((jet(v) for v in values), key=lambda v: v.value)


def greatest(*values):
    return max((jet(v) for v in values), key=lambda v: v.value)


FUNCTIONS = {"sin": sin, "cos": cos, "tan": tan, "asin": asin, "acos": acos, "atan": atan, "sinh": sinh, "cosh": cosh,
             "tanh": tanh, "exp": exp, "log": log, "sqrt": sqrt, "abs": absolute, "sign": sign, "min": least,
             "max": greatest}

_TOKEN = re.compile(r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|(?P<name>[^\W\d]\w*)(?P<primes>'*)"
                    r"|(?P<other>[-+*/^(),]))")
_read = {}


def _python(text, tables):
    """The Python of an expression; names are looked up as n['x', dots], numbers are read in all their digits."""
    out, at = [], 0
    text = text.strip()
    while at < len(text):
        match = _TOKEN.match(text, at)
        if not match:
            raise NotRead(f"{text[at:at + 10]!r} in {text!r}")
        at = match.end()
        if match["number"]:
            out.append(f"number('{match['number']}')")
        elif match["name"]:
            is_call = text[at:].lstrip().startswith("(")
            if is_call and match["name"] not in FUNCTIONS and match["name"] not in tables:
                raise NotRead(f"{match['name']}(…) in {text!r}")
            out.append(f"f['{match['name']}']" if is_call else f"n['{match['name']}', {len(match['primes'])}]")
        else:
            out.append("**" if match["other"] == "^" else match["other"])
    return " ".join(out)


def evaluate(text, names):
    """The Jet of an expression; names[name, dots] gives that of a name. Throws NotRead, and KeyError for a name."""
    text = str(text)
    tables = getattr(names, "tables", {})
    if text not in _read or tables:
        _read[text] = compile(_python(text, tables), text, "eval")
    return jet(eval(_read[text], {"f": {**FUNCTIONS, **tables}, "n": names, "number": lambda digits: Jet(mpf(digits))}))
