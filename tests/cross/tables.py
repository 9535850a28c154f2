# SPDX-License-Identifier: MIT
"""Functions by points in numbers of 60 digits, with their derivatives: a second reading of [tables].

The points are those of the text; the program's polynomials have doubles as coefficients.
"""

from bisect import bisect_right

from mpmath import floor, mpf

from expressions import jet


def _natural_slopes(x, y):
    """m of the cubic spline whose second derivatives vanish at the ends, by elimination."""
    n = len(x)
    h = [b - a for a, b in zip(x, x[1:])]
    rise = [(b - a) / w for a, b, w in zip(y, y[1:], h)]
    rows = [[mpf(0)] * (n + 1) for _ in range(n)]
    rows[0][0], rows[0][1], rows[0][n] = mpf(2), mpf(1), 3 * rise[0]
    rows[-1][n - 2], rows[-1][n - 1], rows[-1][n] = mpf(1), mpf(2), 3 * rise[-1]
    for i in range(1, n - 1):
        rows[i][i - 1], rows[i][i], rows[i][i + 1] = h[i], 2 * (h[i - 1] + h[i]), h[i - 1]
        rows[i][n] = 3 * (h[i] * rise[i - 1] + h[i - 1] * rise[i])
    for i in range(n):
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    m = [mpf(0)] * n
    for i in range(n - 1, -1, -1):
        m[i] = (rows[i][n] - sum(rows[i][k] * m[k] for k in range(i + 1, n))) / rows[i][i]
    return m


def _monotone_slopes(x, y):
    h = [b - a for a, b in zip(x, x[1:])]
    rise = [(b - a) / w for a, b, w in zip(y, y[1:], h)]

    def end(h0, h1, d0, d1):
        slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1)
        if slope * d0 <= 0:
            return mpf(0)
        return 3 * d0 if d0 * d1 <= 0 and abs(slope) > 3 * abs(d0) else slope

    m = [end(h[0], h[1], rise[0], rise[1])]
    for i in range(1, len(x) - 1):
        a, b = 2 * h[i] + h[i - 1], h[i] + 2 * h[i - 1]
        m.append(mpf(0) if rise[i - 1] * rise[i] <= 0 else (a + b) / (a / rise[i - 1] + b / rise[i]))
    return m + [end(h[-1], h[-2], rise[-1], rise[-2])]


def _periodic_slopes(x, y):
    """m of the cubic spline that closes, by elimination; the last point is the first one, a period later."""
    n = len(x) - 1
    h = [b - a for a, b in zip(x, x[1:])]
    rise = [(b - a) / w for a, b, w in zip(y, y[1:], h)]
    rows = [[mpf(0)] * (n + 1) for _ in range(n)]
    for i in range(n):
        before, after = h[i - 1], h[i]
        rows[i][(i - 1) % n] += after
        rows[i][i] += 2 * (before + after)
        rows[i][(i + 1) % n] += before
        rows[i][n] = 3 * (after * rise[i - 1] + before * rise[i])
    for i in range(n):
        for k in range(n):
            if k != i:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    m = [rows[i][n] / rows[i][i] for i in range(n)]
    return m + [m[0]]


def _periodic_monotone_slopes(x, y):
    """As if the points went on; then the ends have neighbours on both sides."""
    period = x[-1] - x[0]
    wide_x = [x[-2] - period] + list(x) + [x[1] + period]
    wide_y = [y[-2]] + list(y) + [y[1]]
    return _monotone_slopes(wide_x, wide_y)[1:-1]


class Table:
    """Called with a Jet; outside of the points along the line."""

    def __init__(self, entry):
        self.x = [mpf(repr(float(p[0]))) for p in entry["points"]]
        self.y = [mpf(repr(float(p[1]))) for p in entry["points"]]
        self.period = mpf(repr(float(entry["period"]))) if "period" in entry else None
        if self.period and self.x[-1] - self.x[0] < self.period:
            self.x.append(self.x[0] + self.period)
            self.y.append(self.y[0])
        how = entry.get("interpolation", "linear")
        cubic, pchip = (_periodic_slopes, _periodic_monotone_slopes) if self.period else (_natural_slopes, _monotone_slopes)
        slopes = {"linear": lambda x, y: None, "cubic": cubic, "pchip": pchip}[how]
        self.m = slopes(self.x, self.y)

    def _polynomial(self, i):
        h = self.x[i + 1] - self.x[i]
        rise = (self.y[i + 1] - self.y[i]) / h
        if self.m is None:
            return [self.y[i], rise, mpf(0), mpf(0)]
        a, b = self.m[i], self.m[i + 1]
        return [self.y[i], a, (3 * rise - 2 * a - b) / h, (a + b - 2 * rise) / h**2]

    def __call__(self, x):
        x = jet(x)
        if self.period:
            x = x - self.period * floor((x.value - self.x[0]) / self.period)
        i = min(max(bisect_right(self.x, x.value) - 1, 0), len(self.x) - 2)
        c = self._polynomial(i)
        at = min(max(x.value, self.x[0]), self.x[-1])
        u = at - self.x[i]
        value, slope = c[0] + u * (c[1] + u * (c[2] + u * c[3])), c[1] + u * (2 * c[2] + 3 * u * c[3])
        bend = 2 * c[2] + 6 * u * c[3] if at == x.value else mpf(0)
        return x.through(value + slope * (x.value - at), slope, bend)


class Grid:
    """Of two arguments, bilinear in each cell, which goes on beyond the points."""

    def __init__(self, entry):
        number = lambda v: mpf(repr(float(v)))
        self.x = sorted({number(p[0]) for p in entry["points"]})
        self.y = sorted({number(p[1]) for p in entry["points"]})
        self.z = {(number(a), number(b)): number(c) for a, b, c in entry["points"]}

    def __call__(self, x, y):
        x, y = jet(x), jet(y)
        i = min(max(bisect_right(self.x, x.value) - 1, 0), len(self.x) - 2)
        k = min(max(bisect_right(self.y, y.value) - 1, 0), len(self.y) - 2)
        (a, b), (c, d) = self.x[i:i + 2], self.y[k:k + 2]
        u, v = (x - a) * (1 / (b - a)), (y - c) * (1 / (d - c))
        z = self.z
        return (1 - u) * (1 - v) * z[a, c] + u * (1 - v) * z[b, c] + (1 - u) * v * z[a, d] + u * v * z[b, d]


def of_scene(scene):
    return {name: Table(entry) if len(entry["arguments"]) == 1 else Grid(entry)
            for name, entry in scene.get("tables", {}).items()}
