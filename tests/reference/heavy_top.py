#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Nutation and precession of the heavy symmetric top by elliptic functions: heavy_top.py SPIN THETA0 TIME...

A = 1 across the figure axis, C = 1/2 along it, m g l = 1; starts at rest but for the spin about the figure axis. With
u = cos theta, u'^2 = (u0 - u)(u - r1)(r2 - u) 2mgl/A where r1, r2 solve 2mgl(1 - u^2) A = (C spin)^2 (u0 - u) (Goldstein, 5-7):
u = r1 + (u0 - r1) sn^2(K - kappa t | m), kappa = sqrt(2mgl/A (r2 - r1))/2, m = (u0 - r1)/(r2 - r1). phi by quadrature. Needs mpmath.
"""
import sys
from mpmath import acos, cos, ellipfun, ellipk, mp, mpf, quad, sqrt

mp.dps = 40
spin, theta0 = mpf(sys.argv[1]), mpf(sys.argv[2])
A, C, W = mpf(1), mpf(1) / 2, mpf(1)
u0, b = cos(theta0), (C * spin) ** 2 / (2 * W * A)
root = sqrt(b * b / 4 + 1 - b * u0)
r1, r2 = b / 2 - root, b / 2 + root
kappa, m = sqrt(2 * W / A * (r2 - r1)) / 2, (u0 - r1) / (r2 - r1)


def u(t):
    return r1 + (u0 - r1) * ellipfun("sn", ellipk(m) - kappa * t, m=m) ** 2


for word in sys.argv[3:]:
    t = mpf(word)
    rate = lambda s: C * spin * (u0 - u(s)) / (A * (1 - u(s) ** 2))
    pieces = [t * k / 64 for k in range(65)]
    print(word, mp.nstr(acos(u(t)), 30), mp.nstr(quad(rate, pieces), 25))
