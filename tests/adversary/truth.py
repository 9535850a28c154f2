# SPDX-License-Identifier: MIT
"""Whether a claim holds: at states in every cell of the functions with sides, on the own branch, in 60 digits.

Many states are tried in doubles, to find where a claim might fail and which cells there are; then one state of each
decides in 60 digits. States are drawn at several sizes, beside the start, and on both sides of each boundary of a cell.
"""

import mpmath
import numpy
from mpmath import mpf

import rest
from scene import BEFORE
from trees import (
    ZERO,
    Compiled,
    NotRead,
    Undefined,
    derivative,
    name,
    over,
    parts,
    rate,
    replaced,
    sides,
    terms,
    used,
    value,
    write,
)

HOLDS, FAILS, UNKNOWN = "holds", "fails", "unknown"
SMALL = mpf("1e-34")  # of the largest term
MORE = 140  # digits, in which rounding leaves less than in 60, and a difference the same


class Claim:
    """left = right at motion, rest or solution; constants: names that stay the same along a motion."""

    def __init__(self, left, right, at="motion", constants=(), where=(), text=None, near=None):
        self.left, self.right, self.at, self.constants, self.where = left, right, at, list(constants), list(where)
        self.near = near or {}  # coordinate: value
        self.text = text or f"{write(left)} = {write(right)}"

    def lines(self):
        found = ["[[claim]]", f'equation = "{self.text}"']
        if self.at != "motion":
            found.append(f'at = "{self.at}"')
        if self.constants:
            found.append("constants = [" + ", ".join(f'"{c}"' for c in self.constants) + "]")
        if self.where:
            found.append("where = [" + ", ".join(f'"{_condition(w)}"' for w in self.where) + "]")
        if self.near:
            found.append("near = { " + ", ".join(f'{q} = "{write(v)}"' for q, v in self.near.items()) + " }")
        return found

    def trees(self):
        return [self.left, self.right, *self.where]

    def like(self, left, right):
        return Claim(left, right, self.at, self.constants, self.where, near=self.near)


def _condition(positive):
    return f"{write(positive)} > 0"


class Answer:
    """kind; the state that decided; left - right there; the side conditions' signs seen (cells)."""

    def __init__(self, kind, state=None, residual=None, cells=0, note=""):
        self.kind, self.state, self.residual, self.cells, self.note = kind, state, residual, cells, note


def confirmed(judge):
    """The answer of judge(); a failure that shrinks with more digits was rounding."""
    answer = judge()
    if answer.kind == FAILS:
        with mpmath.workdps(MORE):
            if abs(judge().residual) < abs(answer.residual) / 1000:
                answer.kind = HOLDS
    return answer


def drawn(rng, count):
    """Numbers of several sizes."""
    kind = rng.integers(0, 5, count)
    values = rng.uniform(-2, 2, count)
    values = numpy.where(kind == 1, rng.uniform(-40, 40, count), values)
    values = numpy.where(kind == 2, rng.choice([-1, 1], count) * 10.0 ** rng.uniform(-3, 2.5, count), values)
    return numpy.where(kind == 3, rng.uniform(-6, 6, count), values)


class Truth:
    """Of one scene: its states, and what holds at them."""

    def __init__(self, scene, seed, count=240):
        self.scene, self.motion = scene, scene.motion()
        self.rng = numpy.random.default_rng(seed)
        self.start = scene.start()
        self.found_rest = None
        corners = [g for holds, _, _ in self.motion.positions for g in sides(holds)]
        self.corners = Compiled(corners) if corners else None
        self.states = self._walk() if self.motion.positions else self._free(count)
        self.count = len(self.states["t", 0])
        self.motion.accelerate_many(self.states, self.count)

    # -- states

    def _parameters(self):
        """Values of the parameters, the scene's own among them."""
        spread = self.scene.reach
        sets = [self.scene.values()]
        return sets + [self.scene.values(lambda: self.rng.uniform(-spread, spread) * 3) for _ in range(7)]

    def _free(self, count):
        states = {}
        sets = self._parameters()
        which = self.rng.integers(0, len(sets), count)
        for label in self.scene.parameters:
            states[label, 0] = numpy.array([float(p[label, 0]) for p in sets])[which]
        for q in self.motion.q:
            for dots in (0, 1):
                near = float(self.start[q, dots]) * (1 + self.rng.uniform(-0.05, 0.05, count))
                states[q, dots] = numpy.where(self.rng.random(count) < 0.15, near, drawn(self.rng, count))
        states["t", 0] = self._times(count)
        if self.motion.m:
            self._slide(states, count)
        return states

    def _times(self, count):
        return self.rng.uniform(0, 12, count) * (self.rng.random(count) < 0.9) if self.scene.time else numpy.zeros(count)

    def _slide(self, states, count):
        """Rates onto the velocity constraints, by least squares."""
        m, n = self.motion.m, self.motion.n
        flat = self.motion.sliding.many(states, count)
        a = numpy.stack(flat[: m * n], axis=1).reshape(count, m, n)
        v = numpy.stack([numpy.broadcast_to(states[q, 1], (count,)) for q in self.motion.q], axis=1)
        miss = numpy.einsum("cmn,cn->cm", a, v) + numpy.stack(flat[m * n :], axis=1)
        with numpy.errstate(all="ignore"):
            good = numpy.isfinite(a).all(axis=(1, 2)) & numpy.isfinite(miss).all(axis=1)
        a[~good], miss[~good] = 0, 0
        v = v - numpy.einsum("cnm,cm->cn", numpy.linalg.pinv(a), miss)
        for i, q in enumerate(self.motion.q):
            states[q, 1] = v[:, i]

    def _walk(self):
        """By short steps from the start, along the own factors, with other values of the parameters."""
        sets, each = self._parameters()[:6], 4
        count = len(sets) * each
        here = {key: numpy.full(count, float(v)) for key, v in self.start.items()}
        here["t", 0] = numpy.zeros(count)
        alive = numpy.ones(count, dtype=bool)
        goals = {key: numpy.repeat([float(s[key]) for s in sets], each) for key in sets[0]}
        for part in range(1, 9):
            for key, goal in goals.items():
                here[key] = float(self.start[key]) + (goal - float(self.start[key])) * part / 8
            alive &= self.motion.onto(here, count, 0.3)[0]
        if not alive.any():
            raise Undefined("no state on the constraints")
        found = self._steps(here, alive, count)
        states = {key: numpy.concatenate([f[key] for f in found]) for key in here}
        count = len(states["t", 0])
        for q in self.motion.q:
            states[q, 1] = numpy.where(self.rng.random(count) < 0.1, float(self.start[q, 1]), drawn(self.rng, count))
        self._slide(states, count)
        return states

    def _steps(self, here, alive, count):
        """Walks from given states; the length of a step grows where Newton's method has nothing to mend."""

        def kept(which):
            return {key: v[which].copy() for key, v in here.items()}

        found, n = [kept(alive)], self.motion.n
        length, way = numpy.full(count, 0.05), numpy.zeros((count, n))
        for _ in range(30):
            along, least = self.motion.tangents(here, count)
            alive &= least > 1e-7
            wish = self.rng.normal(size=(count, n))
            way = numpy.einsum("cij,cj->ci", along, way + 0.3 * wish / numpy.linalg.norm(wish, axis=1)[:, None])
            way /= numpy.maximum(numpy.linalg.norm(way, axis=1), 1e-300)[:, None]
            there = dict(here)
            for i, q in enumerate(self.motion.q):
                there[q, 0] = here[q, 0] + length * way[:, i]
            arrived, moved = self.motion.onto(there, count, 0.4 * length)
            good = alive & arrived
            for q in self.motion.q:
                here[q, 0] = numpy.where(good, there[q, 0], here[q, 0])
            found.append(kept(good))
            length = numpy.where(
                ~arrived,
                length / 3,
                numpy.where(
                    moved < 1e-9 * length,
                    numpy.minimum(length * 1.6, 8),
                    numpy.where(moved > 0.2 * length, length / 2, length),
                ),
            )
            alive &= length > 1e-3
        return found

    def _near(self, boundaries):
        """States on both sides of boundaries, where there are no constraints of position; more of a walk else."""
        rows = []
        if self.motion.positions:
            return None
        for g in boundaries:
            movable = [
                k for k in sorted(used(g)) if (k[0] in self.motion.q and k[1] < 2) or (k == ("t", 0) and self.scene.time)
            ]
            if not movable or any(k[1] == 2 for k in used(g)):
                continue
            made = Compiled([g])
            for key in movable[:3]:
                rows += self._crossings(made, key)
        if not rows:
            return None
        states = {key: numpy.array([row[key] for row in rows]) for key in rows[0]}
        if self.motion.m:
            self._slide(states, len(rows))
        self.motion.accelerate_many(states, len(rows))
        return states

    def _crossings(self, made, key, most=3):
        at = int(self.rng.integers(0, self.count))
        base = {k: v[at] for k, v in self.states.items() if k[1] < 2 and not k[0].startswith("lambda_")}
        grid = numpy.sort(numpy.concatenate([drawn(self.rng, 60), numpy.linspace(-3, 3, 40), [-300, 300, -60, 60, -25, 25]]))
        if key == ("t", 0):
            grid = numpy.sort(numpy.abs(grid[numpy.abs(grid) < 30]))
        found = made.many({**base, key: grid}, len(grid))[0]
        with numpy.errstate(all="ignore"):
            changes = numpy.flatnonzero((found[1:] > 0) != (found[:-1] > 0))
        rows = []
        for k in self.rng.permutation(changes)[:most]:
            low, high = grid[k], grid[k + 1]
            rising = found[k + 1] > 0
            for _ in range(60):
                middle = (low + high) / 2
                if (made.many({**base, key: numpy.array([middle])}, 1)[0][0] > 0) == rising:
                    high = middle
                else:
                    low = middle
            for gap in (1e-6, 1e-2):
                rows += [{**base, key: low - gap * (1 + abs(low))}, {**base, key: high + gap * (1 + abs(high))}]
        return rows

    # -- judging

    def judge(self, claim):
        try:
            if claim.at == "rest":
                return self._rest(claim)
            if claim.at == "solution":
                return self._solution(claim)
            if claim.at == "impact":
                return self._impact(claim)
            if claim.near:
                return self._near_claim(claim)
            left, right = self.scene.named(claim.left), self.scene.named(claim.right)
            if claim.constants:
                left = replaced(left - right, lambda n: ZERO if n.op == "name" and n.args[0] in claim.constants else None)
                answer = self._all(rate(left, self.motion.q), ZERO, claim)
                return self._jumps(left, answer) if answer.kind == HOLDS else answer
            return self._all(left, right, claim)
        except (Undefined, NotRead) as no:
            return Answer(UNKNOWN, note=str(no))

    def _all(self, left, right, claim, only=()):
        boundaries = list(dict.fromkeys([*sides(left), *sides(right), *self.motion.sided]))[:10]
        conditions = [self.scene.named(w) for w in (*claim.where, *only)]
        summands = [t for side in (left, right) for t in terms(side)]
        made = Compiled([left, right, *conditions, *boundaries, *summands])
        pieces = [self.states]
        more = self._near(boundaries)
        pieces += [more] if more else []
        looks, cells = [], {}
        for states in pieces:
            self._look(made, states, len(conditions), len(boundaries), looks, cells)
        if not cells:
            return Answer(UNKNOWN, note="no state")
        short = Compiled([left, right, *summands])
        looks.sort(key=lambda x: -x[0])
        for _, states, at in looks[:4]:
            answer = self._exact(short, states, at)
            if answer and answer.kind == FAILS:
                answer.cells = len(cells)
                return answer
        seen = 0
        for states, at in list(cells.values())[:16]:
            answer = self._exact(short, states, at)
            if answer and answer.kind == FAILS:
                answer.cells = len(cells)
                return answer
            seen += answer is not None
        return Answer(HOLDS if seen else UNKNOWN, cells=len(cells))

    @staticmethod
    def _look(made, states, conditions, boundaries, looks, cells):
        count = len(states["t", 0])
        left, right, *rest_of = made.many(states, count)
        allowed = numpy.isfinite(left) & numpy.isfinite(right) & (numpy.abs(left) < 1e100)
        with numpy.errstate(all="ignore"):
            for c in rest_of[:conditions]:
                allowed &= c > 0
            signs = numpy.stack(
                [numpy.sign(b) for b in rest_of[conditions : conditions + boundaries]] or [numpy.zeros(count)]
            )
            size = sum(numpy.abs(s) for s in rest_of[conditions + boundaries :]) + 1e-12
            miss = numpy.where(allowed, numpy.abs(left - right) / size, 0)
        for at in numpy.flatnonzero(allowed):
            if miss[at] > 1e-7:
                looks.append((miss[at], states, at))
            cells.setdefault(tuple(signs[:, at]), (states, at))

    def _exact(self, made, states, at):
        """What holds at one state in 60 digits."""
        state = {key: v[at] for key, v in states.items()}
        try:
            if self.corners and any(g == 0 for g in self.corners.mp(self.motion.polish(state))):
                return None  # in a corner of a constraint, which allows no velocity there but 0
            return confirmed(lambda: self.at(made, self.motion.polish(state)))
        except Undefined:
            return None

    @staticmethod
    def at(made, state):
        left, right, *summands = made.mp(state)
        size = max([abs(left), abs(right), *[abs(s) for s in summands]])
        return Answer(FAILS if abs(left - right) > SMALL * size else HOLDS, state, left - right)

    def _jumps(self, left, answer):
        """A quantity whose derivative is zero must not jump where a motion goes from one cell into another."""
        if self.motion.positions or self.motion.m:
            return answer
        made = Compiled([left])
        for g in sides(left):
            speed = Compiled([rate(g, self.motion.q)])
            movable = [k for k in sorted(used(g)) if k[0] in self.motion.q or (k == ("t", 0) and self.scene.time)]
            for key in movable:
                for _ in range(8):  # at one state of the others nothing may move there
                    for row in self._crossings(Compiled([g]), key)[::2]:
                        jump = self._jump(made, speed, g, row, key)
                        if jump:
                            return jump
        return answer

    def _jump(self, made, speed, g, row, key):
        """Both sides of a boundary, 1e-25 apart, in 60 digits."""
        state = {k: mpf(float(v)) for k, v in row.items()}
        boundary = Compiled([g])
        try:
            a, b = state[key] - 3e-6 * (1 + abs(state[key])), state[key] + 3e-6 * (1 + abs(state[key]))
            low = boundary.mp({**state, key: a})[0] > 0
            if low == (boundary.mp({**state, key: b})[0] > 0):
                return None
            while b - a > mpf("1e-25") * (1 + abs(a)):
                middle = (a + b) / 2
                a, b = (middle, b) if (boundary.mp({**state, key: middle})[0] > 0) == low else (a, middle)
            before, after = {**state, key: a}, {**state, key: b}
            one, two = made.mp(before)[0], made.mp(after)[0]
            moving = speed.mp(self.motion.accelerate(before))[0]
        except Undefined:
            return None
        if abs(one - two) > mpf("1e-15") * (1 + abs(one)) and abs(moving) > mpf("1e-20"):
            return Answer(FAILS, before, one - two, note=f"jumps where {write(g)} = 0")
        return None

    def _impact(self, claim):
        """At the pose of the start, with the rates before that it has, for all parameters."""
        left, right = self.scene.named(claim.left), self.scene.named(claim.right)
        made = Compiled([left, right, *terms(left), *terms(right)])
        seen = 0
        for at in range(0, self.count, max(1, self.count // 9)):
            state = {**self.start, **{(label, 0): mpf(float(self.states[label, 0][at])) for label in self.scene.parameters}}
            try:
                for label, p in self.scene.parameters.items():
                    if used(p.value):
                        state[label, 0] = value(p.value, state)
                for q, (initial, speed, *_) in self.scene.coordinates.items():
                    state[q, 0], state[q, 1] = value(initial, state), value(speed, state)
                state = self.motion.polish(state)
                state.update({(q, BEFORE): state[q, 1] for q in self.motion.q})
                answer = self.at(made, self.motion.struck(state))
            except Undefined:
                continue
            seen += 1
            if answer.kind == FAILS:
                return answer
        return Answer(HOLDS if seen else UNKNOWN, cells=seen)

    def _near_claim(self, claim):
        """To first order at rest at a value, with one coordinate: what is linear in x, x' and x'' along the linearized motion."""
        (q,) = self.motion.q
        gap = self.scene.named(claim.left - claim.right)
        a = over(self.motion.force[0] - self.motion.bias[0], self.motion.mass[0][0])
        pieces = [gap] + [derivative(gap, (q, d)) for d in (0, 1, 2)] + [derivative(a, (q, d)) for d in (0, 1)]
        made = Compiled([*pieces, a])
        seen = 0
        for values in self._parameters():
            try:
                state = {**values, ("t", 0): mpf(0), (q, 0): value(claim.near[q], values), (q, 1): mpf(0), (q, 2): mpf(0)}
                whole, by, by_rate, by_second, stiff, damped, there = made.mp(state)
            except Undefined:
                continue
            if abs(there) > mpf("1e-40"):
                return Answer(UNKNOWN, note="no rest")
            seen += 1
            for miss, size in ((whole, 1), (by + by_second * stiff, abs(by)), (by_rate + by_second * damped, abs(by_rate))):
                if abs(miss) > SMALL * max(1, size):
                    return Answer(FAILS, state, miss)
        return Answer(HOLDS if seen else UNKNOWN, cells=seen)

    def _rest(self, claim):
        if self.found_rest is None:
            sets = self._parameters()[:3]
            self.found_rest = [s for p in sets for s in rest.states(self.scene, p)]
        if not self.found_rest:
            return Answer(UNKNOWN, note="no rest found")
        left, right = self.scene.named(claim.left), self.scene.named(claim.right)
        made = Compiled([left, right, *terms(left), *terms(right)])
        seen = 0
        for state in self.found_rest:
            try:
                left, right, *summands = made.mp(state)
            except Undefined:
                continue
            seen += 1
            if abs(left - right) > mpf("1e-9") * max([1, *[abs(s) for s in summands]]):  # a multiple root is less exact
                return Answer(FAILS, state, left - right, cells=seen)
        return Answer(HOLDS if seen else UNKNOWN, cells=seen)

    def _solution(self, claim):
        """x = f(t, constants): put into the equations of motion of a scene with one coordinate."""
        q = self.motion.q[0]
        if len(self.motion.q) != 1 or claim.left != name(q):
            return Answer(UNKNOWN, note="not one coordinate")
        f = self.scene.named(claim.right)
        first = rate(f, [])
        known = {(q, 0): f, (q, 1): first, (q, 2): rate(first, [])}
        put = lambda e: replaced(e, lambda n: known.get(n.args) if n.op == "name" else None)  # noqa: E731
        row = put(self.motion.mass[0][0]) * known[q, 2] + put(self.motion.bias[0])
        other = put(self.motion.force[0])
        summands = terms(row) + terms(other)
        made = Compiled([row, other, *summands])
        seen = 0
        for values in self._parameters():
            for _ in range(12):
                state = {**values, ("t", 0): mpf(float(self.rng.uniform(0, 3)))}
                for c in claim.constants:
                    state[c, 0] = mpf(float(drawn(self.rng, 1)[0]))
                try:
                    answer = confirmed(lambda s=state: self.at(made, s))
                except Undefined:
                    continue
                seen += 1
                if answer.kind == FAILS:
                    return answer
        return Answer(HOLDS if seen else UNKNOWN, cells=seen)

    def holds_where(self, claim, conditions):
        """The claim at the states at which the conditions (trees that are positive) hold too."""
        left, right = self.scene.named(claim.left), self.scene.named(claim.right)
        if claim.constants:
            left = replaced(left - right, lambda n: ZERO if n.op == "name" and n.args[0] in claim.constants else None)
            left, right = rate(left, self.motion.q), ZERO
        try:
            return self._all(left, right, claim, conditions)
        except (Undefined, NotRead) as no:
            return Answer(UNKNOWN, note=str(no))


def has_nothing_of(scene, claim):
    """Whether a claim holds whatever the state is, with q, q' and q'' all free where its own conditions hold: an identity,
    which may be called vacuous."""
    left, right = scene.named(claim.left), scene.named(claim.right)
    if claim.constants:
        return not any(n in scene.coordinates or n == "t" for t in (left, right) for n, _ in used(t))
    summands = terms(left) + terms(right)
    made = Compiled([left, right, *summands])
    conditions = [scene.named(w) for w in claim.where]
    allowed = Compiled(conditions) if conditions else None
    names = set().union(used(left), used(right), *(used(c) for c in conditions))
    sizes = {abs(float(n.args[0])) for side in (left, right) for n in parts(side) if n.op == "num"}
    sizes |= {a / b for a in sizes for b in sizes if b}
    numbers = sorted({0.0, *sizes, *(-size for size in sizes)})
    rng = numpy.random.default_rng(5)
    seen = 0
    for _ in range(400):  # arguments of asin and acos are rarely drawn
        if seen == 40:
            break
        if rng.random() < 0.5:
            state = {key: mpf(float(drawn(rng, 1)[0])) for key in sorted(names)}
        else:  # beside a number of the claim: asin(x - 20) has few arguments
            state = {key: mpf(float(rng.choice(numbers) + rng.uniform(-1, 1))) for key in sorted(names)}
        try:
            if allowed and any(value <= 0 for value in allowed.mp(state)):
                continue
            if confirmed(lambda s=state: Truth.at(made, s)).kind == FAILS:
                return False
            seen += 1
        except Undefined:
            continue
    return seen > 0
