# SPDX-License-Identifier: MIT
"""States of rest, found by looking: signs of the force along a line, Newton's method in a plane, all ends in 60 digits."""

import mpmath
import numpy
from mpmath import mpf

from trees import ZERO, Compiled, Undefined, derivative, replaced

FAR = 60
ENOUGH = 40  # roots of one force, those nearest to zero
TINY, SAME, NOTHING, ZERO_AT, AWAY = mpf("1e-52"), mpf("1e-12"), mpf("1e-45"), mpf("1e-30"), mpf("0.1")


def still(node):
    """With all rates zero."""
    return replaced(node, lambda n: ZERO if n.op == "name" and n.args[1] == 1 else None)


def forces(scene):
    """The generalized forces at rest as trees, of scenes without constraints."""
    m = scene.motion()
    return [still(f - b) for f, b in zip(m.force, m.bias)]


def states(scene, values):
    """States of rest at these values of the parameters, as many as are found."""
    if scene.constraints:
        return []
    q = list(scene.coordinates)
    trees = forces(scene)
    base = {**values, ("t", 0): mpf(0)}
    if len(q) == 1:
        return [{**base, (q[0], 0): x, (q[0], 1): mpf(0), (q[0], 2): mpf(0)} for x, _ in roots(trees[0], q[0], base)]
    found = []
    for point in _several(trees, q, base):
        state = dict(base)
        for label, x in zip(q, point):
            state[label, 0], state[label, 1], state[label, 2] = x, mpf(0), mpf(0)
        found.append(state)
    return found


def grid():
    fine = numpy.linspace(-9.0317, 9.0493, 1501)
    wide = numpy.linspace(-FAR - 0.317, FAR + 0.291, 701)
    return numpy.unique(numpy.concatenate([fine, wide]))


def roots(force, q, base):
    """(x, kind) of all zeros of the force found on a line; kind: falling, rising, touching (above or below zero), flat."""
    made, slope = Compiled([force]), Compiled([derivative(force, (q, 0))])
    key, at = (q, 0), grid()
    flat = {k: float(v) for k, v in base.items()}
    f = made.many({**flat, key: at}, len(at))[0]
    found = []

    def sign(x):
        v = made.mp({**base, key: x})[0]
        return (v > 0) - (v < 0)

    for k in sorted(range(len(at) - 1), key=lambda k: abs(at[k])):
        if len(found) > ENOUGH:
            break
        try:
            if f[k] == 0 and sign(mpf(at[k])) == 0:
                found.append((mpf(at[k]), "flat" if f[k + 1] == 0 or (k and f[k - 1] == 0) else "crossing"))
            elif f[k] * f[k + 1] < 0:
                found += _bisected(made, sign, base, key, mpf(at[k]), mpf(at[k + 1]))
            elif (
                0 < k
                and abs(f[k]) <= min(abs(f[k - 1]), abs(f[k + 1]))
                and f[k - 1] * f[k + 1] > 0
                and abs(f[k]) < 0.45 * max(abs(f[k - 1]), abs(f[k + 1]))
            ):
                x = _touched(made, slope, base, key, mpf(at[k]))
                if x is not None:
                    found.append((x, "touching"))
        except Undefined:
            continue
    kinds = []
    for x, kind in found:
        if not any(abs(x - y) < SAME for y, _ in kinds):
            kinds.append((x, _kind(sign, x) if kind != "flat" else "flat"))
    return kinds


def _kind(sign, x):
    gap = mpf("1e-6")
    try:
        below, above = sign(x - gap), sign(x + gap)
    except Undefined:
        return "edge"
    return {(1, -1): "falling", (-1, 1): "rising", (1, 1): "above", (-1, -1): "below"}.get((below, above), "flat")


def _bisected(made, sign, base, key, low, high):
    """A zero between two places of different sign: by halves to 1e-12, then by the secant; none where it jumps."""
    first, top = sign(low), high
    for _ in range(40):
        middle = (low + high) / 2
        s = sign(middle)
        if s == 0:
            return [(middle, "crossing")]
        low, high = (middle, high) if s == first else (low, middle)
    a, b = low, high
    fa, fb = made.mp({**base, key: a})[0], made.mp({**base, key: b})[0]
    for _ in range(12):
        if fa == fb:
            break
        a, fa, b = b, fb, b - fb * (b - a) / (fb - fa)
        fb = made.mp({**base, key: b})[0]
        if fb == 0 or abs(b - a) < TINY * (1 + abs(b)):
            break
    if low - (high - low) <= b <= high + (high - low) and abs(fb) < NOTHING:
        return [(b, "crossing")]
    for _ in range(180):
        middle = (low + high) / 2
        low, high = (middle, high) if sign(middle) == first else (low, middle)
    size = abs(made.mp({**base, key: low})[0]) + abs(made.mp({**base, key: high})[0])
    return [(low, "crossing")] if size < ZERO_AT and top != low else []


def _touched(made, slope, base, key, x):
    """A double root near x, by Newton's method on the slope."""
    start = x
    bend = Compiled([derivative(slope.trees[0], key)])
    for _ in range(200):
        d = slope.mp({**base, key: x})[0]
        e = bend.mp({**base, key: x})[0]
        if e == 0 or d == 0:
            break
        x -= d / e
        if abs(x - start) > AWAY:
            return None
        if abs(d / e) < TINY:
            break
    return x if abs(made.mp({**base, key: x})[0]) < NOTHING else None


def _several(trees, q, base):
    """Zeros of several forces, by Newton's method from many starts."""
    n = len(q)
    flat = [t for t in trees] + [derivative(t, (p, 0)) for t in trees for p in q]
    made = Compiled(flat)
    rng = numpy.random.default_rng(11)
    count = 200
    state = {k: numpy.full(count, float(v)) for k, v in base.items()}
    for p in q:
        state[p, 0] = rng.uniform(-4, 4, count)
    for _ in range(40):
        values = numpy.stack(made.many(state, count), axis=1)
        good = numpy.isfinite(values).all(axis=1)
        values[~good] = 0
        f, jacobian = values[:, :n], values[:, n:].reshape(count, n, n)
        step = numpy.einsum("cij,cj->ci", numpy.linalg.pinv(jacobian), f)
        step = numpy.clip(step, -1, 1)
        for k, p in enumerate(q):
            state[p, 0] = state[p, 0] - step[:, k]
    found = []
    for at in range(count):
        x = [mpf(float(state[p, 0][at])) for p in q]
        if all(abs(v) < FAR for v in x) and not any(max(abs(a - b) for a, b in zip(x, y)) < 1e-6 for y in found):
            x = _finished(made, q, base, x)
            if x is not None:
                found.append(x)
    return found[:40]


def _finished(made, q, base, x):
    n = len(q)
    for _ in range(8):
        try:
            values = made.mp({**base, **{(p, 0): v for p, v in zip(q, x)}})
            jacobian = mpmath.matrix(n, n)
            for i in range(n):
                for j in range(n):
                    jacobian[i, j] = values[n + i * n + j]
            step = mpmath.lu_solve(jacobian, mpmath.matrix(values[:n]))
        except (Undefined, ZeroDivisionError):
            return None
        x = [v - s for v, s in zip(x, step)]
        if max(abs(s) for s in step) < mpf("1e-50"):
            return x
        if max(abs(s) for s in step) > mpf("0.1"):
            return None
    return None
