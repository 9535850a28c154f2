# SPDX-License-Identifier: MIT
"""More families: rolling and blades, impacts, first-order claims near rest, springs whose stiffness changes; and constraints that
are to be refused, degrees of freedom that are to be counted."""

import collections
import random

import constrained  # noqa: F401

from families import FAMILIES, equation_claims, family, line, plain_load, sided_load
from judge import ACCEPTED, DEGREES, Finding
from scene import Constraint, Scene, before
from trees import ONE, PI, ZERO, alias, name, number, of
from truth import Claim
from writings import draws, one_sided, rewritten, slipped, threshold


@family
def blades(rng):
    """Velocity constraints: a blade, a wheel that rolls; speeds by roots of squares of rates."""
    s = Scene()
    m = s.parameter("m", draws(rng, (5, 30)))
    dx, dy = name("x'"), name("y'")
    if rng.random() < 0.5:
        j, angle = s.parameter("J", draws(rng, (1, 20))), number(rng.choice(["0.3", "0", "2.5", "-1"]))
        speed = draws(rng, (-20, 20))
        x = s.coordinate("x", ZERO, speed * of("cos", angle))
        y = s.coordinate("y", ZERO, speed * of("sin", angle))
        phi = s.coordinate("phi", angle, draws(rng, (-10, 10)))
        s.particle("P", m, [x, y])
        s.kinetic = j * name("phi'") ** 2 / 2
        c, d = of("cos", phi), of("sin", phi)
        row = dx * d - dy * c
        s.constraints.append(Constraint("blade", row, holonomic=False))
        if rng.random() < 0.6:
            s.pushes.append(("P", [-s.parameter("c", draws(rng, (1, 20))) * s.norm("P") * u for u in (dx, dy)]))
        along = dx * c + dy * d
        size = of("sqrt", dx**2 + dy**2)
        drag = name("c") * of("abs", along) * along if s.pushes else ZERO
        pairs = [
            (dx * d, dy * c),
            (dy, dx * of("tan", phi)),
            (dx**2 + dy**2, along**2),
            (size, along),
            (size, of("abs", along)),
            (size, -along),
            (name("phi''"), ZERO),
            (m * (name("x''") * c + name("y''") * d), -drag),
            (dx, along * c),
            (m * (name("x''") * c + name("y''") * d), -name("c") * along**2 if s.pushes else along),
            (dx * dy, along**2 * c * d),
            (of("abs", dx), size * of("abs", c)),
            (of("abs", dx), size * c),
            (of("atan2", dy, dx), phi),
        ]
        return s, [Claim(*p) for p in rng.sample(pairs, 7)]
    r, speed = s.parameter("r", draws(rng, (2, 12))), draws(rng, (-20, 20))
    x, phi = s.coordinate("x", ZERO, speed), s.coordinate("phi", ZERO, speed / r)
    s.particle("P", m, [x, ZERO])
    s.kinetic = m * r**2 * name("phi'") ** 2 / 4
    w = name("phi'")
    s.constraints.append(Constraint("roll", dx - r * w, holonomic=False))
    load = plain_load(rng, s, "x") + sided_load(rng, s, rng.choice([x, dx]), "s")
    s.force("x", load)
    row = 3 * m * name("x''") / 2 - load
    pairs = [
        (dx, r * w),
        (dx, -r * w),
        (of("abs", dx), r * of("abs", w)),
        (of("abs", dx), r * w),
        (of("sign", dx), of("sign", w)),
        (row, ZERO),
        (rewritten(rng, row), ZERO),
        (one_sided(rng, row) or row, ZERO),
        (m * name("x''") - load, ZERO),
        (x, r * phi),
        (slipped(rng, row, s) or row, ZERO),
        (of("sqrt", dx**2), r * of("sqrt", w**2)),
        (name("x''"), r * name("phi''")),
        (of("max", dx, 0), r * of("max", w, 0)),
    ]
    return s, [Claim(*p) for p in rng.sample(pairs, 7)]


@family
def impact(rng):
    """Impulses at the pose of the start, of pendulums that are tied on one of several branches."""
    s = Scene()
    m, blow = s.parameter("m", draws(rng, (5, 30))), s.parameter("S", draws(rng, (1, 9)))
    length = s.parameter("l", draws(rng, (5, 20)))
    a0, speed = number(rng.choice(["0.4", "-0.7", "1.1"])), draws(rng, (-9, 9))
    kind = rng.choice(["sin", "cos", "line", "free"])
    p, b0 = ONE, a0
    if kind == "sin" and rng.random() < 0.7:
        p, b0 = -ONE, PI - a0
    elif kind == "cos":
        p, b0 = rng.choice([(-ONE, -a0), (ONE, a0), (ONE, a0 + 2 * PI)])
    elif kind == "line":
        p = rng.choice([number(2), of("sqrt", number(3)), -ONE])
        b0 = p * a0
    a, b = s.coordinate("a", a0, speed), s.coordinate("b", b0, p * speed)
    for label, q, mass in (("A", a, m), ("B", b, 2 * m)):
        s.particle(label, mass, [length * of("sin", q), -length * of("cos", q)])
    own = b - p * a - (b0 - p * a0)
    written = {
        "sin": of("sin", a) - of("sin", b),
        "cos": of("cos", a) - of("cos", b),
        "line": own * (a + 3 * b),
        "free": None,
    }[kind]
    if written is not None:
        s.constraints.append(Constraint("tie", written, own))
    s.impulses["a"] = blow
    da, db, jump = name("a'"), name("b'"), name("a'") - before("a")
    whole = m * length**2 * (ONE if written is None else 1 + 2 * p**2)
    pairs = [
        (da, p * db),
        (db, p * da),
        (db, -da),
        (jump, blow / whole),
        (jump, blow / (3 * m * length**2)),
        (jump, blow / (m * length**2)),
        (db - before("b"), p * blow / whole),
        (db - before("b"), ZERO),
        (whole * jump, blow),
        (of("abs", jump), blow / whole),
        (da, blow / whole),
        (of("sin", a), of("sin", b)),
        (a, b),
        (m * length**2 * jump + 2 * m * length**2 * p * (db - before("b")), blow),
        (da**2 - before("a") ** 2, jump * (da + before("a"))),
    ]
    return s, [Claim(*q, at="impact") for q in rng.sample(pairs, 6)]


@family
def near(rng):
    """To first order near rest, beside stops that are not reached there, or are."""
    s = line(rng, ZERO, ZERO)
    q, v, a, m = name("x"), name("x'"), name("x''"), name("m")
    k, c = s.parameter("k", draws(rng, (5, 60))), s.parameter("c", draws(rng, (1, 20)))
    ks, d = s.parameter("ks", draws(rng, (5, 60))), rng.choice([number("0.05"), number(3), -number(1), number(20)])
    load = rng.choice(
        [
            -k * q - ks * of("max", 0, q - d) + ks * of("max", 0, -d),
            -k * q - ks * (of("abs", q - d) - of("abs", -d)),
            -k * of("sin", q) - c * of("abs", v) * v,
            -k * q - c * v - ks * q**3,
            -k * q * of("sqrt", (q - d) ** 2),
            -k * of("sin", q) * of("exp", q),
            -k * q - c * of("abs", v - d) * v,
        ]
    )
    s.force("x", load)
    far = of("abs", number(d.args[0]))
    pairs = [
        (m * a + k * q, ZERO),
        (m * a + (k + ks) * q, ZERO),
        (m * a + (k - ks) * q, ZERO),
        (m * a + c * v + k * q, ZERO),
        (m * a - k * q, ZERO),
        (m * a + k * far * q, ZERO),
        (m * a + k * q + far * c * v, ZERO),
        (m * a, load),
        (m * a + k * d * q, ZERO),
        (m * a + c * d * v + k * q, ZERO),
        (m * a + k * of("tan", q), ZERO),
    ]
    return s, [Claim(*p, near={"x": ZERO}) for p in rng.sample(pairs, 6)]


@family
def stiff(rng):
    """Springs whose stiffness and length change, with speeds and definitions as names."""
    s = Scene()
    m, k, d, free = (s.parameter(n, draws(rng, (2, 30))) for n in ("m", "k", "d", "l"))
    q = s.coordinate("q", draws(rng, (1, 9)), draws(rng, (-9, 9)))
    s.particle("P", m, [q, ZERO])
    gap = rng.choice([q + d, d, 2 * q, q - d])
    stiffness = rng.choice([k * (1 + q**2), k * of("abs", q), k, k * (2 + of("abs", q - 3))])
    s.springs.append((gap, stiffness, free if rng.random() < 0.6 else ZERO))
    if rng.random() < 0.5:
        stop = s.define(
            "stop",
            rng.choice(
                [of("max", 0, q - threshold(rng)), of("abs", q), of("sign", name("q'")), of("sqrt", name("q'") ** 2)]
            ),
        )
        s.force("q", -k * stop)
    if rng.random() < 0.5:
        s.extra = '[speeds]\nv = "q\'"'
        v = alias("v", name("q'"))
        claims = [Claim(v, name("q'")), Claim(of("abs", v), v), Claim(of("sqrt", v**2), of("abs", name("q'")))]
    else:
        claims = []
    return s, claims + equation_claims(rng, s, 5)


# -- what is no claim


class Asked:
    def __init__(self, verb):
        self.verb = self.text = verb

    def trees(self):
        return []


def nonlinear(program, rng):
    """Velocity constraints that are not linear in the rates are refused by every verb."""
    s = Scene()
    v = draws(rng, (5, 20))
    s.particle("P", number(1), [s.coordinate("x", ZERO, v), s.coordinate("y", ZERO, v)])
    dx, dy = name("x'"), name("y'")
    right = rng.choice(
        [
            of("abs", dx),
            of("sqrt", dx**2),
            of("max", dx, 0),
            of("sign", dx) * dx,
            of("min", dx, 2 * dx),
            dx * dx / of("abs", dx),
            2 * of("max", 0, dx) - dx,
            of("sqrt", dx * dx),
            dx * of("abs", dx) / dx,
            of("max", dx, -dx),
        ]
    )
    s.constraints.append(Constraint("c", dy - right, holonomic=False))
    verb = rng.choice(["derive", "audit", "eval", "check"])
    claims = [Claim(dx, dy)] if verb == "check" else []
    code, _, message = program.ask(s.text(claims), verb)
    counts = collections.Counter(claims=1)
    if code == 3:
        return [], None, counts
    said = f"exit code {code}, expected 3: a constraint that is not linear in the rates; {message[:150]}"
    return [Finding(ACCEPTED, Asked(verb), said, s)], None, counts


def degrees(program, rng):
    """`audit` counts the degrees of freedom of the own branch."""
    kind = rng.choice(["branches", "angles", "angles", "angles", "circles", "roots", "blades"])
    for _ in range(50):
        s, _ = FAMILIES[kind](random.Random(rng.random()))
        if kind != "angles" or len(s.constraints) > 1:
            break
    s.changed()
    own = len(s.coordinates) - len(s.constraints)
    code, answer, message = program.ask(s.text(), "audit")
    counts = collections.Counter(claims=1)
    if code != 0 or answer is None:
        return [], (code, message), counts
    if answer.get("degrees_of_freedom") == own:
        return [], None, counts
    said = f"{answer.get('degrees_of_freedom')} degrees of freedom; there are {own} on the branch of the start"
    return [Finding(DEGREES, Asked("audit"), said, s)], None, counts


KINDS = {"nonlinear": nonlinear, "degrees": degrees}
