# SPDX-License-Identifier: MIT
"""Cross-examination: random valid scenes, and one number of each by all ways that there are.

    tests/cross.sh                        the scenes of the tests
    tests/cross.sh --seconds 3600 --seed 7
    tests/cross.sh --scene FILE.json      one scene that was kept

What is compared, for each scene:
  state    accelerations at the initial state and at random ones: 60 digits (reference.py) with every formalism, emitted
           C++ and C, the units in model exchange
  motion   the end of the motion: methods, a longest step, compiled code, sweep, units in co-simulation, the C program,
           Python; each within the errors told. Events: by all of these, and counted again from rows of a table
  claims   right and wrong ones: verdicts with an evaluation in 60 digits near the scene's own state
A difference is a failure. It is kept in build/cross as the smallest scene found that still shows it.
"""

import argparse
import collections
import copy
import json
import math
import multiprocessing
import os
import random
import re
import shutil
import sys
import time

import claims
import doors
import scenes
from doors import Refused
from expressions import NotRead
from reference import Reference, coordinate_names, on_constraints

MOST_OVER = 4  # an error told is no bound, but a difference of two runs: docs/accuracy.md counts how often it is exceeded

FLOAT = 2.0**29  # how much coarser floats are than doubles

FORMALISMS = ["lagrange", "lagrange1", "routh", "kane", "dalembert", "appell", "maggi", "nielsen", "hamilton", "routhian",
              "schiehlen", "roberson-wittenburg", "recursive"]


class Failure(Exception):
    """kind: the way that differs."""

    def __init__(self, kind, text):
        super().__init__(text)
        self.kind = kind

    def is_like(self, other):
        """Whether both differ in the same way, or are refused with the same words: a smaller scene may be wrong in itself."""
        return self.kind == other.kind and self._refusal() == other._refusal()

    def _refusal(self):
        text = str(self)
        return re.sub(r"[0-9.]+", "", text)[:150] if "ends with" in text else ""


class Examination:
    """One scene; `counts` tells how many comparisons were made by each way."""

    def __init__(self, options, scene, seed, counts):
        self.options, self.scene, self.seed, self.counts = options, scene, seed, counts
        self.rng = random.Random(seed * 7919 + 1)
        self.q = coordinate_names(scene)
        self.z = list(scene.get("states", {}))
        folder = os.path.join(options.folder, f"work-{os.getpid()}")
        shutil.rmtree(folder, ignore_errors=True)
        self.door = doors.Door(options.program, folder, scenes.text(scene))

    def all(self):
        self.start = self._ask("eval", "eval")
        self.state = {**self.start["coordinates"], **{n + "'": v for n, v in self.start["rates"].items()},
                      **self.start.get("states", {})}
        for part in (self.states, self.motions, self.claims):
            if part.__name__ in self.options.only:
                part()

    def _ask(self, kind, *words):
        try:
            return self.door.ask(*words)
        except Refused as no:
            raise Failure(kind, f"{' '.join(words)} ends with {no.code}: {no}") from None

    def _count(self, way):
        self.counts[way] += 1

    # -- accelerations at a state

    def states(self):
        at = [self.state]
        if not self.scene.get("constraint") and not self.start.get("residuals") and not self.scene.get("friction"):
            at += [{name: value + self.rng.choice([1e-6, 0.1]) * self.rng.uniform(-1, 1) for name, value in self.state.items()}]
        expected = []
        for k, state in enumerate(at):
            try:
                right = Reference(self.scene, state)
                values = right.solve()
                expected.append((state, values, self._uncertainty(state, values)))
            except NotRead:
                if k == 0:
                    return
        self._formalisms(expected)
        if self.options.web and self.rng.random() < 0.3:
            self._in_web_assembly(*expected[0])
        if self.options.compile(self.rng):
            self._emitted(expected)
        if self.rng.random() < 0.3 and not self.scene.get("unilateral") and not self.scene.get("friction"):
            self._exchange(expected[0])

    def _uncertainty(self, state, values):
        """What the rounding of the state and of a few hundred operations may change, by a second state beside it."""
        beside = {name: value * (1 + self.rng.choice([-1, 1]) * 3e-16) for name, value in state.items()}
        moved = Reference(self.scene, beside)
        change = max(abs(float(x - values[name])) for name, x in moved.solve().items())
        lengths = sum(float(moved.of(s["stiffness"]).value * abs(moved.of(s.get("length", 0)).value))
                      for s in self.scene.get("spring", []))  # a stretch is the difference of two
        return 100 * change + 1e-12 * max(1, max(abs(float(v)) for v in values.values())) + 1e-15 * lengths

    def _compare(self, way, values, expected, allowed):
        self._count(way)
        for name, value in values.items():
            if not abs(value - float(expected[name])) <= allowed:
                raise Failure(way, f"{name}'' is {value!r}; 60 digits give {float(expected[name])!r} (allowed: {allowed:.1e})")

    def _formalisms(self, expected):
        for state, values, allowed in expected:
            at = self.door.at(state) if state is not self.state else []
            for formalism in [None] + self.rng.sample(FORMALISMS, 4):
                way = f"eval --by {formalism}" if formalism else "eval"
                try:
                    told = self.door.ask("eval", *at, *(["--by", formalism] if formalism else []))
                except Refused as no:
                    if no.code == 3 and formalism and not "error" in str(no)[:8]:
                        continue
                    raise Failure(way, f"ends with {no.code}: {no}") from None
                self._compare(way, {**told["accelerations"], **told.get("state_rates", {})}, values, allowed)

    def _in_web_assembly(self, _, values, allowed):
        try:
            told = self.door.in_web_assembly(self.options.web)
        except Refused as no:
            raise Failure("WebAssembly", f"ends with {no.code}: {no}") from None
        self._compare("WebAssembly", told["accelerations"], values, allowed)

    def _rates(self, state, values):
        """State of the emitted functions: (q, q', z)."""
        if "speeds" in self.scene:
            return None
        return [state[q] for q in self.q] + [state[q + "'"] for q in self.q] + [state[z] for z in self.z]

    def _emitted(self, expected):
        if "speeds" in self.scene or self.scene.get("unilateral") or self.scene.get("friction"):
            return
        rows = [self._rates(state, values) for state, values, _ in expected]
        for language, options in (("c", []), ("cpp", self.rng.choice([[], ["--fold"]]))):
            way = " ".join(["emit", language, *options])
            try:
                results = self.door.compiled(language, rows, *options)
            except Refused as no:
                raise Failure(way, f"ends with {no.code}: {no}") from None
            self._rows(way, results, expected)
        self._by_other_ways(rows, expected)

    def _rows(self, way, results, expected, more=1.0):
        """Rates row by row; `more` is how much coarser the numbers are than doubles."""
        for (_, values, allowed), result in zip(expected, results):
            self._compare(way, dict(zip(self.q + self.z, result[len(self.q):])), values, more * allowed)

    def _by_other_ways(self, rows, expected):
        """Floats, headers of two systems in one program, JavaScript, Systems of Python."""
        ways = [("emit c, floats", lambda: self.door.in_floats(rows)), ("two systems by headers", lambda: self.door.two_systems(rows))]
        if shutil.which("node"):
            ways.append(("emit js", lambda: self.door.in_node(rows)))
        for python in self.options.python if self.options.package else []:
            ways.append((f"System, {python}", lambda python=python: self.door.by_system(self.options.package, python, rows)))
        for way, run in ways:
            try:
                results = run()
            except Refused as no:
                raise Failure(way, f"ends with {no.code}: {no}") from None
            if way.startswith("two"):
                self._rows(way, results[::2], expected)
                self._rows(way, results[1::2], expected)
            else:
                self._rows(way, results, expected, FLOAT if "floats" in way else 1)

    def _exchange(self, expected):
        _, values, allowed = expected
        if "speeds" in self.scene:  # events are refused by such units, which `motions` counts
            return
        version = self.rng.choice([2, 3])
        way = f"model exchange {version}"
        try:
            result = self.door.exchange(version, 2 * len(self.q) + len(self.z))
        except (Refused, doors.UnitFailed) as no:
            raise Failure(way, str(no)) from None
        self._compare(way, dict(zip(self.q + self.z, result[len(self.q):])), values, allowed)

    # -- motions

    def _has_modes(self):
        return any(key in e for e in self.scene.get("event", []) for key in ("set", "rates", "count"))

    def motions(self):
        duration, tolerance = self.scene["simulation"]["duration"], self.scene["simulation"]["tolerance"]
        kicks = self._has_modes() or any("impulses" in e for e in self.scene.get("event", []))
        pieces = kicks or self.scene.get("unilateral") or self.scene.get("friction")
        try:
            best = self.door.simulate("--tolerance", "1e-13", "--max-step", repr(duration / 300), "--method", "verner98")
        except Refused as no:
            if no.code == 4:
                self._count("motion ends early")
                return
            raise Failure("simulate", f"ends with {no.code}: {no}") from None
        methods = ["dop853", "dopri5" if "tables" in self.scene else "taylor", "radau", "verner98", "dopri5", "verner76", "bdf"]
        ways = [("simulate", self.door.simulate), ("--method", lambda: self.door.simulate("--method", self.rng.choice(methods)))]
        ways += [("--max-step", lambda: self.door.simulate("--max-step", repr(duration / self.rng.choice([10, 60]))))]
        ways += [("sweep", self._sweep)]
        if self.options.compile(self.rng):
            ways += [("--code compiled", lambda: self.door.simulate("--code", "compiled"))]
        if not self.scene.get("friction") and self.options.compile(self.rng):
            version, steps = self.rng.choice([2, 3]), self.rng.choice([1, 7, 40])
            ways += [(f"fmu {version}", lambda: self.door.unit(version, self.q, duration, tolerance, steps, self.z))]
            if not pieces and "speeds" not in self.scene and not scenes.has_close_knots(self.scene):
                ways += [("standalone C", lambda: self.door.standalone(self.q, duration, tolerance, self.z))]
        if self.options.package and self.rng.random() < 0.3:
            ways += [("Python", lambda: self.door.in_python(self.options.package))]
        loose = None
        for way, run in ways:
            try:
                told = run()
            except Refused as no:
                if no.code == 3 and way.startswith(("fmu", "standalone")):  # what these do not take, with its reason
                    self._count(f"{way} refused")
                    continue
                if no.code != 4:
                    raise Failure(way, f"ends with {no.code}: {no}") from None
                self._count(f"{way} ends early")
                continue
            except doors.UnitFailed as no:
                raise Failure(way, str(no)) from None
            if "error" in told:
                loose = told
            self._held(way, told, best, loose, tolerance)
        if self.scene.get("event"):
            self._recount(best, duration)

    def _sweep(self):
        free = [q for q, e in self.scene["coordinates"].items() if "initial" in e] if "coordinates" in self.scene else []
        if free:
            return self.door.sweep(free[0], self.scene["coordinates"][free[0]]["initial"])
        return self.door.sweep("t", 0)

    def _held(self, way, told, best, loose, tolerance):
        """The end of a motion against the best one, within the errors that were told."""
        if best["error"] is None or not best["trusted"]:
            self._count("motion not trusted")
            return
        if "error" in told:
            if told["error"] is None or not told["trusted"]:
                self._count("motion not trusted")
                return
            allowed = told["error"]
        else:  # no error is told: that of the run in simulate, and of a method of order 5 with this tolerance
            allowed = 300 * max(tolerance, loose["error"] if loose and loose["error"] else 0)
        allowed += best["error"] + 1e-14
        self._count(way)
        worst = max(abs(told["state"][name] - value) / max(1, abs(value)) for name, value in best["state"].items())
        if allowed < worst <= MOST_OVER * allowed:
            self._count(f"errors told that were exceeded, at most {MOST_OVER} times")
            return
        for name, value in best["state"].items():
            if not abs(told["state"][name] - value) <= MOST_OVER * allowed * max(1, abs(value)):
                raise Failure(way, f"{name} is {told['state'][name]!r} at the end, for {value!r} in short steps; the errors told "
                              f"are together {allowed:.1e}; events {_numbers(told)} for {_numbers(best)}")
        if "events" in told and len(told["events"]) != len(best["events"]):
            latest = self.scene["simulation"]["duration"]
            if not any(abs(t - latest) < 1e-3 for _, t in told["events"] + best["events"]):
                raise Failure(way, f"events {_numbers(told)} for {_numbers(best)} in short steps")

    def _recount(self, best, duration):
        """Changes of sign of each event's expression from row to row, in numbers of our own."""
        if not best["trusted"]:
            return
        try:
            rows = self.door.table(1500, duration, "--tolerance", "1e-12")
        except Refused as no:
            raise Failure("events counted again", f"ends with {no.code}: {no}") from None
        for event in self.scene["event"]:
            if event.get("direction", "both") != "both":
                continue
            values = [plain(event["when"], {**row, **self._parameters()}) for row in rows]
            seen = sum(1 for a, b in zip(values, values[1:]) if a * b < 0)
            told = sum(1 for name, _ in best["events"] if name == event["name"])
            self._count("events counted again")
            if told < seen:
                raise Failure("events counted again", f"{told} events {event['name']!r} for {seen} changes of sign in 1500 rows")

    def _parameters(self):
        return {n: e["value"] if isinstance(e, dict) else e for n, e in self.scene.get("parameters", {}).items()}

    # -- claims

    def claims(self):
        if self.scene.get("unilateral") or self.scene.get("friction"):
            return
        told = self._ask("derive", "derive")
        if told.get("definitions"):
            return
        try:
            truth = claims.Truth(self.scene, self.state, self.seed)
        except NotRead:
            return
        equations = [e["text"] for e in told["equations"] if len(e["text"]) < 1500]
        if not equations:
            return
        names = self.q + list(self.scene.get("parameters", {}))
        listed = []
        for _ in range(6):
            claim = claims.right(self.rng, equations, self.q)
            listed.append(claim)
            listed.append(claims.wrong(self.rng, claim, names, self.q))
        held = []
        for claim in listed:
            try:
                if claim:
                    held.append((claim, truth.holds(claim)))
            except (NotRead, KeyError, ZeroDivisionError, ValueError, TypeError):
                pass
        if not held:
            return
        path = os.path.join(self.door.folder, "claims.txt")
        with open(path, "w", encoding="utf-8") as file:
            file.writelines(claim + "\n" for claim, _ in held)
        verdicts = self._ask("check", "check", path)["claims"]
        for (claim, holds), told in zip(held, verdicts):
            self._count(f"claims {told['verdict']}")
            if told["verdict"] == "proved" and not holds or told["verdict"] == "refuted" and holds:
                raise Failure("check", f"{told['verdict']}: {claim}\n    which is {'true' if holds else 'false'} in 60 digits")


def _numbers(told):
    return len(told["events"]) if "events" in told else "-"


def plain(text, names):
    """An expression in doubles."""
    words = {name.replace("'", "__d"): value for name, value in names.items()}
    words.update({f: getattr(math, f) for f in ("sin", "cos", "exp", "sqrt", "tan", "cosh")}, abs=abs)
    return eval(text.replace("'", "__d").replace("^", "**"), {"__builtins__": {}}, words)


# -- the smallest scene


def smaller(scene):
    """Scenes with one thing less."""
    for key, table in scene.items():
        if key in ("simulation", "coordinates", "body", "joint", "frame"):
            continue
        if isinstance(table, list) and table and isinstance(table[0], dict):
            for k in range(len(table)):
                less = copy.deepcopy(scene)
                del less[key][k]
                yield less
        elif isinstance(table, dict) and key != "parameters":
            for name in table:
                less = copy.deepcopy(scene)
                del less[key][name]
                if not less[key]:
                    del less[key]
                yield less
        elif key == "gravity":
            yield {k: copy.deepcopy(v) for k, v in scene.items() if k != key}
    for name in scene.get("parameters", {}):
        less = copy.deepcopy(scene)
        del less["parameters"][name]
        yield less


def smallest(options, scene, seed, failure, until):
    """The scene without what the failure does not need."""
    shrunk = True
    while shrunk and time.monotonic() < until:
        shrunk = False
        for less in smaller(scene):
            if time.monotonic() > until:
                break
            found = examined(options, less, seed, collections.Counter())
            if found is not None and found.is_like(failure) and "ends with 3" not in str(found):
                scene, failure, shrunk = less, found, True
                break
    return scene, failure


def examined(options, scene, seed, counts):
    """The failure, or None."""
    try:
        Examination(options, scene, seed, counts).all()
    except Failure as failure:
        return failure
    return None


def keep(options, kind, scene, seed, failure):
    path = os.path.join(options.folder, f"{seed}")
    with open(path + ".toml", "w", encoding="utf-8") as file:
        file.write(f"# {failure.kind}: " + str(failure).replace("\n", "\n# ") + "\n" + scenes.text(scene))
    with open(path + ".json", "w", encoding="utf-8") as file:
        json.dump({"seed": seed, "scene": scene}, file, ensure_ascii=False)
    print(f"seed {seed}, {kind}: {failure.kind}: {failure}\n    kept: {path}.toml, {path}.json", flush=True)


def parsed():
    parser = argparse.ArgumentParser(description="random scenes, and one number of each by all ways out of the program")
    parser.add_argument("--program", required=True)
    parser.add_argument("--package", help="folder of the Python package")
    parser.add_argument("--python", action="append", help="an interpreter, for its NumPy; may be repeated; default: /usr/bin/python3")
    parser.add_argument("--web", help="folder of the program as WebAssembly (web/build.sh); default: build/web, where there is one")
    parser.add_argument("--folder", default="build/cross")
    parser.add_argument("--seed", type=int, default=1, help="the first")
    parser.add_argument("--scenes", type=int, help="how many; otherwise as many as --seconds allow")
    parser.add_argument("--seconds", type=float, default=120)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes that share the scenes")
    parser.add_argument("--scene", help="one that was kept (.json)")
    parser.add_argument("--only", default="states,motions,claims")
    parser.add_argument("--compiled", type=float, default=0.15, help="share of scenes that are also compiled")
    parser.add_argument("--shrink", type=float, default=30, help="seconds for the smallest scene of a failure")
    options = parser.parse_args()
    options.only = options.only.split(",")
    options.python = options.python or ["/usr/bin/python3"]
    if options.web is None and os.path.exists("build/web/alembert.wasm") and shutil.which("node"):
        options.web = "build/web"
    options.compile = lambda rng: rng.random() < options.compiled
    os.makedirs(options.folder, exist_ok=True)
    return options


def main():
    options = parsed()
    counts, failures, begun = collections.Counter(), 0, time.monotonic()
    if options.scene:
        with open(options.scene, encoding="utf-8") as file:
            kept = json.load(file)
        failure = examined(options, kept["scene"], kept["seed"], counts)
        print(f"{failure.kind}: {failure}" if failure else "no difference")
        return 1 if failure else 0
    fork = multiprocessing.get_context("fork")
    queue = fork.SimpleQueue()
    jobs = [fork.Process(target=share, args=(options, first, queue)) for first in range(options.jobs)]
    for job in jobs:
        job.start()
    done, broken = 0, 0
    for job in jobs:
        job.join()
        broken += job.exitcode != 0
    while not queue.empty():
        share_counts, share_failures, share_done = queue.get()
        counts, failures, done = counts + share_counts, failures + share_failures, done + share_done
    for name, count in sorted(counts.items()):
        print(f"{count:6} {name}")
    print(f"{done} scenes, {failures} failures, {time.monotonic() - begun:.0f} s")
    if broken:
        print(f"{broken} of {options.jobs} processes ended with an error of their own")
    return 1 if failures or broken else 0


def share(options, first, queue):
    """The scenes first, first + jobs, ... of those that are asked for."""
    counts, failures, done, begun = collections.Counter(), 0, 0, time.monotonic()
    place = first
    while place < options.scenes if options.scenes else time.monotonic() - begun < options.seconds:
        seed = options.seed + place
        place += options.jobs
        kind, scene = scenes.make(seed)
        failure = examined(options, scene, seed, counts)
        done += 1
        counts[f"scenes of {kind}"] += 1
        if failure:
            failures += 1
            keep(options, kind, *_small(options, scene, seed, failure))
    shutil.rmtree(os.path.join(options.folder, f"work-{os.getpid()}"), ignore_errors=True)
    queue.put((counts, failures, done))


def _small(options, scene, seed, failure):
    scene, failure = smallest(options, scene, seed, failure, time.monotonic() + options.shrink)
    return scene, seed, failure


if __name__ == "__main__":
    sys.exit(main())
