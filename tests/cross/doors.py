# SPDX-License-Identifier: MIT
"""One number by every way out of the program: its verbs, machine code, compiled C++ and C, units, Python."""

import json
import os
import resource
import subprocess

from units import Unit, UnitFailed  # noqa: F401


class Refused(Exception):
    """The program said no: exit code and message."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


class Door:
    """The program on one scene in a folder of its own."""

    def __init__(self, program, folder, text, patience=60):  # seconds of processor time
        self.program, self.folder, self.patience = program, folder, patience
        os.makedirs(folder, exist_ok=True)
        self.scene = os.path.join(folder, "scene.toml")
        with open(self.scene, "w", encoding="utf-8") as file:
            file.write(text)

    def run(self, *words):
        """Standard output; throws Refused with what it says. A crash or an endless run is a failure of its own (code < 0)."""
        limit = (self.patience, self.patience + 1)
        done = subprocess.run(words, capture_output=True, check=False, text=True, env={**os.environ, "LC_ALL": "C.UTF-8"},
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, limit))
        if done.returncode < 0:
            raise Refused(done.returncode, f"ended by signal {-done.returncode}; of processor time it had {self.patience} s")
        if done.returncode not in (0, 1, 2) or not done.stdout and done.returncode:
            raise Refused(done.returncode, done.stderr.strip()[:500])
        return done.stdout

    def ask(self, verb, *options):
        return json.loads(self.run(self.program, verb, self.scene, *options, "--json"))

    def at(self, state):
        """Options of a state {name or name': value}."""
        return [word for name, value in state.items() for word in ("--at", f"{name}={float(value)!r}")]

    # -- right-hand sides

    def compiled(self, language, states, *options):
        """The rates of states by the emitted file as its head says how to call it; t is 0."""
        out = os.path.join(self.folder, language)
        self.run(self.program, "emit", self.scene, "-o", out, "--language", language, *options)
        size = len(states[0])
        rows = ", ".join("{" + ", ".join(repr(float(x)) for x in state) + "}" for state in states)
        if language == "c":
            source = f'''#include <stdio.h>
#include "scene.h"
static const double states[][{size}] = {{{rows}}};
int main(void) {{
    double par[scene_par + 1], rate[scene_state];
    scene_defaults(par);
    for (int k = 0; k < {len(states)}; ++k) {{
        scene_rhs(0, states[k], par, rate);
        for (int i = 0; i < {size}; ++i) printf("%.17g\\n", rate[i]);
    }}
    return 0;
}}
'''
            command = ["cc", "-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", "main.c", "scene.c", "-lm", "-o", "main"]
        else:
            with open(os.path.join(out, "scene.cpp"), encoding="utf-8") as file:
                prepare = "prepare(par);" if "void prepare(Real* par)" in file.read() else ""
            source = f'''#include <cstdio>
#include "scene.cpp"
static const double states[][{size}] = {{{rows}}};
int main() {{
    double par[512] = {{}}, rate[{size}];
    for (unsigned k = 0; k < sizeof(parameter_values)/sizeof(parameter_values[0]); ++k) par[k] = parameter_values[k];
    {prepare}
    for (const auto& state : states) {{
        rhs(0.0, state, par, rate);
        for (double value : rate) std::printf("%.17g\\n", value);
    }}
}}
'''
            command = ["c++", "-std=c++20", "-O1", "main.cpp", "-o", "main"]
        with open(os.path.join(out, "main." + language), "w", encoding="utf-8") as file:
            file.write(source)
        self.run("env", "-C", out, *command)
        values = [float(line) for line in self.run(os.path.join(out, "main")).split()]
        return [values[k * size:(k + 1) * size] for k in range(len(states))]

    def in_floats(self, states):
        """The same in C, whose numbers are floats."""
        out = os.path.join(self.folder, "c")  # `compiled` has written there
        command = ["cc", "-std=c99", "-O1", "-DALEMBERT_REAL=float"]
        with open(os.path.join(out, "main.c"), encoding="utf-8") as file:
            source = file.read().replace("static const double states", "static const float states").replace("double par[", "float par[")
        with open(os.path.join(out, "floats.c"), "w", encoding="utf-8") as file:
            file.write(source)
        self.run("env", "-C", out, *command, "floats.c", "scene.c", "-lm", "-o", "floats")
        size, values = len(states[0]), [float(line) for line in self.run(os.path.join(out, "floats")).split()]
        return [values[k * size:(k + 1) * size] for k in range(len(states))]

    def two_systems(self, states):
        """The rates by headers, in a program with two systems: this one and the same with its parameters as constants. Twice as many rows."""
        out = os.path.join(self.folder, "two")
        self.run(self.program, "emit", self.scene, "-o", out)
        self.run(self.program, "emit", self.scene, "-o", out, "--name", "other", "--fold")
        size = len(states[0])
        rows = ", ".join("{" + ", ".join(repr(float(x)) for x in state) + "}" for state in states)
        with open(os.path.join(out, "main.cpp"), "w", encoding="utf-8") as file:
            file.write(f'''#include <cstdio>
#include "other.hpp"
#include "scene.hpp"
static const double states[][{size}] = {{{rows}}};
template <typename State> void print(const State& rate) {{
    for (int i = 0; i < {size}; ++i) std::printf("%.17g\\n", reinterpret_cast<const double*>(&rate)[i]);
}}
int main() {{
    for (const auto& state : states) {{
        scene::State one;
        other::State two;
        for (int i = 0; i < {size}; ++i) scene::numbers(one)[i] = other::numbers(two)[i] = state[i];
        print(scene::rhs(0, one, scene::defaults()));
        print(other::rhs(0, two, other::defaults()));
    }}
}}
''')
        self.run("env", "-C", out, "c++", "-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror", "main.cpp", "scene.cpp", "other.cpp", "-o", "main")
        values = [float(line) for line in self.run(os.path.join(out, "main")).split()]
        return [values[k * size:(k + 1) * size] for k in range(2 * len(states))]

    def in_node(self, states):
        """By the module of JavaScript."""
        out = os.path.join(self.folder, "js")
        self.run(self.program, "emit", self.scene, "-o", out, "--language", "js")
        with open(os.path.join(out, "main.mjs"), "w", encoding="utf-8") as file:
            file.write('import * as scene from "./scene.mjs";\n'
                       f"for (const state of {json.dumps([[float(x) for x in state] for state in states])}) {{\n"
                       f"  const par = scene.defaults(), rate = new Float64Array({len(states[0])});\n"
                       "  scene.rhs(0, state, par, rate);\n  console.log(JSON.stringify([...rate]));\n}\n")
        return [json.loads(line) for line in self.run("node", os.path.join(out, "main.mjs")).splitlines()]

    def by_system(self, package, python, states):
        """By a System of the Python package; `python` is an interpreter, with one NumPy or another."""
        script = ("import sys, json, alembert\nsystem = alembert.Scene(sys.argv[1]).system()\n"
                  "print(json.dumps(system.rhs(0.0, json.loads(sys.argv[2])).tolist()))")
        words = json.dumps([[float(x) for x in state] for state in states])
        return json.loads(self.run("env", *([f"PYTHONPATH={package}"] if package else []), python, "-W", "ignore", "-c", script, self.scene, words))

    def in_web_assembly(self, folder, *options):
        """`eval` by the program as WebAssembly, which web/build.sh puts into a folder."""
        script = ('const [folder, scene, ...options] = process.argv.slice(1);'
                  'const { readFileSync } = await import("node:fs"), { run } = await import(`${folder}/alembert.mjs`);'
                  'const told = await run(["eval", "scene.toml", ...options, "--json"], { "scene.toml": readFileSync(scene, "utf-8") });'
                  'process.stdout.write(told.stdout); process.stderr.write(told.stderr); process.exitCode = told.code;')
        return json.loads(self.run("node", "--input-type=module", "-e", script, os.path.abspath(folder), self.scene, *options))

    # -- motions: {"state": {name or name': value at the end}, "error": told or None, "events": [(name, time)] or None}

    def simulate(self, *options):
        told = self.ask("simulate", *options)
        estimate = told["error_estimate"]
        return {"state": _end(told["final"]), "events": [(e["name"], e["time"]) for e in told.get("events", [])],
                "error": estimate["value"] if estimate else None, "trusted": bool(estimate and estimate["trustworthy"]),
                "contacts": [(c["name"], c["event"]) for c in told.get("contacts", [])], "method": told["method"]}

    def sweep(self, name, value, *options):
        told = self.ask("sweep", "--vary", f"{name}={value!r}:{value!r}:1", *options)
        row = told["rows"][0]
        if row["status"] != "done":
            raise Refused(4, row["status"])
        return {"state": _end(row["final"])}

    def unit(self, version, coordinates, duration, tolerance, steps, states=()):
        path = os.path.join(self.folder, f"scene{version}.fmu")
        self.run(self.program, "fmu", self.scene, "-o", path, "--fmi", str(version))
        unit = Unit(path, version, tolerance)
        at = 0.0
        for k in range(1, steps + 1):
            to = duration * k / steps
            unit.step(at, to - at)
            at = to
        return {"state": {**{name + dot: unit.get(f"der({name})" if dot else name) for name in coordinates for dot in ("", "'")},
                          **{name: unit.get(name) for name in states}}}

    def exchange(self, version, size):
        """The rates of the start by model exchange."""
        path = os.path.join(self.folder, f"scene{version}.fmu")
        if not os.path.exists(path):
            self.run(self.program, "fmu", self.scene, "-o", path, "--fmi", str(version))
        return Unit(path, version, 1e-9, exchange=True).derivatives(size)

    def standalone(self, coordinates, duration, tolerance, states=()):
        """The C program of the scene."""
        out = os.path.join(self.folder, "standalone")
        self.run(self.program, "emit", self.scene, "-o", out, "--language", "c", "--standalone")
        self.run("env", "-C", out, "cc", "-std=c99", "-O1", "scene_main.c", "scene.c", "-lm", "-o", "main")
        last = self.run(os.path.join(out, "main"), repr(duration), repr(tolerance), "1").strip().splitlines()[-1]
        values = [float(x) for x in last.replace(",", " ").split()][1:]
        return {"state": dict(zip([*coordinates, *(c + "'" for c in coordinates), *states], values))}

    def in_python(self, package, *options):
        """Scene.simulate of the Python package, in a process of its own."""
        script = ("import sys, json, alembert\nscene = alembert.Scene(sys.argv[1])\nrun = scene.simulate()\n"
                  "print(json.dumps([run.columns, list(map(float, run.table[-1]))]))")
        words = self.run("env", f"PYTHONPATH={package}", "/usr/bin/python3", "-W", "ignore", "-c", script, self.scene, *options)
        columns, row = json.loads(words)
        return {"state": {n: v for n, v in zip(columns, row)}}

    def table(self, samples, duration, *options):
        """Rows of a motion as {column: value}."""
        path = os.path.join(self.folder, "rows.csv")
        self.run(self.program, "simulate", self.scene, "--sample", repr(duration / samples), "-o", path, "--json", *options)
        with open(path, encoding="utf-8") as file:
            head, *rows = file.read().splitlines()
        names = head.split(",")
        return [dict(zip(names, map(float, row.split(",")))) for row in rows]


def _end(final):
    return {**final["coordinates"], **{name + "'": value for name, value in final["rates"].items()}, **final.get("states", {})}
