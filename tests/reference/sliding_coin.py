#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Digits of scenes/friction/sliding_coin.toml: Newton's and Euler's equations of the coin in vectors, in 30 digits.

The state is the centre, its momentum, the axis n and the angular momentum L about the centre. The normal force follows
from the height of the lowest point. The integration variable s with dt = |v| ds, v the sliding velocity, makes the end
of sliding regular: v falls exponentially in s. Extrapolation (Gragg, Bulirsch, Stoer) of order 20.
"""
from mpmath import mp, mpf, sqrt, sin, cos

mp.dps = 30
m, r, g, mu = mpf(1) / 100, mpf(125) / 10000, mpf(981) / 100, mpf(2) / 10
A, C = m * r * r / 4, m * r * r / 2
EZ = [mpf(0), mpf(0), mpf(1)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(*terms):
    return [sum(c * v[i] for c, v in terms) for i in range(3)]


def motion(state):
    """Rates in time of (t, centre, momentum, n, L), and the sliding velocity."""
    p, n, L = state[4:7], state[7:10], state[10:13]
    omega = add((1 / A, L), ((1 / C - 1 / A) * dot(L, n), n))
    turn = cross(omega, n)
    s, ds = n[2], turn[2]
    w, dw = add((1, EZ), (-s, n)), add((-ds, n), (-s, turn))
    length = sqrt(dot(w, w))
    dlength = dot(w, dw) / length
    rho, drho = add((-r / length, w)), add((-r / length, dw), (r * dlength / length**2, w))
    v = add((1 / m, p), (1, cross(omega, rho)))
    speed = sqrt(v[0]**2 + v[1]**2)
    pull = [-mu * v[0] / speed, -mu * v[1] / speed, mpf(1)]  # the force for N = 1

    def lift(N):
        """The vertical acceleration of the lowest point, with its force and moment."""
        F = [N * f for f in pull]
        moment = cross(rho, F)
        domega = add((1 / A, moment), ((1 / C - 1 / A) * (dot(moment, n) + dot(L, turn)), n),
                     ((1 / C - 1 / A) * dot(L, n), turn))
        up = (F[2] - m * g) / m + add((1, cross(domega, rho)), (1, cross(omega, drho)))[2]
        return up, F, moment

    none, one = lift(mpf(0))[0], lift(mpf(1))[0]
    _, F, moment = lift(-none / (one - none))
    force = add((1, F), (-m * g, EZ))
    return [mpf(1)] + [x / m for x in p] + force + turn + moment, speed


def in_time(state):
    return motion(state)[0]


def in_slip(state):
    rates, speed = motion(state)
    return [speed * rate for rate in rates]


def step(f, y, h, columns=10):
    """Extrapolation of Gragg's midpoint rule."""
    table = []
    for k in range(columns):
        n = 2 * (k + 1)
        small = h / n
        a, b = y, [u + small * du for u, du in zip(y, f(y))]
        for _ in range(n - 1):
            a, b = b, [u + 2 * small * du for u, du in zip(a, f(b))]
        row = [[(u + v + small * dv) / 2 for u, v, dv in zip(a, b, f(b))]]
        for j in range(k):
            ratio = mpf(n) / (2 * (k - j))
            row.append([u + (u - w) / (ratio**2 - 1) for u, w in zip(row[j], table[k - 1][j])])
        table.append(row)
    return table[-1][-1]


def start():
    theta, dphi, dpsi = mpf(13) / 10, mpf(20), mpf(15)
    n = [mpf(0), -sin(theta), cos(theta)]
    up = [mpf(0), cos(theta), sin(theta)]
    spin = dpsi + dphi * cos(theta)
    L = add((A * dphi * sin(theta), up), (C * spin, n))
    p = [m * mpf(3) / 10, m * mpf(1) / 10, mpf(0)]
    return [mpf(0), mpf(0), mpf(0), r * sin(theta)] + p + n + L


if __name__ == "__main__":
    y = start()
    for _ in range(40):
        y = step(in_time, y, mpf(1) / 2000)
    print("t", mp.nstr(y[0], 20), "x", mp.nstr(y[1], 18), "y", mp.nstr(y[2], 18), "cos theta", mp.nstr(y[9], 18))
    for pieces in (1, 2):  # the second, with half the steps, shows how many digits are right
        y, s = start(), mpf(1) / 400 / pieces
        while motion(y)[1] > mpf(10)**-2:
            y = step(in_slip, y, s)
        while motion(y)[1] > mpf(10)**-20:
            y = step(in_slip, y, 10 * s)
        print("rolls at t =", mp.nstr(y[0], 20), "x", mp.nstr(y[1], 18), "y", mp.nstr(y[2], 18))
