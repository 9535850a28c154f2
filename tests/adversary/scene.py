# SPDX-License-Identifier: MIT
"""A scene as it was drawn: its text for the program, and its motion by Lagrange's equations of these trees.

Constraints are known twice: as they are written (a product of branches, say) and by their own factor, the one that
vanishes where the scene begins and is regular there. States, rates and accelerations obey the own factor alone, so that
no other branch can come in; the multiplier is that of what is written.
"""

import copy

import mpmath
import numpy
from mpmath import mpf

from trees import (
    ONE,
    ZERO,
    Compiled,
    Tree,
    Undefined,
    alias,
    derivative,
    name,
    number,
    of,
    plain,
    rate,
    replaced,
    sides,
    tree,
    used,
    value,
    write,
)

BEFORE = 3  # in place of dots: the rate before an impact, written x'(-)


def before(label):
    return alias(f"{label}'(-)", Tree("name", label, BEFORE))


class Constraint:
    """written = 0; own: the factor that holds at the start; velocity constraints are linear in the rates."""

    def __init__(self, label, written, own=None, holonomic=True, text=None):
        self.label, self.written, self.own = label, written, own if own is not None else written
        self.holonomic, self.text = holonomic, text


class Parameter:
    """text: as in the file; value: a tree, of other parameters too; kind: scale, shift (angles) or fixed."""

    def __init__(self, text, meaning, kind="scale", spread=None):
        self.text, self.value, self.kind, self.spread = text, tree(meaning), kind, spread


class Scene:
    def __init__(self):
        self.parameters, self.coordinates, self.particles = {}, {}, []
        self.gravity, self.potential, self.kinetic, self.springs = None, ZERO, ZERO, []
        self.forces, self.pushes, self.frictions, self.constraints, self.inputs = {}, [], [], [], {}
        self.definitions = {}  # abbreviations: names in expressions, their trees here
        self.impulses, self.extra, self.needed = {}, "", []  # extra: text, and the trees of what it names
        self.lengths = False  # roots of squares of positions, which may be told on the sheet of the start
        self.time = False  # whether t matters
        self.reach = 0.2  # by how much parameters may change

    def __getstate__(self):
        """Without what is compiled: scenes go from one process to another."""
        return {k: v for k, v in self.__dict__.items() if k != "_motion"}

    # -- building

    def parameter(self, label, meaning, text=None, kind="scale"):
        meaning = tree(meaning)
        if text is None:
            text = write(meaning) if meaning.op == "num" else '"' + write(meaning) + '"'
        self.parameters[label] = Parameter(text, meaning, kind)
        return name(label)

    def coordinate(self, label, initial=0, speed=0, unit=None, guess=False):
        self.coordinates[label] = (tree(initial), tree(speed), unit, guess)
        return name(label)

    def particle(self, label, mass, position):
        self.particles.append((label, tree(mass), [tree(p) for p in position]))

    def force(self, q, load):
        self.forces[q] = self.forces.get(q, ZERO) + load

    def define(self, label, meaning):
        """A name for an expression."""
        self.definitions[label] = tree(meaning)
        return alias(label, meaning)

    def velocity(self, label):
        """Components of a particle's velocity."""
        position = next(p for n, _, p in self.particles if n == label)
        return [rate(p, self.coordinates) for p in position]

    def norm(self, label):
        x, *more = [v for v in self.velocity(label) if v != ZERO] or [ZERO]
        size = of("abs", x) if not more else of("sqrt", sum((v**2 for v in more), x**2))
        return alias(f"norm(vel({label}))", size)

    def without(self, label):
        """The scene without a coordinate, or None where something else needs it."""
        left = copy.copy(self)
        if len(self.coordinates) < 2:
            return None
        left.coordinates = {k: v for k, v in self.coordinates.items() if k != label}
        left.forces = {k: v for k, v in self.forces.items() if k != label}
        left.particles = [p for p in self.particles if not any((label, 0) in used(c) for c in p[2])]
        left.constraints = [c for c in self.constraints if not any((label, d) in used(c.written) for d in (0, 1))]
        trees = [self.potential, self.kinetic, *left.forces.values(), *[c for p in left.particles for c in p[2]]]
        trees += [c.written for c in left.constraints] + [t for s in self.springs for t in s]
        trees += [t for p in self.pushes for t in p[1]] + [t for f in self.frictions for t in f[1:]]
        if any(n == label for t in trees for n, _ in used(plain(t))):
            return None
        if {p[0] for p in self.pushes} - {p[0] for p in left.particles}:
            return None
        return left

    # -- text

    def text(self, claims=(), head=""):
        lines = [head] if head else []
        if self.gravity:
            lines.append("gravity = [" + ", ".join(_quoted(g) for g in self.gravity) + "]")
        used_names = {n for t in self._trees(claims) for n, _ in used(t)}
        waiting = True
        while waiting:
            more = {n for p in used_names & set(self.parameters) for n, _ in used(self.parameters[p].value)} - used_names
            used_names |= more
            waiting = bool(more)
        kept = {k: p for k, p in self.parameters.items() if k in used_names}
        if kept:
            lines.append("[parameters]")
            lines += [f"{k} = {p.text}" for k, p in kept.items()]
        if self.inputs:
            lines.append("[inputs]")
            lines += [f"{k} = {_quoted(e)}" for k, e in self.inputs.items()]
        lines.append("[coordinates]")
        for q, (initial, speed, unit, guess) in self.coordinates.items():
            keys = f"{'guess' if guess else 'initial'} = {_quoted(initial)}"
            if speed != ZERO:
                keys += f", {'rate_guess' if guess else 'rate'} = {_quoted(speed)}"
            lines.append(f"{q} = {{ {keys}" + (f', unit = "{unit}"' if unit else "") + " }")
        if self.definitions:
            lines.append("[definitions]")
            lines += [f"{k} = {_quoted(e)}" for k, e in self.definitions.items()]
        for label, mass, position in self.particles:
            vector = ", ".join(_quoted(p) for p in position)
            lines += ["[[particle]]", f'name = "{label}"', f"mass = {_quoted(mass)}", f"position = [{vector}]"]
        if self.potential != ZERO or self.kinetic != ZERO:
            lines.append("[energy]")
            lines += [
                f"{k} = {_quoted(e)}" for k, e in (("kinetic", self.kinetic), ("potential", self.potential)) if e != ZERO
            ]
        for along, stiffness, length in self.springs:
            lines += ["[[spring]]", _between(along), f"stiffness = {_quoted(stiffness)}"]
            lines += [f"length = {_quoted(length)}"] if length != ZERO else []
        for label, vector in self.pushes:
            lines += ["[[force]]", f'at = "{label}"', "vector = [" + ", ".join(_quoted(v) for v in vector) + "]"]
        if self.forces:
            lines.append("[forces]")
            lines += [f"{q} = {_quoted(f)}" for q, f in self.forces.items()]
        for label, coefficient, slip, normal in self.frictions:
            lines += [
                "[[friction]]",
                f'name = "{label}"',
                f"coefficient = {_quoted(coefficient)}",
                f"slip = {_quoted(slip)}",
                f"normal = {_quoted(normal)}",
            ]
        if self.impulses:
            lines.append("[impulses]")
            lines += [f"{q} = {_quoted(f)}" for q, f in self.impulses.items()]
        for c in self.constraints:
            kind = "holonomic" if c.holonomic else "nonholonomic"
            lines += ["[[constraint]]", f'name = "{c.label}"', f'{kind} = "{c.text or write(c.written)}"']
        if self.extra:
            lines.append(self.extra)
        lines += [line for claim in claims for line in claim.lines()]
        return "\n".join(lines) + "\n"

    def _trees(self, claims=()):
        found = [*(self.gravity or []), self.potential, self.kinetic, *self.forces.values(), *self.inputs.values()]
        found += [t for _, mass, position in self.particles for t in (mass, *position)]
        found += [t for spring in self.springs for t in spring] + [t for _, vector in self.pushes for t in vector]
        found += [t for f in self.frictions for t in f[1:]] + [c.written for c in self.constraints]
        found += [t for i, r, _, _ in self.coordinates.values() for t in (i, r)] + list(self.impulses.values())
        found += [t for claim in claims for t in claim.trees()] + self.needed + list(self.definitions.values())
        return [plain(t) for t in found]

    # -- mechanics

    def named(self, node):
        """Without aliases and inputs, which become their expressions of t."""

        def change(n):
            if n.op == "alias":
                return self.named(n.args[1])
            if n.op == "name" and n.args[0] in self.inputs:
                e = self.inputs[n.args[0]]
                for _ in range(n.args[1]):
                    e = derivative(e, ("t", 0))
                return self.named(e)
            return None

        return replaced(node, change)

    def energies(self):
        kinetic, potential = self.named(self.kinetic), self.named(self.potential)
        for label, mass, position in self.particles:
            for k, p in enumerate(position):
                kinetic = kinetic + mass * rate(self.named(p), self.coordinates) ** 2 / 2
                if self.gravity and k < len(self.gravity):
                    potential = potential - mass * self.gravity[k] * p
        for along, stiffness, length in self.springs:
            potential = potential + stiffness * (along - length) ** 2 / 2
        return kinetic, self.named(potential)

    def loads(self):
        """Generalized forces that are not in V."""
        total = {q: self.forces.get(q, ZERO) for q in self.coordinates}
        for label, vector in self.pushes:
            position = next(p for n, _, p in self.particles if n == label)
            for f, p in zip(vector, position):
                for q in total:
                    total[q] = total[q] + f * derivative(p, (q, 0))
        for _, coefficient, slip, normal in self.frictions:
            for q in total:
                total[q] = total[q] - coefficient * normal * of("sign", slip) * derivative(slip, (q, 1))
        return {q: self.named(f) for q, f in total.items()}

    def motion(self):
        if not hasattr(self, "_motion"):
            self._motion = Motion(self)
        return self._motion

    def changed(self):
        """To be called after something was edited."""
        self.__dict__.pop("_motion", None)
        return self

    def equations(self):
        """The equations of motion as trees with a right side that is zero, where there are no constraints."""
        m = self.motion()
        rows = []
        for i, q in enumerate(self.coordinates):
            row = sum((m.mass[i][j] * name(p + "''") for j, p in enumerate(self.coordinates)), ZERO)
            rows.append((row + m.bias[i], m.force[i]))
        return rows

    def start(self):
        """{(name, dots): value} in 60 digits at the scene's values."""
        state = self.values()
        for q, (initial, speed, unit, _) in self.coordinates.items():
            factor = mpmath.pi / 180 if unit == "deg" else 1
            state[q, 0], state[q, 1] = value(initial, state) * factor, value(speed, state) * factor
        state["t", 0] = mpf(0)
        return state

    def values(self, draw=None):
        """Parameters; draw() changes those that stand alone."""
        state = {}
        for label, p in self.parameters.items():
            number = value(p.value, state)
            if draw and not used(p.value):
                shift = mpf(draw()) * (p.spread if p.spread is not None else 1)
                number = number + shift if p.kind == "shift" else number if p.kind == "fixed" else number * mpmath.exp(shift)
                number = mpf(float(number))
            state[label, 0] = number
        return state


def _quoted(node):
    text = write(node)
    try:
        float(text)
        return text
    except ValueError:
        return '"' + text + '"'


def _between(along):
    return f"between = {along.args[0]}" if along.op == "alias" else f'along = "{write(along)}"'


class Motion:
    """M q'' + bias = force + A^T lambda, A q'' = curve, as compiled functions."""

    def __init__(self, scene):
        self.scene, self.q = scene, list(scene.coordinates)
        kinetic, potential = scene.energies()
        self.kinetic, self.potential = kinetic, potential
        loads = scene.loads()
        n = len(self.q)
        momenta = [derivative(kinetic, (q, 1)) for q in self.q]
        self.mass = [[derivative(p, (q, 1)) for q in self.q] for p in momenta]
        self.bias, self.force = [], []
        for p, q in zip(momenta, self.q):
            bias = derivative(p, ("t", 0)) - derivative(kinetic, (q, 0))
            for other in self.q:
                bias = bias + derivative(p, (other, 0)) * name(other + "'")
            self.bias.append(bias + derivative(potential, (q, 0)))
            self.force.append(loads[q])
        self.rows, self.curves, self.holds, self.slips, self.factors = [], [], [], [], []
        for c in scene.constraints:
            own = scene.named(c.own)
            moved = rate(own, self.q) if c.holonomic else own
            self.holds.append(own if c.holonomic else None)
            self.slips.append(moved)
            row = [derivative(moved, (q, 1)) for q in self.q]
            self.rows.append(row)
            curve = derivative(moved, ("t", 0))
            for q in self.q:
                curve = curve + derivative(moved, (q, 0)) * name(q + "'")
            self.curves.append(-curve)
            self.factors.append(self._times_own(scene.named(c.written), c, row))
        m = len(self.rows)
        flat = [e for row in self.mass for e in row] + self.bias + self.force
        flat += [e for row in self.rows for e in row] + self.curves + self.factors
        self.system = Compiled(flat)
        self.n, self.m = n, m
        self.sided = sides_of([*self.bias, *self.force, *self.curves])
        self.positions = [(h, row, k) for k, (h, row) in enumerate(zip(self.holds, self.rows)) if h is not None]
        self.held = Compiled([h for h, _, _ in self.positions] + [e for _, row, _ in self.positions for e in row])
        still = [replaced(s, lambda n: ZERO if n.op == "name" and n.args[1] == 1 else None) for s in self.slips]
        self.sliding = Compiled([e for row in self.rows for e in row] + still)

    def _times_own(self, written, constraint, row):
        """By what the gradient of the own factor is multiplied in that of what is written; multipliers are divided by it."""
        if written == self.scene.named(constraint.own):
            return ONE
        dots = 0 if constraint.holonomic else 1
        whole = sum((derivative(written, (q, dots)) * r for q, r in zip(self.q, row)), ZERO)
        return whole / sum((r**2 for r in row), ZERO)

    # -- accelerations

    def _parts(self, flat):
        n, m = self.n, self.m
        mass = [flat[i * n : (i + 1) * n] for i in range(n)]
        at = n * n
        bias, force = flat[at : at + n], flat[at + n : at + 2 * n]
        at += 2 * n
        rows = [flat[at + k * n : at + (k + 1) * n] for k in range(m)]
        at += m * n
        return mass, bias, force, rows, flat[at : at + m], flat[at + m : at + 2 * m]

    def accelerate(self, state):
        """Adds q'' and the multipliers to a state in 60 digits."""
        mass, bias, force, rows, curves, factors = self._parts(self.system.mp(state))
        n, m = self.n, self.m
        if n == 1 and not m:
            if mass[0][0] == 0:
                raise Undefined
            state[self.q[0], 2] = (force[0] - bias[0]) / mass[0][0]
            return state
        whole, right = mpmath.zeros(n + m), mpmath.zeros(n + m, 1)
        for i in range(n):
            right[i] = force[i] - bias[i]
            for j in range(n):
                whole[i, j] = mass[i][j]
        for k in range(m):
            right[n + k] = curves[k]
            for i in range(n):
                whole[n + k, i], whole[i, n + k] = rows[k][i], -rows[k][i]
        try:
            x = mpmath.lu_solve(whole, right)
        except ZeroDivisionError:
            raise Undefined from None
        for i, q in enumerate(self.q):
            state[q, 2] = x[i]
        for k, c in enumerate(self.scene.constraints):
            if factors[k]:
                state["lambda_" + c.label, 0] = x[n + k] / factors[k]
        return state

    def accelerate_many(self, states, count):
        """The same in doubles over arrays."""
        mass, bias, force, rows, curves, factors = self._parts(self.system.many(states, count))
        n, m = self.n, self.m
        whole, right = numpy.zeros((count, n + m, n + m)), numpy.zeros((count, n + m))
        for i in range(n):
            right[:, i] = force[i] - bias[i]
            for j in range(n):
                whole[:, i, j] = mass[i][j]
        for k in range(m):
            right[:, n + k] = curves[k]
            for i in range(n):
                whole[:, n + k, i], whole[:, i, n + k] = rows[k][i], -rows[k][i]
        bad = ~numpy.isfinite(whole).all(axis=(1, 2)) | ~numpy.isfinite(right).all(axis=1)
        whole[bad] = numpy.eye(n + m)
        with numpy.errstate(all="ignore"):
            bad |= ~(numpy.abs(numpy.linalg.det(whole)) > 1e-300)
        whole[bad] = numpy.eye(n + m)
        x = numpy.linalg.solve(whole, right[:, :, None])[:, :, 0]
        x[bad] = numpy.nan
        for i, q in enumerate(self.q):
            states[q, 2] = x[:, i]
        with numpy.errstate(all="ignore"):
            for k, c in enumerate(self.scene.constraints):
                states["lambda_" + c.label, 0] = x[:, n + k] / factors[k]
        return states

    def struck(self, state):
        """Rates after the impulses, of a state with the rates before as (name, BEFORE): M (v - v-) = S + A^T Lambda, A v = b."""
        mass, _, _, rows, _, factors = self._parts(self.system.mp({**state, **{(q, 1): mpf(0) for q in self.q}}))
        n, m = self.n, self.m
        blow = Compiled([self.scene.named(self.scene.impulses.get(q, ZERO)) for q in self.q]).mp(state)
        still = self.sliding.mp(state)[m * n :]
        whole, right = mpmath.zeros(n + m), mpmath.zeros(n + m, 1)
        for i in range(n):
            right[i] = blow[i] + sum(mass[i][j] * state[q, BEFORE] for j, q in enumerate(self.q))
            for j in range(n):
                whole[i, j] = mass[i][j]
        for k in range(m):
            right[n + k] = -still[k]
            for i in range(n):
                whole[n + k, i], whole[i, n + k] = rows[k][i], -rows[k][i]
        try:
            x = mpmath.lu_solve(whole, right)
        except ZeroDivisionError:
            raise Undefined from None
        return {**state, **{(q, 1): x[i] for i, q in enumerate(self.q)}}

    # -- states that obey the constraints

    def onto(self, states, count, most):
        """Newton's method in doubles on the own factors, of many states at once; `most`: how far each may go. Moves the
        coordinates; (whether each arrived, how far it went)."""
        k, n = len(self.positions), self.n
        moved, arrived = numpy.zeros(count), numpy.zeros(count, dtype=bool)
        lost = numpy.zeros(count, dtype=bool)
        for _ in range(12):
            flat = numpy.stack(self.held.many(states, count), axis=1)
            lost |= ~numpy.isfinite(flat).all(axis=1)
            flat[lost] = 0
            step = -numpy.einsum("cnk,ck->cn", numpy.linalg.pinv(flat[:, k:].reshape(count, k, n)), flat[:, :k])
            step[lost | arrived] = 0
            size = numpy.abs(step).max(axis=1)
            moved += size
            lost |= moved > most
            step[lost] = 0
            for i, q in enumerate(self.q):
                states[q, 0] = states[q, 0] + step[:, i]
            arrived |= ~lost & (size < 1e-12 * (1 + numpy.abs(states[self.q[0], 0])))
            if (arrived | lost).all():
                break
        return arrived, moved

    def tangents(self, states, count):
        """For each state the projector onto the directions that the holonomic constraints leave, and the size of the smallest
        row's singular value."""
        k, n = len(self.positions), self.n
        row = numpy.stack(self.held.many(states, count), axis=1)[:, k:].reshape(count, k, n)
        bad = ~numpy.isfinite(row).all(axis=(1, 2))
        row[bad] = 0
        least = numpy.linalg.svd(row, compute_uv=False).min(axis=1)
        least[bad] = 0
        return numpy.eye(n) - numpy.linalg.pinv(row) @ row, least

    def polish(self, state):
        """The state in 60 digits, on the own factors, its rates too; its accelerations are added."""
        state = {key: mpf(v) if isinstance(v, (int, mpf)) else mpf(float(v)) for key, v in state.items() if key[1] < 2}
        for label, p in self.scene.parameters.items():
            if used(p.value):  # given by others, which doubles have rounded
                state[label, 0] = value(p.value, state)
        k, n = len(self.positions), self.n
        if k:
            for _ in range(12):
                flat = self.held.mp(state)
                a = mpmath.matrix(k, n)
                for r in range(k):
                    for i in range(n):
                        a[r, i] = flat[k + r * n + i]
                step = _least(a, flat[:k])
                for i, q in enumerate(self.q):
                    state[q, 0] -= step[i]
                if max(abs(s) for s in step) < mpf(10) ** (4 - mpmath.mp.dps) * (1 + max(abs(state[q, 0]) for q in self.q)):
                    break
            else:
                raise Undefined
        if self.m:
            flat = self.sliding.mp(state)
            a = mpmath.matrix(self.m, n)
            miss = []
            for r in range(self.m):
                for i in range(n):
                    a[r, i] = flat[r * n + i]
                miss.append(flat[self.m * n + r] + sum(a[r, i] * state[q, 1] for i, q in enumerate(self.q)))
            step = _least(a, miss)
            for i, q in enumerate(self.q):
                state[q, 1] -= step[i]
        return self.accelerate(state)


def _least(a, miss):
    try:
        return a.T * mpmath.lu_solve(a * a.T, mpmath.matrix(miss))
    except ZeroDivisionError:
        raise Undefined from None


def sides_of(trees):
    return list(dict.fromkeys(s for t in trees for s in sides(plain(t))))
