# SPDX-License-Identifier: MIT
"""The same thing written in another way, with one side taken for both, or with a slip: what claims are made of."""

from trees import ONE, PI, ZERO, Tree, name, number, of, parts, plain, rebuilt, replaced, used, value

THRESHOLDS = ["0", "0.05", "0.3", "1", "2.5", "3", "7", "20"]


def draws(rng, tenths):
    """A number with one decimal."""
    return number(f"{rng.randint(*tenths) / 10:.1f}")


def threshold(rng):
    return number(rng.choice(THRESHOLDS))


def linear(rng, variables):
    """v - d, d - v, v + d, 2*v - d, v - w …"""
    v = rng.choice(variables)
    form = rng.random()
    if form < 0.12:
        return v
    if form < 0.2 and len(variables) > 1:
        return v - rng.choice([w for w in variables if w != v])
    d = threshold(rng)
    if form < 0.5:
        return v - d
    if form < 0.7:
        return v + d
    if form < 0.85:
        return d - v
    if form < 0.93:
        return 2 * v - d
    return v**2 - d


# -- |e|, max, sign in other words


def _abs(rng, e):
    return rng.choice(
        [
            lambda: of("abs", e),
            lambda: of("sqrt", e**2),
            lambda: of("max", e, -e),
            lambda: -of("min", e, -e),
            lambda: e * of("sign", e),
            lambda: 2 * of("max", 0, e) - e,
            lambda: e**2 / of("abs", e),
            lambda: of("abs", -e),
            lambda: e**2 / of("sqrt", e**2),
            lambda: of("max", 0, e) - of("min", 0, e),
            lambda: of("sqrt", of("abs", e)) ** 2,
        ]
    )()


def _max(rng, a, b):
    return rng.choice(
        [
            lambda: of("max", a, b),
            lambda: of("max", b, a),
            lambda: -of("min", -a, -b),
            lambda: (a + b + of("abs", a - b)) / 2,
            lambda: b + of("max", 0, a - b),
            lambda: a + of("max", 0, b - a),
            lambda: (a + b + of("sqrt", (a - b) ** 2)) / 2,
        ]
    )()


def _sign(rng, e):
    return rng.choice(
        [
            lambda: of("sign", e),
            lambda: e / of("abs", e),
            lambda: of("abs", e) / e,
            lambda: e / of("sqrt", e**2),
            lambda: -of("sign", -e),
            lambda: of("sign", e**3),
            lambda: of("sign", e) ** 3,
        ]
    )()


def rewritten(rng, node, chance=0.5):
    """The same value, but where an argument is zero."""

    def change(n):
        if rng.random() > chance:
            return None
        if n.op == "abs":
            return _abs(rng, n.args[0])
        if n.op == "sqrt" and n.args[0].op == "^" and n.args[0].args[1] == number(2):
            return _abs(rng, n.args[0].args[0])
        if n.op == "max" and len(n.args) == 2:
            return _max(rng, *n.args)
        if n.op == "min" and len(n.args) == 2:
            return -_max(rng, -n.args[0], -n.args[1])
        if n.op == "sign":
            return _sign(rng, n.args[0])
        if n.op == "alias":
            return rewritten(rng, n.args[1], 0.8)
        return None

    return replaced(node, change)


def _one_side(rng, n):
    if n.op == "abs":
        return rng.choice([n.args[0], -n.args[0]])
    if n.op == "sqrt" and n.args[0].op == "^":
        return rng.choice([n.args[0].args[0], -n.args[0].args[0]])
    if n.op in ("max", "min"):
        return rng.choice(n.args)
    if n.op == "sign":
        return rng.choice([ONE, -ONE])
    if n.op == "atan2":
        return of("atan", n.args[0] / n.args[1])
    return None


def one_sided(rng, node):
    """One function with sides replaced by what it is on one side; None where there is none."""
    node = plain(node)
    found = [n for n in parts(node) if _one_side(rng, n) is not None]
    if not found:
        return None
    chosen = rng.choice(found)
    return replaced(node, lambda n: _one_side(rng, n) if n is chosen else None)


# -- slips


def slipped(rng, node, scene):
    """One change somewhere; it may still be true."""
    nodes = [n for n in parts(node) if n.op not in ("pi",)]
    for _ in range(30):
        chosen = rng.choice(nodes)
        new = _slip(rng, chosen, scene)
        if new is not None and new != chosen:
            return replaced(node, lambda n, c=chosen, w=new: w if n is c else None)
    return None


def _slip(rng, n, scene):
    if n.op == "num":
        return number(n.args[0] * rng.choice([2, number("0.5").args[0], -1])) if n.args[0] else None
    if n.op == "name":
        label, dots = n.args
        if label in scene.coordinates:
            other = rng.choice([*scene.coordinates, label])
            return name(other + "'" * (dots if other != label else rng.choice([max(0, dots - 1), min(2, dots + 1)])))
        if label in scene.parameters:
            same = [k for k in scene.parameters if k != label]
            pick = rng.random()
            if pick < 0.5 and same:
                equal = [k for k in same if value(scene.parameters[k].value, scene.values()) == scene.values()[label, 0]]
                return name(rng.choice(equal or same))
            return scene.parameters[label].value if pick < 0.8 and not used(scene.parameters[label].value) else 2 * n
        return None
    swaps = {"sin": "cos", "cos": "sin", "max": "min", "min": "max", "sinh": "cosh", "cosh": "sinh"}
    if n.op in swaps:
        return Tree(swaps[n.op], *n.args)
    if n.op in ("abs", "sign", "alias", "sqrt"):
        return n.args[0] if n.op != "alias" else n.args[1].args[0]
    if n.op == "+":
        at = rng.randrange(len(n.args))
        change = rng.choice([lambda t: -t, lambda t: ZERO, lambda t: 2 * t])
        return rebuilt(n, [change(t) if k == at else t for k, t in enumerate(n.args)])
    if n.op == "^":
        return n.args[0]
    if n.op == "*" and len(n.args) > 2:
        return rebuilt(n, n.args[:-1])
    return -n if n.op in ("*", "/") else None


# -- factors


def vanishing(rng, variables):
    v = rng.choice(variables)
    d = number(rng.choice(["0.6", "0.2", "1", "20"]))
    return rng.choice(
        [
            lambda: v,
            lambda: v - d,
            lambda: of("sin", v),
            lambda: of("max", 0, v - d),
            lambda: of("abs", v) - v,
            lambda: v**2 - d,
            lambda: 1 + of("sign", v - d),
            lambda: of("cos", v) - 1,
            lambda: of("abs", v - d) + v - d,
            lambda: of("min", v, d) - d,
        ]
    )()


def never_vanishing(rng, variables):
    v = rng.choice(variables)
    return rng.choice(
        [
            lambda: v**2 + 1,
            lambda: of("exp", v),
            lambda: 2 + of("sin", v),
            lambda: number(3),
            lambda: of("sqrt", 1 + v**2),
            lambda: 2 + of("sign", v),
            lambda: 1 + of("abs", v),
            lambda: PI,
            lambda: of("max", 1, v),
            lambda: number(-2) - v**4,
            lambda: of("cosh", v),
        ]
    )()


# -- identities, true and half true


def identity(rng, variables):
    e, f = linear(rng, variables), linear(rng, variables)
    one = [
        lambda: (of("abs", e), rng.choice([e, -e])),
        lambda: (of("abs", e), _abs(rng, e)),
        lambda: (of("max", 0, e), rng.choice([ZERO, e, _max(rng, ZERO, e)])),
        lambda: (of("min", 0, e), rng.choice([ZERO, e])),
        lambda: (of("max", e, f), rng.choice([e, f, _max(rng, e, f)])),
        lambda: (of("min", e, f) + of("max", e, f), e + f),
        lambda: (of("max", e, f) - of("min", e, f), of("abs", e - f)),
        lambda: (of("sign", e), rng.choice([ONE, -ONE, _sign(rng, e)])),
        lambda: (of("sqrt", e**2), rng.choice([e, -e, _abs(rng, e)])),
        lambda: (of("sign", e) * of("sign", f), rng.choice([of("sign", e * f), ONE])),
        lambda: (of("abs", e) * of("abs", f), rng.choice([of("abs", e * f), e * f, -e * f])),
        lambda: (of("abs", e + f), of("abs", e) + of("abs", f)),
        lambda: (of("atan2", e, 1), rng.choice([of("atan", e), -of("atan", e)])),
        lambda: (of("atan2", 1, e), rng.choice([PI / 2 - of("atan", e), of("atan", 1 / e)])),
        lambda: (
            of("atan2", of("sin", e), of("cos", e)),
            rng.choice([e, of("acos", of("cos", e)) * _sign(rng, of("sin", e))]),
        ),
        lambda: (of("atan2", e, f), rng.choice([of("atan", e / f), PI / 2 - of("atan2", f, e)])),
        lambda: (of("acos", of("cos", e)), e),
        lambda: (of("asin", of("sin", e)), e),
        lambda: (of("atan", of("tan", e)), e),
        lambda: (of("acos", e) + of("asin", e), PI / 2),
        lambda: (of("sin", of("asin", e)), e),
        lambda: (of("sin", of("acos", e)), of("sqrt", 1 - e**2)),
        lambda: (of("cos", of("atan", e)), 1 / of("sqrt", 1 + e**2)),
        lambda: (of("abs", e) ** 3, rng.choice([e**3, e**2 * of("abs", e)])),
        lambda: (of("abs", e) ** 2, e**2),
        lambda: (of("sqrt", e**4), rng.choice([e**2, e * of("abs", e)])),
        lambda: (of("sqrt", e**2 * f**2), rng.choice([e * f, of("abs", e) * of("abs", f), of("abs", e * f)])),
        lambda: (of("sqrt", e**2 - 2 * e * f + f**2), rng.choice([e - f, f - e, of("abs", e - f)])),
        lambda: (of("abs", of("abs", e) - of("abs", f)), rng.choice([of("abs", e - f), of("abs", e) - of("abs", f)])),
        lambda: (of("sqrt", 1 - of("sin", e) ** 2), rng.choice([of("cos", e), of("abs", of("cos", e))])),
        lambda: (of("sqrt", (1 - of("cos", e)) / 2), rng.choice([of("sin", e / 2), of("abs", of("sin", e / 2))])),
        lambda: (of("max", e, f, 0), rng.choice([of("max", of("max", e, f), 0), of("max", e, f)])),
        lambda: (of("sign", of("exp", e)), ONE),
        lambda: (of("abs", e**2 + 1), e**2 + 1),
        lambda: (of("log", e**2), 2 * of("log", of("abs", e))),
        lambda: (of("tanh", of("abs", e)), rng.choice([of("abs", of("tanh", e)), of("tanh", e)])),
    ]
    left, right = rng.choice(one)()
    return (left, right) if rng.random() < 0.7 else (left * f, right * f)
