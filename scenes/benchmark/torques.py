#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints a scene whose generalized forces are numbers with parameters tau1, tau2 … in their place.

    python3 scenes/benchmark/torques.py scenes/benchmark/trees/arm7.toml > arm7.toml
"""
import sys

head, forces = open(sys.argv[1], encoding="utf-8").read().split("[forces]\n")
rows = [line.split(" = ") for line in forces.splitlines() if line.strip()]
print(head + "[parameters]")
for k, (_, value) in enumerate(rows, 1):
    print(f"tau{k} = {value}")
print("\n[forces]")
for k, (name, _) in enumerate(rows, 1):
    print(f'{name} = "tau{k}"')
