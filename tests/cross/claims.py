# SPDX-License-Identifier: MIT
"""Claims about a scene, right and made wrong, and whether they hold: an evaluation in 60 digits on its own branch."""

import random
import re

from mpmath import mpf

from expressions import NotRead, evaluate
from reference import Reference, coordinate_names, on_constraints

_WORD = re.compile(r"[^\W\d]\w*'*|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[-+*/^()]")


def wrong(rng, claim, names, coordinates):
    """The claim with one change: a number, a sign, sine for cosine, a name, a dot. It may still be true."""
    words = list(_WORD.finditer(claim))
    for _ in range(20):
        word = rng.choice(words)
        text = word.group()
        if text in ("sin", "cos"):
            other = {"sin": "cos", "cos": "sin"}[text]
        elif text in "+-" and claim[:word.start()].rstrip()[-1:] not in ("", "(", "="):
            other = {"+": "-", "-": "+"}[text]
        elif text[0].isdigit() and claim[:word.start()].rstrip()[-1:] != "^":
            other = repr(float(text) * rng.choice([2, 0.5, 1.01]))
        elif text.endswith("'"):
            other = text[:-1] if rng.random() < 0.5 else text + "'"
            if other.endswith("'''") or text.rstrip("'") not in coordinates:
                continue
        elif text in names and claim[word.end():word.end() + 1] != "(":
            other = rng.choice(names)
        else:
            continue
        if other != text:
            return claim[:word.start()] + other + claim[word.end():]
    return None


def right(rng, equations, coordinates):
    """An equation of motion, a multiple of one, or a sum of two."""
    left, _, other = rng.choice(equations).partition("=")
    form = rng.random()
    if form < 0.5:
        return f"{left.strip()} = {other.strip()}"
    factor = rng.choice([f"(2 + {rng.choice(coordinates)}')", "3", f"({rng.choice(coordinates)} - 7)"])
    if form < 0.75:
        return f"{factor}*({left.strip()}) = {factor}*({other.strip()})"
    more, _, last = rng.choice(equations).partition("=")
    return f"{left.strip()} + {factor}*({more.strip()}) = {other.strip()} + {factor}*({last.strip()})"


class Truth:
    """The scene at random states near its initial one, with other values of the parameters, in 60 digits."""

    def __init__(self, scene, state, seed, count=3):
        rng = random.Random(seed)
        self.states = []
        names = coordinate_names(scene)
        for _ in range(count):
            parameters = {}
            for name, entry in scene.get("parameters", {}).items():
                value = entry["value"] if isinstance(entry, dict) else entry
                parameters[name] = mpf(value) * (1 + mpf(rng.uniform(-0.02, 0.02)))
            start = {name + dot: mpf(state[name + dot]) + mpf(rng.uniform(-0.02, 0.02)) for name in names for dot in ("", "'")}
            start.update({name: mpf(state[name]) + mpf(rng.uniform(-0.02, 0.02)) for name in scene.get("states", {})})
            time = mpf(rng.uniform(0, 0.05)) if scene.get("inputs") else mpf(rng.uniform(0, 2))
            held = on_constraints(scene, start, parameters, time)
            if held is None:
                raise NotRead("no state near")
            here = Reference(scene, held, parameters, time)
            here.solve()
            self.states.append(here)

    def holds(self, claim):
        left, _, right = claim.partition("=")
        for here in self.states:
            a, b = evaluate(left, here.names).value, evaluate(right, here.names).value
            if abs(a - b) > mpf("1e-38") * max(abs(a), abs(b), self._size(here, left)) + mpf("1e-48"):
                return False
        return True

    @staticmethod
    def _size(here, text):
        """Of the largest term at the top level, by which a sum that cancels is measured."""
        depth, begin, largest = 0, 0, mpf(0)
        for at, letter in enumerate(text + "+"):
            depth += (letter == "(") - (letter == ")")
            if letter in "+-" and depth == 0 and text[begin:at].strip() and text[begin:at].rstrip()[-1] not in "*/^e":
                largest = max(largest, abs(evaluate(text[begin:at], here.names).value))
                begin = at + 1
        return largest
