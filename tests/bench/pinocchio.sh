#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Forward and inverse dynamics, mass matrices and their Jacobians beside Pinocchio's, in one run: Pinocchio's own functions (aba,
# rnea, crba, computeABADerivatives, computeRNEADerivatives), and the code that CppADCodeGen writes from these.
#
#   tests/bench/pinocchio.sh [--robot NAME]... [--rounds N] [--flags "FLAGS"]... [--length N]... [--compile-seconds S]
#                            [--compile-gigabytes G] [--json FILE] [PROGRAM]
#
# Robots are humanoid32, tree30, oblique20 and chain20 of robots.py, and arm7. Results agree to 1e-9 before anything is timed; then
# all take turns, and a time is the least of N rounds (20), since others may use the processor. Ours is compiled with the flags of
# `alembert simulate`. The code of CppADCodeGen is compiled with each of FLAGS ("-O3 -march=native"; -Ofast and -O1 were slower), whole
# (--length 0) and in functions of at most N assignments (1000), and the best counts. What takes the compiler more than S seconds (600)
# or G gigabytes (6) is left out, and said so. Ours for the Jacobian of inverse dynamics is `inverse_jacobian` and `mass`, because
# theirs has d tau / d q'' too. computeABADerivatives gives the inverse of the mass matrix besides; ours does not, and neither does the
# code written from it here.
#
# Pinocchio: PINOCCHIO_PREFIX (a folder with include/pinocchio and Boost's headers), or PINOCCHIO_PYTHON, an interpreter whose
# environment has the package `pin`, or python3. CppADCodeGen: CPPADCG_PREFIX, a folder with include/cppad/cg.hpp,
# include/cppad/cppad.hpp and lib/libcppad_lib.so. Eigen: EIGEN_INCLUDE, or /usr/include/eigen3. PROGRAM: build/release/generator/alembert.
set -eu
root=$(cd -- "$(dirname -- "$0")/../.." && pwd)
exec python3 -B - "$root" "$@" <<'PYTHON'
import atexit
import json
import math
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as tree

root = sys.argv[1]
sys.path.append(os.path.join(root, "tests/bench"))
from measuring import keep, options, processor, read

ROBOTS = ["humanoid32", "tree30", "oblique20", "chain20", "arm7"]
parser = options("pinocchio.sh", root)
parser.add_argument("--robot", action="append", choices=ROBOTS)
parser.add_argument("--rounds", type=int, default=20)
parser.add_argument("--flags", action="append")
parser.add_argument("--length", action="append", type=int)
parser.add_argument("--compile-seconds", type=int, default=600)
parser.add_argument("--compile-gigabytes", type=float, default=6)
wishes = read(parser, sys.argv[2:])
bench = os.path.join(root, "tests/bench")
folder = tempfile.mkdtemp(prefix="pinocchio-")
atexit.register(shutil.rmtree, folder)
compiler = os.environ.get("CXX", "c++")
lengths = wishes.length or [0, 1000]


def pinocchio():
    """The folder above include/pinocchio."""
    candidates = [os.environ.get("PINOCCHIO_PREFIX")]
    where = "import pinocchio, os; print(os.path.abspath(os.path.join(os.path.dirname(pinocchio.__file__), *[os.pardir] * 4)))"
    for python in (os.environ.get("PINOCCHIO_PYTHON"), "python3"):
        if python:
            candidates.append(subprocess.run([python, "-c", where], capture_output=True, text=True).stdout.strip())
    for one in candidates:
        if one and os.path.exists(os.path.join(one, "include/pinocchio/algorithm/aba.hpp")):
            return one
    sys.exit("Pinocchio is not found: name its folder with PINOCCHIO_PREFIX, or an interpreter that has the package "
             "'pin' with PINOCCHIO_PYTHON (python3 -m venv FOLDER; FOLDER/bin/pip install pin)")


class TooLarge(Exception):
    """A limit that a compiler would have passed."""


def timed(command, limited=False):
    """The seconds of processor time that a command takes, and what it writes."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (wishes.compile_seconds, wishes.compile_seconds + 5))
        resource.setrlimit(resource.RLIMIT_AS, (int(wishes.compile_gigabytes * 2**30),) * 2)

    before = os.times()
    done = subprocess.run(command, capture_output=True, text=True, preexec_fn=limit if limited else None)
    after = os.times()
    took = after.children_user - before.children_user + after.children_system - before.children_system
    if done.returncode != 0:
        if limited and "CPU time limit" in done.stderr:
            raise TooLarge(f"more than {wishes.compile_seconds} s")
        if limited and re.search("memory exhausted|out of memory|bad_alloc", done.stderr):
            raise TooLarge(f"more than {wishes.compile_gigabytes:g} GB")
        sys.exit(f"{' '.join(command[:6])} …: {done.stderr[-2000:]}")
    return took, done.stdout


def compiled(name, optimized, prefix, *more):
    """A program of this folder that uses Pinocchio."""
    command = [compiler, "-std=c++17", *optimized, "-DNDEBUG", "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
               "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30", "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
               "-DBOOST_FUSION_INVOKE_MAX_ARITY=12", "-I" + os.path.join(root, "lib")]
    for include in (os.path.join(prefix, "include"), os.environ.get("EIGEN_INCLUDE", "/usr/include/eigen3")):
        command += ["-isystem", include]
    path = os.path.join(folder, name)
    took = timed([*command, os.path.join(bench, name + ".cpp"), "-o", path, *more])[0]
    print(f"{name} is compiled with {' '.join(optimized)} in {took:.0f} s", flush=True)
    return path


def angles_of(R):
    return [math.atan2(R[2][1], R[2][2]), math.asin(max(-1, min(1, -R[2][0]))), math.atan2(R[1][0], R[0][0])]


def urdf_of_arm():
    """systems/arm7.json as a URDF."""
    system = json.load(open(os.path.join(bench, "systems/arm7.json")))
    number = lambda list: " ".join(repr(float(x)) for x in list)
    lines = ['<robot name="arm7">', '<link name="l0"/>']
    for k, body in enumerate(system["bodies"], 1):
        xx, xy, xz, yy, yz, zz = body["inertia"]
        lines += [f'<link name="l{k}"><inertial><mass value="{body["mass"]}"/><origin xyz="{number(body["com"])}"/>'
                  f'<inertia ixx="{xx}" iyy="{yy}" izz="{zz}" ixy="{xy}" ixz="{xz}" iyz="{yz}"/></inertial></link>',
                  f'<joint name="j{k}" type="continuous"><origin xyz="{number(body["p"])}" rpy="{number(angles_of(body["R"]))}"/>'
                  f'<parent link="l{body["parent"] + 1}"/><child link="l{k}"/><axis xyz="{number(body["axis"])}"/></joint>']
    return "\n".join(lines + ["</robot>\n"])


def table_of(urdf):
    """The numbers of a URDF of robots.py as a table that the peer reads."""
    robot = tree.parse(urdf).getroot()
    links = {link.get("name"): link.find("inertial") for link in robot.findall("link")}

    def inertia(link):
        if links[link] is None:
            return "0 0 0 0 0 0 0 0 0 0"
        origin, I = links[link].find("origin"), links[link].find("inertia")
        return " ".join([links[link].find("mass").get("value"), origin.get("xyz")] +
                        [I.get(key) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")])

    base = robot.find("link").get("name")
    numbers, lines, left = {base: 0}, [inertia(base)], []

    def enter(link):
        left.extend(joint for joint in reversed(robot.findall("joint")) if joint.find("parent").get("link") == link)

    enter(base)
    while left:  # depth first, as Pinocchio wants them
        joint = left.pop()
        child, damping = joint.find("child").get("link"), joint.find("dynamics")
        enter(child)
        numbers[child] = len(numbers)
        lines.append(" ".join([joint.get("name"), str(numbers[joint.find("parent").get("link")]), joint.find("axis").get("xyz"),
                               joint.find("origin").get("xyz"), joint.find("origin").get("rpy"),
                               "0" if damping is None else damping.get("damping"), inertia(child)]))
    return "\n".join(lines) + "\n"


def ours(name, urdf, floats):
    """Our file, compiled as `alembert simulate` does, and the seconds of both steps."""
    scene, out = os.path.join(folder, name + ".toml"), os.path.join(folder, "ours")
    timed([wishes.program, "import", urdf, "-o", scene] + (["--floating"] if floats else []))
    emitted = timed([wishes.program, "emit", scene, "--jacobian", "--functions", "inverse,mass,inverse_jacobian", "-o", out])[0]
    source = os.path.join(out, name + ".cpp")
    flags = ["-std=c++20", "-shared", "-fPIC", "-march=native", "-ffp-contract=fast", "-fno-math-errno", "-fno-trapping-math",
             "-fno-tree-slp-vectorize"]
    large = ["-O1", "-fexpensive-optimizations", "-fno-tree-dse", "-fno-dse", "-fno-gcse",
             "--param=lra-max-considered-reload-pseudos=10"] if os.path.getsize(source) > 200000 else ["-O2"]
    path = source[:-4] + ".so"
    return path, emitted, timed([compiler, *flags, *large, source, "-o", path])[0]


def library_of(sources, flags, path):
    """Compiles C; the seconds that this takes."""
    total, objects = 0, []
    for source in sources:
        objects.append(f"{path}_{os.path.basename(source)}.o")
        total += timed(["cc", "-std=gnu99", "-fPIC", *flags.split(), "-c", source, "-o", objects[-1]], limited=True)[0]
        if total > wishes.compile_seconds:
            raise TooLarge(f"more than {wishes.compile_seconds} s")
    timed(["cc", "-shared", *objects, "-o", path, "-lm"])
    return total


def lines_in(path):
    return sum(1 for _ in open(path))


def theirs(name, table, floats, writer):
    """The code that CppADCodeGen writes, as the peer's words; for each function, the seconds for writing and compiling each form."""
    words, forms = [], {}
    for function in ("forward", "inverse", "mass", "forward_jacobian", "inverse_jacobian"):
        for length in lengths:
            where = os.path.join(folder, f"{name}_{function}_{length}")
            os.makedirs(where)
            written = timed([writer, table, floats, function, str(length or 10**9), where])[0]
            sources = [os.path.join(where, one) for one in sorted(os.listdir(where)) if one.endswith(".c")]
            if length and 0 in lengths and max(map(lines_in, sources)) < length:
                continue  # it is whole
            for flags in wishes.flags or ["-O3 -march=native"]:
                form = f"{'whole' if length == 0 else f'by {length}'}, {flags}"
                path = os.path.join(where, re.sub("[^A-Za-z0-9]", "", flags) + ".so")
                told = {"written_s": round(written, 2), "lines": sum(map(lines_in, sources))}
                try:
                    told["compiled_s"] = round(library_of(sources, flags, path), 2)
                    words += [function, f"CppADCodeGen {form}", path]
                except TooLarge as limit:
                    told["left_out"] = str(limit)
                    print(f"{name:11} {function:17} {form}: left out, {told['lines']} lines take the compiler {limit}", flush=True)
                forms.setdefault(function, {})[form] = told
    return words, forms


prefix, codegen = pinocchio(), os.environ.get("CPPADCG_PREFIX")
if codegen and not os.path.exists(os.path.join(codegen, "include/cppad/cg.hpp")):
    sys.exit(f"there is no include/cppad/cg.hpp in CPPADCG_PREFIX, {codegen}")
model, flags = processor()
print(f"processor: {model} ({' '.join(flags)}); Pinocchio: {prefix}; CppADCodeGen: "
      f"{codegen or 'left out, CPPADCG_PREFIX names none'}", flush=True)
peer = compiled("pinocchio_peer", ["-O3", "-march=native"], prefix, "-ldl")
writer = codegen and compiled("pinocchio_code", ["-O0"], prefix, "-isystem", os.path.join(codegen, "include"),
                              "-L" + os.path.join(codegen, "lib"), "-lcppad_lib", "-ldl", "-Wl,-rpath," + os.path.join(codegen, "lib"))
subprocess.run([sys.executable, "-B", os.path.join(bench, "robots.py"), folder], check=True)
open(os.path.join(folder, "arm7.urdf"), "w").write(urdf_of_arm())
print(f"{'robot':11} {'function':17} {'operations':>10} {'ours, us':>9} {'Pinocchio':>10} {'ratio':>6} {'CppADCodeGen':>13} {'ratio':>6}")
listed = []
for name in wishes.robot or ROBOTS:
    floats = name.startswith("humanoid")
    urdf, table, kind = os.path.join(folder, name + ".urdf"), os.path.join(folder, name + ".table"), "floating" if floats else "fixed"
    open(table, "w").write(table_of(urdf))
    path, emitted, took = ours(name, urdf, floats)
    print(f"{name:11} ours: emitted in {emitted:.1f} s, compiled in {took:.1f} s", flush=True)
    words, forms = theirs(name, table, kind, writer) if writer else ([], {})
    result = json.loads(timed([peer, table, kind, str(wishes.rounds), path, *words])[1])
    for function, times in result["ns"].items():
        own = times["ours"]
        generated, who = min(((ns, who) for who, ns in times.items() if who.startswith("CppADCodeGen")), default=(None, ""))
        form = who.removeprefix("CppADCodeGen ")
        cell = lambda ns: f"{ns / 1000:.2f}" if ns else "-"
        ratio = lambda ns: f"{own / ns:.2f}" if ns else "-"
        by = f"  {form}, compiled in {forms[function][form]['compiled_s']:.1f} s" if form else ""
        print(f"{name:11} {function:17} {result['operations'].get(function, ''):>10} {cell(own):>9} {cell(times['Pinocchio']):>10} "
              f"{ratio(times['Pinocchio']):>6} {cell(generated):>13} {ratio(generated):>6}{by}", flush=True)
        listed.append({"robot": name, "function": function, "ns": times, "processor": model, "flags": flags,
                       "codegen": forms.get(function)})
keep(listed, wishes.json)
PYTHON
