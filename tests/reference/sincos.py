#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Constants of the sine and cosine in templates/solver.cpp.mustache: python3 sincos.py (needs mpmath).

With z = r^2, |r| <= pi/4 (and a little more):
    sin r = r - r z P(z),            P minimax for (r - sin r) / r^3, error relative to sin r / r^3
    cos r = 1 - z/2 + z^2 Q(z),      Q minimax for (cos r - 1 + z/2) / z^2, error relative to cos r / z^2
both of degree 5, by Remez' exchange (Cheney, Introduction to Approximation Theory, ch. 3). pi/2 is cut into parts of 27
bits, so that a whole number of up to 26 bits times a part is exact; the last part is a whole double.
"""

from mpmath import cos, findroot, lu_solve, matrix, mp, mpf, pi, sin, floor

mp.dps = 60
END = (pi / 4 * mpf("1.0000001")) ** 2
DEGREE = 5


def sine(z):
    r = z ** mpf("0.5")
    return (r - sin(r)) / (r * z) if z > mpf("1e-12") else mpf(1) / 6 - z / 120 + z * z / 5040


def cosine(z):
    r = z ** mpf("0.5")
    return (cos(r) - 1 + z / 2) / (z * z) if z > mpf("1e-8") else mpf(1) / 24 - z / 720 + z * z / 40320


def sine_weight(z):
    r = z ** mpf("0.5")
    return z * r / sin(r) if z > 0 else mpf(0)


def cosine_weight(z):
    return z * z / cos(z ** mpf("0.5"))


def polynomial(coefficients, z):
    value = mpf(0)
    for c in reversed(coefficients):
        value = value * z + c
    return value


def remez(f, weight):
    """Coefficients and the largest weighted error."""
    count = DEGREE + 2
    points = [END * (1 - cos(pi * (2 * k + 1) / (2 * count))) / 2 for k in range(count)]
    for _ in range(12):
        system, right = matrix(count, count), matrix(count, 1)
        for i, z in enumerate(points):
            for j in range(DEGREE + 1):
                system[i, j] = z**j
            system[i, DEGREE + 1] = (-1) ** i / weight(z)
            right[i] = f(z)
        coefficients = list(lu_solve(system, right))[: DEGREE + 1]
        error = lambda z: weight(z) * (f(z) - polynomial(coefficients, z))
        grid = [END * k / 2000 for k in range(1, 2001)]
        values = [error(z) for z in grid]
        points, start = [], 0
        for k in range(1, len(grid) + 1):
            if k == len(grid) or (values[k] > 0) != (values[start] > 0):
                points.append(max(range(start, k), key=lambda i: abs(values[i])))
                start = k
        points = [grid[i] for i in points][-count:]
    return coefficients, max(abs(v) for v in values)


def main():
    for name, f, weight in (("P", sine, sine_weight), ("Q", cosine, cosine_weight)):
        coefficients, error = remez(f, weight)
        rounded = [mpf(float(c)) for c in coefficients]
        grid = [END * k / 5000 for k in range(1, 5001)]
        after = max(abs(weight(z) * (f(z) - polynomial(rounded, z))) for z in grid)
        print(name, *(repr(float(c)) for c in coefficients), f"relative error {float(error):.2e}, of the doubles {float(after):.2e}")
    rest = pi / 2
    for k in range(3):
        scale = mpf(2) ** (26 + 27 * k)
        part = floor(rest * scale) / scale
        rest -= part
        print(f"part {k}: {float(part)!r} = {float(part).hex()}", mpf(float(part)) == part)
    print(f"part 3: {float(rest)!r} = {float(rest).hex()}", "2/pi:", repr(float(2 / pi)))


if __name__ == "__main__":
    main()
