#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""256 regular double pendulums, 10 s, side by side on one thread: ours and heyoka's batches, in turn.

    PYTHON tests/bench/heyoka_batches.py BENCH_SWEEP SCENE

PYTHON has heyoka (PyPI's wheel), BENCH_SWEEP is build/release/tests/bench_sweep, SCENE scenes/benchmark/double_pendulum_regular.toml.
Prints, for each error, the motions in a second of processor time: the largest over rounds, interpolated between tolerances in the
logarithms; and how much longer ours take than heyoka's.
"""
import math
import subprocess
import sys
import time

import heyoka
import numpy

ROUNDS, MEMBERS, DURATION = 5, 256, 10.0
OURS = "1e-3,1e-4,1e-5,1e-6,1e-7,1e-8,1e-9,1e-10,1e-11,1e-12,1e-13"
THEIRS = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14]
ERRORS = [1e-5, 1e-6, 1e-7, 1e-9, 1e-11, 1e-13, 3e-15]


def equations():
    a, b, u, v = heyoka.make_vars("a", "b", "u", "v")
    c, s = heyoka.cos(a - b), heyoka.sin(a - b)
    f, h = -19.62 * heyoka.sin(a) - s * v * v, -9.81 * heyoka.sin(b) + s * u * u
    det = 2 - c * c
    return [(a, u), (b, v), (u, (f - c * h) / det), (v, (2 * h - c * f) / det)]


def heyoka_ends(batch, starts):
    width = batch.batch_size
    ends = numpy.empty_like(starts)
    begin = time.process_time()
    for k in range(0, MEMBERS, width):
        batch.set_time(0.0)
        batch.state[:] = starts[:, k:k + width]
        batch.propagate_until(DURATION)
        ends[:, k:k + width] = batch.state
    return time.process_time() - begin, ends


def our_rates(bench, scene):
    text = subprocess.run([bench, "--tolerances", OURS, scene], check=True, capture_output=True, text=True).stdout
    for line in text.splitlines()[1:]:
        words = line.split()
        yield (words[1], words[0]), float(words[2]), float(words[4])


def rate_at(error, points):
    """The most motions in a second at an error, between two neighbouring tolerances of one method."""
    best = math.nan
    for (e0, r0), (e1, r1) in zip(points, points[1:]):
        if not min(e0, e1) <= error <= max(e0, e1) or e0 == e1:
            continue
        part = math.log(error / e0) / math.log(e1 / e0)
        rate = math.exp(math.log(r0) + part * math.log(r1 / r0))
        best = rate if math.isnan(best) else max(best, rate)
    return best


def main():
    bench, scene = sys.argv[1:]
    width = heyoka.recommended_simd_size()
    dice = numpy.random.default_rng(7)
    starts = numpy.array([0.1, 0.2, 0, 0])[:, None] + dice.uniform(-0.1, 0.1, (4, MEMBERS))
    zero = numpy.zeros((4, width))
    exact = heyoka_ends(heyoka.taylor_adaptive_batch(equations(), zero, tol=1e-18), starts)[1]
    batches = [heyoka.taylor_adaptive_batch(equations(), zero, tol=tol) for tol in THEIRS]
    theirs, ours, our_errors = [[math.nan, 0.0] for _ in THEIRS], {}, {}
    for _ in range(ROUNDS):
        for point, batch in zip(theirs, batches):
            seconds, ends = heyoka_ends(batch, starts)
            point[0] = float(numpy.median(numpy.abs(ends - exact).max(axis=0)))
            point[1] = max(point[1], MEMBERS / seconds)
        for key, rate, error in our_rates(bench, scene):
            ours[key] = max(ours.get(key, 0.0), rate)
            our_errors[key] = error
    print(f"heyoka {heyoka.__version__}, batches of {width}")
    methods = list(dict.fromkeys(method for method, _ in ours))
    for error in ERRORS:
        their = rate_at(error, [tuple(point) for point in theirs])
        rates = {m: rate_at(error, [(our_errors[k], ours[k]) for k in ours if k[0] == m]) for m in methods}
        known = {m: rate for m, rate in rates.items() if not math.isnan(rate)}
        best = max(known, key=known.get, default=None)
        line = f"{error:8.0e}  heyoka {their:8.0f}"
        if best:
            line += f"  ours {known[best]:8.0f} ({best})  {their / known[best]:.2f}"
        print(line)


if __name__ == "__main__":
    main()
