# SPDX-License-Identifier: MIT
"""Expressions of the scene language as trees: written, read, differentiated, and evaluated in 60 digits or over many states.

A tree is kept as it was drawn, so that the text that the program reads and the numbers by which it is judged have one
source and no other reader between them. `read` is for what the program answers (states, equations, conditions) alone.
"""

import re
from fractions import Fraction

import mpmath
import numpy
from mpmath import mpf

mpmath.mp.dps = 60


class Undefined(Exception):
    """A value that is not real, or none."""


class NotRead(Exception):
    """Text that this reading does not know."""


class Tree:
    """op is a number, a name, an operator or a function; `alias` prints as its text and means its tree."""

    __slots__ = ("op", "args")

    def __init__(self, op, *args):
        self.op, self.args = op, args

    def __add__(self, other):
        return add(self, tree(other))

    def __radd__(self, other):
        return add(tree(other), self)

    def __sub__(self, other):
        return add(self, negative(tree(other)))

    def __rsub__(self, other):
        return add(tree(other), negative(self))

    def __mul__(self, other):
        return times(self, tree(other))

    def __rmul__(self, other):
        return times(tree(other), self)

    def __truediv__(self, other):
        return over(self, tree(other))

    def __rtruediv__(self, other):
        return over(tree(other), self)

    def __pow__(self, other):
        return power(self, tree(other))

    def __neg__(self):
        return negative(self)

    def __str__(self):
        return write(self)

    def __eq__(self, other):
        return isinstance(other, Tree) and self.op == other.op and self.args == other.args

    def __hash__(self):
        return hash((self.op, self.args))


def number(value):
    return Tree("num", Fraction(str(value)) if isinstance(value, float) else Fraction(value))


def tree(value):
    return value if isinstance(value, Tree) else number(value)


def name(text):
    """x, x' or x''."""
    return Tree("name", text.rstrip("'"), len(text) - len(text.rstrip("'")))


def names(text):
    return [name(word) for word in text.split()]


def of(function, *args):
    return Tree(function, *[tree(a) for a in args])


def alias(text, meaning):
    return Tree("alias", text, meaning)


PI, ZERO, ONE = Tree("pi"), number(0), number(1)


def add(a, b):
    if a == ZERO:
        return b
    if b == ZERO:
        return a
    if a.op == b.op == "num":
        return number(a.args[0] + b.args[0])
    return Tree("+", *(a.args if a.op == "+" else (a,)), *(b.args if b.op == "+" else (b,)))


def negative(a):
    if a.op == "num":
        return number(-a.args[0])
    if a.op == "+":
        return Tree("+", *[negative(x) for x in a.args])
    return a.args[0] if a.op == "neg" else Tree("neg", a)


def _factors(a):
    return a.args if a.op == "*" else (a,)


def times(a, b):
    """A product; numbers are gathered in front."""
    if ZERO in (a, b):
        return ZERO
    if a.op == "neg":
        return negative(times(a.args[0], b))
    if b.op == "neg":
        return negative(times(a, b.args[0]))
    front, others = Fraction(1), []
    for f in _factors(a) + _factors(b):
        if f.op == "num":
            front *= f.args[0]
        else:
            others.append(f)
    if not others:
        return number(front)
    if front < 0:
        return negative(times(number(-front), Tree("*", *others) if len(others) > 1 else others[0]))
    if front != 1:
        others.insert(0, number(front))
    return others[0] if len(others) == 1 else Tree("*", *others)


def over(a, b):
    if a == ZERO:
        return ZERO
    if b == ONE:
        return a
    if a.op == "neg":
        return negative(over(a.args[0], b))
    if b.op == "num" and b.args[0] > 0:
        first = _factors(a)[0]
        if first.op == "num":
            rest = over(number(first.args[0] / b.args[0]), ONE)
            return times(rest, Tree("*", *a.args[1:]) if len(a.args) > 2 else a.args[1]) if a.op == "*" else rest
    return Tree("/", a, b)


def power(a, b):
    if b == ONE:
        return a
    if b == ZERO:
        return ONE
    return Tree("^", a, b)


# -- text


def _digits(value):
    """A decimal where there is a short one, else a quotient."""
    if value.denominator == 1:
        return str(value.numerator), 4
    rest = value.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    if rest == 1:
        whole, places = value, 0
        while whole.denominator != 1:
            whole, places = whole * 10, places + 1
        if places <= 12:
            text = str(abs(whole.numerator)).rjust(places + 1, "0")
            return ("-" if value < 0 else "") + text[:-places] + "." + text[-places:], 4
    return f"{value.numerator}/{value.denominator}", 2


def _write(node):
    """Text and how strongly it binds: 1 sum, 2 product, 3 power, 4 atom."""
    op, args = node.op, node.args
    if op == "num":
        text, strength = _digits(args[0])
        return (text, strength) if args[0] >= 0 else (text, 1)
    if op == "name":
        return args[0] + "'" * args[1], 4
    if op == "pi":
        return "pi", 4
    if op == "alias":
        return args[0], 4
    if op == "+":
        text = ""
        for a in args:
            part = write(a.args[0], 1.5) if a.op == "neg" else write(a, 1)
            minus = a.op == "neg"
            if part.startswith("-"):
                minus, part = not minus, part[1:]
            text += (" - " if minus else " + ") + part if text else ("-" if minus else "") + part
        return text, 1
    if op == "neg":
        return "-" + write(args[0], 1.5), 1
    if op == "*":
        return "*".join(write(a, 2) for a in args), 2
    if op == "/":
        return write(args[0], 2) + "/" + write(args[1], 2.5), 2
    if op == "^":
        return write(args[0], 3.5) + "^" + write(args[1], 3.5), 3
    return op + "(" + ", ".join(write(a) for a in args) + ")", 4


def write(node, least=0):
    text, strength = _write(node)
    return text if strength >= least else "(" + text + ")"


# -- parts


def parts(node):
    """This node and all in it; of an alias its meaning."""
    yield node
    for a in node.args:
        if isinstance(a, Tree):
            yield from parts(a)


def rebuilt(node, args):
    """The node with other children, simplified as it is built."""
    op = node.op
    if op == "+":
        total = ZERO
        for a in args:
            total = add(total, a)
        return total
    if op == "*":
        total = ONE
        for a in args:
            total = times(total, a)
        return total
    made = {"/": over, "^": power}.get(op)
    if made:
        return made(*args)
    return negative(args[0]) if op == "neg" else Tree(op, *args)


def replaced(node, change):
    """Each node as change(node) gives it, from the top; None leaves it and goes on below."""
    new = change(node)
    if new is not None:
        return new
    if node.op in ("num", "name", "pi", "alias"):
        return node
    return rebuilt(node, [replaced(a, change) for a in node.args])


def plain(node):
    """Without aliases."""
    return replaced(node, lambda n: plain(n.args[1]) if n.op == "alias" else None)


def used(node):
    """Names with their dots, {("x", 1), …}."""
    return {n.args for n in parts(node) if n.op == "name"}


SIDED = {"abs", "sign", "min", "max", "atan2", "asin", "acos"}


def _square(node):
    return node.op == "^" and node.args[1].op == "num" and node.args[1].args[0].numerator % 2 == 0


def sides(node):
    """What the cells of a tree are bounded by: expressions whose signs tell them apart."""
    found = []
    for n in parts(node):
        if n.op in ("abs", "sign"):
            found.append(n.args[0])
        elif n.op in ("min", "max"):
            found += [a - b for k, a in enumerate(n.args) for b in n.args[:k]]
        elif n.op == "pick":
            found.append(n.args[0])
        elif n.op == "atan2":
            found += list(n.args)
        elif n.op == "sqrt":
            found.append(n.args[0].args[0] if _square(n.args[0]) else n.args[0])
            found += [f.args[0] for f in (n.args[0].args if n.args[0].op == "*" else ()) if _square(f)]
        elif n.op in ("asin", "acos", "atan"):
            found += [Tree(f, m.args[0]) for m in parts(n.args[0]) if m.op in ("sin", "cos", "tan") for f in ("sin", "cos")]
    return list(dict.fromkeys(plain(f) for f in found if used(f)))


def terms(node):
    return [t for a in node.args for t in terms(a)] if node.op == "+" else [node]


# -- derivatives


def _chain(node):
    """The derivative of a function of one argument."""
    u = node.args[0]
    return {
        "sin": lambda: of("cos", u),
        "cos": lambda: -of("sin", u),
        "tan": lambda: 1 + of("tan", u) ** 2,
        "sqrt": lambda: 1 / (2 * node),
        "exp": lambda: node,
        "log": lambda: 1 / u,
        "abs": lambda: of("sign", u),
        "sign": lambda: ZERO,
        "sinh": lambda: of("cosh", u),
        "cosh": lambda: of("sinh", u),
        "tanh": lambda: 1 - of("tanh", u) ** 2,
        "atan": lambda: 1 / (1 + u**2),
        "asin": lambda: 1 / of("sqrt", 1 - u**2),
        "acos": lambda: -1 / of("sqrt", 1 - u**2),
    }[node.op]()


def derivative(node, by):
    """by is (name, dots)."""
    op, args = node.op, node.args
    if op in ("num", "pi"):
        return ZERO
    if op == "name":
        return ONE if args == by else ZERO
    if op == "alias":
        return derivative(args[1], by)
    if by not in used(node):
        return ZERO
    inner = [derivative(a, by) for a in args]
    if op == "+":
        return rebuilt(node, inner)
    if op == "neg":
        return negative(inner[0])
    if op == "*":
        total = ZERO
        for k, d in enumerate(inner):
            total = total + rebuilt(node, args[:k] + (d,) + args[k + 1 :])
        return total
    if op == "/":
        first = over(inner[0], args[1])
        return first - args[0] * inner[1] / args[1] ** 2
    if op == "^":
        if inner[1] == ZERO:
            return args[1] * args[0] ** (args[1] - 1) * inner[0]
        return node * (inner[1] * of("log", args[0]) + args[1] * inner[0] / args[0])
    if op in ("max", "min"):
        best, slope = args[0], inner[0]
        for a, d in zip(args[1:], inner[1:]):
            way = best - a if op == "max" else a - best
            best, slope = Tree(op, best, a), Tree("pick", way, slope, d)
        return slope
    if op == "pick":
        return Tree("pick", args[0], inner[1], inner[2])
    if op == "atan2":
        return (args[1] * inner[0] - args[0] * inner[1]) / (args[0] ** 2 + args[1] ** 2)
    return _chain(node) * inner[0]


def rate(node, coordinates, inputs=None):
    """d/dt: of coordinates, rates and t."""
    total = derivative(node, ("t", 0))
    for q in coordinates:
        for dots in (0, 1):
            total = total + derivative(node, (q, dots)) * Tree("name", q, dots + 1)
    return total


# -- numbers


def _real(function):
    def guarded(*args):
        try:
            value = function(*args)
        except (ZeroDivisionError, ValueError, OverflowError):
            raise Undefined from None
        if not isinstance(value, mpf):
            raise Undefined
        return value

    return guarded


def _mp_power(a, b):
    if b == int(b):
        return a ** int(b)
    if a < 0:
        raise Undefined
    return a**b


def _mp_divide(a, b):
    return a / b


IN_MP = {
    "sin": mpmath.sin,
    "cos": mpmath.cos,
    "tan": mpmath.tan,
    "exp": mpmath.exp,
    "sinh": mpmath.sinh,
    "cosh": mpmath.cosh,
    "tanh": mpmath.tanh,
    "atan": mpmath.atan,
    "abs": abs,
    "sign": lambda u: mpf((u > 0) - (u < 0)),
    "min": min,
    "max": max,
    "atan2": _real(mpmath.atan2),
    "sqrt": _real(mpmath.sqrt),
    "log": _real(mpmath.log),
    "asin": _real(mpmath.asin),
    "acos": _real(mpmath.acos),
    "power": _real(_mp_power),
    "divide": _real(_mp_divide),
    "pick": lambda g, a, b: a if g > 0 else b,
}


def _np_power(a, b):
    return numpy.power(a, b)


IN_NUMPY = {
    "sin": numpy.sin,
    "cos": numpy.cos,
    "tan": numpy.tan,
    "exp": numpy.exp,
    "sinh": numpy.sinh,
    "cosh": numpy.cosh,
    "tanh": numpy.tanh,
    "atan": numpy.arctan,
    "abs": numpy.abs,
    "sign": numpy.sign,
    "atan2": numpy.arctan2,
    "sqrt": numpy.sqrt,
    "log": numpy.log,
    "asin": numpy.arcsin,
    "acos": numpy.arccos,
    "power": _np_power,
    "divide": numpy.divide,
    "pick": lambda g, a, b: numpy.where(g > 0, a, b),
    "min": lambda *a: numpy.minimum.reduce(numpy.broadcast_arrays(*a)),
    "max": lambda *a: numpy.maximum.reduce(numpy.broadcast_arrays(*a)),
}


class Compiled:
    """Trees as one function of a state {(name, dots): value}; the same subtree is evaluated once."""

    def __init__(self, trees):
        self.trees = [plain(t) for t in trees]
        self.lines, self.seen, self.constants = [], {}, {}
        results = [self._code(t) for t in self.trees]
        body = "".join(f"    {line}\n" for line in self.lines)
        self.source = f"def made(s):\n{body}    return [{', '.join(results)}]\n"
        self.made = {}

    def _code(self, node):
        if node in self.seen:
            return self.seen[node]
        op, args = node.op, node.args
        if op == "num":
            text = f"c{len(self.constants)}"
            self.constants[text] = args[0]
            self.seen[node] = text
            return text
        if op == "name":
            text = f"s[{args!r}]"
        elif op == "pi":
            text = "pi"
        else:
            inner = [self._code(a) for a in args]
            if op in "+*":
                text = op.join(inner)
            elif op == "neg":
                text = "-" + inner[0]
            elif op == "/":
                text = f"divide({inner[0]}, {inner[1]})"
            elif op == "^":
                whole = args[1].op == "num" and args[1].args[0].denominator == 1 and args[1].args[0] > 0
                text = f"{inner[0]}**{args[1].args[0]}" if whole else f"power({inner[0]}, {inner[1]})"
            else:
                text = f"{op}({', '.join(inner)})"
        variable = f"v{len(self.lines)}"
        self.lines.append(f"{variable} = {text}")
        self.seen[node] = variable
        return variable

    def _function(self, kind):
        key = kind, mpmath.mp.dps
        if key not in self.made:
            space = dict(IN_MP if kind == "mp" else IN_NUMPY)
            if kind == "mp":
                space["pi"] = +mpmath.pi
                space.update({k: mpf(v.numerator) / v.denominator for k, v in self.constants.items()})
            else:
                space["pi"] = numpy.pi
                space.update({k: numpy.float64(v) for k, v in self.constants.items()})
            exec(self.source, space)  # noqa: S102, of trees that were drawn here
            self.made[key] = space["made"]
        return self.made[key]

    def mp(self, state):
        try:
            values = self._function("mp")(state)
        except (OverflowError, ZeroDivisionError):
            raise Undefined from None
        for value in values:
            if not isinstance(value, (mpf, int)) or not mpmath.isfinite(value):
                raise Undefined
        return [mpf(v) for v in values]

    def many(self, states, count):
        with numpy.errstate(all="ignore"):
            return [numpy.broadcast_to(numpy.asarray(v, dtype=float), (count,)) for v in self._function("np")(states)]


def value(node, state=None):
    return Compiled([node]).mp(state or {})[0]


# -- reading what the program answers

_TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?)|([^\W\d]\w*'*)|(\S))")


class _Reader:
    def __init__(self, text, known):
        self.tokens, at, text = [], 0, text.replace("\u2248", " ").strip()
        while at < len(text):
            found = _TOKEN.match(text, at)
            if not found:
                raise NotRead(text)
            self.tokens.append(found.groups())
            at = found.end()
        self.at, self.known, self.text = 0, known, text

    def sign(self):
        return self.tokens[self.at][2] if self.at < len(self.tokens) else None

    def take(self, wanted):
        if self.sign() != wanted:
            raise NotRead(f"{wanted} is missing in {self.text}")
        self.at += 1

    def sum(self):
        total = self.product()
        while self.sign() in ("+", "-"):
            sign = self.sign()
            self.at += 1
            other = self.product()
            total = total + other if sign == "+" else total - other
        return total

    def product(self):
        if self.sign() in ("-", "+"):
            sign = self.sign()
            self.at += 1
            return -self.product() if sign == "-" else self.product()
        total = self.factor()
        while self.sign() in ("*", "/"):
            sign = self.sign()
            self.at += 1
            other = self.factor()
            total = total * other if sign == "*" else total / other
        return total

    def factor(self):
        if self.sign() == "-":
            self.at += 1
            return -self.factor()
        base = self.atom()
        if self.sign() == "^":
            self.at += 1
            return base ** self.factor()
        return base

    def atom(self):
        if self.at >= len(self.tokens):
            raise NotRead(self.text)
        digits, word, sign = self.tokens[self.at]
        self.at += 1
        if digits:
            degrees = self.tokens[self.at : self.at + 1] and (self.tokens[self.at][1] == "deg" or self.sign() == "\u00b0")
            self.at += bool(degrees)
            return Tree("num", Fraction(digits)) * (PI / 180 if degrees else ONE)
        if word and self.sign() == "(":
            self.at += 1
            args = [self.sum()]
            while self.sign() == ",":
                self.at += 1
                args.append(self.sum())
            self.take(")")
            if word in IN_MP and word not in ("power", "divide", "pick"):
                return Tree(word, *args)
            raise NotRead(word)
        if word == "pi":
            return PI
        if word:
            return self.known(word) if self.known else name(word)
        if sign == "(":
            inner = self.sum()
            self.take(")")
            if self.tokens[self.at : self.at + 1] and self.tokens[self.at][2] == "'":
                raise NotRead("a derivative of parentheses")
            return inner
        raise NotRead(self.text)


def read(text, known=None):
    """The tree of a text; known(word) gives the tree of a name, or throws."""
    reader = _Reader(text, known)
    result = reader.sum()
    if reader.at != len(reader.tokens):
        raise NotRead(text)
    return result


def read_equation(text, known=None):
    left, _, right = text.partition("=")
    return read(left, known), read(right, known) if right else ZERO


def read_conditions(text, known=None):
    """e > f, e <= f, e != f, e < f < g … as trees that are positive where it holds (or zero at its edge)."""
    pieces = re.split(r"(<=|>=|!=|<|>)", text)
    if len(pieces) < 3:
        raise NotRead(text)
    found = []
    for left, sign, right in zip(pieces[::2], pieces[1::2], pieces[2::2]):
        a, b = read(left, known), read(right, known)
        found.append(of("abs", a - b) if sign == "!=" else a - b if sign[0] == ">" else b - a)
    return found
