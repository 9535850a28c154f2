# SPDX-License-Identifier: MIT
"""Branches of equilibria over a parameter, and crossings of roots: against scenes whose branches and special points are known."""

import collections

from mpmath import mpf

from judge import BRANCHES, Finding
from poses import Verb
from scene import Scene
from trees import ONE, ZERO, name, number, of
from writings import draws


class Known:
    """Over `label` from a to b: equilibria(p) are all at the value p, with whether each is stable; special: {(kind, value)}.
    Places are angles modulo whole turns where `turns`."""

    def __init__(self, scene, label, ends, equilibria, special, turns=False):
        self.scene, self.label, self.ends, self.equilibria, self.special, self.turns = (
            scene,
            label,
            ends,
            equilibria,
            special,
            turns,
        )


def _line(force, label, start, values, ends, equilibria, special):
    s = Scene()
    s.parameter(label, start)
    q = s.coordinate("x", values)
    s.particle("P", ONE, [q, ZERO])
    s.force("x", force(q, name(label)))
    return Known(s, label, ends, equilibria, special)


def scenes(rng):
    """One scene with what is known of it."""
    shift = float(draws(rng, (-5, 5)).args[0])
    a = number(str(shift))
    kind = rng.choice(["pitchfork", "fold", "transcritical", "cubic", "pendulum", "spring", "hoop", "bent"])
    low, high = shift - rng.choice([0.5, 1, 2]), shift + rng.choice([0.7, 1, 2.3])
    ends = (low, high) if rng.random() < 0.5 else (high, low)
    start = number(f"{shift + 0.3:.1f}")
    if kind == "pitchfork":
        return _line(
            lambda x, p: (p - a) * x - x**3,
            "p",
            start,
            ZERO,
            ends,
            lambda p: [(0, p < shift)]
            + ([(r, True) for r in (-((p - shift) ** 0.5), (p - shift) ** 0.5)] if p > shift else []),
            {("pitchfork", shift)},
        )
    if kind == "fold":
        return _line(
            lambda x, p: (p - a) - x**2,
            "p",
            start,
            number("0.5"),
            ends,
            lambda p: [((p - shift) ** 0.5, True), (-((p - shift) ** 0.5), False)] if p > shift else [],
            {("fold", shift)},
        )
    if kind == "transcritical":
        return _line(
            lambda x, p: (p - a) * x - x**2,
            "p",
            start,
            ZERO,
            ends,
            lambda p: [(0, p < shift), (p - shift, p > shift)],
            {("transcritical", shift)},
        )
    if kind == "cubic":
        ends = (-3, 3) if rng.random() < 0.5 else (3, -3)
        return _line(lambda x, p: p + 3 * x - x**3, "p", number("0.3"), ZERO, ends, _cubic, {("fold", -2.0), ("fold", 2.0)})
    if kind == "bent":  # nothing happens here
        return _line(
            lambda x, p: p - x**3 - x, "p", start, ZERO, ends, lambda p: [(r, True) for r in _real([1, 0, 1, -p])], set()
        )
    if kind == "spring":
        low = rng.choice([1, 0.5])
        ends = rng.choice([(low, 3), (3, low)])
        return _line(lambda x, p: 2 - p * x, "p", ONE, ZERO, ends, lambda p: [(2 / p, True)], set())
    s = Scene()
    g, size = s.parameter("g", number("9.81")), s.parameter("l", number(2))
    q = s.coordinate("theta", number("0.5"))
    s.gravity = [ZERO, -g]
    mass = s.parameter("m", number(1))
    s.particle("bob", mass, [size * of("sin", q), -size * of("cos", q)])
    if kind == "pendulum":
        label, ends = rng.choice(
            [("l", (1, 2)), ("l", (2, 1)), ("m", (2, 1)), ("g", (5, 12)), ("g", (12, 5)), ("m", (0.5, 3))]
        )
        return Known(s, label, ends, lambda p: [(0, True), (mpf("3.14159265358979"), False)], set(), True)
    w = s.parameter("w", number(5))
    s.force("theta", mass * size**2 * w**2 * of("sin", q) * of("cos", q))
    critical = (9.81 / 2) ** 0.5

    def hoop(p):
        from mpmath import acos, pi

        c = 9.81 / 2 / p**2
        return [(0, c > 1), (pi, False)] + ([(acos(c), True), (-acos(c), True)] if c < 1 else [])

    return Known(s, "w", rng.choice([(1, 6), (6, 1)]), hoop, {("pitchfork", critical)}, True)


def _real(coefficients):
    import numpy

    return [float(r.real) for r in numpy.roots(coefficients) if abs(r.imag) < 1e-9]


def _cubic(p):
    return [(x, 3 - 3 * x * x < 0) for x in _real([-1, 0, 3, p])]


def branches(program, rng):
    """What `equilibrium --vary` follows."""
    known = scenes(rng)
    low, high = known.ends
    words = ["equilibrium", "--vary", f"{known.label}={low}:{high}"]
    counts = collections.Counter(claims=1)
    code, answer, message = program.ask(known.scene.text(), *words)
    if code not in (0, 2) or answer is None:
        return [], (code, message), counts
    verb = Verb(" ".join(words))
    findings = [Finding(BRANCHES, verb, said, known.scene) for said in _special(known, answer) + _followed(known, answer)]
    return findings[:2], None, counts


def _special(known, answer):
    found = [(p["kind"], p["parameter"]) for p in answer.get("points", ())]
    said = [
        f"{kind} at {known.label} = {value:.10g}, where there is none; there are {sorted(known.special)}"
        for kind, value in found
        if not any(kind == k and abs(value - v) < 1e-4 for k, v in known.special)
    ]
    for kind, value in known.special:
        near = [v for k, v in found if k == kind and abs(v - value) < 1e-4]
        if min(known.ends) < value < max(known.ends) and not near:
            said.append(f"no {kind} at {known.label} = {value:.10g}; there are {found}")
        elif len(near) > 1:
            said.append(f"the {kind} at {known.label} = {value:.10g} is told {len(near)} times: {near}")
    return said


def _followed(known, answer):
    """At values in between, each equilibrium is on some branch, with the right judgement."""
    low, high = known.ends
    said = []
    for part in (0.13, 0.37, 0.61, 0.89):
        p = low + part * (high - low)
        if any(abs(p - v) < 0.05 * abs(high - low) for _, v in known.special):
            continue
        told = _told(answer, p)
        for x, stable in known.equilibria(p):
            near = [s for y, s in told if _far(known, x, y) < 0.05 * max(1, abs(float(x)))]
            if not near:
                said.append(
                    f"no branch goes through {float(x):.6g} at {known.label} = {p:.6g}; there are {told} "
                    f"in {len(answer.get('branches', ()))} pieces"
                )
            elif any(s == ("no" if stable else "yes") for s in near):
                said.append(f"{float(x):.6g} at {known.label} = {p:.6g} is called {'un' if stable else ''}stable")
    return said


def _far(known, x, y):
    d = abs(float(x) - y)
    turn = 6.283185307179586
    return min(d % turn, turn - d % turn) if known.turns else d


def _told(answer, p):
    """Where the branches are at a value: between two points that enclose it, by a line."""
    told = []
    for branch in answer.get("branches", ()):
        points = branch["points"]
        for a, b in zip(points, points[1:]):
            if (a["parameter"] - p) * (b["parameter"] - p) <= 0 and a["parameter"] != b["parameter"]:
                part = (p - a["parameter"]) / (b["parameter"] - a["parameter"])
                x, y = (list(e["coordinates"].values())[0] for e in (a, b))
                told.append((x + part * (y - x), a["stable"] if a["stable"] == b["stable"] else "undecided"))
    return told


def crossings(program, rng):
    """What `stability --vary` says of roots that cross the axis at x = 0."""
    s = Scene()
    shift = float(draws(rng, (-5, 5)).args[0])
    a = number(str(shift))
    p, q = s.parameter("p", number(f"{shift + rng.choice([0.3, -0.4]):.1f}")), s.coordinate("x", ZERO)
    s.particle("P", ONE, [q, ZERO])
    v = name("x'")
    force, there = rng.choice(
        [
            ((p - a) * q - q**3, True),
            ((a - p) * q, True),
            (-q + (p - a) * v, True),
            (-q - v - (p - a) ** 2 * q, False),
            ((p - a) * q - v - q * of("abs", q), True),
            (-2 * q - v, False),
            (of("sin", q) * (a - p) - v / 5, True),
        ]
    )
    s.force("x", force + ZERO * p)
    s.needed = [p]
    low, high = shift - rng.choice([0.5, 1, 2]), shift + rng.choice([0.7, 1, 2.3])
    low, high = (low, high) if rng.random() < 0.5 else (high, low)
    words = ["stability", "--vary", f"p={low}:{high}"]
    counts = collections.Counter(claims=1)
    code, answer, message = program.ask(s.text(), *words)
    if code not in (0, 1, 2) or answer is None:
        return [], (code, message), counts
    found = [c["value"] for c in answer.get("crossings", ())]
    wrong = [c for c in found if not there or abs(c - shift) > 1e-4]
    said = f"crossings at {found}; there is {f'one at {shift}' if there else 'none'}"
    if wrong or (there and not found):
        return [Finding(BRANCHES, Verb(" ".join(words)), said, s)], None, counts
    return [], None, counts


KINDS = {"branches_over": branches, "crossings": crossings}
