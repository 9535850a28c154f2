# SPDX-License-Identifier: MIT
"""Reads the functions of an emitted file of Julia or Modelica by the grammars of these languages, as far as such a file uses
them, and evaluates them: for machines that have neither.

    straight_line.py julia double_pendulum.jl calls.txt      # prints the results of the calls
    straight_line.py modelica double_pendulum.mo calls.txt

A call is a line: the function, then the arguments; numbers in brackets are an array, and = before a name stands for the
array of results of an earlier line of that name. What the grammar does not have, a name that is used before it has a value,
one that is not declared (Modelica), and a word that the language reserves as a name are mistakes."""

import math
import re
import sys

TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:e[+-]?\d+)?)|([A-Za-z_]\w*!?)|(:=|<=|>=|==|<>|[-+*/^()\[\]{},;:=<>&.]))", re.ASCII)
RESERVED = {
    "julia": """abstract baremodule begin break catch const continue do else elseif end export false finally for function
        global if import let local macro module mutable primitive quote return struct true try type using while where in isa""",
    "modelica": """algorithm and annotation block break class connect connector constant constrainedby der discrete each
        else elseif elsewhen encapsulated end enumeration equation expandable extends external false final flow for function if
        import impure in initial inner input loop model not operator or outer output package parameter partial protected public
        pure record redeclare replaceable return stream then true type when while within""",
}
NAN = float("nan")


def outside(condition, value):
    return NAN if condition else value()


class Beyond(Exception):
    """An assertion of Modelica does not hold: where C has no number."""


def held(condition):
    if not condition:
        raise Beyond


def power(x, y):
    return outside(x < 0 and y != math.floor(y), lambda: x**y)


FUNCTIONS = {name: getattr(math, name) for name in "sin cos tan atan sinh cosh tanh exp".split()}
FUNCTIONS |= {
    "abs": abs, "min": lambda x, y: y if y < x or y != y else x, "max": lambda x, y: y if x < y or y != y else x, "sign": lambda x: x if x != x else (x > 0) - (x < 0), "floor": math.floor,
    "ifelse": lambda c, a, b: a if c else b, "root_or_nan": lambda x: outside(x < 0, lambda: math.sqrt(x)),
    "log_or_nan": lambda x: outside(x < 0, lambda: math.log(x) if x else -math.inf),
    "asin_or_nan": lambda x: outside(abs(x) > 1, lambda: math.asin(x)),
    "acos_or_nan": lambda x: outside(abs(x) > 1, lambda: math.acos(x)), "pow_or_nan": power, "pow": power,
    "sqrt": lambda x: outside(x < 0, lambda: math.sqrt(x)), "log": lambda x: outside(x < 0, lambda: math.log(x)),
    "asin": lambda x: outside(abs(x) > 1, lambda: math.asin(x)), "acos": lambda x: outside(abs(x) > 1, lambda: math.acos(x)),
    "atan2": math.atan2, "zeros": lambda n: [0.0] * int(n), "assert": lambda condition: held(condition),
    "promote_type": lambda *types: float, "typeof": lambda x: float, "eltype": lambda x: float,
    "table_place": lambda at, x: min(max(sum(knot <= x for knot in at) - 1, 0), len(at) - 2),
}  # fmt: skip
FUNCTIONS_OF = {"julia": FUNCTIONS | {"atan": lambda y, *x: math.atan2(y, *x) if x else math.atan(y),
                                   "zeros": lambda of, n=None: [0.0] * int(of if n is None else n)}}


class Text:
    """Tokens of a text, and expressions as functions of the values of names."""

    def __init__(self, text, language, known):
        self.tokens, self.at, self.language, self.known = [], 0, language, known
        place = 0
        text = text.rstrip()
        while place < len(text):
            found = TOKEN.match(text, place)
            if not found:
                raise SyntaxError(f"{text[place:place + 40]!r} is no text of {language}")
            self.tokens.append(found.group().strip())
            place = found.end()

    def next(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self, token=None):
        found = self.next()
        if token is not None and found != token:
            raise SyntaxError(f"{token!r} is expected, not {found!r}, in {' '.join(self.tokens)[:200]}")
        self.at += 1
        return found

    def name(self):
        word = self.take()
        if not re.fullmatch(r"[A-Za-z_]\w*!?", word) or word in RESERVED[self.language].split():
            raise SyntaxError(f"{word!r} is no name")
        return word

    def list(self, end):
        items = []
        while self.next() != end:
            items.append(self.expression())
            if self.next() != end:
                self.take(",")
        self.take(end)
        return items

    def expression(self):
        if self.language == "modelica" and self.next() == "if":
            self.take()
            condition = self.expression()
            self.take("then")
            first = self.expression()
            self.take("else")
            other = self.expression()
            return lambda v: first(v) if condition(v) else other(v)
        value = self.relation()
        both = "and" if self.language == "modelica" else "&"
        while self.next() == both:
            self.take()
            left, right = value, self.relation()
            value = lambda v, left=left, right=right: left(v) and right(v)
        return value

    def relation(self):
        left = self.sum()
        if self.next() in ("<", ">", "<=", ">="):
            sign, right = self.take(), self.sum()
            test = {"<": "__lt__", ">": "__gt__", "<=": "__le__", ">=": "__ge__"}[sign]
            return lambda v: getattr(float(left(v)), test)(float(right(v)))
        return left

    def sum(self):
        sign = self.take() if self.next() == "-" else "+"
        first = self.product()
        value = (lambda v: -first(v)) if sign == "-" else first
        while self.next() in ("+", "-"):
            sign, left, right = self.take(), value, self.product()
            if sign == "+":
                value = lambda v, left=left, right=right: left(v) + right(v)
            else:
                value = lambda v, left=left, right=right: left(v) - right(v)
        return value

    def product(self):
        value = self.factor()
        while self.next() in ("*", "/"):
            sign, left, right = self.take(), value, self.factor()
            if sign == "*":
                value = lambda v, left=left, right=right: left(v) * right(v)
            else:
                value = lambda v, left=left, right=right: self.divided(left(v), right(v))
        return value

    @staticmethod
    def divided(x, y):
        return x / y if y else NAN if not x else math.copysign(math.inf, x)

    def factor(self):
        token = self.next()
        if token == "(":
            self.take()
            value = self.expression()
            self.take(")")
            return value
        if token[:1].isdigit():
            number = float(self.take())
            return lambda v: number
        name = self.name()
        if self.next() == "(":
            self.take()
            arguments = self.list(")")
            return lambda v: self.known[name](*[a(v) for a in arguments])
        if self.next() == "[":
            self.take()
            at = self.expression()
            self.take("]")
            return lambda v: v[name][place(at(v))]
        if self.language == "julia" and name in ("pi", "NaN"):
            return lambda v: math.pi if name == "pi" else NAN
        return lambda v: v[name]


def place(number):
    if number != int(number) or number < 1:
        raise IndexError(f"there is no place {number}")
    return int(number) - 1


def statement(text, sign):
    """Names, or a place in an array, and what they get."""
    targets = []
    start = text.at
    if sign not in text.tokens:
        value = text.expression()
        return lambda v: value(v)
    while True:
        name, at = text.name(), None
        if text.next() == "[":
            text.take()
            at = text.expression()
            if text.next() == ":":
                text.take()
                text.expression()
            text.take("]")
        targets.append((name, at))
        if text.take() == sign:
            break
        text.at -= 1
        text.take(",")
    values = [text.expression()]
    while text.next() == ",":
        text.take()
        values.append(text.expression())
    assert start < text.at and len(values) == len(targets), "as many values as names"

    def run(v):
        for (name, at), value in zip(targets, [value(v) for value in values]):
            if at is None:
                v[name] = list(value) if isinstance(value, list) else value
            elif isinstance(value, list):
                v[name][: len(value)] = value
            else:
                v[name][place(at(v))] = value

    return run


def ended(text):
    if text.next():
        raise SyntaxError(f"{text.next()!r} follows a statement")


def lists_of(language, text):
    """The constants of a file that are lists of numbers, or numbers."""
    shape = {"julia": r"^const (\w+) = (?:Float64|Int)\[([^\]]*)\]", "modelica": r"^constant \w+ (\w+)\[\d+\] = \{([^}]*)\};"}
    return {name: [float(x) for x in numbers.replace("\n", " ").split(",") if x.strip()]
            for name, numbers in re.findall(shape[language], text, re.M)}  # fmt: skip


def functions_of_julia(text, known, constants):
    functions = {}
    for name, arguments, body in re.findall(r"^function (\w+!?)\(([^)]*)\)\n(.*?)^end$", text, re.M | re.S):
        if name == "defaults":
            continue
        lines, whole = [], ""
        for line in body.splitlines():
            line = line.split("#")[0].rstrip()
            whole += " " + line
            if whole.count("[") != whole.count("]"):
                raise SyntaxError(f"a new row begins in {line.strip()!r}")
            if whole.count("(") == whole.count(")") and whole.strip():
                lines.append(whole.strip())
                whole = ""
        takes, steps, result = arguments.split(", "), [], None
        for line in lines:
            if line.startswith("return"):
                if line != "return nothing":
                    one = Text(line.removeprefix("return "), "julia", known)
                    result = one.expression()
                    ended(one)
                continue
            one = Text(line, "julia", known)
            steps.append(statement(one, "="))
            ended(one)

        def call(*values, takes=takes, steps=steps, result=result):
            v = dict(constants) | dict(zip(takes, values, strict=True))
            for step in steps:
                step(v)
            return result(v) if result else None

        functions[name] = known[name] = call
    if re.search(r"^prepare!\(par\) = nothing$", text, re.M):
        functions["prepare!"] = lambda par: None
    return functions


def functions_of_modelica(text, known, constants):
    functions = {}
    for name, declared, body in re.findall(r"^function (\w+)\n(.*?)^algorithm\n(.*?)^end \1;$", text, re.M | re.S):
        if name in ("pow", "table_place", "defaults"):
            continue
        body = re.sub(r"//.*", "", body)
        body = re.sub(r'assert\((.*), "[^"]*"\);', r"assert(\1);", body)
        variables = {}
        takes, gives = [], []
        for kind, names in re.findall(r"^    ((?:input |output )?(?:Real|Integer)) ([^;]*);", declared, re.M):
            for one, size in re.findall(r"(\w+)(\[\d+\])?", names):
                if one in variables or one in RESERVED["modelica"].split():
                    raise SyntaxError(f"{one} is declared twice, or reserved, in {name}")
                variables[one] = [NAN] * int(size[1:-1]) if size else NAN
                if kind.startswith("input"):
                    takes.append(one)
                if kind.startswith("output"):
                    gives.append(one)
        steps = []
        for line in body.replace("\n", " ").split(";"):
            if not line.strip():
                continue
            one = Text(line, "modelica", known)
            steps.append(statement(one, ":="))
            ended(one)
            for used in one.tokens:
                if re.fullmatch(r"[A-Za-z_]\w*", used) and used not in variables and used not in known \
                        and used not in constants and used not in ("if", "then", "else", "and"):  # fmt: skip
                    raise SyntaxError(f"{used} is not declared in {name}")

        def call(*values, takes=takes, gives=gives, variables=variables, steps=steps):
            v = dict(constants) | {k: list(x) if isinstance(x, list) else x for k, x in variables.items()}
            v |= dict(zip(takes, values, strict=True))
            try:
                for step in steps:
                    step(v)
            except Beyond:
                return NAN
            return v[gives[0]] if len(gives) == 1 else tuple(v[one] for one in gives)

        functions[name] = known[name] = call
    return functions


def main(language, file, calls):
    text = open(file, encoding="utf-8").read()
    known = dict(FUNCTIONS_OF.get(language, FUNCTIONS))
    if language == "modelica":
        known["pow"] = power
    constants = lists_of(language, text)
    read = functions_of_julia if language == "julia" else functions_of_modelica
    functions = read(text, known, constants)
    earlier = {}
    for line in open(calls, encoding="utf-8"):
        name, to, sizes, *arguments = line.split("|")
        values = [earlier[a.strip()[1:]] if a.strip().startswith("=")
                  else [float(x) for x in a.strip()[1:-1].split()] if a.strip().startswith("[") else float(a)
                  for a in arguments]  # fmt: skip
        sizes = [int(size) for size in sizes.split()]
        if language == "julia":
            results = [[0.0] * size for size in sizes]
            if name == "prepare":
                results = [values[0] + [0.0] * (sizes[0] - len(values[0]))]
                functions["prepare!"](results[0])
            else:
                functions[name + "!"](*results, *values[1:], values[0])
        else:
            results = functions[name](*values)
            results = list(results) if isinstance(results, tuple) else [results]
        earlier[to] = results[0]
        if name != "prepare":
            print(" ".join(repr(float(x)) for result in results for x in result))


if __name__ == "__main__":
    main(*sys.argv[1:])
