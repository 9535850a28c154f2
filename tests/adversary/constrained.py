# SPDX-License-Identifier: MIT
"""Families whose constraints have several branches, of which the scene begins on one."""

import mpmath

from families import family, plain_load
from scene import Constraint, Scene
from trees import ONE, PI, ZERO, derivative, name, number, of, parts, replaced, value
from truth import Claim
from writings import draws, slipped

NEAR = mpmath.mpf("0.02")


def masses(rng, s, labels):
    for k, label in enumerate(labels):
        m = number(k + 1) if rng.random() < 0.5 else s.parameter("m" + label, draws(rng, (5, 30)))
        s.particle("P" + label, m, [name(label), ZERO])
    if rng.random() < 0.5:
        for label in labels[: 1 + rng.randrange(len(labels))]:
            s.force(label, plain_load(rng, s, label) + draws(rng, (-20, 20)))


def product(rng, s, own, written, others, at):
    """The constraint written * others = 0; others that vanish near the start are left out."""
    here = {(k, 0): value(v) for k, v in at.items()}
    kept = [o for o in others if abs(value(o, {**s.values(), **here})) > NEAR]
    total = written
    for o in kept:
        total = total * o if rng.random() < 0.7 else o * total
    s.constraints.append(Constraint("z0", -total if rng.random() < 0.2 else total, own))
    return kept


def slope_claims(rng, a, b, p, others):
    """Right and wrong ones of a branch a = p b."""
    da, db, dda, ddb = name("a'"), name("b'"), name("a''"), name("b''")
    right = [
        (a, p * b),
        (da, p * db),
        (dda, p * ddb),
        (a**2, p**2 * b**2),
        (a * da, p**2 * b * db),
        (a * b, p * b**2),
        (a * db, b * da),
        ((a - p * b) * (a**2 + 1), ZERO),
        (a**3, p**3 * b**3),
        (a * (a - p * b), ZERO),
        (of("abs", a), of("abs", p * b)),
        (of("sqrt", a**2), of("sqrt", p**2) * of("abs", b)),
        (da * db, p * db**2),
        (a**2 - p**2 * b**2, ZERO),
        (da - p * db, ZERO),
    ]
    wrong = [
        (a, -p * b),
        (a, b),
        (da, db),
        (a**2, b**2),
        (a * da, b * db),
        (da, -db),
        (a, 2 * b),
        (a**2, 2 * p * b**2),
        (of("abs", a), a),
        (a * b, of("abs", a * b)),
        (dda, ddb),
    ] + [(o, ZERO) for o in others]
    return right, wrong


def dynamic_claims(rng, s, a, b, p, left_by):
    """d'Alembert's equation along a = p b + …, or b = p a + …: what the constraint leaves of both equations."""
    m = s.motion()
    rows = [m.mass[i][i] * name(q + "''") + m.bias[i] - m.force[i] for i, q in enumerate(m.q[:2])]
    row = p * rows[0] + rows[1] if left_by == "b" else rows[0] + p * rows[1]
    return row


@family
def branches(rng):
    """Products of lines, squares and circles, with roots of integers."""
    s = Scene()
    roots = [of("sqrt", number(n)) for n in (2, 3, 5, 7)]
    b0 = number(rng.choice(["1", "0.5", "-0.485", "2", "-1.5", "0.7"]))
    n = number(rng.choice([2, 3, 5, 7, 4]))
    p = rng.choice([ONE, -ONE, number(2), number("0.5"), -number(3), *roots, -of("sqrt", n)])
    a, b = s.coordinate("a", p * b0), s.coordinate("b", b0)
    at = {"a": p * b0, "b": b0}
    masses(rng, s, "ab")
    own = a - p * b
    written = own
    if p.op in ("sqrt", "neg") and rng.random() < 0.7:
        square = p.args[0] if p.op == "sqrt" else p.args[0].args[0]
        written = a**2 - square * b**2
    elif rng.random() < 0.2:
        written = a**2 - p**2 * b**2
    pool = [
        a - b,
        a + b,
        a - 2 * b,
        a**2 - 3 * b**2,
        a**2 - 2 * b**2,
        a**2 - 7 * b**2,
        a**2 + b**2 - 9,
        a - 3,
        b + 4,
        a * b - 10,
        2 * a + b - 1,
        a - of("sqrt", number(3)) * b,
        a**2 + a * b + b**2,
    ]
    others = product(rng, s, own, written, rng.sample(pool, rng.choice([1, 1, 2])), at)
    right, wrong = slope_claims(rng, a, b, p, others)
    claims = [Claim(*c) for c in rng.sample(right, 4) + rng.sample(wrong, min(4, len(wrong)))]
    claims.append(Claim(dynamic_claims(rng, s, a, b, p, "b"), ZERO))
    speed = rng.choice([ZERO, draws(rng, (-20, 20))])
    s.coordinates["a"], s.coordinates["b"] = (p * b0, p * speed, None, False), (b0, speed, None, False)
    return s, claims


@family
def circles(rng):
    """A circle or an ellipse beside lines, which it meets."""
    s = Scene()
    size = s.parameter("l", number(rng.choice(["1", "2", "0.5"])))
    angle = rng.choice([PI / 6, PI / 3, 2 * PI / 3, 5 * PI / 4, number("0.3"), number("-1.1")])
    x0, y0 = size * of("cos", angle), size * of("sin", angle)
    x, y = s.coordinate("x", x0), s.coordinate("y", y0)
    m = s.parameter("m", draws(rng, (5, 30)))
    s.particle("P", m, [x, y])
    s.lengths = True
    g = s.parameter("g", number("9.81"))
    s.gravity = [ZERO, -g]
    own = x**2 + y**2 - size**2
    at = {"x": value(x0, s.values()), "y": value(y0, s.values())}
    others = product(
        rng,
        s,
        own,
        own,
        rng.sample([x - y, x + y, x - 3, x**2 - 3 * y**2, 2 * y + x - 5, x * y - 2], rng.choice([0, 1, 1])),
        {k: number_of(v) for k, v in at.items()},
    )
    dx, dy, ddx, ddy = name("x'"), name("y'"), name("x''"), name("y''")
    pairs = [
        (x * dx + y * dy, ZERO),
        (x**2 + y**2, size**2),
        (y, of("sqrt", size**2 - x**2)),
        (dy, -x * dx / y),
        (y * ddx - x * ddy - x * g, ZERO),
        (y * ddx - x * ddy + x * g, ZERO),
        (x, y),
        (dx, dy),
        (x * ddx + y * ddy + dx**2 + dy**2, ZERO),
        (of("abs", y), of("sqrt", size**2 - x**2)),
        (y, -of("sqrt", size**2 - x**2)),
        (of("abs", y), y),
        (x * ddx + y * ddy, ZERO),
        (of("abs", x) * dx, -y * dy),
        (of("atan2", y, x), of("atan", y / x)),
        (x, size * of("cos", of("atan2", y, x))),
        (y, size * of("sin", of("acos", x / size))),
    ]
    claims = [Claim(*c) for c in rng.sample(pairs, 7)] + [Claim(o, ZERO) for o in others]
    energy = m * (dx**2 + dy**2) / 2 + m * g * y
    return s, claims + [Claim(energy, name("C"), constants=["C"])]


def number_of(x):
    return number(f"{float(x):.12g}")


@family
def angles(rng):
    """Relations of angles modulo pi and 2 pi, written as equations of sines and cosines."""
    s = Scene()
    n = rng.choice([1, 2, 3, 3, 4])
    a0 = number(rng.choice(["0.3", "0.5", "-0.7", "1.1", "0.2"]))
    k = rng.randint(-n, n)
    kind = rng.choice(["cos+", "cos-", "sin+", "sin-", "tan", "mixed", "triple", "square"])
    a, b = name("a"), name("b")
    two = 2 * PI * number(k) / n if k else ZERO
    p, shift = ONE, two
    if kind == "cos+":
        written = of("cos", n * a) - of("cos", n * b)
    elif kind == "cos-":
        written, p = of("cos", n * a) - of("cos", n * b), -ONE
    elif kind == "sin+":
        written = of("sin", n * a) - of("sin", n * b)
    elif kind == "sin-":
        written, p, shift = of("sin", n * a) - of("sin", n * b), -ONE, PI / n + two
    elif kind == "tan":
        written, shift = of("tan", n * a) - of("tan", n * b), PI * number(k) / n if k else ZERO
    elif kind == "triple":
        written, shift = 4 * of("cos", a) ** 3 - 3 * of("cos", a) - of("cos", 3 * b), 2 * PI * number(k) / 3 if k else ZERO
    elif kind == "square":
        written, shift = of("cos", a) ** 2 - of("cos", b) ** 2, PI * number(k) if k else ZERO
    else:
        i, j, phase = rng.choice([1, 2, 3]), rng.choice([1, 1, 2, 3]), rng.choice([ZERO, PI / 6, PI / 3, number(1), -PI / 4])
        written = of("sin", i * a - j * b + phase)
        p, shift = number(i) / j if i % j else number(i // j), (phase - PI * number(k)) / j
    own = b - p * a - shift
    b0 = p * a0 + shift
    rate = rng.choice([ZERO, draws(rng, (-20, 20))])
    s.coordinate("a", a0, rate)
    s.coordinate("b", b0, p * rate)
    labels = "ab"
    masses(rng, s, labels)
    pool = [
        of("cos", 3 * a - 3 * b + PI / 3),
        of("sin", a + 2 * b + PI / 6),
        of("cos", 2 * a + b),
        of("sin", 2 * a - b - 1),
        a - 2 * b,
        a + b - 9,
        of("sin", 3 * a - b + 1),
    ]
    others = product(rng, s, own, written, rng.sample(pool, rng.choice([0, 0, 1, 2])), {"a": a0, "b": b0})
    da, db = name("b'"), name("a'")
    da, db = db, da
    pairs = [
        (of("cos", a), of("cos", b)),
        (of("sin", a), of("sin", b)),
        (of("cos", n * a), of("cos", n * b)),
        (da, db),
        (da, -db),
        (db, 2 * da),
        (db, p * da),
        (name("b''"), p * name("a''")),
        (written, ZERO),
        (a, b),
        (of("tan", a), of("tan", b)),
        (of("cos", 2 * a), of("cos", 2 * b)),
        (of("sin", a - b), ZERO),
        (of("cos", 3 * a), of("cos", 3 * b)),
        (of("sin", 3 * a), of("sin", 3 * b)),
        (b, p * a + shift),
        (of("sin", b), of("sin", p * a + shift)),
        (da**2, db**2),
        (of("cos", a) * of("sin", b), of("sin", a) * of("cos", b)),
        (b * db, p**2 * a * da),
        (of("cos", a) ** 2, of("cos", b) ** 2),
        (of("sin", 6 * a), of("sin", 6 * b)),
        (b - a, shift),
        (of("sin", a) ** 2 + of("cos", b) ** 2, ONE),
    ]
    claims = [Claim(*c) for c in rng.sample(pairs, 7)] + [Claim(o, ZERO) for o in others[:1]]
    claims.append(Claim(dynamic_claims(rng, s, a, b, p, "a"), ZERO))
    if rng.random() < 0.25 and p == ONE:  # a third mass that is held by a factor that does not vanish here, or is free
        here = {("a", 0): value(a0), ("b", 0): value(b0)}
        gap = of("cos", a) - of("cos", b)
        if abs(value(gap, here)) > NEAR:
            c = s.coordinate("e", 1)
            s.particle("Pe", number(3), [c, ZERO])
            s.force("e", number(5))
            s.constraints.append(Constraint("z1", gap * (c - 1), c - 1))
            s.changed()
            claims = claims[:4] + [
                Claim(name("e''"), ZERO),
                Claim(name("e''"), number(5) / 3),
                Claim(c, ONE),
                Claim(name("e'"), ZERO),
            ]
    return s, claims


@family
def roots(rng):
    """Constraints that bring square roots and corners."""
    s = Scene()
    s.lengths = True
    kind = rng.choice(["half", "hyperbola", "abs", "crank", "max", "ratio"])
    g = s.parameter("g", number("9.81"))
    m = s.parameter("m", draws(rng, (5, 30)))
    dx, dy = name("x'"), name("y'")
    if kind == "crank":
        r, length = s.parameter("r", draws(rng, (2, 9))), s.parameter("l", draws(rng, (10, 25)))
        th0 = number(rng.choice(["0.4", "2.5", "-1.2", "0.9"]))
        x0 = r * of("cos", th0) + of("sqrt", length**2 - r**2 * of("sin", th0) ** 2)
        th, x = s.coordinate("theta", th0), s.coordinate("x", x0)
        s.particle("P", m, [x, ZERO])
        s.kinetic = s.parameter("J", draws(rng, (1, 10))) * name("theta'") ** 2 / 2
        root = of("sqrt", length**2 - r**2 * of("sin", th) ** 2)
        own = (x - r * of("cos", th)) ** 2 + r**2 * of("sin", th) ** 2 - length**2
        written = own if rng.random() < 0.6 else x - r * of("cos", th) - root
        s.constraints.append(Constraint("z0", written))
        pairs = [
            (x, r * of("cos", th) + root),
            (x, r * of("cos", th) - root),
            ((x - r * of("cos", th)) ** 2, root**2),
            (of("abs", x - r * of("cos", th)), root),
            (dx, -r * of("sin", th) * name("theta'") * x / (x - r * of("cos", th))),
            (dx, -r * of("sin", th) * name("theta'")),
            (of("abs", x), x),
        ]
        return s, [Claim(*c) for c in rng.sample(pairs, 6)]
    x0 = number(rng.choice(["0.3", "-0.4", "0.6", "-0.2"]))
    x = name("x")
    d = number(rng.choice(["0.1", "1", "20", "0"]))
    k = s.parameter("a", draws(rng, (5, 20)))
    f = {
        "half": of("sqrt", 4 - x**2),
        "hyperbola": of("sqrt", 1 + x**2),
        "abs": k * of("abs", x - d),
        "max": k * of("max", 0, x - d),
        "ratio": k * x * of("sqrt", x**2),
    }[kind]
    if kind in ("half", "hyperbola") and rng.random() < 0.4:
        f = -f
    values = {**s.values(), ("x", 0): value(x0)}
    y0 = value(f, values)
    s.coordinate("x", x0)
    start = replaced(f, lambda n: x0 if n.op == "name" and n.args == ("x", 0) else None)
    y = s.coordinate("y", start if kind != "max" else k * of("abs", x0 - d) if value(f, values) else ZERO)
    s.particle("P", m, [x, y])
    s.gravity = [ZERO, -g]
    s.constraints.append(Constraint("z0", y - f))
    row = sum_along(f, g)
    one = {
        "half": -x * dx / of("sqrt", 4 - x**2),
        "hyperbola": x * dx / of("sqrt", 1 + x**2),
        "abs": k * dx,
        "max": k * dx,
        "ratio": 2 * k * x * dx,
    }[kind]
    pairs = [
        (dy, one),
        (dy, -one),
        (y, f),
        (y**2, f**2),
        (of("abs", y), y),
        (dy * y, one * f),
        (y * of("sign", y0_sign(y0)), f),
        row,
        (dy, ZERO),
        (name("y''"), ZERO),
        (of("sqrt", y**2), of("abs", f)),
        (of("abs", dy), of("abs", one)),
        (dy**2, one**2),
    ]
    claims = [Claim(*c) for c in rng.sample(pairs, 6)]
    changed = slipped(rng, row[0] - row[1], s)
    return s, claims + ([Claim(changed, ZERO)] if changed is not None else [])


def y0_sign(y0):
    return ONE if y0 >= 0 else -ONE


def sum_along(f, g):
    """x'' + f' (y'' + g) = 0, for a mass on y = f(x)."""
    slope = derivative(f, ("x", 0))
    if any(n.op == "pick" for n in parts(slope)):
        slope = name("y'") / name("x'")
    return name("x''") + slope * (name("y''") + g), ZERO
