# SPDX-License-Identifier: MIT
"""others.py PROGRAM FOLDER SCENE...: emitted Python in JAX, emitted Modelica in pymoca and rumoca. See others.sh."""

import csv
import importlib
import os
import subprocess
import sys

import jax
import numpy
import pymoca.parser
import rumoca

jax.config.update("jax_enable_x64", True)
program, folder, *scenes = sys.argv[1:]
sys.path.insert(0, folder)
is_good = True


def tell(what, off, allowed):
    global is_good
    is_good = is_good and off <= allowed
    print(f"{what}: off by {off:.1e}" + ("" if off <= allowed else f", more than {allowed:.0e}"))


def run(*words):
    subprocess.run([program, *words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def off(a, b):
    return float(numpy.max(numpy.abs(numpy.asarray(a) - numpy.asarray(b)), initial=0)) / (1 + float(numpy.max(numpy.abs(a), initial=0)))


def traced(name):
    """Under jit, vmap and derivatives what NumPy gives, and what the emitted Jacobian gives."""
    module = importlib.import_module(name)
    random = numpy.random.default_rng(74)
    state = numpy.array(module.initial_state) + 0.1 * random.normal(size=(100, len(module.initial_state)))
    par = module.defaults()
    rates = module.rhs(0.3, state.T, par).T
    tell(f"{name}, 100 states at once and one by one", off(rates, [module.rhs(0.3, x, par) for x in state]), 1e-13)
    tell(f"{name}, vmap of jit", off(rates, jax.vmap(jax.jit(module.rhs), (None, 0, None))(0.3, state, par)), 1e-12)
    derivatives = jax.vmap(jax.jacfwd(module.rhs, 1), (None, 0, None))(0.3, state, par)
    size, entries = state.shape[1], numpy.zeros((len(state), state.shape[1] + 1, state.shape[1]))
    for k, x in enumerate(state):
        entries[k, module.rows, module.columns] = module.jacobian(0.3, x, par)
    tell(f"{name}, derivatives by JAX and emitted", off(entries[:, :size], derivatives), 1e-10)


def simulated(name, scene):
    """The end of a second of motion, in both programs."""
    text = open(os.path.join(folder, name + ".mo"), encoding="utf-8").read()
    tree = pymoca.parser.parse(text)
    assert "Motion" in tree.classes[name].classes, name
    run("simulate", scene, "--duration", "1", "-o", os.path.join(folder, "run.csv"))
    rows = list(csv.reader(open(os.path.join(folder, "run.csv"), encoding="utf-8")))
    begin, end = float(rows[1][0]), float(rows[-1][0])
    model = rumoca.Session().load(os.path.join(folder, name + ".mo"), model=name + ".Motion")
    data = model.simulate((begin, end), dt=end - begin, config=rumoca.SimConfig(rtol=1e-11, atol=1e-12)).to_dict()["data"]
    found = [(float(value), data[key.replace("'", "_dot")][-1]) for key, value in zip(rows[0], rows[-1])
             if key.replace("'", "_dot") in data]  # fmt: skip
    assert len(found) > 1, name
    tell(f"{name}, motion of {len(found)} states in rumoca", off(*zip(*found)), 1e-6)


for scene in scenes:
    name = os.path.splitext(os.path.basename(scene))[0]
    run("emit", scene, "-o", folder, "--language", "python", "--jacobian")
    run("emit", scene, "-o", folder, "--language", "modelica")
    traced(name)
    simulated(name, scene)
sys.exit(0 if is_good else 1)
