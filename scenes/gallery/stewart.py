#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes stewart.toml: a platform on six legs (Stewart, Proc. IMechE 180 (1965) 371), each a cylinder on a universal joint at the
base, a rod that slides in it, and a ball joint at the platform.

    stewart.py > stewart.toml

The platform flies free by a quaternion; every leg hangs on the base and closes a loop with it. The legs' angles and lengths are
solved for from the platform's place: what is written for them are guesses."""
import math

RADIUS = (0.9, 0.5)                                # base, platform
HEIGHT = 1.0
BASE = [(120 * (k // 2) + (10 if k % 2 else -10)) for k in range(6)]
TOP = [(120 * (k // 2) + (50 if k % 2 else -50)) for k in range(6)]


def corner(radius, degrees):
    return [radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees)), 0.0]


def vector(v):
    return "[" + ", ".join(f"{x:.12g}" for x in v) + "]"


print(f'''title  = "Stewart platform"
source = "Stewart, Proc. Institution of Mechanical Engineers 180 (1965) 371; written by stewart.py"
notes  = "Springs along the legs carry the platform."
gravity = [0, 0, "-g"]

[parameters]
g = {{ value = 9.81, unit = "m/s^2" }}
k = {{ value = 4000, unit = "N/m", about = "stiffness of a leg" }}
L = {{ value = 1.15, unit = "m", about = "unstretched length of a leg" }}

[[body]]
name = "platform"
mass = 8
inertia = [0.5, 0.5, 1.0]

[[joint]]
name = "flight"
type = "free"
parent = "N"
child = "platform"
coordinates = {{ x = {{ initial = 0.02, rate = 0.1 }}, y = -0.01, z = {HEIGHT}, e0 = "cos(0.05)", e1 = "sin(0.05)", e2 = 0, e3 = 0 }}
''')
for k in range(6):
    foot, top = corner(RADIUS[0], BASE[k]), corner(RADIUS[1], TOP[k])
    way = [top[0] - foot[0], top[1] - foot[1], HEIGHT]
    length = math.sqrt(sum(w * w for w in way))
    # z of the leg after turns a about x and b about y: (sin b, -sin a cos b, cos a cos b)
    b = math.asin(way[0] / length)
    a = math.atan2(-way[1], way[2])
    n = k + 1
    print(f'''[[body]]
name = "cylinder{n}"
mass = 1.0
inertia = [0.02, 0.02, 0.001]

[[body]]
name = "rod{n}"
mass = 0.5
inertia = [0.01, 0.01, 0.0002]

[[joint]]
name = "foot{n}"
type = "universal"
parent = "N"
child = "cylinder{n}"
parent_point = {vector(foot)}
child_point = [0, 0, -0.25]
coordinates = {{ a{n} = {{ guess = {a:.6f}, rate_guess = 0 }}, b{n} = {{ guess = {b:.6f}, rate_guess = 0 }} }}

[[joint]]
name = "slide{n}"
type = "prismatic"
parent = "cylinder{n}"
child = "rod{n}"
parent_point = [0, 0, -0.25]
child_point = [0, 0, 0.25]
coordinates = {{ s{n} = {{ guess = {length:.6f}, rate_guess = 0 }} }}

[[joint]]
name = "ball{n}"
type = "spherical"
parent = "rod{n}"
child = "platform"
parent_point = [0, 0, 0.25]
child_point = {vector(top)}

[[spring]]
along = "s{n}"
stiffness = "k"
length = "L"
''')
print('''[simulation]
duration = 1
tolerance = 1e-10''')
