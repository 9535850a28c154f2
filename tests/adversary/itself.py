# SPDX-License-Identifier: MIT
"""Whether the adversary itself is right: its numbers against closed forms, its verdicts against known ones, and whether it sees
each word of a program that lies."""

import random

import mpmath
from mpmath import mpf

import constrained  # noqa: F401
import judge
import more  # noqa: F401
import rest
from families import FAMILIES
from scene import Constraint, Scene
from trees import PI, ZERO, Compiled, NotRead, Undefined, derivative, name, number, of, plain, read, used, value, write
from truth import FAILS, HOLDS, Claim, Truth


class Wrong(Exception):
    pass


def same(a, b, what, bound="1e-50"):
    if abs(a - b) > mpf(bound) * (1 + abs(a)):
        raise Wrong(f"{what}: {mpmath.nstr(a, 30)} and {mpmath.nstr(b, 30)}")


# -- expressions


def expressions():
    """Trees are written, read again and differentiated; doubles agree with 60 digits; slopes with differences of mpmath."""
    seen = 0
    for seed in range(60):
        rng = random.Random(seed)
        scene, claims = FAMILIES[rng.choice(sorted(set(FAMILIES) - {"primes"}))](rng)
        for claim in claims:
            node = plain(claim.left - claim.right)
            state = {key: mpf(rng.uniform(0.3, 2.7)) for key in used(node)}
            try:
                there, again = value(node, state), value(read(write(node)), state)
                same(there, again, f"{write(node)} read again")
                single = Compiled([node]).many({k: float(v) for k, v in state.items()}, 1)[0][0]
                if abs(there) < 1e9:
                    same(there, mpf(float(single)), f"{write(node)} in doubles", "1e-7")
                for key in sorted(used(node)):
                    by = mpmath.diff(lambda x, k=key: value(node, {**state, k: x}), state[key], h=mpf("1e-25"))
                    same(value(derivative(node, key), state), by, f"the slope of {write(node)} by {key}", "1e-12")
                seen += 1
            except (Undefined, NotRead):
                continue
    return seen


# -- mechanics


def _at(scene, **values):
    state = scene.values()
    for key, v in values.items():
        label = key.rstrip("_")
        state[label, len(key) - len(label)] = mpf(v)
    state["t", 0] = mpf(0)
    return scene.motion().accelerate(state)


def mechanics():
    g, l, m, big = mpf("9.81"), mpf("0.8"), mpf("0.5"), mpf(2)
    s = Scene()
    parameters = {k: s.parameter(k, number(v)) for k, v in (("g", "9.81"), ("l", "0.8"), ("m", "0.5"), ("M", "2"))}
    s.gravity = [ZERO, -parameters["g"]]
    x, q = s.coordinate("x"), s.coordinate("theta")
    s.particle("cart", parameters["M"], [x, ZERO])
    s.particle("bob", parameters["m"], [x + parameters["l"] * of("sin", q), -parameters["l"] * of("cos", q)])
    there = _at(s, x="0.3", theta="0.7", x_="1.1", theta_="-2.3")
    th, w = mpf("0.7"), mpf("-2.3")
    acceleration = (m * l * w**2 * mpmath.sin(th) + m * g * mpmath.sin(th) * mpmath.cos(th)) / (
        big + m * mpmath.sin(th) ** 2
    )
    same(there["x", 2], acceleration, "a pendulum on a cart, x''")
    same(there["theta", 2], -(g * mpmath.sin(th) + acceleration * mpmath.cos(th)) / l, "a pendulum on a cart, theta''")

    s = Scene()  # the same pendulum by its Cartesian coordinates
    parameters = {k: s.parameter(k, number(v)) for k, v in (("g", "9.81"), ("l", "0.8"), ("m", "0.5"))}
    s.gravity = [ZERO, -parameters["g"]]
    angle = number("0.7")
    x = s.coordinate("x", parameters["l"] * of("sin", angle))
    y = s.coordinate("y", -parameters["l"] * of("cos", angle))
    s.particle("bob", parameters["m"], [x, y])
    own = x**2 + y**2 - parameters["l"] ** 2
    s.constraints.append(Constraint("rod", own * (x + 7), own))
    state = s.start()
    state["x", 1], state["y", 1] = l * w * mpmath.cos(th), l * w * mpmath.sin(th)
    there = s.motion().polish(state)
    turned = -g / l * mpmath.sin(th)
    same(there["x", 2], l * turned * mpmath.cos(th) - l * w**2 * mpmath.sin(th), "a pendulum by x and y, x''")
    tension = m * (l * w**2 + g * mpmath.cos(th))
    same(
        there["lambda_rod", 0] * 2 * l * (l * mpmath.sin(th) + 7), -tension, "its multiplier, of the product that is written"
    )

    s = Scene()  # quadratic drag upwards and downwards, by the length of the velocity
    parameters = {k: s.parameter(k, number(v)) for k, v in (("g", "9.81"), ("c", "0.3"), ("m", "0.5"))}
    s.gravity = [ZERO, -parameters["g"]]
    y = s.coordinate("y")
    s.particle("P", parameters["m"], [ZERO, y])
    s.pushes.append(("P", [ZERO, -parameters["c"] * s.norm("P") * name("y'")]))
    for speed in (mpf(3), mpf(-3)):
        same(_at(s, y=0, y_=speed)["y", 2], -g - mpf("0.3") / m * abs(speed) * speed, "drag")
    return 6


def roots():
    s = Scene()
    x = s.coordinate("x")
    s.particle("P", number(1), [x, ZERO])
    cases = [
        ((x**2 - 3) * (x - number("0.4")) ** 2, {mpmath.sqrt(3): "rising", -mpmath.sqrt(3): "falling", mpf(2) / 5: "below"}),
        (3 * x - x**3, {mpf(0): "rising", mpmath.sqrt(3): "falling", -mpmath.sqrt(3): "falling"}),
        (-9 - 100 * of("max", 0, x - 1) + 100 * of("max", 0, -x - 1), {mpf("-1.09"): "falling"}),
        (-of("sign", x - 2), {}),
    ]
    for force, expected in cases:
        found = dict(rest.roots(force, "x", {}))
        if len(found) != len(expected):
            raise Wrong(f"roots of {write(force)}: {found}")
        for root, kind in expected.items():
            near = min(found, key=lambda f, r=root: abs(f - r))
            same(near, root, f"a root of {write(force)}", "1e-20")
            if found[near] != kind:
                raise Wrong(f"{write(force)} at {near} is {found[near]}, not {kind}")
    return len(cases)


# -- verdicts that are known


def _stop():
    s = Scene()
    m, k, ks = s.parameter("m", number("1.5")), s.parameter("k", number(30)), s.parameter("ks", number(200))
    x = s.coordinate("x", number("0.02"), number("0.1"))
    s.particle("P", m, [x, ZERO])
    stop = ks * of("max", 0, -x - number("0.05"))
    s.force("x", -k * x + stop)
    a, v = name("x''"), name("x'")
    energy = m * v**2 / 2 + k * x**2 / 2
    return s, [
        (Claim(m * a + k * x, ZERO), FAILS),
        (Claim(m * a + k * x + stop, ZERO), FAILS),
        (Claim(m * a + k * x - stop, ZERO), HOLDS),
        (Claim(of("abs", x - 20), 20 - x), FAILS),
        (Claim(of("sign", v + 4), number(1)), FAILS),
        (Claim(of("max", 0, x - 3), ZERO), FAILS),
        (Claim(of("sqrt", (x - 20) ** 2), of("abs", x - 20)), HOLDS),
        (Claim(energy, name("C"), constants=["C"]), FAILS),
        (Claim(of("sign", x), name("C"), constants=["C"]), FAILS),
        (Claim(energy + ks * of("max", 0, -x - number("0.05")) ** 2 / 2, name("C"), constants=["C"]), HOLDS),
        (Claim(of("min", x**2, 20), name("C"), constants=["C"]), FAILS),
        (Claim(x, ZERO, "rest"), HOLDS),
        (Claim(of("sqrt", (x - 20) ** 2), 20 - x, where=[20 - x]), HOLDS),
        (Claim(of("sqrt", x**2), x, where=[-x]), FAILS),
    ]


def _branches():
    s = Scene()
    a, b = s.coordinate("a", number("0.3")), s.coordinate("b", number("0.3") + 2 * PI / 3)
    s.particle("P", number(1), [a, ZERO])
    s.particle("Q", number(2), [b, ZERO])
    s.constraints.append(Constraint("z0", of("cos", 3 * a) - of("cos", 3 * b), b - a - 2 * PI / 3))
    return s, [
        (Claim(of("cos", a), of("cos", b)), FAILS),
        (Claim(name("b'"), name("a'")), HOLDS),
        (Claim(name("b'"), -name("a'")), FAILS),
        (Claim(of("cos", 3 * a), of("cos", 3 * b)), HOLDS),
        (Claim(of("sin", b - a), of("sqrt", number(3)) / 2), HOLDS),
    ]


def _lines():
    s = Scene()
    x, y = s.coordinate("x", of("sqrt", number(3))), s.coordinate("y", number(1))
    s.particle("P", number(1), [x, ZERO])
    s.particle("Q", number(2), [y, ZERO])
    s.constraints.append(Constraint("z0", (x - y) * (x**2 - 3 * y**2), x - of("sqrt", number(3)) * y))
    return s, [
        (Claim(x, y), FAILS),
        (Claim(name("x'"), name("y'")), FAILS),
        (Claim(name("x'"), of("sqrt", number(3)) * name("y'")), HOLDS),
        (Claim(x**2, 3 * y**2), HOLDS),
        (Claim(x, -of("sqrt", number(3)) * y), FAILS),
    ]


def _slope():
    s = Scene()
    g = s.parameter("g", number("9.81"))
    alpha = s.parameter("alpha", number(45) * PI / 180, '{ value = 45, unit = "deg" }', kind="shift")
    s.gravity = [ZERO, -g]
    q = s.coordinate("s")
    s.particle("P", number(1), [q * of("cos", alpha), -q * of("sin", alpha)])
    a = name("s''")
    return s, [
        (Claim(a, g * of("cos", alpha)), FAILS),
        (Claim(a, number("9.81") * of("sin", alpha)), FAILS),
        (Claim(a, g * of("sin", alpha)), HOLDS),
    ]


def _well():
    s = Scene()
    x = s.coordinate("x", of("sqrt", number(3)))
    s.particle("P", number(1), [x, ZERO])
    s.force("x", 3 * x - x**3 - name("x'") / 10)
    return s, [(Claim(x, ZERO, "rest"), FAILS), (Claim(x**3, 3 * x, "rest"), HOLDS), (Claim(x**2, number(3), "rest"), FAILS)]


def known():
    count = 0
    for make in (_stop, _branches, _lines, _slope, _well):
        scene, claims = make()
        truth = Truth(scene, 3)
        for claim, expected in claims:
            found = truth.judge(claim).kind
            if found != expected:
                raise Wrong(f"{claim.text} {found}; it should be that it {expected}")
            count += 1
    return count


# -- a program that lies


class Liar:
    """Says what is true, but of one claim, or in one printed equation."""

    def __init__(self, scene, claims, truths):
        self.scene, self.lies = scene, {}
        self.right = {c.text: "proved" if t.kind == HOLDS else "refuted" for c, t in zip(claims, truths)}
        self.claims = claims

    def ask(self, text, verb, *_):
        if verb == "derive":
            rows = [f"{write(left)} = {write(right)}" for left, right in self.printed]
            return 0, {"equations": [{"text": r} for r in rows], "where": []}, ""
        rows = [{"verdict": self.lies.get(c.text, self.right[c.text])} for c in self.claims]
        said = {r["verdict"] for r in rows}
        return 1 if "refuted" in said else 2 if "vacuous" in said else 0, {"claims": rows}, ""


def lies():
    """Every verdict turned around is found, and nothing else is."""
    count = 0
    for kind in sorted(FAMILIES):
        for seed in range(4):
            scene, claims = FAMILIES[kind](random.Random(f"{kind} {seed}"))
            truth = Truth(scene, seed)
            told = [(c, t) for c, t in ((c, truth.judge(c)) for c in claims) if t.kind in (HOLDS, FAILS)]
            told = [(c, t) for k, (c, t) in enumerate(told) if c.text not in [d.text for d, _ in told[:k]]]
            if not told:
                continue
            claims, truths = [c for c, _ in told], [t for _, t in told]
            liar = Liar(scene, claims, truths)
            _expect(liar, scene, claims, seed, None, None)
            for claim, t in told:
                lie, word = ("refuted", judge.REFUTED) if t.kind == HOLDS else ("proved", judge.PROVED)
                liar.lies = {claim.text: lie}
                _expect(liar, scene, claims, seed, claim, word)
                count += 1
    return count


def _expect(liar, scene, claims, seed, claim, word):
    at = judge.Examined(liar, scene, claims, seed)
    at.examine()
    found = [(f.word, f.claim.text) for f in at.findings]
    if found != ([(word, claim.text)] if word else []):
        raise Wrong(f"of a program that lies about {claim.text if claim else 'nothing'}: {found}\n{scene.text(claims)}")


def printed():
    """Equations of motion are found right; with one side taken, or a row missing, wrong."""
    count = 0
    for kind in ("sides", "rates", "smooth"):
        for seed in range(6):
            scene, _ = FAMILIES[kind](random.Random(f"printed {kind} {seed}"))
            liar = Liar(scene, [], [])
            liar.printed = [(plain(a), plain(b)) for a, b in scene.equations()]
            for change in ("none", "doubled", "missing"):
                rows = list(liar.printed)
                if change == "doubled":
                    rows[0] = (2 * rows[0][0], rows[0][1] + rows[0][0] * 1 + 1)
                elif change == "missing":
                    rows = rows[1:]
                teller = Liar(scene, [], [])
                teller.printed = rows
                found = judge.derived(teller, scene, seed)[0]
                if bool(found) != (change != "none"):
                    raise Wrong(f"printed equations, {change}: {[f.text for f in found]}\n{scene.text()}")
                count += 1
    return count


def all():  # noqa: A001
    try:
        for part in (expressions, mechanics, roots, known, printed, lies):
            print(f"{part.__name__}: {part()} right", flush=True)
    except Wrong as no:
        print(f"wrong: {no}")
        return 1
    return 0
