#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Digits of scenes/friction/belt_blocks.toml: power series in 40 digits, and exact switching.

In each mode the blocks obey m x'' = -K x - mu N sign(x' - v), or x' = v where they stick, which is linear, so that
series of order 40 over 0.05 s are exact. A piece ends at the first zero of a sliding velocity, or where the force on
a block that sticks comes to mu_s N.
"""
from mpmath import mp, mpf, sign

mp.dps = 40
m, k, kc, v = mpf(1), mpf(10), mpf(4), mpf(2) / 10
N, mu, mu_s = [mpf(3), mpf(4), mpf(5)], mpf(1) / 2, mpf(8) / 10
K = [[k + kc, -kc, 0], [-kc, k + 2 * kc, -kc], [0, -kc, k + kc]]
order, step, end = 40, mpf(5) / 100, mpf(10)


def load(x):
    return [sum(K[i][j] * x[j] for j in range(3)) for i in range(3)]


def series(x, u, side):
    """Coefficients of x_i(t), by the mode: side 0 sticks."""
    c = [[x[i], u[i]] for i in range(3)]
    for n in range(order - 1):
        pull = load([c[i][n] for i in range(3)])
        for i in range(3):
            rate = 0 if side[i] == 0 else -pull[i] - (mu * N[i] * side[i] if n == 0 else 0)
            c[i].append(rate / m / (n + 1) / (n + 2))
    return c


def at(c, t, derivative=0):
    total = mpf(0)
    for n in range(len(c) - 1, derivative - 1, -1):
        factor = n if derivative else 1
        total = total * t + factor * c[n]
    return total


def watched(c, side, i, t):
    if side[i] != 0:
        return side[i] * (at(c[i], t, 1) - v)
    pull = load([at(c[j], t) for j in range(3)])[i]
    return mu_s * N[i] - abs(pull)


def zero(c, side, i, a, b):
    for _ in range(140):
        middle = (a + b) / 2
        if watched(c, side, i, middle) > 0:
            a = middle
        else:
            b = middle
    return b


x, u, side, t = [mpf(0), mpf(5) / 100, mpf(-2) / 100], [v, v, v], [0, 0, 0], mpf(0)
changes, just = [], None
while t < end:
    h = min(step, end - t)
    c = series(x, u, side)
    first = None
    for i in range(3):
        start = mpf(10) ** -20 if just == i else mpf(0)  # it has just left its zero
        cells = 16
        for n in range(cells):
            a, b = max(start, h * n / cells), h * (n + 1) / cells
            if watched(c, side, i, a) > 0 >= watched(c, side, i, b):
                when = zero(c, side, i, a, b)
                if first is None or when < first[0]:
                    first = (when, i)
                break
    h = first[0] if first else h
    x, u = [at(c[i], h) for i in range(3)], [at(c[i], h, 1) for i in range(3)]
    t += h
    just = None
    if first:
        i = first[1]
        pull = load(x)[i]
        if side[i] == 0:
            side[i] = -int(sign(pull))
        else:
            u[i] = v
            side[i] = 0 if abs(pull) <= mu_s * N[i] else -int(sign(pull))
        just = i
        changes.append((t, i, side[i]))
for t, i, s in changes:
    print(mp.nstr(t, 18), "first second third".split()[i], s)
print([mp.nstr(e, 18) for e in x], [mp.nstr(e, 18) for e in u])
