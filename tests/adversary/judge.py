# SPDX-License-Identifier: MIT
"""What the program says of a scene, held against what is true: false words, undecided ones, and other exits."""

import json
import os
import resource
import subprocess

from mpmath import mpf

import rest
import trees
from trees import Compiled, NotRead, Undefined, name, read, read_conditions, read_equation, terms, used
from truth import FAILS, HOLDS, UNKNOWN, Claim, Truth, has_nothing_of

PROVED, REFUTED, VACUOUS = "proved wrongly", "refuted wrongly", "vacuous wrongly"
STATE, REPAIR, SIDES, NEIGHBOUR, EXIT = "state wrong", "repair wrong", "holds_where wrong", "neighbours", "exit code"
ACCEPTED, DEGREES, BRANCHES = "accepted wrongly", "degrees wrong", "branches wrong"
PRINTED, STABLE, ROOTS = "printed wrong", "stable wrongly", "roots wrong"
FALSE = [
    PROVED,
    REFUTED,
    VACUOUS,
    STABLE,
    ROOTS,
    PRINTED,
    ACCEPTED,
    DEGREES,
    BRANCHES,
    STATE,
    REPAIR,
    SIDES,
    NEIGHBOUR,
    EXIT,
]


keep_undecided = False  # whether these are kept as false words are


class Finding:
    def __init__(self, word, claim, text, scene=None):
        self.word, self.claim, self.text, self.scene = word, claim, text, scene
        self.by = None  # the formalism of printed equations


class Program:
    """The program on files in a folder of its own."""

    def __init__(self, path, folder, patience=60):  # seconds of processor time
        self.path, self.folder, self.patience, self.runs = path, folder, patience, 0
        os.makedirs(folder, exist_ok=True)

    def ask(self, text, *words):
        """(exit code, JSON or None, the message): a negative code is a signal."""
        file = os.path.join(self.folder, "scene.toml")
        with open(file, "w", encoding="utf-8") as out:
            out.write(text)
        self.runs += 1
        limit = (self.patience, self.patience + 1)
        done = subprocess.run(
            [self.path, words[0], file, *words[1:], "--json"],
            capture_output=True,
            check=False,
            text=True,
            env={**os.environ, "LC_ALL": "C.UTF-8"},
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, limit),
        )
        try:
            answer = json.loads(done.stdout) if done.stdout.strip() else None
        except ValueError:
            answer = None
        return done.returncode, answer, done.stderr.strip()[:400]


def shown(state, claim):
    """A state as options, what the claim and the equations need of it."""
    if not state:
        return "every state"
    return ", ".join(
        f"{n + chr(39) * d} = {trees.mpmath.nstr(v, 8)}" for (n, d), v in sorted(state.items()) if n != "t" or v
    )


def known(scene, word):
    """The tree of a name of the scene in what the program answers."""
    n = name(word)
    if word in scene.definitions:
        return scene.named(scene.definitions[word])
    label = n.args[0]
    if label not in {*scene.coordinates, *scene.parameters, *scene.inputs, "t"} and not label.startswith("lambda_"):
        raise NotRead(word)
    return n


# -- claims


class Examined:
    """Claims of one scene with their truth, and what was said of them."""

    def __init__(self, program, scene, claims, seed):
        self.program, self.scene, self.seed = program, scene, seed
        self.truth = Truth(scene, seed)
        self.claims = []
        self.truths = []
        for claim in claims:
            answer = self.truth.judge(claim)
            if answer.kind != UNKNOWN:
                self.claims.append(claim)
                self.truths.append(answer)
        self.findings, self.verdicts, self.refused = [], [], None
        self.counts = {"undecided": 0, "no state": 0, "missed": 0, "sheets": 0}

    def ask(self, claims):
        return self.program.ask(self.scene.text(claims), "check")

    def examine(self, alone=()):
        """alone: indices of claims that are judged by themselves too."""
        if not self.claims:
            return
        code, answer, message = self.ask(self.claims)
        if code not in (0, 1, 2) or answer is None or len(answer.get("claims", ())) != len(self.claims):
            self.refused = (code, message)
            return
        rows = answer["claims"]
        self.verdicts = [row["verdict"] for row in rows]
        expected = 1 if "refuted" in self.verdicts else 2 if {"undecided", "vacuous"} & set(self.verdicts) else 0
        if code != expected:
            self._found(EXIT, None, f"exit code {code}, expected {expected} of {self.verdicts}")
        for claim, truth, row in zip(self.claims, self.truths, rows):
            self.one(claim, truth, row)
        for k in alone:
            if k < len(self.claims):
                self._alone(self.claims[k], self.truths[k], self.verdicts[k])

    def _alone(self, claim, truth, beside):
        code, answer, _ = self.ask([claim])
        if code not in (0, 1, 2) or not answer or not answer.get("claims"):
            return
        row = answer["claims"][0]
        if row["verdict"] != beside:
            self._found(NEIGHBOUR, claim, f"{row['verdict']} alone, {beside} beside others")
            self.one(claim, truth, row)

    def _found(self, word, claim, text):
        self.findings.append(Finding(word, claim, text, self.scene))

    def one(self, claim, truth, row):
        verdict = row["verdict"]
        if verdict == "undecided":
            self.counts["undecided"] += 1
            why = "undecided " + (row.get("reason") or "without a reason")
            self.counts[why] = self.counts.get(why, 0) + 1
            if keep_undecided:
                in_words = truth.kind + (self._at(truth, claim) if truth.kind == FAILS else "")
                self._found("not decided", claim, f"{why}; it {in_words}")
        elif verdict == "proved":
            self._proved(claim, truth, row)
        elif verdict == "vacuous":
            on_sheet = self._without_lengths(claim)
            where = row.get("where") or []
            if where and self._holds_on_sheet(claim, where):
                self.counts["sheets"] += 1
            elif not has_nothing_of(self.scene, claim) and not (on_sheet and has_nothing_of(self.scene, on_sheet)):
                self._found(VACUOUS, claim, f"vacuous; it {truth.kind}" + self._at(truth, claim))
        elif verdict == "refuted":
            self._refuted(claim, truth, row)

    @staticmethod
    def _at(truth, claim):
        if truth.kind != FAILS:
            return ""
        return f": left - right = {trees.mpmath.nstr(truth.residual, 6)} at {shown(truth.state, claim)}" + (
            f" ({truth.note})" if truth.note else ""
        )

    def _proved(self, claim, truth, row):
        if truth.kind != FAILS:
            return
        where = row.get("where") or []
        if where and self._on_its_sheet(claim, where):
            self.counts["sheets"] += 1
            return
        said = f"proved where {', '.join(where)}" if where else "proved"
        self._found(PROVED, claim, f"{said}; it fails" + self._at(truth, claim))

    def _known(self, word):
        return known(self.scene, word)

    def _conditions(self, where):
        return [c for w in where for c in read_conditions(w, self._known)]

    def _on_its_sheet(self, claim, where):
        """A sheet of roots of lengths, which is that of the start, and on which the claim holds."""
        if not self.scene.lengths and not self._pulls_by_lengths():
            on_sheet = self._without_lengths(claim)
            return on_sheet is not None and self.truth.judge(on_sheet).kind == HOLDS
        return self._holds_on_sheet(claim, where)

    def _pulls_by_lengths(self):
        """Whether a load holds the root of a square of coordinates, whose sheet is that of the start."""

        def is_length(n):
            if n.op != "sqrt" or n.args[0].op != "^" or n.args[0].args[1] != trees.number(2):
                return False
            return all(label in self.scene.coordinates and not dots for label, dots in used(n.args[0].args[0]))

        return any(is_length(n) for load in self.scene.forces.values() for n in trees.parts(self.scene.named(load)))

    def _holds_on_sheet(self, claim, where):
        """Where conditions on positions say so, which the start fulfils."""
        try:
            own = [self.scene.named(w) for w in claim.where]
            conditions = [c for c in (self.scene.named(c) for c in self._conditions(where)) if c not in own]
            if any(d for c in conditions for _, d in used(c)):
                return False
            start = self.truth.start
            if any(Compiled([c]).mp(start)[0] <= 0 for c in conditions):
                return False
        except (NotRead, Undefined):
            return False
        return self.truth.holds_where(claim, conditions).kind == HOLDS

    def _without_lengths(self, claim):
        """The claim with sqrt(e^2) of coordinates, or of differences of these, by the sign that e has at the start."""
        changed = []

        def change(n):
            if n.op != "sqrt" or n.args[0].op != "^" or n.args[0].args[1] != trees.number(2):
                return None
            e = n.args[0].args[0]
            if any(label not in self.scene.coordinates or dots for label, dots in used(e)):
                return None
            at_zero = Compiled([e]).mp({key: mpf(0) for key in used(e)})[0]
            sign = Compiled([e]).mp(self.truth.start)[0]
            if at_zero or not sign:
                return None
            changed.append(e)
            return e if sign > 0 else -e

        try:
            left, right = trees.replaced(self.scene.named(claim.left), change), trees.replaced(
                self.scene.named(claim.right), change
            )
        except Undefined:
            return None
        return claim.like(left, right) if changed else None

    def _refuted(self, claim, truth, row):
        state = row.get("counterexample") or {}
        how = self.counterexample(claim, state)
        if truth.kind == HOLDS and how != "valid":
            self._found(REFUTED, claim, f"refuted at {state}, where it {how}; it holds in {truth.cells} cells")
        elif truth.kind == HOLDS:
            self.counts["missed"] += 1
        elif how in ("holds", "is off the constraints") and not truth.note:  # of a jump a single state says nothing
            self._found(
                STATE, claim, f"refuted, rightly, at {state}, but that state {how}; it fails" + self._at(truth, claim)
            )
        elif how != "valid":
            self.counts["no state"] += 1
        self._repair(claim, row)
        sides = row.get("holds_where") or []
        if sides:
            self._holds_where(claim, sides + (row.get("where") or []))

    def _repair(self, claim, row):
        text = (row.get("likely") or {}).get("repair")
        if not text or claim.at == "solution":
            return
        try:
            left, right = read_equation(text, self._named_or_constant(claim))
        except NotRead:
            return
        repaired = claim.like(left, right)
        truth = self.truth.judge(repaired)
        where = row.get("where") or []  # what was assumed is told, and the start fulfils it
        if truth.kind == FAILS and not self._sheeted(repaired) and not (where and self._holds_on_sheet(repaired, where)):
            self._found(REPAIR, claim, f"repaired as {text}, which fails" + self._at(truth, claim))

    def _sheeted(self, claim):
        """Whether a claim holds on the sheet of the start at least, in scenes with roots of lengths."""
        if not (self.scene.lengths or self._pulls_by_lengths()) or claim.at != "motion":
            return False
        start = self.truth.start
        conditions = []
        for s in trees.sides(claim.left - claim.right) + [name(q) for q in self.scene.coordinates]:
            if any(d for _, d in used(s)):
                continue
            try:
                conditions.append(s if Compiled([s]).mp(start)[0] > 0 else -s)
            except Undefined:
                continue
        return self.truth.holds_where(claim, conditions).kind == HOLDS

    def _named_or_constant(self, claim):
        return lambda word: name(word) if word in claim.constants else self._known(word)

    def _holds_where(self, claim, sides):
        try:
            conditions = self._conditions(sides)
        except NotRead:
            return
        truth = self.truth.holds_where(claim, conditions)
        if truth.kind == FAILS:
            self._found(SIDES, claim, f"said to hold where {', '.join(sides)}, but fails" + self._at(truth, claim))

    def counterexample(self, claim, given):
        """valid, holds, is off the constraints, is not there, or is not read."""
        if not given:
            return "is not there"
        scene, motion = self.scene, self.scene.motion()
        values = {}
        try:
            for word, text in given.items():
                values[name(word).args] = trees.value(read(str(text)), values)
        except (NotRead, Undefined):
            return "is not read"
        state = scene.values()
        for label, p in scene.parameters.items():
            state[label, 0] = values[label, 0] if (label, 0) in values else trees.value(p.value, state)
        state["t", 0] = values.get(("t", 0), mpf(0))
        missing = []
        for q in motion.q:
            for dots in (0, 1):
                if (q, dots) not in values:
                    missing.append((q, dots))
                state[q, dots] = values.get((q, dots), self.truth.start[q, dots])
        try:
            if claim.at == "rest":
                return self._at_rest(claim, state)
            if claim.at in ("solution", "impact") or claim.near:
                return "is not read"
            if not any(q in motion.q for q, _ in missing) or not motion.m:
                before = dict(state)
                state = motion.polish(state)
                if any(
                    abs(state[key] - before[key]) > mpf("1e-6") * (1 + abs(before[key]))
                    for key in before
                    if key[0] in motion.q
                ):
                    return "is off the constraints"
            else:
                return "is not read"
            for key, v in values.items():
                state.setdefault(key, v)
            return self._violates(claim, state, values)
        except Undefined:
            return "is not defined"

    def _violates(self, claim, state, values):
        left, right = self.scene.named(claim.left), self.scene.named(claim.right)
        for w in claim.where:
            if Compiled([self.scene.named(w)]).mp(state)[0] <= 0:
                return "does not obey its assumption"
        if claim.constants:
            zeroed = trees.replaced(
                left - right, lambda n: trees.ZERO if n.op == "name" and n.args[0] in claim.constants else None
            )
            left, right = trees.rate(zeroed, self.scene.motion().q), trees.ZERO
        made = Compiled([left, right, *terms(left), *terms(right)])
        left, right, *summands = made.mp(state)
        size = max([abs(left), abs(right), *[abs(s) for s in summands]])
        return "valid" if abs(left - right) > mpf("1e-9") * size else "holds"

    def _at_rest(self, claim, state):

        if self.scene.constraints:
            return "is not read"
        flat = {**state, **{(q, 1): mpf(0) for q in self.scene.coordinates}}
        forces = Compiled(rest.forces(self.scene)).mp(flat)
        if max(abs(f) for f in forces) > mpf("1e-9"):
            return "is no state of rest"
        return self._violates(claim, flat, {})


# -- printed equations


def derived(program, scene, seed, by=None):
    """(findings, refused, how many equations): what `derive` prints at states of every cell."""
    code, answer, message = program.ask(scene.text(), "derive", *(["--by", by] if by else []))
    if code != 0 or answer is None:
        return [], None if by and code == 3 else (code, message), 0
    truth = Truth(scene, seed)
    texts = {d["name"]: d["text"] for d in answer.get("definitions", ())}

    def named(word):
        return read(texts[word], named) if word in texts else known(scene, word)

    findings = []
    try:
        conditions = [c for w in answer.get("where") or [] for c in read_conditions(w, named)]
        equations = [read_equation(e["text"], named) for e in answer["equations"]]
    except NotRead as no:
        return [], None if by else (0, f"not read: {no}"), 0
    said = (f" by {by}" if by else "") + (" where " + ", ".join(answer["where"]) if answer.get("where") else "")
    for (left, right), e in zip(equations, answer["equations"]):
        claim = Claim(left, right, text=e["text"])
        found = truth.holds_where(claim, conditions)
        if found.kind == FAILS:
            findings.append(Finding(PRINTED, claim, f"printed{said}; it fails" + Examined._at(found, claim), scene))
    if not findings and not _determine(scene, truth, equations):
        findings.append(
            Finding(
                PRINTED,
                None,
                "the equations do not determine the accelerations: " + "; ".join(e["text"] for e in answer["equations"]),
                scene,
            )
        )
    for f in findings:
        f.by = by
    return findings, None, len(equations)


def _determine(scene, truth, equations):
    """Whether the equations leave no acceleration or multiplier free, at one state."""
    named = {n for left, right in equations for side in (left, right) for n, _ in used(side)}
    multipliers = ["lambda_" + c.label for c in scene.constraints if "lambda_" + c.label in named]
    unknowns = [(q, 2) for q in scene.coordinates] + [(label, 0) for label in multipliers]
    rows = [trees.derivative(scene.named(left - right), u) for left, right in equations for u in unknowns]
    motion = scene.motion()
    moved = [r for r, h in zip(motion.rows, motion.holds)]
    try:
        for at in range(0, truth.count, max(1, truth.count // 10)):
            state = motion.polish({k: v[at] for k, v in truth.states.items()})
            flat = Compiled(rows).mp(state)
            held = Compiled([e for row in moved for e in row]).mp(state) if moved else []
            matrix = [flat[i : i + len(unknowns)] for i in range(0, len(flat), len(unknowns))]
            n = len(scene.coordinates)
            matrix += [held[i * n : (i + 1) * n] + [mpf(0)] * len(multipliers) for i in range(len(moved))]
            if _rank(matrix) >= len(unknowns):
                return True
    except Undefined:
        return True
    return False


def _rank(rows):
    rows, rank = [list(r) for r in rows], 0
    for column in range(len(rows[0]) if rows else 0):
        best = max(range(rank, len(rows)), key=lambda i: abs(rows[i][column]), default=None)
        if best is None or abs(rows[best][column]) < mpf("1e-20"):
            continue
        rows[rank], rows[best] = rows[best], rows[rank]
        for i in range(rank + 1, len(rows)):
            factor = rows[i][column] / rows[rank][column]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[rank])]
        rank += 1
        if rank == len(rows):
            break
    return rank
