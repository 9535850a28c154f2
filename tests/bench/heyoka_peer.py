# SPDX-License-Identifier: MIT
"""heyoka on the hard cases, for strongest.sh: prints JSON as verner_peer.cpp does. Times are those of `propagate_until` alone, not of
the making of its code."""

import json
import math
import sys
import time

import heyoka as hy

PLEIADES = [3, 3, -1, -3, 2, -2, 2, 3, -3, 2, 0, 0, -4, 4, 0, 0, 0, 0, 0, 1.75, -1.5, 0, 0, 0, -1.25, 1, 0, 0]
OUTER = [0, 0, 0, -3.5023653, -3.8169847, -1.5507963, 9.0755314, -3.0458353, -1.6483708, 8.310142, -16.2901086, -7.2521278, 11.4707666,
         -25.7294829, -10.8169456, -15.5387357, -25.2225594, -3.1902382, 0, 0, 0, 0.00565429, -0.00412490, -0.00190589, 0.00168318,
         0.00483525, 0.00192462, 0.00354178, 0.00137102, 0.00055029, 0.00288930, 0.00114527, 0.00039677, 0.00276725, -0.00170702,
         -0.00136504]
OUTER_MASSES = [1.00000597682, 0.000954786104043, 0.000285583733151, 0.0000437273164546, 0.0000517759138449, 1 / 1.3e8]


def bodies(masses, dimensions, place):
    """Equations of bodies that attract each other; place(k, i) is the number of coordinate k of body i."""
    count = len(masses) * dimensions
    q = [hy.expression(f"q{m}") for m in range(count)]
    v = [hy.expression(f"v{m}") for m in range(count)]
    force = [[] for _ in range(count)]
    for i in range(len(masses)):
        for j in range(i + 1, len(masses)):
            apart = [q[place(k, j)] - q[place(k, i)] for k in range(dimensions)]
            pull = hy.sum([d**2 for d in apart])**-1.5
            for k, d in enumerate(apart):
                force[place(k, i)].append(masses[j] * d * pull)
                force[place(k, j)].append(-masses[i] * d * pull)
    return list(zip(q, v)) + [(v[m], hy.sum(force[m])) for m in range(count)]


def system(name):
    """Equations, initial state, end."""
    if name == "pleiades":
        return bodies([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0], 2, lambda k, i: 7 * k + i), PLEIADES, 3.0
    if name == "outer_solar_system":
        return bodies([2.95912208286e-4 * m for m in OUTER_MASSES], 3, lambda k, i: 3 * i + k), OUTER, 200000.0
    if name == "kepler":
        x, y, vx, vy = hy.make_vars("x", "y", "vx", "vy")
        pull = (x**2 + y**2)**-1.5
        return ([(x, vx), (y, vy), (vx, -x * pull), (vy, -y * pull)], [1 - 0.99, 0, 0, math.sqrt((1 + 0.99) / (1 - 0.99))], 62.8)
    if name == "double_pendulum_chaotic":
        a, b, u, w = hy.make_vars("a", "b", "u", "w")
        s, c = hy.sin(a - b), hy.cos(a - b)
        f1, f2, d = -s * w**2 - 2 * 9.81 * hy.sin(a), s * u**2 - 9.81 * hy.sin(b), 2.0 - c**2
        return [(a, u), (b, w), (u, (f1 - c * f2) / d), (w, (2.0 * f2 - c * f1) / d)], [2.0, 2.5, 0, 0], 10.0
    sys.exit(f"no case {name}")


equations, start, end = system(sys.argv[1])
runs = []
for half_decades in range(6, 32):
    tolerance = 10.0**(-half_decades / 2)
    integrator = hy.taylor_adaptive(equations, [float(x) for x in start], tol=tolerance)
    seconds, spent = [], 0.0
    while len(seconds) < 200 and spent < 0.3 and (len(seconds) < 3 or spent < 0.02):
        integrator.time = 0.0
        integrator.state[:] = start
        begin = time.thread_time()
        outcome = integrator.propagate_until(end)
        seconds.append(time.thread_time() - begin)
        spent += seconds[-1]
    runs.append({"tolerance": tolerance, "steps": int(outcome[3]), "seconds": sorted(seconds)[len(seconds) // 2],
                 "final": [float(x) for x in integrator.state]})
print(json.dumps({"runs": runs}))
