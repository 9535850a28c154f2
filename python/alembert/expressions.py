# SPDX-License-Identifier: GPL-2.0-or-later
"""Expressions and equations of a scene as SymPy's, and back.

    to_sympy("m*l^2*theta'' + m*g*l*sin(theta) = 0")     # sympy.Eq; theta is Function("theta")(t)
    from_sympy(equation)                                  # "m*l^2*theta'' + … = 0", a valid claim

A name that has a prime somewhere in the text is a function of t; `functions` names others that are. A function that
the scene leaves open, V(r), is an undefined function of SymPy, and diff(V(r), r) its derivative.
"""

import re

from . import _alembert

_TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|([^\W\d]\w*)('*)|([-+*/^(),=]))")
_RENAMED = {"asin": "asin", "acos": "acos", "abs": "Abs", "min": "Min", "max": "Max"}
_LANGUAGE = {"Abs": "abs", "Min": "min", "Max": "max"}
_FUNCTIONS = "sin cos tan asin acos atan atan2 sinh cosh tanh exp log sqrt abs min max sign".split()


class _Parser:
    def __init__(self, text, functions):
        import sympy

        self.sympy = sympy
        self.t = sympy.Symbol("t")
        self.tokens, at = [], 0
        while text[at:].strip():
            match = _TOKEN.match(text, at)
            if not match:
                raise ValueError(f"cannot read {text[at:at + 20]!r} in {text!r}")
            self.tokens.append(match)
            at = match.end()
        self.functions = {functions} if isinstance(functions, str) else set(functions)
        self.functions |= {m[2] for m in self.tokens if m[3]}
        self.position = 0

    def symbol(self):
        return self.tokens[self.position][4] if self.position < len(self.tokens) else None

    def take(self, *wanted):
        if self.symbol() in wanted and self.symbol() is not None:
            self.position += 1
            return self.tokens[self.position - 1][4]
        return None

    def expect(self, wanted):
        if not self.take(wanted):
            found = self.tokens[self.position][0].strip() if self.position < len(self.tokens) else "the end"
            raise ValueError(f"expected '{wanted}', found {found!r}")

    def sum(self):
        value = self.product()
        while sign := self.take("+", "-"):
            other = self.product()
            value = value + other if sign == "+" else value - other
        return value

    def product(self):
        value = self.signed()
        while sign := self.take("*", "/"):
            other = self.signed()
            value = value * other if sign == "*" else value / other
        return value

    def signed(self):
        if self.take("-"):
            return -self.signed()
        if self.take("+"):
            return self.signed()
        return self.power()

    def power(self):
        base = self.atom()
        return base ** self.signed() if self.take("^") else base

    def atom(self):
        if self.position >= len(self.tokens):
            raise ValueError("the expression ends too early")
        if self.take("("):
            value = self.sum()
            self.expect(")")
            return value
        number, name, primes, other = self.tokens[self.position].groups()
        if other:
            raise ValueError(f"a number, a name or '(' was expected, found {other!r}")
        self.position += 1
        if number:
            return self.sympy.Rational(number)
        if self.symbol() == "(" and not primes:
            return self.call(name)
        if name == "pi":
            return self.sympy.pi
        if name == "t":
            return self.t
        if name in self.functions:
            value = self.sympy.Function(name)(self.t)
            return value.diff(self.t, len(primes)) if primes else value
        return self.sympy.Symbol(name)


    def call(self, name):
        """A known function, a partial derivative diff(f(x), x), or a function that the scene leaves open."""
        self.expect("(")
        arguments = [self.sum()]
        while self.take(","):
            arguments.append(self.sum())
        self.expect(")")
        if name == "diff":
            return self.sympy.Derivative(*arguments)
        if name in _FUNCTIONS:
            return getattr(self.sympy, _RENAMED.get(name, name))(*arguments)
        advice = "" if name in self.functions else _alembert.advice_on_function(name)
        if advice:
            raise ValueError(f"the scene language has no function '{name}'; {advice}")
        return self.sympy.Function(name)(*arguments)


def to_sympy(text, functions=()):
    """`text`, an expression or an equation of the scene language, as SymPy's, in all spellings that a scene may have
    ("ln(x)", "x²", "arcsin(x)"). Decimals become exact rationals.

    Raises ValueError for a text that is none (vector functions and primes of parentheses are not read), and for a function
    that the scene language does not have (asinh, log10, cot …).
    """
    parser = _Parser(_alembert.in_words_of_scenes(text), functions)
    value = parser.sum()
    if parser.take("="):
        value = parser.sympy.Eq(value, parser.sum(), evaluate=False)
    if parser.position != len(parser.tokens):
        raise ValueError(f"cannot read {parser.tokens[parser.position][0]!r} in {text!r}")
    return value


def _check_language(value):
    """Throws where a part of a SymPy expression has no word in the scene language."""
    import sympy

    def refuse(part, why):
        raise ValueError(f"{part}: {why}")

    known = (sympy.Symbol, sympy.Rational, sympy.Float, sympy.Add, sympy.Mul, sympy.Pow, sympy.Derivative, sympy.Tuple,
             type(sympy.pi), type(sympy.E))  # yapf: disable
    if value in (sympy.true, sympy.false):
        refuse(value, "this is no equation; Eq(…, …, evaluate=False) keeps one that holds for all values, or for none")
    for part in sympy.preorder_traversal(value):
        if not isinstance(part, sympy.Basic):
            refuse(part, "the scene language has no words for this")
        kind = part.func.__name__
        is_open = isinstance(part, sympy.core.function.AppliedUndef)
        if isinstance(part, sympy.core.relational.Relational):
            if not isinstance(part, sympy.Eq):
                refuse(part, "an inequality cannot be written as an equation")
            if part is not value:
                refuse(part, "an equation cannot stand within an expression")
        elif (is_open or isinstance(part, sympy.Symbol)) and not re.fullmatch(
                r"[^\W\d]\w*", kind if is_open else part.name):
            refuse(part, "a name of the scene language has letters, digits and _ alone")
        elif isinstance(part, (sympy.Function, sympy.core.operations.LatticeOp)) and not is_open:
            if _LANGUAGE.get(kind, kind) not in _FUNCTIONS:
                refuse(part, f"the scene language has no {kind}")
        elif not is_open and not isinstance(part, known) or part is sympy.nan:
            refuse(part, "the scene language has no words for this")


def from_sympy(value):
    """A SymPy expression or equation in the scene language. Functions of t lose their argument: theta(t) is theta.

    Raises ValueError for what the language does not have, such as inequalities and cases.
    """
    import sympy
    from sympy.printing.str import StrPrinter

    value = sympy.sympify(value)
    _check_language(value)

    class Printer(StrPrinter):
        def _print_Function(self, e):
            name = e.func.__name__
            if e.args == (sympy.Symbol("t"),) and isinstance(e, sympy.core.function.AppliedUndef):
                return name
            return f"{_LANGUAGE.get(name, name)}({self.stringify(e.args, ', ')})"

        def _print_Float(self, e):
            return repr(float(e)) if e._prec == 53 else super()._print_Float(e)

        def _print_Exp1(self, e):
            return "exp(1)"

        _print_Abs = _print_Min = _print_Max = _print_Function
        _print_LatticeOp = _print_Function

        def _print_Derivative(self, e):
            text = self._print(e.expr)
            for variable, order in e.variable_count:
                if variable == sympy.Symbol("t") and re.fullmatch(r"\w+'*", text):
                    text += "'" * int(order)
                    continue
                for _ in range(int(order)):
                    text = f"diff({text}, {self._print(variable)})"
            return text

        def _print_Pow(self, e, rational=False):
            return super()._print_Pow(e, rational).replace("**", "^")

        def _print_Relational(self, e):
            return f"{self._print(e.lhs)} = {self._print(e.rhs)}"

    return Printer().doprint(value)
