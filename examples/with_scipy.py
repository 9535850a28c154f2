# SPDX-License-Identifier: MIT
"""A scene's equations in SciPy: its integrators, its root finder, and a length that is fitted to a measured motion.

    PYTHONPATH=build/release/python python3 examples/with_scipy.py
"""

import numpy as np
from scipy import integrate, optimize

import alembert

SCENE = """
gravity = [0, "-g"]
[parameters]
m = { value = 1, unit = "kg" }
l = { value = 0.8, unit = "m" }
g = { value = 9.81, unit = "m/s^2" }
c = { value = 0.05, unit = "N*m*s" }
k = { value = 6, unit = "N*m" }
[coordinates]
theta = { initial = 0.9, unit = "rad" }
[[particle]]
name = "bob"
mass = "m"
position = ["l*sin(theta)", "l*cos(theta)"]
[forces]
theta = "-c*theta' - k*theta"
"""

scene = alembert.Scene(text=SCENE)  # a pendulum that a spring holds upright
f = scene.system()
y0 = scene.initial_state()

# An implicit method of SciPy, with the exact Jacobian.
theirs = integrate.solve_ivp(f.rhs, (0, 5), y0, method="Radau", jac=f.jacobian, rtol=1e-9, atol=1e-11)
ours = scene.simulate(duration=5, tolerance=1e-12)
print(f"Radau and alembert differ by less than 1e-6: {abs(theirs.y[:, -1] - ours(5)).max() < 1e-6}")

# A state of rest: y' = 0. The spring is too weak to hold the pendulum upright.
rest = optimize.root(lambda y: f.rhs(0.0, y), [1.0, 0.0], jac=lambda y: f.jacobian(0.0, y), tol=1e-13)
slope = np.linalg.eigvals(f.jacobian(0.0, rest.x))
print(f"at rest at theta = {rest.x[0]:.6f}, and stable there: {slope.real.max() < 0}")

# A measured motion, with errors of 1e-3, of a pendulum of 0.83 m. All times are evaluated at once.
times = np.linspace(0, 3, 60)
truth = alembert.Scene(text=SCENE.replace("0.8,", "0.83,")).simulate(duration=3, tolerance=1e-11)
measured = truth(times)[:, 0] + 1e-3 * np.random.default_rng(1).normal(size=times.size)


def misfit(unknown):
    f.set(l=unknown[0])
    motion = integrate.solve_ivp(f.rhs, (0, 3), y0, method="DOP853", t_eval=times, rtol=1e-9, atol=1e-9)
    return motion.y[0] - measured


found = optimize.least_squares(misfit, [0.7])
print(f"the length is {found.x[0]:.2f} m")
