# SPDX-License-Identifier: MIT
"""An adversary by construction: random scenes and claims where something must be assumed, and what is said of them.

    tests/adversary.sh                            300 claims, always the same
    tests/adversary.sh --claims 100000 --seed 7   for a release
    tests/adversary.sh --kinds sides,rates        these families alone
    tests/adversary.sh --self                     whether the adversary itself sees what is false

A false word is kept in the folder as the smallest scene found of which it is still said; its first lines say the command,
what came out and what is right. The exit code is 1 if there is one.
"""

import argparse
import collections
import copy
import hashlib
import multiprocessing
import os
import random
import shutil
import sys
import time
import traceback

import constrained  # noqa: F401
import judge
import more
import poses
import vary
from families import FAMILIES
from judge import FALSE, NEIGHBOUR, PRINTED, Examined, Program, derived
from trees import NotRead, Undefined, ZERO, add, parts, plain, replaced, write

VERBS = {**poses.KINDS, **vary.KINDS, **more.KINDS}
OTHERS = ["derive", *VERBS]
FORMALISMS = [None, None, None, "lagrange", "kane", "dalembert", "appell", "nielsen", "maggi", "lagrange1", "routh"]
KEPT = 2  # findings of one family and word that are made small and kept


class Count(collections.Counter):
    """Of a family: scenes, claims, false words …"""


def draw(kind, seed):
    """The scene and claims of a family at a seed; a scene that is not defined at its start is drawn again."""
    rng = random.Random(f"{kind} {seed}")
    for _ in range(20):
        try:
            scene, claims = FAMILIES[kind](rng)
            scene.changed().start()
            return scene, claims, rng
        except (Undefined, ZeroDivisionError):
            continue
    raise Undefined(kind)


def examine(options, kind, seed):
    """(counts, findings) of one scene."""
    counts, begin = Count(scenes=1), time.process_time()
    program = Program(options.program, os.path.join(options.folder, f"work-{os.getpid()}"))
    number = int(hashlib.sha256(f"{kind} {seed}".encode()).hexdigest()[:8], 16)
    try:
        if kind == "derive":
            choose = random.Random(f"derive {seed}")
            of = choose.choice([k for k in FAMILIES if k not in ("primes", "solutions", "rest", "impact")])
            scene, _, _ = draw(of, f"derive {seed}")
            findings, refused, count = derived(program, scene, number, choose.choice(FORMALISMS))
            counts["claims"] += count
        elif kind in VERBS:
            findings, refused, told = VERBS[kind](program, random.Random(f"{kind} {seed}"))
            counts.update(told)
        else:
            scene, claims, rng = draw(kind, seed)
            at = Examined(program, scene, claims, number)
            at.examine(range(len(at.claims)) if kind == "neighbours" else [0] if rng.random() < 0.25 else [])
            findings, refused = at.findings, at.refused
            counts.update(at.counts)
            counts["claims"] += len(at.claims)
            counts.update({"holds": sum(t.kind == "holds" for t in at.truths)})
    except Undefined:
        counts["not drawn"] += 1
        return counts, []
    if refused:
        counts["other exits"] += 1
        counts[f"exit {refused[0]}: {refused[1][:110]}"] += 1
    for finding in findings:
        counts[finding.word] += 1
    counts["runs"] += program.runs
    counts["seconds"] += time.process_time() - begin
    return counts, findings


def guarded(task):
    options, kind, seed = task
    try:
        return kind, seed, *examine(options, kind, seed), None
    except Exception:  # noqa: BLE001, a mistake of the adversary is told with its seed
        return kind, seed, Count(scenes=1), [], traceback.format_exc()


def made_small(task):
    options, kind, word, finding = task
    try:
        return kind, word, smallest(options, finding)
    except Exception:  # noqa: BLE001
        finding.text += "\nIt could not be made smaller: " + traceback.format_exc(limit=2)
        return kind, word, finding


def _file(finding):
    """The scene with the claim, and what is to be known in its first lines."""
    if finding.scene is None:
        return finding.text + "\n"
    verb = (
        "derive" + (f" --by {finding.by}" if finding.by else "")
        if finding.word == PRINTED
        else finding.claim.verb if hasattr(finding.claim, "verb") else "check"
    )
    claims = [finding.claim] if finding.claim and verb == "check" else []
    head = f"# alembert {verb} FILE: {finding.word}.\n" + "".join(f"# {line}\n" for line in finding.text.split("\n"))
    return finding.scene.text(claims, head.rstrip("\n"))


# -- smaller


def smallest(options, finding):
    """A smaller scene and claim of which the same false word is said."""
    if finding.claim is None or finding.scene is None or finding.word == NEIGHBOUR or hasattr(finding.claim, "verb"):
        return finding
    program = Program(options.program, os.path.join(options.folder, f"work-{os.getpid()}"))
    best, left = None, 40

    def same(scene, claim):
        nonlocal best, left
        if left <= 0:
            return False
        left -= 1
        try:
            scene.changed()
            if finding.word == PRINTED:
                found = derived(program, scene, 7, finding.by)[0]
            else:
                at = Examined(program, scene, [claim], 7)
                at.examine()
                found = at.findings
        except (Undefined, NotRead, KeyError, IndexError, ZeroDivisionError):
            return False
        for f in found:
            if f.word == finding.word and ("fails" in f.text) == ("fails" in finding.text):
                best = f
                return True
        return False

    scene, claim = finding.scene, finding.claim
    if not same(scene, claim):
        finding.text += "\nOnly beside the other claims of its scene."
        return finding
    going = True
    while going and left > 0:
        going = False
        for other in _smaller_scenes(scene):
            if same(other, claim):
                scene, going = other, True
                break
        if finding.word == PRINTED:
            continue
        for other in _smaller_claims(claim):
            if same(scene, other):
                claim, going = other, True
                break
    return best


def _smaller_scenes(scene):
    for q in list(scene.coordinates):
        left = scene.without(q)
        if left:
            yield left
    for table in ("springs", "pushes", "frictions"):
        for k in range(len(getattr(scene, table))):
            yield _with(scene, **{table: getattr(scene, table)[:k] + getattr(scene, table)[k + 1 :]})
    if scene.gravity:
        yield _with(scene, gravity=None)
    for energy in ("potential", "kinetic"):
        if getattr(scene, energy) != ZERO:
            yield _with(scene, **{energy: ZERO})
    for q, force in scene.forces.items():
        yield _with(scene, forces={k: v for k, v in scene.forces.items() if k != q})
        for smaller in _smaller_trees(force):
            yield _with(scene, forces={**scene.forces, q: smaller})
    for q, (initial, speed, unit, guess) in scene.coordinates.items():
        if speed != ZERO and not scene.constraints:
            yield _with(scene, coordinates={**scene.coordinates, q: (initial, ZERO, unit, guess)})


def _with(scene, **changes):
    other = copy.copy(scene)
    for key, value in changes.items():
        setattr(other, key, value)
    return other.changed()


def _smaller_trees(node):
    """A sum without a term; a node replaced by one of its parts."""
    nodes = [n for n in parts(plain(node)) if n.args and n.op not in ("num", "name")]
    for n in nodes[:25]:
        if n.op == "+":
            for k in range(len(n.args)):
                total = ZERO
                for a in n.args[:k] + n.args[k + 1 :]:
                    total = add(total, a)
                yield replaced(plain(node), lambda x, n=n, w=total: w if x == n else None)
        elif n.op in ("*", "/", "neg", "^", "max", "min", "sqrt"):
            for a in n.args[:1] if n.op in ("/", "^") else n.args:
                yield replaced(plain(node), lambda x, n=n, w=a: w if x == n else None)


def _smaller_claims(claim):
    for left in _smaller_trees(claim.left):
        yield claim.like(left, claim.right)
    for right in _smaller_trees(claim.right):
        yield claim.like(claim.left, right)
    left, right = plain(claim.left), plain(claim.right)
    if write(left) + write(right) != write(claim.left) + write(claim.right):
        yield claim.like(left, right)


# -- all of them


def report(totals, seconds):
    words = [w for w in FALSE if any(c[w] for c in totals.values())]
    print(
        f"{'family':<12}{'scenes':>8}{'claims':>8}"
        + "".join(f"{w.replace(' wrongly', '').replace(' wrong', ''):>12}" for w in words)
        + f"{'undecided':>11}{'on sheets':>11}{'other exits':>13}{'seconds':>9}"
    )
    whole = Count()
    for kind, c in [*totals.items(), ("all", None)]:
        if c is None:
            c = whole
        else:
            whole.update(c)
        print(
            f"{kind:<12}{c['scenes']:>8}{c['claims']:>8}"
            + "".join(f"{c[w]:>12}" for w in words)
            + f"{c['undecided']:>11}{c['sheets']:>11}{c['other exits']:>13}{c['seconds']:>9.0f}"
        )
    for word, number in sorted((k, v) for k, v in whole.items() if k.startswith(("exit ", "undecided "))):
        print(f"  {number} x {word}")
    wrong = sum(whole[w] for w in FALSE)
    print(
        f"{wrong} false words; {whole['undecided']} of {whole['claims']} undecided; {whole['missed']} counterexamples in cells "
        f"that were not looked at here; {whole['holds']} claims hold; {seconds:.0f} s"
    )
    return wrong


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/release/generator/alembert")
    parser.add_argument("--claims", type=int, default=300)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--folder", default="build/adversary")
    parser.add_argument("--kinds", default=",".join([*FAMILIES, *OTHERS]))
    parser.add_argument("--no-shrink", dest="shrink", action="store_false")
    parser.add_argument("--undecided", action="store_true", help="keep what stays undecided too")
    parser.add_argument("--self", dest="itself", action="store_true")
    return parser.parse_args()


def tasks(options, kinds):
    """Scenes of all families in turn, until there are enough claims of each."""
    each = max(1, round(options.claims / len(kinds)))
    per_scene = {"derive": 1.6, **{kind: 1 for kind in VERBS}}
    for kind in kinds:
        for k in range(max(1, round(each / per_scene.get(kind, 7)))):
            yield options, kind, f"{options.seed} {k}"


def main():
    options = arguments()
    if options.itself:
        import itself

        return itself.all()
    kinds = options.kinds.split(",")
    unknown = [k for k in kinds if k not in FAMILIES and k not in OTHERS]
    if unknown:
        print(f"no family {unknown[0]}; there are {', '.join([*FAMILIES, *OTHERS])}")
        return 3
    judge.keep_undecided = options.undecided
    options.program = os.path.abspath(options.program)
    os.makedirs(options.folder, exist_ok=True)
    totals, begin, found, broken = {k: Count() for k in kinds}, time.time(), collections.defaultdict(list), 0
    with multiprocessing.Pool(options.jobs) as pool:
        for kind, seed, counts, findings, mistake in pool.imap_unordered(guarded, tasks(options, kinds)):
            totals[kind].update(counts)
            if mistake:
                broken += 1
                print(f"the adversary broke at {kind} {seed}:\n{mistake}", file=sys.stderr)
            for f in findings:
                f.size = len(f.scene.text()) + 4 * len(f.claim.text if f.claim else "") if f.scene else 0
                kept = found[kind, f.word] = sorted([*found[kind, f.word], f], key=lambda f: f.size)
                del kept[KEPT:]
        small = [(options, *key, f) for key, kept in found.items() for f in kept]
        for number, (kind, word, f) in enumerate(pool.imap(made_small, small) if options.shrink else [s[1:] for s in small]):
            label = f"{kind}-{word.replace(' ', '-')}-{number}.toml"
            with open(os.path.join(options.folder, label), "w", encoding="utf-8") as out:
                out.write(_file(f))
            print(f"{label}: {f.claim.text if f.claim else ''}\n    {f.text}", flush=True)
    for folder in os.listdir(options.folder):
        if folder.startswith("work-"):
            shutil.rmtree(os.path.join(options.folder, folder), ignore_errors=True)
    wrong = report(totals, time.time() - begin)
    return 1 if wrong or broken else 0


if __name__ == "__main__":
    sys.exit(main())
