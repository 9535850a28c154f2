# SPDX-License-Identifier: MIT
"""A scene's equations as an external function of CasADi, with exact derivatives.

    PYTHONPATH=build/release/python python3 examples/with_casadi.py [FOLDER]

Without CasADi the function is emitted and compiled all the same.
"""

import subprocess
import sys
import tempfile

import alembert

SCENE = """
gravity = [0, "-g"]
[parameters]
M = { value = 2, unit = "kg" }
m = { value = 0.5, unit = "kg" }
l = { value = 1.2, unit = "m" }
g = { value = 9.81, unit = "m/s^2" }
F = { value = 0, unit = "N", about = "what the optimization chooses" }
[coordinates]
x = { initial = 0, unit = "m" }
theta = { initial = 0.1, unit = "rad" }
[[particle]]
name = "trolley"
mass = "M"
position = ["x", 0]
[[particle]]
name = "load"
mass = "m"
position = ["x + l*sin(theta)", "-l*cos(theta)"]
[forces]
x = "F"
"""

folder = sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp()
scene = alembert.Scene(text=SCENE, name="crane.toml")
emitted = scene.emit(folder, language="c", casadi=True)
sources = [path for path in emitted.files if path.endswith(".c")]
library = f"{folder}/crane.so"
subprocess.run(["cc", "-std=c99", "-O2", "-shared", "-fPIC", *sources, "-lm", "-o", library], check=True)
print("compiled:", ", ".join(sorted(emitted.sources)))

try:
    import casadi
except ImportError:
    print("CasADi is not installed; with it, casadi.external('casadi_crane_rhs', 'crane.so') is the right-hand side")
    sys.exit()

# The force, constant on each of 40 intervals of 0.1 s, that takes the trolley 2 m with the least effort, the load at
# rest at the end; the rule of Runge and Kutta of order 4 on each interval.
rhs = casadi.external("casadi_crane_rhs", library)
problem = casadi.Opti()
force, state = problem.variable(40), [casadi.DM([0, 0, 0, 0])]
for k in range(40):
    parameters = casadi.vertcat(2, 0.5, 1.2, 9.81, force[k])
    h, y = 0.1, state[-1]
    a = rhs(0, y, parameters)
    b = rhs(0, y + h / 2 * a, parameters)
    c = rhs(0, y + h / 2 * b, parameters)
    d = rhs(0, y + h * c, parameters)
    state.append(y + h / 6 * (a + 2 * b + 2 * c + d))
problem.subject_to(state[-1] == casadi.DM([2, 0, 0, 0]))
problem.minimize(casadi.sumsqr(force))
problem.solver("ipopt", {"ipopt.hessian_approximation": "limited-memory", "ipopt.print_level": 0, "print_time": False})
solution = problem.solve()
print("the largest force is", abs(solution.value(force)).max(), "N")
