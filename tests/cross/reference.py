# SPDX-License-Identifier: MIT
"""Accelerations and multipliers of a scene in 60 digits, by the principle of virtual power.

Every mass is a sum of w (dr/dq)(dr'/dt) over vectors r: a particle is its position with its mass; a body is that of its
mass centre and its three axes e_j with the weights P_jk = tr(I)/2 d_jk - I_jk. So there is no angular velocity in the
inertia, no formalism, and no line in common with the program. What is not known here (contacts that are closed, friction
on reactions) is refused with NotRead.
"""

import mpmath
from mpmath import mpf

import tables
from expressions import Jet, NotRead, cos, evaluate, jet, sin, sqrt


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum((x * y for x, y in zip(a, b)), Jet(mpf(0)))


def plus(a, b):
    return [x + y for x, y in zip(a, b)]


def along(matrix, vector):
    """Components along N of a vector that is given along the columns of a matrix."""
    return [sum((matrix[row][k] * vector[k] for k in range(3)), Jet(mpf(0))) for row in range(3)]


def product(a, b):
    return [[sum((a[i][k] * b[k][j] for k in range(3)), Jet(mpf(0))) for j in range(3)] for i in range(3)]


def transposed(a):
    return [list(row) for row in zip(*a)]


def identity():
    return [[Jet(mpf(i == j)) for j in range(3)] for i in range(3)]


def turn(axis, angle):
    """Rodrigues' rotation about an axis of any length."""
    size = sqrt(dot(axis, axis))
    x, y, z = (component / size for component in axis)
    c, s = cos(angle), sin(angle)
    return [[c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s],
            [x * y * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s],
            [x * z * (1 - c) - y * s, y * z * (1 - c) + x * s, c + z * z * (1 - c)]]


def by_quaternion(e):
    size = dot(e, e)
    w, x, y, z = e
    return [[(w * w + x * x - y * y - z * z) / size, 2 * (x * y - w * z) / size, 2 * (x * z + w * y) / size],
            [2 * (x * y + w * z) / size, (w * w - x * x + y * y - z * z) / size, 2 * (y * z - w * x) / size],
            [2 * (x * z - w * y) / size, 2 * (y * z + w * x) / size, (w * w - x * x - y * y + z * z) / size]]


AXES = {"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}


def coordinate_names(scene):
    """Of the scene, then of its joints in the order of the file."""
    return list(scene.get("coordinates", {})) + [q for j in scene.get("joint", []) for q in j.get("coordinates", {})]


class Names(dict):
    """What names mean: the keys are (name, dots); those of the scene are worked out when they are first asked for."""

    def __init__(self, scene):
        super().__init__()
        self.scene = scene
        self.tables = tables.of_scene(scene)

    def __missing__(self, key):
        name, dots = key
        for table in ("parameters", "inputs", "definitions", "speeds"):
            entry = self.scene.get(table, {}).get(name)
            if entry is not None and not isinstance(entry, list):
                text = entry.get("value", entry.get("form")) if isinstance(entry, dict) else entry
                value = evaluate(text, self)
                for _ in range(dots):
                    value = self.rate(value)
                self[key] = value
                return value
        raise KeyError(name)


class Reference:
    """The scene at one state. Variables of the Jets: q (0 … n-1), t (n), q' (n+1 … 2n)."""

    def __init__(self, scene, state, parameters=None, time=0):
        """state: {name: value} and {name': value}; parameters replace those of the scene."""
        self.scene = scene
        self.q = coordinate_names(scene)
        n = self.n = len(self.q)
        self.rates = [mpf(state[name + "'"]) for name in self.q]
        names = self.names = Names(scene)
        names.rate = self.rate
        names["pi", 0] = Jet(+mpmath.pi)
        names["t", 0] = Jet.variable(time, n)
        for i, name in enumerate(self.q):
            names[name, 0] = Jet.variable(state[name], i)
            names[name, 1] = Jet.variable(self.rates[i], n + 1 + i)
        for name, value in (parameters or {}).items():
            names[name, 0] = Jet(mpf(value))
        for name in scene.get("states", {}):
            names[name, 0] = Jet(mpf(state[name]))
        self.accelerations = self.multipliers = None
        self._place()

    def of(self, text):
        return evaluate(text, self.names)

    def vector(self, components):
        values = [self.of(c) for c in components]
        return values + [Jet(mpf(0))] * (3 - len(values))

    def rate(self, value):
        """d/dt of a Jet as a Jet with its first derivatives, but for what needs accelerations, which must be known."""
        n, total = self.n, value.first.get(self.n, mpf(0))
        first = {i: value.second.get((min(i, n), max(i, n)), mpf(0)) for i in range(2 * n + 1)}
        for i in range(n):
            total += value.first.get(i, 0) * self.rates[i]
            for k in range(2 * n + 1):
                first[k] += value.second.get((min(i, k), max(i, k)), mpf(0)) * self.rates[i]
            first[n + 1 + i] += value.first.get(i, mpf(0))
            by_rate = value.first.get(n + 1 + i, mpf(0))
            if by_rate:
                if self.accelerations is None:
                    raise NotRead("a derivative that holds accelerations")
                total += by_rate * self.accelerations[i]
        return Jet(total, first)

    # -- where things are

    def _place(self):
        scene = self.scene
        self.frames, self.points, self.bodies = {"N": identity()}, {"O": self.vector([0, 0, 0])}, []
        for frame in scene.get("frame", []):
            turned = self.frames[frame.get("parent", "N")]
            if "quaternion" in frame:
                self.frames[frame["name"]] = product(turned, by_quaternion([self.of(e) for e in frame["quaternion"]]))
            else:
                self.frames[frame["name"]] = product(turned, self._turns(frame["rotate"]))
        for point in scene.get("point", []):
            self.points[point["name"]] = self._from(point, point["offset"])
        self.masses = []  # (weight, vector, vector)
        self.weights = []  # (mass, position)
        for kind in ("particle", "body"):
            for thing in scene.get(kind, []):
                if "at" in thing or "position" in thing:
                    place = self.points[thing["at"]] if "at" in thing else self._from(thing, thing["position"])
                    self._mass(thing, place, self.frames[thing.get("frame", "N")])
        self._joints()

    def _turns(self, rotations):
        turned = identity()
        for axis, angle in rotations:
            turned = product(turned, turn(self.vector(AXES[axis] if isinstance(axis, str) else axis), self.of(angle)))
        return turned

    def _from(self, thing, offset):
        return plus(self.points[thing.get("from", "O")],
                    along(self.frames[thing.get("axes", "N")], self.vector(offset)))

    def _mass(self, thing, place, frame):
        self.points[thing["name"]] = place
        self.frames.setdefault(thing["name"], frame)
        mass = self.of(thing["mass"])
        self.masses.append((mass.value, place, place))
        self.weights.append((mass.value, place))
        inertia = thing.get("inertia")
        if inertia is None:
            return
        tensor = [[mpf(0)] * 3 for _ in range(3)]
        if isinstance(inertia, list):
            for k in range(3):
                tensor[k][k] = self.of(inertia[k]).value
        elif isinstance(inertia, dict):
            for key, text in inertia.items():
                i, j = "xyz".index(key[0]), "xyz".index(key[1])
                tensor[i][j] = tensor[j][i] = self.of(text).value
        else:
            tensor[2][2] = self.of(inertia).value
        if "about" in thing:
            raise NotRead("inertia about another point")
        trace = sum(tensor[k][k] for k in range(3))
        columns = transposed(frame)
        for j in range(3):
            for k in range(3):
                weight = (trace / 2 if j == k else 0) - tensor[j][k]
                if weight:
                    self.masses.append((weight, columns[j], columns[k]))

    def _joints(self):
        self.closures = []
        waiting = list(self.scene.get("joint", []))
        bodies = {body["name"]: body for body in self.scene.get("body", [])}
        placed = {"N"} | {b["name"] for b in bodies.values() if "at" in b or "position" in b}

        def ready(joint):
            return (joint["parent"] in placed) != (joint["child"] in placed)

        while waiting:
            able = [j for j in waiting if ready(j) and j.get("coordinates")] or [j for j in waiting if ready(j)]
            if not able:
                break
            joint = able[0]
            waiting.remove(joint)
            if joint["child"] in placed:
                raise NotRead("a joint that places its parent")
            self._joint(joint, bodies[joint["child"]])
            placed.add(joint["child"])
        for joint in waiting:
            self._closure(joint)

    def _side(self, joint, side):
        name = joint[side]
        frame = self.frames[name]
        place = self.points["O" if name == "N" else name]
        place = plus(place, along(frame, self.vector(joint.get(side + "_point", [0, 0, 0]))))
        return place, product(frame, self._turns(joint.get(side + "_rotate", [])))

    def _joint(self, joint, body):
        place, axes = self._side(joint, "parent")
        q = [self.names[name, 0] for name in joint.get("coordinates", {})]
        zero = Jet(mpf(0))
        axis = joint.get("axis", "z")
        axis = self.vector(AXES[axis] if isinstance(axis, str) else axis)
        size = sqrt(dot(axis, axis))
        axis = [a / size for a in axis]
        x, y, z = (self.vector(AXES[name]) for name in "xyz")
        shift, turned, kind = [zero] * 3, identity(), joint["type"]
        if kind == "revolute":
            turned = turn(axis, q[0])
        elif kind == "prismatic":
            shift = [a * q[0] for a in axis]
        elif kind == "screw":
            turned, shift = turn(axis, q[0]), [a * q[0] * self.of(joint["pitch"]) for a in axis]
        elif kind == "cylindrical":
            turned, shift = turn(axis, q[0]), [a * q[1] for a in axis]
        elif kind == "universal":
            turned = product(turn(x, q[0]), turn(y, q[1]))
        elif kind == "planar":
            turned, shift = turn(z, q[2]), [q[0], q[1], zero]
        elif kind in ("spherical", "free"):
            if kind == "free":
                shift, q = q[:3], q[3:]
            if "angles" in joint:
                turned = identity()
                for name, angle in zip(joint["angles"], q):
                    turned = product(turned, turn(self.vector(AXES[name]), angle))
            else:
                turned = by_quaternion(q)
        elif kind != "fixed":
            raise NotRead(f"a joint of type {kind}")
        place = plus(place, along(axes, shift))
        frame = product(product(axes, turned), transposed(self._turns(joint.get("child_rotate", []))))
        back = along(frame, self.vector(joint.get("child_point", [0, 0, 0])))
        self._mass(body, [a - b for a, b in zip(place, back)], frame)

    def _closure(self, joint):
        (a, parent), (b, child) = self._side(joint, "parent"), self._side(joint, "child")
        self.closures += [x - y for x, y in zip(b, a)]
        if joint["type"] == "spherical":
            return
        if joint["type"] != "revolute" or joint.get("axis", "z") != "z":
            raise NotRead(f"a closing joint of type {joint['type']}")
        normal = transposed(child)[2]
        self.closures += [dot(transposed(parent)[k], normal) for k in range(2)]

    # -- equations

    def constraints(self):
        """(name, residual of position or None, row, what the row times q'' must be, rate of the residual) of each."""
        found, n = [], self.n
        listed = [(c["name"], c.get("holonomic"), c.get("nonholonomic")) for c in self.scene.get("constraint", [])]
        for name, holonomic, nonholonomic in listed:
            left, _, right = str(holonomic or nonholonomic).partition("=")
            value = self.of(left) - (self.of(right) if right else 0)
            found.append(self._held(name, value) if holonomic else self._slides(name, value))
        for frame in self.scene.get("frame", []):
            if "quaternion" in frame:
                e = [self.of(name) for name in frame["quaternion"]]
                found.append(self._held(frame["name"], dot(e, e) - 1))
        for joint in self.scene.get("joint", []):
            q = [self.names[name, 0] for name in joint.get("coordinates", {})]
            if joint["type"] in ("spherical", "free") and "angles" not in joint and q:
                found.append(self._held(joint["child"], dot(q[-4:], q[-4:]) - 1))
        found += [self._held(None, value) for value in self.closures]
        for rolling in self.scene.get("rolling", []):
            found += self._rolls(rolling)
        return found

    def _held(self, name, value):
        row = [value.first.get(i, mpf(0)) for i in range(self.n)]
        return name, value.value, row, -self._bend(value), self.rate(value).value

    def _slides(self, name, value):
        n = self.n
        row = [value.first.get(n + 1 + i, mpf(0)) for i in range(n)]
        bias = value.first.get(n, mpf(0)) + sum(value.first.get(i, mpf(0)) * self.rates[i] for i in range(n))
        return name, None, row, -bias, value.value

    def _rolls(self, rolling):
        if "on" in rolling:
            raise NotRead("rolling on a body")
        contact = along(self.frames[rolling.get("axes", "N")], self.vector(rolling["contact"]))
        velocity = [self.rate(x) for x in self.points[rolling["body"]]]
        moved = plus(velocity, cross(self._omega(rolling["body"]), contact))
        return [self._slides(None, component) for component in moved]

    def _bend(self, value):
        """The part of d2/dt2 without accelerations."""
        n, moving = self.n, self.rates + [mpf(1)]
        total = mpf(0)
        for (i, j), d in value.second.items():
            if j <= n:
                total += d * moving[i] * moving[j] * (1 if i == j else 2)
        return total

    def _omega(self, frame):
        """Angular velocity as Jets with first derivatives, from R' R^T."""
        matrix = self.frames[frame]
        moved = product([[self.rate(x) for x in row] for row in matrix], transposed(matrix))
        return [moved[2][1], moved[0][2], moved[1][0]]

    def virtual(self, point):
        return [[x.first.get(i, mpf(0)) for x in point] for i in range(self.n)]

    def solve(self):
        """Accelerations, the rates of first-order states, and multipliers of the constraints that are named."""
        n = self.n
        matrix, loads = mpmath.zeros(n), [mpf(0)] * n
        for weight, a, b in self.masses:
            for x, y in zip(a, b):
                bend = self._bend(y)
                for i, d in x.first.items():
                    if i >= n:
                        continue
                    loads[i] -= weight * d * bend
                    for j, e in y.first.items():
                        if j < n:
                            matrix[i, j] += weight * d * e
        for load in (self._gravity, self._forces, self._torques, self._springs, self._energies, self._sliding):
            load(matrix, loads)
        return self._solved(matrix, loads)

    def _solved(self, matrix, loads):
        n, rows = self.n, self.constraints()
        kept = independent([row for _, _, row, _, _ in rows])
        m = len(kept)
        whole, right = mpmath.zeros(n + m), mpmath.zeros(n + m, 1)
        whole[:n, :n] = matrix
        for i in range(n):
            right[i] = loads[i]
        for k, at in enumerate(kept):
            for i in range(n):
                whole[n + k, i] = rows[at][2][i]
                whole[i, n + k] = -rows[at][2][i]
            right[n + k] = rows[at][3]
        try:
            x = mpmath.lu_solve(whole, right)
        except ZeroDivisionError:
            raise NotRead("a singular system") from None
        self.accelerations = [x[i] for i in range(n)]
        for i, name in enumerate(self.q):
            self.names[name, 2] = Jet(x[i])
        self.multipliers = {}
        if m == len(rows):  # else they are not unique
            self.multipliers = {rows[at][0]: x[n + k] for k, at in enumerate(kept) if rows[at][0]}
        for constraint in self.scene.get("constraint", []):
            if constraint["name"] in self.multipliers:
                name = constraint.get("multiplier", "lambda_" + constraint["name"])
                self.names[name, 0] = Jet(self.multipliers[constraint["name"]])
        return {**dict(zip(self.q, self.accelerations)),
                **{name: self.of(entry.get("rate", "0")).value for name, entry in self.scene.get("states", {}).items()}}

    def _gravity(self, _, loads):
        pull = self.vector(self.scene.get("gravity", [0, 0]))
        for mass, place in self.weights:
            for i, step in enumerate(self.virtual(place)):
                loads[i] += mass * sum(g.value * s for g, s in zip(pull, step))

    def _forces(self, _, loads):
        for force in self.scene.get("force", []):
            vector = along(self.frames[force.get("axes", "N")], self.vector(force["vector"]))
            for point, side in ((force["at"], 1), (force.get("reaction"), -1)):
                if point:
                    for i, step in enumerate(self.virtual(self.points[point])):
                        loads[i] += side * sum(f.value * s for f, s in zip(vector, step))
        for name, text in self.scene.get("forces", {}).items():
            loads[self.q.index(name)] += self.of(text).value
        for joint in self.scene.get("joint", []):
            for name, text in joint.get("drive", {}).items():
                loads[self.q.index(name)] += self.of(text).value

    def _torques(self, _, loads):
        for torque in self.scene.get("torque", []):
            given = torque["vector"]
            given = given if isinstance(given, list) else [0, 0, given]
            vector = along(self.frames[torque.get("axes", "N")], self.vector(given))
            for frame, side in ((torque["on"], 1), (torque.get("reaction"), -1)):
                if frame:
                    omega = self._omega(frame)
                    for i in range(self.n):
                        loads[i] += side * sum(m.value * w.first.get(self.n + 1 + i, mpf(0)) for m, w in zip(vector, omega))

    def _length(self, link):
        if "along" in link:
            return self.of(link["along"])
        a, b = (self.points[name] for name in link["between"])
        way = [x - y for x, y in zip(b, a)]
        return sqrt(dot(way, way))

    def _springs(self, _, loads):
        for spring in self.scene.get("spring", []):
            stretch = self._length(spring) - self.of(spring.get("length", 0))
            self._potential(self.of(spring["stiffness"]) * stretch * stretch / 2, loads)
        for damper in self.scene.get("damper", []):
            length = self._length(damper)
            force = -self.of(damper["damping"]).value * self.rate(length).value
            for i in range(self.n):
                loads[i] += force * length.first.get(i, mpf(0))

    def _potential(self, value, loads):
        for i in range(self.n):
            loads[i] -= value.first.get(i, mpf(0))

    def _energies(self, matrix, loads):
        n, energy = self.n, self.scene.get("energy", {})
        if "potential" in energy:
            self._potential(self.of(energy["potential"]), loads)
        for key in ("kinetic", "lagrangian"):
            if key in energy:
                self._lagrangian(self.of(energy[key]), matrix, loads)
        if "dissipation" in self.scene:
            lost = self.of(self.scene["dissipation"]["rayleigh"])
            for i in range(n):
                loads[i] -= lost.first.get(n + 1 + i, mpf(0))
        for joint in self.scene.get("joint", []):
            for name, text in joint.get("armature", {}).items():
                i = self.q.index(name)
                matrix[i, i] += self.of(text).value

    def _lagrangian(self, value, matrix, loads):
        n = self.n
        second = lambda i, j: value.second.get((min(i, j), max(i, j)), mpf(0))
        for i in range(n):
            loads[i] += value.first.get(i, mpf(0)) - second(n + 1 + i, n)
            for j in range(n):
                matrix[i, j] += second(n + 1 + i, n + 1 + j)
                loads[i] -= second(n + 1 + i, j) * self.rates[j]

    def _sliding(self, _, loads):
        for friction in self.scene.get("friction", []):
            if "normal" not in friction or isinstance(friction["slip"], list):
                raise NotRead("friction on a reaction")
            slip = self.of(friction["slip"])
            if abs(slip.value) < mpf("1e-12"):
                raise NotRead("friction that sticks")
            force = -self.of(friction["coefficient"]).value * self.of(friction["normal"]).value * mpmath.sign(slip.value)
            for i in range(self.n):
                loads[i] += force * slip.first.get(self.n + 1 + i, mpf(0))
        for contact in self.scene.get("unilateral", []):
            if self.of(contact["gap"]).value < mpf("1e-9"):
                raise NotRead("a closed contact")

    def energy(self):
        """T and V of masses, gravity and springs, and of [energy]."""
        n, kinetic, potential = self.n, mpf(0), mpf(0)
        for weight, a, b in self.masses:
            kinetic += weight * sum(self.rate(x).value * self.rate(y).value for x, y in zip(a, b)) / 2
        pull = self.vector(self.scene.get("gravity", [0, 0]))
        for mass, place in self.weights:
            potential -= mass * sum(g.value * x.value for g, x in zip(pull, place))
        for spring in self.scene.get("spring", []):
            stretch = self._length(spring) - self.of(spring.get("length", 0))
            potential += (self.of(spring["stiffness"]) * stretch * stretch).value / 2
        energy = self.scene.get("energy", {})
        kinetic += self.of(energy.get("kinetic", 0)).value
        potential += self.of(energy.get("potential", 0)).value
        for joint in self.scene.get("joint", []):
            for name, text in joint.get("armature", {}).items():
                kinetic += self.of(text).value * self.rates[self.q.index(name)] ** 2 / 2
        return kinetic, potential


def independent(rows):
    """Indices of rows that none of the others kept gives, in 60 digits."""
    kept, basis = [], []
    for at, row in enumerate(rows):
        size = max((abs(x) for x in row), default=mpf(0))
        rest = list(row)
        for pivot, other in basis:
            factor = rest[pivot] / other[pivot]
            rest = [x - factor * y for x, y in zip(rest, other)]
        left = max(range(len(rest)), key=lambda i: abs(rest[i]), default=None)
        if left is None or size == 0 or abs(rest[left]) < mpf("1e-13") * size:
            continue
        kept.append(at)
        basis.append((left, rest))
    return kept


def on_constraints(scene, state, parameters=None, time=0, fixed=()):
    """The state that obeys the constraints to 55 digits, moved as little as possible; None where it does not converge."""
    names = coordinate_names(scene)
    state = {key: mpf(value) for key, value in state.items()}
    for dots, tries in (("", 30), ("'", 2)):
        for _ in range(tries):
            here = Reference(scene, state, parameters, time)
            rows = [r for r in here.constraints() if dots or r[1] is not None]
            rows = [rows[k] for k in independent([r[2] for r in rows])]
            misses = [r[4] if dots else r[1] for r in rows]
            if not rows or max(abs(x) for x in misses) < mpf("1e-56"):
                break
            a = mpmath.matrix([r[2] for r in rows])
            step = a.T * mpmath.lu_solve(a * a.T, mpmath.matrix(misses))
            for i, name in enumerate(names):
                state[name + dots] -= step[i]
        else:
            if not dots:
                return None
    return state
