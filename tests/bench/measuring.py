# SPDX-License-Identifier: MIT
"""What measurements have in common: the program and the file that they are asked for, and the processor that they tell.

    parser = options("strongest.sh", root)           # [--json FILE] [PROGRAM]
    parser.add_argument("--rounds", type=int, default=2)
    wishes = read(parser, sys.argv[2:])              # wishes.program is there
    model, flags = processor()
    keep(rows, wishes.json)                          # if it was asked for

PROGRAM may be the folder of a build, too.
"""
import argparse
import json
import os
import sys


def options(name, root):
    parser = argparse.ArgumentParser(prog=name)
    parser.add_argument("program", nargs="?", default=os.path.join(root, "build/release"))
    parser.add_argument("--json")
    return parser


def read(parser, words):
    wishes = parser.parse_args(words)
    if os.path.isdir(wishes.program):
        wishes.program = os.path.join(wishes.program, "generator/alembert")
    if not os.path.exists(wishes.program):
        sys.exit(f"there is no {wishes.program}: build it first")
    return wishes


def processor():
    """The name of the processor, and which of the registers that we use it has."""
    listed = {}
    for line in open("/proc/cpuinfo"):
        key, _, value = line.partition(":")
        listed.setdefault(key.strip(), value.strip())
    flags = set(listed.get("flags", "").split())
    return listed.get("model name", "?"), [flag for flag in ("sse2", "avx", "avx2", "fma", "avx512f") if flag in flags]


def keep(rows, path):
    if path:
        json.dump(rows, open(path, "w"), indent=1)
