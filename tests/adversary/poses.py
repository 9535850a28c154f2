# SPDX-License-Identifier: MIT
"""Equilibria and their stability: what `equilibrium` and `stability` say, against roots found here and closed forms.

One degree of freedom: the force at rest decides by its sign on both sides of a root, with the sign of what damps. Square
waves of time: the matrix over a period is a product of two exponentials. A rotor with internal friction, and potentials with
a normal form in two coordinates, have closed forms.
"""

import collections
from fractions import Fraction

import mpmath
from mpmath import mpf

import rest
from judge import ROOTS, STABLE, Finding
from scene import Scene
from trees import ONE, ZERO, Compiled, NotRead, Undefined, name, number, of, read_conditions, value
from writings import draws, threshold

CLOSE = mpf("1e-3")


class Verb:
    """What was asked, in place of a claim."""

    def __init__(self, verb):
        self.verb = self.text = verb

    def trees(self):
        return []


class Pose:
    """A scene with one coordinate: its force at rest and how it is damped (1, 0, -1), quadratically or not."""

    def __init__(self, scene, damped, angle=False):
        self.scene, self.damped, self.angle = scene, damped, angle
        self.q = list(scene.coordinates)[0]

    def roots(self):
        state = {**self.scene.values(), ("t", 0): mpf(0)}
        return rest.roots(rest.forces(self.scene)[0], self.q, state)

    def truth(self, kind):
        if kind == "falling":
            return {1: "asymptotically stable", 0: "stable", -1: "unstable"}[self.damped]
        return "unstable" if kind in ("rising", "above", "below") else None


def _damping(rng, s, q):
    kind = rng.choice(["none", "none", "linear", "linear", "quadratic", "negative", "blown"])
    v = name(q + "'")
    c = number(rng.choice(["0.1", "0.5", "1", "3"]))
    s.force(
        q,
        {
            "none": ZERO,
            "linear": -c * v,
            "quadratic": -c * of("abs", v) * v,
            "negative": c * v,
            "blown": c * of("abs", v) * v,
        }[kind],
    )
    return {"none": 0, "linear": 1, "quadratic": 1, "negative": -1, "blown": -1}[kind]


def _expanded(factors):
    """Coefficients of a product of (x - r)."""
    coefficients = [number(1).args[0]]
    for r in factors:
        shifted = coefficients + [0]
        for k, c in enumerate(coefficients):
            shifted[k + 1] -= c * r
        coefficients = shifted
    return coefficients


def line_pose(rng):
    s = Scene()
    kind = rng.choice(["polynomial", "polynomial", "fold", "well", "cogging", "torque", "stop", "flat", "pull"])
    m = s.parameter("m", rng.choice([number(1), draws(rng, (5, 30))]))
    if kind in ("cogging", "torque"):
        n = rng.choice([1, 2, 3])
        q = s.coordinate("theta", number(rng.choice(["0.1", "1", "-0.4", "2.9"])))
        length, g = s.parameter("l", draws(rng, (5, 20))), s.parameter("g", number("9.81"))
        s.particle("P", m, [length * of("sin", q), -length * of("cos", q)])
        if kind == "cogging":
            s.force("theta", -s.parameter("T0", draws(rng, (1, 30))) * of("sin", n * q))
        else:
            s.gravity = [ZERO, -g]
            s.force("theta", m * g * length * number(rng.choice(["1", "0.5", "0", "0.3"])))
        return Pose(s, _damping(rng, s, "theta"), True)
    start = number(rng.choice(["0", "0.2", "0.4", "-0.3", "1"]))
    q = s.coordinate("x", start)
    s.particle("P", m, [q, ZERO])
    if kind in ("polynomial", "fold"):
        tenths = rng.sample(range(-20, 21), 3)
        roots = [number(f"{t / 10:.1f}").args[0] for t in tenths]
        multiple = rng.choice([[1, 1, 1], [2, 1], [2], [3], [1, 2], [1]]) if kind == "polynomial" else [2]
        factors = [r for r, k in zip(roots, multiple) for _ in range(k)]
        sign = rng.choice([1, -1])
        if rng.random() < 0.5:
            force, degree = ZERO, len(factors)
            for k, c in enumerate(_expanded(factors)):
                force = force + number(c) * q ** (degree - k)
        else:
            force = ONE
            for r, k in zip(roots, multiple):
                force = force * (q - number(r)) ** k
        s.force("x", sign * force)
        if rng.random() < 0.6:
            near = factors[0] + number(rng.choice(["-0.1", "0.1", "0.05", "0"])).args[0]
            s.coordinates["x"] = (number(near), ZERO, None, False)
    elif kind == "well":
        a = number(rng.choice(["2", "3", "5", "7"]))
        s.coordinates["x"] = (rng.choice([ZERO, of("sqrt", a), number("1.5")]), ZERO, None, False)
        s.force("x", rng.choice([1, 1, -1]) * (a * q - q**3))
    elif kind == "stop":
        k, d = s.parameter("k", draws(rng, (10, 60))), threshold(rng)
        load = draws(rng, (-60, 60))
        s.force("x", load - k * of("max", 0, q - d) + k * of("max", 0, -q - d))
        if rng.random() < 0.4:
            s.force("x", -s.parameter("ks", draws(rng, (5, 30))) * q)
    elif kind == "pull":
        s.potential = 27 * q**2 / 2 - number(rng.choice([4, 3, 2])) / (1 - q)
    else:
        s.force(
            "x",
            rng.choice([1, -1])
            * rng.choice(
                [
                    q**3,
                    q**5,
                    q**25,
                    q**7,
                    q**2,
                    q**4,
                    q * of("abs", q),
                    q**3 - q**5,
                    q * of("exp", -1 / (q**2 + number("0.0001"))),
                ]
            ),
        )
        s.coordinates["x"] = (ZERO, ZERO, None, False)
    return Pose(s, _damping(rng, s, "x"))


def _nearest(pose, roots, x):
    turn = 2 * mpmath.pi

    def far(r):
        d = abs(r - x)
        return min(d % turn, turn - d % turn) if pose.angle else d

    return min(((far(r), r, kind) for r, kind in roots), default=(mpf("inf"), None, None), key=lambda f: f[0])


def equilibria(program, rng):
    """What `equilibrium` lists."""
    pose = line_pose(rng)
    counts = collections.Counter(claims=1)
    roots = pose.roots()
    text = pose.scene.text()
    code, answer, message = program.ask(text, "equilibrium")
    findings = []

    def found(word, said):
        findings.append(Finding(word, Verb("equilibrium"), said, pose.scene))

    shown = ", ".join(f"{mpmath.nstr(r, 10)} ({pose.truth(kind)})" for r, kind in roots if abs(r) < 10)
    if code not in (0, 2) or answer is None:
        if code == 3 and any(abs(r) < 20 for r, _ in roots):
            found(ROOTS, f"refused: {message[:200]}; there are {shown}")
            return findings, None, counts
        return [], None if code == 3 else (code, message), counts
    seen = []
    for e in answer.get("equilibria", ()):
        if e.get("moving") or pose.q not in e["coordinates"]:
            found(ROOTS, f"a steady motion is listed: {e.get('coordinates')}, {e.get('rates')}; there are {shown}")
            break
        x = mpf(e["coordinates"][pose.q])
        far, root, kind = _nearest(pose, roots, x)
        if kind in ("flat", "edge"):
            continue
        if far > CLOSE:
            if abs(_force_at(pose, x)) > mpf("1e-6") and abs(x) < rest.FAR - 1:
                found(ROOTS, f"{mpmath.nstr(x, 12)} is listed; there are {shown}")
            continue
        if any(root == other for other in seen):
            found(ROOTS, f"{mpmath.nstr(root, 12)} is listed again, as {mpmath.nstr(x, 14)}; there are {shown}")
            break
        seen.append(root)
        truth = pose.truth(kind)
        said = e.get("stable")
        if truth and ((said == "yes" and truth == "unstable") or (said == "no" and truth != "unstable")):
            found(
                STABLE,
                f"{mpmath.nstr(x, 14)} is called {'stable' if said == 'yes' else 'unstable'} ({e.get('because')}); "
                f"it is {truth}: the force is {kind} there",
            )
        counts["undecided"] |= said == "undecided"
    if answer.get("complete"):
        for r, kind in roots:
            if kind in ("flat", "edge"):
                continue
            if _nearest(pose, [(s, None) for s in seen], r)[0] > CLOSE:
                found(ROOTS, f"the list is called complete and lacks {mpmath.nstr(r, 12)}; there are {shown}")
                break
    return findings, None, counts


def _force_at(pose, x):
    try:
        state = {**pose.scene.values(), (pose.q, 0): x, ("t", 0): mpf(0)}
        return Compiled(rest.forces(pose.scene)).mp(state)[0]
    except Undefined:
        return mpf("inf")


def wrong(said, truth):
    """Whether a verdict contradicts the truth; `stable` of what is asymptotically stable is right."""
    if said == "undecided" or truth is None:
        return False
    return (said == "unstable") != (truth == "unstable") or (said == "asymptotically stable" and truth == "stable")


def stability(program, rng):
    kind = rng.choice(["line", "line", "line", "line", "wave", "rotor", "normal", "switch"])
    if kind != "line":
        return {"wave": wave, "rotor": rotor, "normal": normal, "switch": switch}[kind](program, rng)
    pose = line_pose(rng)
    counts = collections.Counter(claims=1)
    roots = pose.roots()
    words = ["stability"]
    if rng.random() < 0.6 and roots:
        r = rng.choice([r for r, _ in roots if abs(r) < 20] or [mpf(0)])
        text = _in_pi(r) if pose.angle else repr(float(r))
        words += ["--at", f"{pose.q}={text}"]
    code, answer, message = program.ask(pose.scene.text(), *words)
    if code not in (0, 1, 2) or answer is None:
        return [], None if code == 3 else (code, message), counts
    said = answer.get("verdict")
    counts["undecided"] += said == "undecided"
    x = (
        mpf(answer["coordinates"][pose.q])
        if answer.get("coordinates")
        else value(pose.scene.coordinates[pose.q][0], pose.scene.values())
    )
    far, root, kind = _nearest(pose, roots, x)
    if far > CLOSE:
        return [], None, counts
    truth, findings = pose.truth(kind), []
    verb = Verb(" ".join(words))
    if wrong(said, truth):
        findings.append(
            Finding(
                STABLE,
                verb,
                f"{said} ({answer.get('theorem')}) at {pose.q} = {mpmath.nstr(x, 14)}; it is {truth}: "
                f"the force is {kind} at {mpmath.nstr(root, 14)}",
                pose.scene,
            )
        )
    if {0: 0, 1: 1, 2: 2}[code] != {"unstable": 1, "undecided": 2}.get(said, 0):
        findings.append(Finding("exit code", verb, f"exit code {code} with {said}", pose.scene))
    findings += _conditions(pose, answer, root, truth, verb)
    return findings, None, counts


def _in_pi(x):
    """2*pi/3 for its number; a decimal for what is no such multiple."""
    sixths = x / mpmath.pi * 6
    if abs(sixths - mpmath.nint(sixths)) > 1e-9 or abs(sixths) < 1e-9:
        return repr(float(x))
    part = Fraction(int(mpmath.nint(sixths)), 6)
    text = {1: "pi", -1: "-pi"}.get(part.numerator, f"{part.numerator}*pi")
    return text if part.denominator == 1 else f"{text}/{part.denominator}"


def _conditions(pose, answer, root, truth, verb):
    """Conditions in the parameters hold at the scene's values exactly where the first approximation is stable."""
    conditions = answer.get("conditions") or []
    slope = _slope(pose, root)
    if not conditions or slope is None or abs(slope) < mpf("1e-6"):
        return []
    try:
        values = [Compiled([pose.scene.named(e)]).mp(pose.scene.values())[0] for c in conditions for e in read_conditions(c)]
    except (NotRead, Undefined, KeyError):
        return []
    hold = all(v > 0 for v in values)
    expected = slope < 0 and pose.damped >= 0
    if hold != expected and truth:
        return [
            Finding(
                STABLE,
                verb,
                f"conditions {', '.join(conditions)} {'hold' if hold else 'do not hold'} at the scene's values; "
                f"it is {truth} at {pose.q} = {mpmath.nstr(root, 12)}",
                pose.scene,
            )
        ]
    return []


def _slope(pose, x):
    gap = mpf("1e-20")
    a, b = _force_at(pose, x - gap), _force_at(pose, x + gap)
    return (b - a) / (2 * gap) if mpmath.isfinite(a) and mpmath.isfinite(b) else None


def _said(program, scene, truth, words=("stability",)):
    counts = collections.Counter(claims=1)
    code, answer, message = program.ask(scene.text(), *words)
    if code not in (0, 1, 2) or answer is None:
        return [], None if code == 3 else (code, message), counts
    if words[0] == "equilibrium":
        found = [e for e in answer.get("equilibria", ()) if e.get("stable") == "yes" and truth == "unstable"]
        return (
            (
                [Finding(STABLE, Verb(words[0]), f"called stable ({found[0].get('because')}); it is {truth}", scene)]
                if found
                else []
            ),
            None,
            counts,
        )
    said = answer.get("verdict")
    counts["undecided"] += said == "undecided"
    if wrong(said, truth):
        return (
            [Finding(STABLE, Verb(" ".join(words)), f"{said} ({answer.get('theorem')}); it is {truth}", scene)],
            None,
            counts,
        )
    return [], None, counts


def wave(program, rng):
    """x'' = -(a + b sign(sin(w t + p))) x - d x': multipliers of two exponentials."""
    s = Scene()
    a, b, d = draws(rng, (5, 30)), draws(rng, (1, 20)), number(rng.choice(["0", "0.05", "0.3"]))
    w, p = number(rng.choice([1, 2, 3])), number(rng.choice([0, 1]))
    q = s.coordinate("x", ZERO)
    s.particle("P", ONE, [q, ZERO])
    s.force(
        "x", -(s.parameter("a", a) + s.parameter("b", b) * of("sign", of("sin", w * name("t") + p))) * q - d * name("x'")
    )
    whole = mpmath.eye(2)
    for sign in (1, -1):
        k = mpf(a.args[0].numerator) / a.args[0].denominator + sign * mpf(b.args[0].numerator) / b.args[0].denominator
        whole = mpmath.expm(mpmath.matrix([[0, 1], [-k, -value(d)]]) * (mpmath.pi / value(w))) * whole
    size = max(abs(r) for r in mpmath.eig(whole, left=False, right=False))
    if abs(size - 1) < mpf("1e-3") and d != ZERO or abs(abs(whole[0, 0] + whole[1, 1]) - 2) < mpf("1e-3"):
        return [], None, collections.Counter()
    truth = "unstable" if size > 1 + mpf("1e-6") else "stable" if d == ZERO else "asymptotically stable"
    return _said(program, s, truth, (rng.choice(["stability", "stability", "equilibrium"]),))


def switch(program, rng):
    """Damping that changes its sign at a time: what holds in the end decides."""
    s = Scene()
    q, v, t = s.coordinate("x", ZERO), name("x'"), name("t")
    s.particle("P", ONE, [q, ZERO])
    c, when, sign = number(rng.choice(["0.1", "0.5"])), number(rng.choice([3, 5, 20])), rng.choice([1, -1])
    step = sign * c * of("sign", rng.choice([t - when, 2 * t - when]))
    if rng.random() < 0.5:
        s.inputs["u"] = step
        step = name("u")
    s.force("x", -q + step * v)
    return _said(
        program, s, "unstable" if sign > 0 else "asymptotically stable", (rng.choice(["stability", "equilibrium"]),)
    )


def rotor(program, rng):
    """A shaft with internal friction in the turning axes, and external friction: m z'' + (ci + ce) z' + (k - i ci W) z = 0."""
    s = Scene()
    s.extra = '[[frame]]\nname = "R"\nrotate = [["z", "W*t"]]'
    m, k, ci = s.parameter("m", number(1)), s.parameter("k", draws(rng, (5, 30))), s.parameter("ci", draws(rng, (1, 20)))
    w, ce = s.parameter("W", draws(rng, (1, 60))), draws(rng, (0, 5))
    x, y = s.coordinate("x", ZERO), s.coordinate("y", ZERO)
    s.particle("P", m, [x, y])
    s.potential = k * (x**2 + y**2) / 2
    if ce != ZERO:
        for q in "xy":
            s.force(q, -ce * name(q + "'"))
    by_bend = rng.random() < 0.4
    damping = "ci*(x^2 + y^2)" if by_bend else "ci"
    for axis in "xy":
        s.extra += f'\n[[damper]]\nalong = "dot(pos(P), e{axis}(R))"\ndamping = "{damping}"'
    s.needed = [k, ci, w]
    v = s.values()
    outer, inner, stiff, speed = value(ce), v["ci", 0], v["k", 0], v["W", 0]
    if by_bend:
        truth = "asymptotically stable" if outer else "unstable" if speed > mpmath.sqrt(stiff) else "asymptotically stable"
        if abs(speed - mpmath.sqrt(stiff)) < mpf("0.05"):
            truth = None
    else:
        margin = (outer + inner) ** 2 * stiff - (inner * speed) ** 2
        truth = None if abs(margin) < mpf("1e-6") else "asymptotically stable" if margin > 0 else "unstable"
    return _said(program, s, truth, (rng.choice(["stability", "stability", "equilibrium"]),))


def normal(program, rng):
    """V = s (x - a)^n/n + k (y - p x)^2/2: a minimum where n is even and s > 0."""
    s = Scene()
    n, sign = rng.choice([2, 3, 3, 4, 5, 6]), rng.choice([1, -1])
    a, p = number(rng.choice(["0.5", "0", "0.3", "1"])), number(rng.choice(["1", "2", "-1", "0.5"]))
    near = rng.choice([ZERO, ZERO, number("0.1"), number("-0.2")])
    x, y = s.coordinate("x", a + near), s.coordinate("y", p * (a + near))
    s.kinetic = (name("x'") ** 2 + name("y'") ** 2) / 2
    s.potential = sign * (x - a) ** n / n + draws(rng, (5, 30)) * (y - p * x) ** 2 / 2
    damped = rng.random() < 0.3
    if damped:
        for q in "xy":
            s.force(q, -name(q + "'") / 2)
    truth = "unstable" if n % 2 or sign < 0 else "asymptotically stable" if damped else "stable"
    return _said(program, s, truth, (rng.choice(["stability", "stability", "equilibrium"]),))


KINDS = {"equilibrium": equilibria, "stability": stability}
