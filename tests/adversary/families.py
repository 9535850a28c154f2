# SPDX-License-Identifier: MIT
"""Families of scenes and claims where something must be assumed: draw(rng) gives a scene and its claims."""

from scene import Scene
from trees import ONE, PI, ZERO, alias, name, number, of, parts, plain, replaced, used
from truth import Claim
from writings import draws, identity, linear, never_vanishing, one_sided, rewritten, slipped, threshold, vanishing

FAMILIES = {}


def family(draw):
    FAMILIES[draw.__name__.rstrip("_")] = draw
    return draw


# -- scenes that several families use


def line(rng, start=None, speed=None, count=1):
    """One or two particles on lines."""
    s = Scene()
    for label in "xy"[:count]:
        mass = s.parameter("m" if count == 1 else "m" + label, draws(rng, (5, 40)))
        initial = start if start is not None else draws(rng, (-30, 30))
        v = speed if speed is not None else draws(rng, (-20, 20))
        q = s.coordinate(label, initial, v)
        s.particle("P" + label, mass, [q, ZERO])
    return s


def sided_load(rng, s, v, label):
    """A load with sides in one variable."""
    k = s.parameter(label, draws(rng, (5, 300)))
    d = threshold(rng)
    if rng.random() < 0.4 and d != ZERO:
        d = s.parameter("d" + label, d)
    e = rng.choice([v - d, -v - d, d - v, v + d])
    return rng.choice(
        [
            lambda: -k * of("max", 0, v - d),
            lambda: k * of("max", 0, -v - d),
            lambda: k * of("max", 0, d - v),
            lambda: -k * of("min", 0, v + d),
            lambda: -k * of("abs", e),
            lambda: -k * of("sqrt", e**2),
            lambda: -k * v * of("abs", v),
            lambda: -k * of("sign", e),
            lambda: -k * e * of("sign", v),
            lambda: of("max", -k, of("min", k, -3 * v)),
            lambda: -k * of("max", 0, e) ** 2,
            lambda: -k * of("max", 0, v - d) + k * of("max", 0, -v - d),
            lambda: -of("min", k * v, d + 1),
        ]
    )()


def plain_load(rng, s, q):
    total = ZERO
    if rng.random() < 0.7:
        total = total - s.parameter("k", draws(rng, (5, 60))) * name(q)
    if rng.random() < 0.3:
        total = total - s.parameter("c", draws(rng, (1, 20))) * name(q + "'")
    return total


def equation_claims(rng, s, count):
    """The equations of motion: as they are, in other words, of one side, with a slip, multiplied."""
    rows, claims = s.equations(), []
    rates = [name(q + "'") for q in s.coordinates]
    places = [name(q) for q in s.coordinates]
    while len(claims) < count:
        left, right = rng.choice(rows)
        kind = rng.random()
        if kind < 0.25:
            right = one_sided(rng, right)
        elif kind < 0.5:
            left, right = rewritten(rng, left), rewritten(rng, right)
        elif kind < 0.7:
            changed = slipped(rng, left - right, s)
            if changed is None:
                continue
            left, right = changed, ZERO
        elif kind < 0.8:
            left, right = slipped(rng, left, s), rewritten(rng, right)
        elif kind < 0.85:
            right = one_sided(rng, rewritten(rng, right))
        if left is None or right is None:
            if rng.random() < 0.2:
                left, right = rows[0]
            else:
                continue
        form = rng.random()
        if form < 0.12:
            factor = rng.choice([vanishing, never_vanishing])(rng, places + rates)
            left, right = factor * left, factor * right
        elif form < 0.4:
            left, right = left - right, ZERO
        claims.append(Claim(left, right))
    return claims


@family
def sides(rng):
    s = line(rng, count=rng.choice([1, 1, 2]))
    for label in list(s.coordinates):
        s.force(label, plain_load(rng, s, label) + sided_load(rng, s, name(label), "s" + label))
    variables = [name(q + dots) for q in s.coordinates for dots in ("", "'")]
    claims = equation_claims(rng, s, 4)
    return s, claims + [Claim(*identity(rng, variables)) for _ in range(4)]


@family
def rates(rng):
    """Drag, friction and other loads by rates."""
    kind = rng.choice(["line", "throw", "slope", "pendulum", "plane", "friction"])
    s = Scene()
    m, c, g = s.parameter("m", draws(rng, (5, 30))), s.parameter("c", draws(rng, (1, 20))), s.parameter("g", number("9.81"))
    speed = draws(rng, (-50, 50))
    if kind in ("line", "friction"):
        q = s.coordinate("x", draws(rng, (-10, 10)), speed)
        s.particle("P", m, [q, ZERO])
        s.force("x", -s.parameter("k", draws(rng, (5, 50))) * q)
    elif kind == "throw":
        q = s.coordinate("y", ZERO, speed)
        s.gravity = [ZERO, -g]
        s.particle("P", m, [ZERO, q])
    elif kind == "slope":
        angle = s.parameter("alpha", draws(rng, (1, 12)), kind="shift")
        q = s.coordinate("s", ZERO, speed)
        s.gravity = [ZERO, -g]
        s.particle("P", m, [q * of("cos", angle), q * of("sin", angle)])
    elif kind == "pendulum":
        length = s.parameter("l", draws(rng, (5, 20)))
        q = s.coordinate("theta", draws(rng, (-20, 20)), speed)
        s.gravity = [ZERO, -g]
        s.particle("P", m, [length * of("sin", q), -length * of("cos", q)])
    else:
        x, y = s.coordinate("x", ZERO, rng.choice([ZERO, speed])), s.coordinate("y", ZERO, draws(rng, (-50, 50)))
        s.gravity = [ZERO, -g]
        s.particle("P", m, [x, y])
    velocity = s.velocity("P")
    q = list(s.coordinates)[-1]
    v = name(q + "'")
    if kind == "friction":
        s.frictions.append(("rub", c, v, m * g))
    elif kind == "plane" or rng.random() < 0.5:
        s.pushes.append(("P", [-c * s.norm("P") * u for u in velocity]))
    else:
        s.force(
            q,
            rng.choice(
                [
                    -c * v * of("abs", v),
                    -c * of("sqrt", v**2) * v,
                    -c * of("sign", v) * v**2,
                    -c * of("sign", v),
                    -c * of("max", 0, v),
                    -c * of("sign", v - 2),
                    -c * v**3 / of("abs", v),
                    -c * v / of("sqrt", v**2),
                    -c * of("abs", v) ** 3 * of("sign", v),
                    -c * of("max", v, -v),
                ]
            ),
        )
    claims = equation_claims(rng, s, 5)
    for left, right in s.equations()[:2]:  # quadratic drag with the sign that it has at the start, or without any
        bare = replaced(plain(right), lambda n: v if n.op in ("abs", "sqrt") and (q, 1) in used(n) else None)
        claims += [Claim(left, bare), Claim(left, replaced(plain(right), lambda n: -v if n.op in ("abs", "sqrt") else None))]
    return s, claims + [Claim(*identity(rng, [name(p + "'") for p in s.coordinates])) for _ in range(2)]


@family
def lengths(rng):
    """Roots of squares of positions: springs along coordinates, which may be told on the sheet of the start."""
    s = Scene()
    s.lengths = True
    m, k, l0 = (
        s.parameter("m", draws(rng, (5, 30))),
        s.parameter("k", draws(rng, (5, 50))),
        s.parameter("l0", draws(rng, (2, 15))),
    )
    r0 = draws(rng, (2, 30)) * rng.choice([1, -1])
    polar = rng.random() < 0.5
    if polar:
        r, th = s.coordinate("r", r0, draws(rng, (-10, 10))), s.coordinate(
            "theta", draws(rng, (-10, 10)), draws(rng, (-10, 10))
        )
        s.particle("P", m, [r * of("cos", th), r * of("sin", th)])
        x, y = [e for e in s.particles[0][2]]
        length = of("sqrt", x**2 + y**2)
    else:
        r = s.coordinate("x", r0, draws(rng, (-10, 10)))
        s.particle("P", m, [r, ZERO])
        length = of("sqrt", r**2)
    s.springs.append((alias('["O", "P"]', length), k, l0))
    sign = ONE if r0.args[0] > 0 else -ONE
    v, a, label = name(r.args[0] + "'"), name(r.args[0] + "''"), r.args[0]
    turn = m * r * name("theta'") ** 2 if polar else ZERO
    claims = [
        Claim(m * a - turn + k * (r - l0), ZERO),
        Claim(m * a - turn + k * (r + l0), ZERO),
        Claim(m * a - turn + k * (of("abs", r) - l0) * of("sign", r), ZERO),
        Claim(m * a - turn, -k * (r - l0 * r / of("sqrt", r**2))),
        Claim(of("sqrt", r**2), sign * r),
        Claim(of("sqrt", r**2), -sign * r),
        Claim(of("abs", r), sign * r),
        Claim(of("sqrt", v**2), v),
        Claim(of("sqrt", v**2), of("abs", v)),
        Claim(of("sqrt", (r - 1) ** 2), r - 1),
        Claim(
            m * v**2 / 2 + (m * r**2 * name("theta'") ** 2 / 2 if polar else ZERO) + k * (of("sqrt", r**2) - l0) ** 2 / 2,
            name("C"),
            constants=["C"],
        ),
    ]
    return s, rng.sample(claims, 6) + [Claim(*identity(rng, [name(label), v]))]


@family
def parameters(rng):
    """By degrees, by pi, by roots, by decimals, by equal values: a claim that holds at the values alone is refuted."""
    s = Scene()
    g = s.parameter("g", number(rng.choice(["9.81", "10", "9.8"])))
    kind = rng.choice(["slope", "slopes", "oscillator", "pendulum", "wire"])
    claims, numbers = [], []
    if kind in ("slope", "slopes"):
        s.gravity = [ZERO, -g]
        degrees = rng.choice([15, 18, 20, 30, 36, 40, 45, 60, 70])
        by_pi = rng.random() < 0.4
        angles = []
        for label in ("alpha", "beta")[: 1 if kind == "slope" else 2]:
            meaning = number(degrees) * PI / 180
            text = f'"{degrees}*pi/180"' if by_pi else f'{{ value = {degrees}, unit = "deg" }}'
            if degrees in (30, 45, 60) and by_pi:
                text = f'"pi/{180 // degrees}"'
            if rng.random() < 0.15:
                text, meaning = "0.7", number("0.7")
            angles.append(s.parameter(label, meaning, text, kind="shift"))
        q, mass = s.coordinate("s", ZERO), draws(rng, (5, 30))
        masses = [s.parameter(f"m{k + 1}", mass if rng.random() < 0.6 else draws(rng, (5, 30))) for k in range(len(angles))]
        for k, (m, a) in enumerate(zip(masses, angles)):
            way = q if k == 0 else 1 - q
            s.particle(f"P{k}", m, [(-way if k == 0 and len(angles) == 2 else way) * of("cos", a), -way * of("sin", a)])
        a = name("s''")
        total = sum(masses[1:], masses[0])
        pull = masses[0] * g * of("sin", angles[0]) - (masses[1] * g * of("sin", angles[1]) if len(masses) == 2 else ZERO)
        numbers = [
            (of("sin", angles[0]), number("0.5")),
            (of("sin", angles[0]), of("sqrt", number(2)) / 2),
            (of("sin", angles[0]), of("sqrt", number(3)) / 2),
            (of("sin", angles[0]), of("cos", angles[0])),
            (of("sin", angles[0]), of("cos", 2 * angles[0])),
            (of("sin", angles[-1]), of("sin", angles[0])),
            (of("sin", angles[0]), of("sin", PI - 3 * angles[0])),
            (g, number("9.81")),
            (masses[-1], masses[0]),
        ]
        claims = [
            Claim(total * a, pull),
            Claim(a, pull / total),
            Claim(a, g * of("cos", angles[0])),
            Claim(total * a, (masses[0] - masses[-1] if len(masses) == 2 else masses[0]) * g * of("sin", angles[-1])),
        ]
    elif kind == "oscillator":
        m = s.parameter("m", rng.choice([number(2), of("sqrt", number(2)), of("sqrt", number(3)), of("sqrt", number(7))]))
        f0 = s.parameter("f0", draws(rng, (5, 20)))
        w = s.parameter("w", rng.choice([2 * PI * f0, 2 * PI, PI / 4, of("sqrt", number(5))]))
        q = s.coordinate("x", draws(rng, (-20, 20)), draws(rng, (-20, 20)))
        s.particle("P", m, [q, ZERO])
        s.force("x", -m * w**2 * q + f0)
        numbers = [
            (w**2, 4 * PI**2),
            (w**2, number(5)),
            (w**2, 4 * PI**2 * f0**2),
            (m**2, number(2)),
            (m * w**2, 3 * w**2),
            (w, PI / 4),
            (m**2, number(7)),
        ]
        claims = [Claim(m * name("x''") + m * w**2 * q, f0), Claim(m**2 * name("x''") + m**2 * w**2 * q, f0 * m)]
    elif kind == "pendulum":
        same = draws(rng, (5, 20))
        m, length, big = s.parameter("m", same), s.parameter("l", same), s.parameter("M", same)
        inertia = s.parameter("J", m * length**2 / 3) if rng.random() < 0.5 else s.parameter("J", draws(rng, (1, 10)))
        s.gravity = [ZERO, -g]
        q = s.coordinate("theta", draws(rng, (-10, 10)))
        s.particle("P", m, [length * of("sin", q), -length * of("cos", q)])
        s.kinetic = inertia * name("theta'") ** 2 / 2
        s.force("theta", big * of("cos", q))
        numbers = [(inertia, m * length**2 / 3), (big, m), (length, m), (g, number("9.81")), (m * length, big**2)]
        claims = [
            Claim((m * length**2 + inertia) * name("theta''") + m * g * length * of("sin", q), big * of("cos", q)),
            Claim((m * length**2 + m * length**2 / 3) * name("theta''") + m * g * length * of("sin", q), big * of("cos", q)),
        ]
    else:
        degrees = rng.choice([30, 40, 45, 60])
        a = s.parameter("a", number(degrees) * PI / 180, f'"{degrees} deg"', kind="shift")
        w = s.parameter("w", draws(rng, (10, 40)))
        s.gravity, s.time = [ZERO, ZERO, -g], True
        r, t = s.coordinate("r", draws(rng, (2, 20)), draws(rng, (-10, 10))), name("t")
        s.particle(
            "bead", number(1), [r * of("sin", a) * of("cos", w * t), r * of("sin", a) * of("sin", w * t), r * of("cos", a)]
        )
        right = w**2 * of("sin", a) ** 2 * r - g * of("cos", a)
        numbers = [
            (of("sin", a) ** 2, number("0.25")),
            (of("sin", a) ** 2, number("0.5")),
            (of("sin", a), of("cos", a)),
            (of("cos", a), 1 - of("sin", a)),
            (of("sin", a) ** 2, 1 - of("cos", a) ** 2),
        ]
        form = g * of("cos", a) / (w * of("sin", a)) ** 2
        claims = [
            Claim(name("r''"), right),
            Claim(r, form + name("A") * of("exp", w * of(rng.choice(["sin", "sin", "cos"]), a) * t), "solution", ["A"]),
        ]
    base = claims[0]
    for old, new in rng.sample(numbers, min(4, len(numbers))):
        change = lambda e, o=old, w=new: replaced(e, lambda n: w if n == o else None)  # noqa: E731
        both = change(base.left), change(base.right)
        claims.append(Claim(*both) if both != (base.left, base.right) else Claim(old, new))
    for _ in range(2):
        changed = slipped(rng, base.left - base.right, s)
        if changed is not None:
            claims.append(Claim(changed, ZERO))
    return s, claims


@family
def integrals(rng):
    """Constants of the motion, and what only looks like one."""
    s = Scene()
    m, k = s.parameter("m", draws(rng, (5, 30))), s.parameter("k", draws(rng, (5, 50)))
    if rng.random() < 0.3:
        x, y = s.coordinate("x", draws(rng, (2, 20)), draws(rng, (-20, 20))), s.coordinate(
            "y", draws(rng, (-20, 20)), draws(rng, (2, 20))
        )
        s.particle("P", m, [x, y])
        s.potential = k * (x**2 + y**2) / 2
        moment = m * (x * name("y'") - y * name("x'"))
        energy = m * (name("x'") ** 2 + name("y'") ** 2) / 2 + s.potential
        good = [
            moment,
            of("abs", moment),
            moment**2,
            of("sign", moment),
            of("sqrt", moment**2),
            energy,
            energy * moment,
            of("abs", moment) + energy,
            of("max", moment, energy),
            m * name("x'") ** 2 / 2 + k * x**2 / 2,
        ]
        bad = [
            x * name("y'") + y * name("x'"),
            of("abs", x * name("y'")) - of("abs", y * name("x'")),
            energy + of("sign", x),
            moment * of("sign", y),
            of("atan2", y, x) - of("atan", y / x),
        ]
    else:
        x = s.coordinate("x", draws(rng, (-30, 30)), draws(rng, (-20, 20)))
        v = name("x'")
        s.particle("P", m, [x, ZERO])
        d = threshold(rng)
        form = rng.randrange(5)
        s.force(
            "x",
            [
                -k * x,
                -k * of("abs", x),
                -k * of("max", 0, x - d) + k * of("max", 0, -x - d),
                -k * x - k * of("abs", x - d),
                -k * of("sign", x - d),
            ][form],
        )
        stored = [
            k * x**2 / 2,
            k * x * of("abs", x) / 2,
            k * of("max", 0, x - d) ** 2 / 2 + k * of("max", 0, -x - d) ** 2 / 2,
            k * x**2 / 2 + k * (x - d) * of("abs", x - d) / 2,
            k * of("abs", x - d),
        ][form]
        energy = m * v**2 / 2 + stored
        a = draws(rng, (2, 30))
        good = [energy, rewritten(rng, energy), 2 * energy, energy**2, of("abs", energy), energy + a]
        bad = [
            of("sign", x),
            of("sign", v),
            of("min", x**2, number(20)),
            of("max", x, number(30)),
            energy + a * of("sign", x),
            energy + a * of("sign", x - d),
            energy + a * of("max", 0, x - 20),
            energy + a * of("sign", v),
            energy * of("sign", x),
            x / of("abs", x),
            of("sign", x) * of("sign", v),
            of("abs", x) / x + energy,
            of("atan2", 0 * x + 1, x) - of("atan", 1 / x),
            of("sign", x**2 + 1),
            of("acos", of("sign", x)),
            one_sided(rng, energy) or energy * x,
            one_sided(rng, rewritten(rng, energy, 1)) or energy + x,
            slipped(rng, energy, s) or x,
        ]
    chosen = rng.sample(good, 3) + rng.sample(bad, 4)
    return s, [Claim(f, name(f"C{n}"), constants=[f"C{n}"]) for n, f in enumerate(chosen)]


@family
def rest(rng):
    """States of rest that are roots of integers, angles modulo pi, states behind a stop."""
    s = Scene()
    kind = rng.choice(["well", "well", "cogging", "stop", "two", "product"])
    unit = s.parameter("m", draws(rng, (5, 30)))
    c = number("0.1")
    if kind == "cogging":
        n = rng.choice([2, 3, 4, 6])
        q = s.coordinate("theta", number(rng.randint(0, 2 * n)) * PI / n)
        s.particle("P", unit, [of("cos", q), of("sin", q)])
        s.force("theta", -s.parameter("T0", draws(rng, (1, 30))) * of("sin", n * q) - c * name("theta'"))
        pairs = [(of(f, j * q), ZERO) for f in ("sin", "cos") for j in {1, 2, 3, n, 2 * n}]
        pairs += [(of("sin", q) * of("cos", q), ZERO), (of("cos", n * q) ** 2, ONE), (of("cos", 2 * n * q), ONE)]
    else:
        q = s.coordinate("x", ZERO)
        s.particle("P", unit, [q, ZERO])
        a = number(rng.choice(["2", "3", "5", "7", "1.5", "6", "4"]))
        b = number(rng.choice(["2", "3", "5", "7", "11"]))
        if kind == "well":
            s.force("x", a * q - q**3 - c * name("x'"))
            start = rng.choice([ZERO, of("sqrt", a), -of("sqrt", a), number("0.4")])
            pairs = [
                (q, ZERO),
                (q**2, a),
                (q * (q**2 - a), ZERO),
                (q**3, a * q),
                (q - of("sqrt", a), ZERO),
                (q * of("abs", q), ZERO),
                (of("abs", q), of("sqrt", a)),
                (q**5, a**2 * q),
                (q**3 * (q**2 - a), ZERO),
            ]
        elif kind == "product":
            s.force("x", (q**2 - a) * (q**2 - b) * (1 if rng.random() < 0.5 else -q))
            start = rng.choice([of("sqrt", a), of("sqrt", b), ZERO])
            pairs = [
                (q**2, a),
                (q**2, b),
                ((q**2 - a) * (q**2 - b), ZERO),
                (q * (q**2 - a) * (q**2 - b), ZERO),
                (q, ZERO),
                (q * (q**2 - a), ZERO),
                (q**4 + a * b, (a + b) * q**2),
            ]
        elif kind == "stop":
            k, d = s.parameter("k", draws(rng, (10, 50))), threshold(rng)
            load = draws(rng, (-60, 60))
            s.force("x", load - k * of("max", 0, q - d) + k * of("max", 0, -q - d))
            start = rng.choice([ZERO, d + 1])
            big = s.parameter("ks", draws(rng, (10, 50)))
            if rng.random() < 0.5:
                s.force("x", -big * q)
            pairs = [
                (q, d + load / k),
                (q, -d + load / k),
                (load - k * of("max", 0, q - d) + k * of("max", 0, -q - d), ZERO),
                (k * of("max", 0, q - d), load),
                (of("max", 0, -q - d), ZERO),
                (of("max", 0, q - d), ZERO),
                (q, load / big),
                (big * q + k * of("max", 0, q - d), load + k * of("max", 0, -q - d)),
            ]
        else:
            y = s.coordinate("y", rng.choice([ZERO, of("sqrt", b)]))
            s.particle("Q", unit, [ZERO, y])
            s.force("x", a * q - q**3)
            s.force("y", (y**2 - b) * (1 if rng.random() < 0.5 else y))
            start = rng.choice([ZERO, of("sqrt", a)])
            pairs = [
                (q, ZERO),
                (y**2, b),
                (q * (q**2 - a), ZERO),
                (q * y, ZERO),
                (q**2 + y**2, a + b),
                (y**3, b * y),
                (q * (y**2 - b), ZERO),
            ]
        s.coordinates["x"] = (start, ZERO, None, False)
    return s, [Claim(*p, at="rest") for p in rng.sample(pairs, min(6, len(pairs)))]


@family
def factors(rng):
    """The same claim multiplied by what vanishes somewhere, and nowhere."""
    s, claims = rng.choice([sides, rates, smooth])(rng)
    variables = [name(q + dots) for q in s.coordinates for dots in ("", "'")]
    found = []
    for claim in claims[:3]:
        left, right = claim.left, claim.right
        found.append(claim)
        for make in (vanishing, never_vanishing):
            factor = make(rng, variables)
            found.append(
                Claim(factor * left, factor * right) if rng.random() < 0.6 else Claim(factor * (left - right), ZERO)
            )
    return s, found


@family
def neighbours(rng):
    """Claims of one side of a load beside claims that speak of the same side."""
    s = line(rng)
    k = s.parameter("k", draws(rng, (5, 30)))
    d = rng.choice([number(1), number("0.05"), number(20)])
    q = rng.choice([name("x"), name("x"), name("x'")])
    e = q - d
    s.force("x", -k * name("x") - k * of("abs", e))
    a, m = name("x''"), name("m")
    claims = [
        Claim(m * a + k * name("x") + k * (d - q), ZERO),
        Claim(m * a + k * name("x") + k * (q - d), ZERO),
        Claim(of("sqrt", e**2), -e),
        Claim(of("sqrt", e**2), e),
        Claim(of("abs", e), -e),
        Claim(of("sign", e), -ONE),
        Claim(m * a + k * name("x") + k * of("sqrt", e**2), ZERO),
        Claim(of("max", q, d), d),
        Claim(of("sqrt", e**2), of("abs", e)),
    ]
    return s, rng.sample(claims, 5)


@family
def primes(rng):
    """Coefficients that are 0 or 1 modulo 2^61 - 1, the prime of the program's arithmetic."""
    s = line(rng)
    k, q, a = s.parameter("k", draws(rng, (5, 30))), name("x"), name("x''")
    s.force("x", -k * q)
    p = 2**61 - 1
    big, one = number(p * rng.randint(1, 3)), number(p * rng.randint(1, 3) + 1)
    m = name("m")
    claims = [
        Claim(m * a + k * q + big * q ** rng.randint(1, 5), ZERO),
        Claim(one * a, a),
        Claim(of("cos", one * q), ONE),
        Claim(of("exp", number((p - 1) // 2) * q), of("exp", 0 * q)),
        Claim(m * a + one * k * q, ZERO),
        Claim(of("sin", one * q), of("sin", q)),
        Claim(m * a + k * q, big * name("x'")),
        Claim(of("cos", number(p - 1) * q), of("cos", 0 * q)),
        Claim(of("abs", big * q), big * q),
        Claim(one * m * a + one * k * q, ZERO),
    ]
    return s, rng.sample(claims, 6)


@family
def where(rng):
    """Claims with an assumption, on either side of the start."""
    s = line(rng)
    s.force("x", plain_load(rng, s, "x") + sided_load(rng, s, rng.choice([name("x"), name("x'")]), "s"))
    claims = []
    for claim in equation_claims(rng, s, 3) + [Claim(*identity(rng, [name("x"), name("x'")])) for _ in range(4)]:
        inner = [n.args[0] for t in (claim.left, claim.right) for n in parts(t) if n.op in ("abs", "sign")]
        inner += [
            n.args[0].args[0] for t in (claim.left, claim.right) for n in parts(t) if n.op == "sqrt" and n.args[0].op == "^"
        ]
        e = rng.choice(inner) if inner else linear(rng, [name("x"), name("x'")])
        claims.append(Claim(claim.left, claim.right, where=[rng.choice([e, -e])]))
    return s, claims


@family
def smooth(rng):
    """Nothing to assume: a control."""
    kind = rng.choice(["pendulum", "cart", "bead", "plane", "double"])
    s = Scene()
    m, g = s.parameter("m", draws(rng, (5, 30))), s.parameter("g", number("9.81"))
    s.gravity = [ZERO, -g]
    if kind == "pendulum":
        length, q = s.parameter("l", draws(rng, (5, 20))), s.coordinate(
            "theta", draws(rng, (-20, 20)), draws(rng, (-20, 20))
        )
        s.particle("P", m, [length * of("sin", q), -length * of("cos", q)])
        s.force("theta", -s.parameter("c", draws(rng, (1, 9))) * name("theta'"))
    elif kind == "cart":
        big, length = s.parameter("M", draws(rng, (5, 30))), s.parameter("l", draws(rng, (5, 20)))
        x, q = s.coordinate("x", draws(rng, (-20, 20))), s.coordinate("theta", draws(rng, (-20, 20)), draws(rng, (-20, 20)))
        s.particle("cart", big, [x, ZERO])
        s.particle("P", m, [x + length * of("sin", q), -length * of("cos", q)])
    elif kind == "bead":
        q, a = s.coordinate("x", draws(rng, (-20, 20)), draws(rng, (-20, 20))), s.parameter("a", draws(rng, (2, 20)))
        s.particle("P", m, [q, a * q**2])
    elif kind == "plane":
        x, y = s.coordinate("x", draws(rng, (-20, 20))), s.coordinate("y", draws(rng, (-20, 20)), draws(rng, (-20, 20)))
        s.particle("P", m, [x, y])
        s.potential = s.parameter("k", draws(rng, (5, 30))) * (x**2 + y**2) ** 2 / 4 + of("exp", x)
    else:
        a, b = s.coordinate("a", draws(rng, (-20, 20))), s.coordinate("b", draws(rng, (-20, 20)), draws(rng, (-20, 20)))
        s.particle("P", m, [of("sin", a), -of("cos", a)])
        s.particle("Q", 2 * m, [of("sin", a) + of("sin", b), -of("cos", a) - of("cos", b)])
    return s, equation_claims(rng, s, 5)


@family
def switching(rng):
    """Loads that switch with time."""
    s = line(rng)
    s.time = True
    a, b = s.parameter("a", draws(rng, (5, 30))), s.parameter("b", draws(rng, (2, 20)))
    q, t, w = name("x"), name("t"), number(rng.choice(["1", "2", "3"]))
    wave = rng.choice(
        [
            of("sign", of("sin", w * t)),
            of("sign", of("sin", w * t + 1)),
            of("sign", t - 3),
            of("abs", of("sin", w * t)),
            of("max", 0, of("cos", w * t)),
            of("sign", 5 - t),
        ]
    )
    s.potential = (a + b * wave) * q**2 / 2
    v, m = name("x'"), name("m")
    energy = m * v**2 / 2 + s.potential
    claims = equation_claims(rng, s, 4)
    claims += [
        Claim(f, name(f"C{k}"), constants=[f"C{k}"])
        for k, f in enumerate([energy, m * v**2 / 2 + (a + b) * q**2 / 2, wave, m * v**2 / 2])
    ]
    return s, claims + [Claim(wave, rng.choice([ONE, -ONE, ZERO])), Claim(of("abs", of("sin", w * t)), of("sin", w * t))]


@family
def solutions(rng):
    """Closed forms, of scenes with a stop too."""
    s = line(rng, number(1), ZERO)
    m, q, t = name("m"), name("x"), name("t")
    k = s.parameter("k", rng.choice([draws(rng, (5, 50)), of("sqrt", number(2)), PI / 3]))
    stop = rng.random() < 0.4
    s.force(
        "x",
        -k * q
        + (s.parameter("ks", number(9)) * of("max", 0, -q - number(rng.choice(["0.05", "2", "20"]))) if stop else ZERO),
    )
    w = of("sqrt", k / m)
    a, b = name("A"), name("B")
    found = [
        a * of("cos", w * t) + b * of("sin", w * t),
        a * of("cos", w * t + b),
        a * of("sin", w * t),
        a * of("cosh", w * t),
        a * of("cos", k / m * t),
        a * of("exp", -w * t),
        of("cos", w * t),
        a * of("abs", of("cos", w * t)),
        a * of("cos", w * t) ** 2,
    ]
    form = rng.choice(found)
    constants = sorted({n for n, _ in used(form)} & {"A", "B"})
    return s, [Claim(q, form, "solution", constants), *equation_claims(rng, s, 2)]
