# SPDX-License-Identifier: MIT
"""Control of an arm by computed torques: tau = M(q) (a_wanted + k_v e' + k_p e) + h(q, q').

    PYTHONPATH=build/release/python python3 examples/arm.py

The hand follows a circle. The controller's robot carries a load of which it does not know at first.
"""

import numpy as np

import alembert

ARM = """
gravity = [0, "-g"]
[parameters]
l = 0.5
m = 2
load = 0
g = 9.81
[coordinates]
q1 = 0
q2 = 0
[[particle]]
name = "elbow"
mass = "m"
position = ["l*cos(q1)", "l*sin(q1)"]
[[particle]]
name = "hand"
mass = "m/2 + load"
position = ["l*cos(q1) + l*cos(q1 + q2)", "l*sin(q1) + l*sin(q1 + q2)"]
"""

scene = alembert.Scene(text=ARM)
model, plant = scene.robot(frames=["hand"]), scene.robot(frames=["hand"])


def wanted(t):
    """Joint angles, rates and accelerations for a circle of the hand, by the inverse of its Jacobian."""
    angle = 2 * t
    place = np.array([0.6, 0.1]) + 0.15 * np.array([np.cos(angle), np.sin(angle)])
    speed = 0.3 * np.array([-np.sin(angle), np.cos(angle)])
    turn = -0.6 * np.array([np.cos(angle), np.sin(angle)])
    bend = np.arccos((place @ place - 0.5) / 0.5)
    q = np.array([np.arctan2(place[1], place[0]) - bend / 2, bend])
    J = model.hand_jacobian(q)[:2]
    v = np.linalg.solve(J, speed)
    return q, v, np.linalg.solve(J, turn - model.hand_drift(q, v)[:2])


def error_after(seconds, load, h=1e-3):
    """The distance of the hand from its place on the circle at the end; the rule of the midpoint."""
    plant.set(load=load)
    q, v, _ = wanted(0)

    def acceleration(t, q, v):
        q_wanted, v_wanted, a_wanted = wanted(t)
        a = a_wanted + 20 * (v_wanted - v) + 100 * (q_wanted - q)
        tau = model.mass(q) @ a + model.bias(q, v)
        return plant.mass_inverse(q) @ (tau - plant.bias(q, v))

    for k in range(round(seconds / h)):
        half_q, half_v = q + h / 2 * v, v + h / 2 * acceleration(k * h, q, v)
        q, v = q + h * half_v, v + h * acceleration((k + 0.5) * h, half_q, half_v)
    there, target = model.hand_pose(np.array([q, wanted(seconds)[0]]))[..., 3]
    return np.linalg.norm(there - target)


print(f"without a load the hand is {1000 * error_after(0.5, 0):.0f} mm from the circle")
print(f"with 1 kg in the hand it is {1000 * error_after(0.5, 1):.0f} mm away")
model.set(load=1)
print(f"after the model has learned of it, {1000 * error_after(0.5, 1):.0f} mm")
# Gravity's torques over a whole grid of poses, in one call.
q = np.stack(np.meshgrid(np.linspace(-1, 1, 200), np.linspace(0.1, 2, 200), indexing="ij"), axis=-1)
print(f"the largest torque of gravity on this grid is {abs(model.gravity(q)).max():.1f} N m")
