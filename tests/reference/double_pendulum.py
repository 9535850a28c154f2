#!/usr/bin/env python3
"""Reference digits for the double pendulum (m = l = 1, g = 9.81), by Taylor series in 60-digit decimal arithmetic.

    double_pendulum.py TH1 TH2 T [STEPS]    angles at rest at the start, exact decimals; 500 steps when missing

Prints the state (th1, th2, w1, w2) at T from two runs with different steps and orders, and how far they agree: that
many digits are claimed. Nothing here is shared with the program: the equations are solved for the accelerations by
hand, D = 2 - c²:

    a1 = (-s w2² - 2 g sin th1 - c (s w1² - g sin th2)) / D
    a2 = (2 (s w1² - g sin th2) + c (s w2² + 2 g sin th1)) / D,       s, c = sin, cos(th1 - th2)
"""
import sys
from decimal import Decimal as Dec, getcontext

getcontext().prec = 60
G = Dec("9.81")


def sine_cosine(x):
    """By Maclaurin's series, after halving."""
    halvings = 12
    y = x / 2**halvings
    s, c, term, k = Dec(0), Dec(0), Dec(1), 0
    while abs(term) > Dec(10) ** -75 or k < 4:
        if k % 2 == 0:
            c += term if k % 4 == 0 else -term
        else:
            s += term if k % 4 == 1 else -term
        k += 1
        term = term * y / k
    for _ in range(halvings):
        s, c = 2 * s * c, c * c - s * s
    return s, c


class Series:
    """Coefficients known so far of a product, a quotient …, one more at each call."""

    @staticmethod
    def product(a, b, k):
        return sum((a[j] * b[k - j] for j in range(k + 1)), Dec(0))

    @staticmethod
    def sine_cosine(s, c, x, k):
        """Coefficient k >= 1 of sin x and cos x."""
        up = sum((j * x[j] * c[k - j] for j in range(1, k + 1)), Dec(0)) / k
        down = -sum((j * x[j] * s[k - j] for j in range(1, k + 1)), Dec(0)) / k
        return up, down


def step(state, h, order):
    th1, th2, w1, w2 = ([x] for x in state)
    names = ("s1", "c1", "s2", "c2", "s", "c", "x", "y", "cx", "cy", "d", "a1", "a2", "w11", "w22")
    v = {n: [] for n in names}
    d = []
    for k in range(order):
        d.append(th1[k] - th2[k])
        for sn, cn, x in (("s1", "c1", th1), ("s2", "c2", th2), ("s", "c", d)):
            up, down = sine_cosine(x[0]) if k == 0 else Series.sine_cosine(v[sn], v[cn], x, k)
            v[sn].append(up)
            v[cn].append(down)
        v["w11"].append(Series.product(w1, w1, k))
        v["w22"].append(Series.product(w2, w2, k))
        v["x"].append(-Series.product(v["s"], v["w22"], k) - 2 * G * v["s1"][k])
        v["y"].append(Series.product(v["s"], v["w11"], k) - G * v["s2"][k])
        v["d"].append((2 if k == 0 else 0) - Series.product(v["c"], v["c"], k))
        n1 = v["x"][k] - Series.product(v["c"], v["y"], k)
        n2 = 2 * v["y"][k] - Series.product(v["c"], v["x"], k)
        for a, n in (("a1", n1), ("a2", n2)):
            rest = sum((v[a][j] * v["d"][k - j] for j in range(k)), Dec(0))
            v[a].append((n - rest) / v["d"][0])
        th1.append(w1[k] / (k + 1))
        th2.append(w2[k] / (k + 1))
        w1.append(v["a1"][k] / (k + 1))
        w2.append(v["a2"][k] / (k + 1))
    result = []
    for x in (th1, th2, w1, w2):
        value = Dec(0)
        for coefficient in reversed(x):
            value = value * h + coefficient
        result.append(value)
    return result


def run(th1, th2, end, steps, order):
    state = [Dec(th1), Dec(th2), Dec(0), Dec(0)]
    for _ in range(steps):
        state = step(state, Dec(end) / steps, order)
    return state


th1, th2, end = sys.argv[1:4]
steps = int(sys.argv[4]) if len(sys.argv) > 4 else 500
a = run(th1, th2, end, steps, 42)
b = run(th1, th2, end, steps * 5 // 4, 46)
for name, x in zip(("th1", "th2", "w1 ", "w2 "), b):
    print(name, f"{x:.45f}")
print("the two runs agree to", f"{max(abs(x - y) for x, y in zip(a, b)):.1e}")
