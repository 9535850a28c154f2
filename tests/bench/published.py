#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many published robots does `import` read, and do the scenes move as others say?

    tests/bench/published.py PROGRAM FOLDER [--seconds N] [--list FILE]

FOLDER holds checkouts of repositories with robots; nothing in it is changed. Every file whose outermost element is
<mujoco>, <robot> or <sdf> is imported, and is one of these:

    read      a scene was written
    still     refused, because nothing moves: no joint, or masses by meshes alone
    refused   for another reason: exit code 3 with a message
    crashed   any other end;  hung: no end within N seconds (60 when missing)

Of those that are read, `told` counts those for which something that changes the motion is listed as left out. Scenes are
evaluated at a random state and compared with accelerations by MuJoCo (MJCF), Pinocchio (URDF) and Drake (SDF), if the
Python packages mujoco, pin and drake are installed; contacts, limits, dry friction and clamped forces are switched off
there. `agree` counts accelerations that differ by less than 1e-6 of the largest (MuJoCo turns inertias to principal axes
with about seven digits); `told, differ` those that differ where a change was told, and `wrong` those that differ where
none was told. A file is not compared if the other program refuses it, or if the scene has no unique accelerations.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import zlib

import published_peers as peers

OUTERMOST = re.compile(rb"<(?:\?.*?\?>|!--.*?-->|!DOCTYPE[^>]*>|([A-Za-z_]\w*))", re.S)
# What the other programs are told to leave out too.
SWITCHED_OFF = ("limits of", "Coulomb friction", "ctrlrange", "forcerange", "frcrange", "effort", "velocity")


def kind_of(path):
    for match in OUTERMOST.finditer(path.read_bytes()[:200000]):
        if match[1]:
            return {b"mujoco": "MJCF", b"robot": "URDF", b"sdf": "SDF"}.get(match[1])
    return None


def run(command, seconds):
    done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, errors="replace", check=False)
    return done.returncode, done.stdout, done.stderr


def compared(program, kind, path, scene, told, seconds):
    """'agree', 'differ' with the difference, or the reason why nothing was compared."""
    state = peers.states[kind](path, told, random.Random(zlib.crc32(path.name.encode())))
    if isinstance(state, str):
        return state, ""
    at, expected, inputs = state
    text = scene.read_text()
    for name, value in inputs.items():
        text = re.sub(rf"(?m)^{re.escape(name)} = 0$", f"{name} = {value!r}", text)
    scene.write_text(text)
    command = [program, "eval", str(scene), "--json"]
    for name, value in at.items():
        command += ["--at", f"{name}={value!r}"]
    try:
        code, out, err = run(command, seconds)
    except subprocess.TimeoutExpired:
        return "eval takes long", ""
    if code != 0:
        return "not evaluated", err.strip().split("\n")[-1][:200]
    found = json.loads(out)["accelerations"]
    size = max([1] + [abs(a) for a in expected.values()])
    worst = max((abs(found[name] - a) / size, name) for name, a in expected.items())
    return ("agree", "") if worst[0] < 1e-6 else ("differ", f"{worst[0]:.2g} of {size:.3g} in {worst[1]}")


def judged(program, path, kind, seconds):
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.toml"
        command = [program, "import", str(path), "-o", str(scene), "--quaternion", "--json"]
        if kind == "MJCF":
            command.append("--drives")
        try:
            code, out, err = run(command, seconds)
        except subprocess.TimeoutExpired:
            return kind, "hung", "", ""
        if code != 0:
            why = err.strip().split("\n")[-1]
            still = "no joint that moves a mass" in why or "no link of this robot has a mass" in why
            return kind, "crashed" if code != 3 or not why else "still" if still else "refused", "", why
        told = json.loads(out)
        changes = sorted(what for what in told.get("changes_motion", {})
                         if not any(word in what for word in SWITCHED_OFF))
        try:
            verdict, about = compared(program, kind, path, scene, told, seconds)
        except Exception as problem:  # of the other program
            verdict, about = "not compared", f"{type(problem).__name__}: {problem}"[:200]
        return kind, "read", ("told, " if changes else "") + verdict, "; ".join(filter(None, [about, *changes]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--list", type=pathlib.Path, help="a line for each file is written here")
    given = parser.parse_args()
    files = [(path, kind) for path in sorted(given.folder.rglob("*"))
             if path.suffix in (".xml", ".urdf", ".sdf", ".world", ".mjcf") and path.is_file() and (kind := kind_of(path))]
    lines, counts = [], collections.defaultdict(collections.Counter)
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        waiting = [pool.submit(judged, given.program, path, kind, given.seconds) for path, kind in files]
        for (path, kind), one in zip(files, waiting):
            _, state, verdict, about = one.result()
            fields = [kind, state, verdict, str(path.relative_to(given.folder)), about]
            lines.append("\t".join(" ".join(field.split()) for field in fields))
            count = counts[kind]
            count["files"] += 1
            count[state] += 1
            if state == "read":
                count["told"] += verdict.startswith("told")
                name = verdict.removeprefix("told, ")
                count["wrong" if verdict == "differ" else verdict if verdict == "told, differ" else
                      "agree" if name == "agree" else "not compared"] += 1
    if given.list:
        given.list.write_text("\n".join(lines) + "\n")
    columns = ["files", "read", "still", "refused", "crashed", "hung", "told", "agree", "told, differ", "wrong", "not compared"]
    print("| | " + " | ".join(columns) + " |\n| --- |" + " ---: |" * len(columns))
    for kind in ("MJCF", "URDF", "SDF"):
        if kind in counts:
            print(f"| {kind} | " + " | ".join(str(counts[kind][c]) for c in columns) + " |")
    return 1 if any(c["crashed"] + c["hung"] + c["wrong"] for c in counts.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
