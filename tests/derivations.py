#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Hand derivations with known verdicts, held against what `alembert check` says of each line.

    tests/derivations.py PROGRAM corpus                 # tests/derivations/: each file has its .expected
    tests/derivations.py PROGRAM steps                  # derive --steps --format latex of the scenes, every line right
    tests/derivations.py PROGRAM steps --format text    # the same, printed as text
    tests/derivations.py PROGRAM steps --all --limit 60 # the same for all scenes by all formalisms, in 60 s a pair
    tests/derivations.py PROGRAM made --count 1000 --seed 7
                                                        # the same rewritten in several hands, with random slips

A file NAME.expected has the scene, perhaps options, and for each equality in reading order its line in the document, its
status, and the kind of a mistake; `|` stands between what is accepted. `corpus` fails unless every first mistake is
found with its kind, no right line is called wrong, and 95 % of the lines that follow from a slip are told so. `made`
fails unless 99 % of the slips are found at their line and no right line is called wrong.
"""

import argparse
import collections
import concurrent.futures
import glob
import json
import os
import random
import re
import statistics
import subprocess
import sys
import tempfile
import threading

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
CORPUS = os.path.join(ROOT, "tests/derivations")
SCENES = os.path.join(ROOT, "scenes/textbook")
GALLERY = os.path.join(ROOT, "scenes/gallery")
RIGHT = {"right", "right_near", "right_up_to_constant", "right_up_to_derivative"}
WRONG = {"mistake", "follows"}
ALLOWED = RIGHT | {"definition", "not_about_scene"}  # of the program's own lines; the last are laws in general letters
FORMALISMS = ["lagrange", "lagrange1", "routh", "kane", "dalembert", "routhian", "hamilton", "schiehlen",
              "roberson-wittenburg", "recursive", "maggi", "appell", "nielsen"]  # yapf: disable


def run(program, *arguments, text=None, limit=600):
    environment = {**os.environ, "LC_ALL": "C.UTF-8", "LANG": "C"}
    return subprocess.run([program, *arguments], input=text, capture_output=True, text=True, env=environment,
                          timeout=limit)


def checked(program, scene, file, options=(), limit=600):
    """The JSON of a derivation, and the seconds of processor time that it took."""
    environment = {**os.environ, "LC_ALL": "C.UTF-8", "LANG": "C"}
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
        process = subprocess.Popen([program, "check", scene, file, "--json", *options], stdout=out, stderr=errors,
                                   env=environment)
        stop = threading.Timer(limit, process.kill)
        stop.start()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        stop.cancel()
        out.seek(0), errors.seek(0)
        printed, told = out.read().decode(), errors.read().decode()
    seconds = used.ru_utime + used.ru_stime
    if process.returncode not in (0, 1, 2):
        return None, seconds, told or f"exit code {process.returncode}"
    try:
        return json.loads(printed), seconds, told
    except json.JSONDecodeError:
        return None, seconds, printed + told


class Tally:
    """Counts with their totals, and what to say of each that failed."""

    def __init__(self):
        self.counts = collections.Counter()
        self.totals = collections.Counter()
        self.told = []

    def add(self, what, held, tell=""):
        self.totals[what] += 1
        self.counts[what] += bool(held)
        if not held and tell:
            self.told.append(f"{what}: {tell}")

    def share(self, what):
        return self.counts[what] / self.totals[what] if self.totals[what] else 1.0

    def shown(self):
        return "\n".join(f"  {what}: {self.counts[what]} of {self.totals[what]} ({100 * self.share(what):.1f} %)"
                         for what in self.totals)


# The corpus


def expected(path):
    scene, options, lines = None, [], []
    with open(path, encoding="utf-8") as file:
        for row in file:
            words = row.split()
            if words[0] == "scene":
                scene = words[1]
            elif words[0] == "option":
                options += words[1:]
            else:
                kinds = set(words[2].split("|")) if len(words) > 2 else set()
                lines.append((int(words[0]), set(words[1].split("|")), kinds))
    return scene, options, lines


def kind_of(line):
    return (line["likely"] or {}).get("kind", "")


def hold_one(program, name, tally):
    """One file of the corpus."""
    scene, options, lines = expected(os.path.join(CORPUS, name + ".expected"))
    result, _, errors = checked(program, os.path.join(ROOT, scene), os.path.join(CORPUS, name), options)
    if result is None:
        return tally.add("read", False, f"{name}: {errors.strip()}")
    found = result["lines"]
    tally.add("read", len(found) == len(lines),
              f"{name}: {len(found)} equalities instead of {len(lines)}: " + "; ".join(
                  f"{one['line']} {one['source']!r}" for one in found))  # yapf: disable
    if len(found) != len(lines):
        return None
    first = next((k for k, (_, statuses, _) in enumerate(lines) if "mistake" in statuses), None)
    slip = None if result["first_mistake"] is None else result["first_mistake"]
    told = "" if slip is None else f"line {found[slip]['line']}, {kind_of(found[slip])}"
    tally.add("first mistake", slip == first, f"{name}: {told or 'none'}")
    if first is not None and slip == first and lines[first][2]:
        tally.add("kind of slip", kind_of(found[slip]) in lines[first][2], f"{name}: {told} instead of {lines[first][2]}")
    for (line, statuses, _), one in zip(lines, found):
        place = f"{name}:{line}: {one['status']} instead of {'|'.join(sorted(statuses))}: {one['source']!r} {one['reason']}"
        if statuses == {"any"}:
            continue
        what = "follow-through" if statuses & {"follows", "unfounded"} else "mistakes" if "mistake" in statuses else "right lines"
        tally.add(what, one["status"] in statuses, place)
        if what == "right lines":
            tally.add("right lines not called wrong", one["status"] not in WRONG | {"unfounded"})
    return None


def corpus(program, options):
    tally = Tally()
    names = sorted(os.path.basename(path)[:-len(".expected")] for path in glob.glob(CORPUS + "/*.expected"))
    for name in names:
        if not options.only or options.only in name:
            hold_one(program, name, tally)
    print("\n".join(tally.told))
    print(f"{len(names)} derivations\n{tally.shown()}")
    whole = ["read", "first mistake", "kind of slip", "right lines not called wrong"]
    return all(tally.share(what) == 1 for what in whole) and tally.share("follow-through") >= 0.95


# What the program derives


def steps_of(program, scene, formalism="", limit=600, form="latex"):
    by = ["--by", formalism] if formalism else []
    result = run(program, "derive", scene, "--steps", "--format", form, *by, limit=limit)
    return result.stdout if result.returncode == 0 else None


def hold_steps(job):
    """Every equality of derive --steps: counts of what `check` says of it."""
    program, scene, formalism, limit, form = job
    name = f"{os.path.basename(scene)} by {formalism}"
    try:
        text = steps_of(program, scene, formalism, limit, form)
        if text is None:
            return None
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "steps.tex" if form == "latex" else "steps.txt")
            with open(file, "w", encoding="utf-8") as out:
                out.write(text)
            result, seconds, errors = checked(program, scene, file, limit=limit)
    except subprocess.TimeoutExpired:
        return collections.Counter(late=1), [f"{name}: not derived in {limit} s"], []
    if result is None and seconds >= 0.9 * limit:
        return collections.Counter(late=1), [f"{name}: not checked in {limit} s"], []
    if result is None:
        return collections.Counter(unread=1), [f"{name}: {errors.strip()}"], []
    counts = collections.Counter(line["status"] for line in result["lines"])
    counts.update(pairs=1)
    told = [f"{name}: {line['status']} in line {line['line']}: {line['source']} {line['reason']}" for line in result["lines"]
            if line["status"] not in ALLOWED]  # yapf: disable
    return counts, told, [1000 * seconds / max(1, len(result["lines"]))]


# By all formalisms; and of each other cause for which a line was once not understood one.
WHOLE = """bar_in_guides bead_on_turning_circle bead_on_wire beam_two_modes belt_drive bifilar_suspension block_on_wedge
bouncing_ball cart_pole cartesian_pendulum central_force chain_hoist chaplygin_sleigh chaplygin_sleigh_in_speeds
charged_pendulum clock condenser_microphone cycloidal_pendulum cylinder_in_cylinder cylinder_on_wedge double_atwood
eccentric_cylinder elliptic_trammel falling_ladder falling_stick foucault_pendulum kepler_parabolic magnetic_field
moving_support parallel_axes planetary_gear relativistic_kepler rolling_disc rotating_hoop shortened_pendulum
skate_on_slope slack_pendulum sled_regular spool towed_trailer universal_joint yo_yo""".split()
STEPS = {
    "ball_on_turntable": ["maggi"], "beam_with_moving_load": ["hamilton", "maggi"], "furuta_joints": ["dalembert"],
    "double_pendulum_joints": ["roberson-wittenburg"], "free_body_quaternion": ["maggi"], "heavy_top_joint": ["routh"],
    "motor_on_springs": ["dalembert", "routhian"], "struck_rods": ["appell"], "tractor_with_trailer": ["kane", "dalembert"],
}  # yapf: disable


def name_of(scene):
    return os.path.splitext(os.path.basename(scene))[0]


def steps(program, options):
    scenes = sorted(glob.glob(SCENES + "/*.toml") + glob.glob(GALLERY + "/*.toml"), key=os.path.getsize)
    pairs = [(scene, formalism) for scene in scenes for formalism in FORMALISMS
             if options.all or name_of(scene) in WHOLE or formalism in STEPS.get(name_of(scene), [])]
    pairs = [pair for pair in pairs if options.only in f"{os.path.basename(pair[0])} {pair[1]}"]
    counts, told, times, missing = collections.Counter(), [], [], set(FORMALISMS)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for pair, found in zip(pairs, pool.map(hold_steps, [(program, *pair, options.limit, options.format) for pair in pairs])):
            if found is not None:
                counts += found[0]
                told += found[1]
                times += found[2]
                missing.discard(pair[1])
    print("\n".join(told[:options.show]))
    print(f"{len(pairs)} pairs: " + ", ".join(f"{count} {status}" for status, count in counts.most_common()))
    if missing and not options.only:
        print("by these nothing was derived: " + ", ".join(sorted(missing)))
    if times:
        print(f"milliseconds a line: median {statistics.median(times):.1f}, most {max(times):.1f}")
    return bool(times) and not (missing and not options.only) and not set(counts) - ALLOWED - {"pairs"}


# Machine-made derivations

GREEK = r"\\(?:theta|varphi|phi|psi|alpha|beta|gamma|lambda|omega|xi|eta|chi|mu|sigma|tau|zeta|delta)"
LETTER = rf"(?:{GREEK}|\\mathrm{{\w+}}|[A-Za-z])"
DOTTED = re.compile(rf"\\(d?dot)\{{({LETTER})\}}(_\{{(?:[^{{}}]|\{{[^{{}}]*\}})*\}})?(\(t\))?(\^\{{(\d+)\}})?")


def in_fractions(found):
    letter, index, power = found.group(2), found.group(3) or "", found.group(6)
    name = letter + index
    if found.string[:found.start()].endswith(r"\partial "):  # nobody writes a fraction there
        return found.group()
    rate = rf"\frac{{d{name}}}{{dt}}" if found.group(1) == "dot" else rf"\frac{{d^2{name}}}{{dt^2}}"
    return rf"\left({rate}\right)^{{{power}}}" if power else rate + " "


def in_primes(found):
    letter, index, power = found.group(2), found.group(3) or "", found.group(6)
    primes = "'" if found.group(1) == "dot" else "''"
    rate = f"{letter}{index}{primes}"
    return f"({rate})^{power} " if power else rate + " "


def in_short(found):
    if found.group(2).startswith(r"\mathrm"):
        return found.group()
    letter, index, power = found.group(2), found.group(3) or "", found.group(6)
    short = rf"\{found.group(1)} {letter}" if letter.startswith("\\") is False else rf"\{found.group(1)}{letter}"
    return short + index.replace("{", "").replace("}", "") * (len(index) <= 4) + index * (len(index) > 4) + (
        f"^{power} " if power else " ")


DOTS = {"as printed": None, "short": in_short, "primes": in_primes, "fractions": in_fractions}


class Hand:
    """A way of writing."""

    def __init__(self, rng, scene_text):
        self.dots = rng.choice(list(DOTS))
        self.energies = rng.choice(["TV", "TV", "KU"])
        names = set(re.findall(r"^\s*([A-Za-z_]\w*)\s*=", scene_text, re.M)) | set(
            re.findall(r'(?:name|multiplier)\s*=\s*"(\w+)"', scene_text))
        if names & {"K", "U", "T", "V"}:
            self.energies = "TV"
        self.ell = rng.random() < 0.4 and "ell" not in names
        self.layout = rng.choice(["align", "chat", "bullets", "article"])
        self.is_swapped = rng.random() < 0.3

    def write(self, formula):
        if DOTS[self.dots]:
            formula = DOTTED.sub(DOTS[self.dots], formula).rstrip()
        if self.ell:
            formula = re.sub(r"(?<![A-Za-z\\])l(?![A-Za-z])", r"\\ell ", formula)
        if self.energies == "KU":
            formula = re.sub(r"(?<![A-Za-z\\])T(?![A-Za-z])", "K", formula)
            formula = re.sub(r"(?<![A-Za-z\\])V(?![A-Za-z])", "U", formula)
        return formula

    def page(self, formulas):
        written = [self.write(formula) for formula in formulas]
        if self.layout == "chat":
            return "\n\n".join(f"**Step {k}.** We find\n\n$${one}$$" for k, one in enumerate(written, 1)) + "\n", ".md"
        if self.layout == "bullets":
            return "\n".join(f"- ${one}$" for one in written) + "\n", ".md"
        rows = " \\\\\n".join(one.replace(" = ", " &= ", 1) for one in written)
        body = f"\\begin{{align*}}\n{rows}\n\\end{{align*}}\n"
        if self.layout == "align":
            return "We obtain\n" + body, ".tex"
        return ("\\documentclass{article}\n\\usepackage{amsmath}\n\\begin{document}\nThe derivation:\n" + body +
                "\\end{document}\n"), ".tex"


# What only the words around it explain: Jacobians of one body, matrices, Gibbs's function, angular velocities.
OF_A_FORMALISM = re.compile(r"(\\frac\{\\partial (?:[vrsS]|\\omega)|B_|E_|S$|a_|r_|\\omega_|\\mathrm\{L'|\\frac\{\\partial \\dot|Q_\{\\dot|F_\{|R$)")


def formulas_of(text):
    """The lines of the displays that stand for themselves."""
    rows = []
    for words, display in re.findall(r"([^\n]*)\n\\begin{align\*}(.*?)\\end{align\*}", text, re.S):
        if words.startswith(("With all rates", "with the roots")):
            continue
        whole = []
        for row in display.split("\\\\\n"):
            row = row.strip()
            if row.startswith(r"&\quad") and whole:  # goes on with the row above
                whole[-1] += " " + row[len(r"&\quad"):].strip()
            else:
                whole.append(row)
        for row in whole:
            row = row.replace("&", "").replace("  ", " ").strip()
            left = row.split(" = ")[0]
            if row and row not in rows and r"^{\text" not in row and "*" not in left and not OF_A_FORMALISM.match(left):
                rows.append(row)
    return rows


def coordinates_of(text):
    """As the steps write them."""
    found = re.search(r"generalized coordinates?: (.*)\.", text)
    return re.findall(r"\$([^$]*)\$", found.group(1)) if found else []


def varies(term, coordinates):
    """Whether a term of an energy is more than a constant."""
    return r"\dot" in term or any(re.search(r"(?<![A-Za-z\\])" + re.escape(one) + r"(?![A-Za-z_])", term) for one in coordinates)


def terms_of(side):
    """A sum as [(sign, term)], split outside of all brackets."""
    terms, depth, begin, sign = [], 0, 0, "+"
    k = 0
    while k < len(side):
        c = side[k]
        if c in "({[":
            depth += 1
        elif c in ")}]":
            depth -= 1
        elif depth == 0 and c in "+-" and (k == 0 or side[k - 1] == " ") and side[k - 2:k] != "= ":
            if side[begin:k].strip():
                terms.append((sign, side[begin:k].strip()))
            sign, begin = c, k + 1
        k += 1
    terms.append((sign, side[begin:].strip()))
    return [one for one in terms if one[1]]


def joined(terms):
    if not terms:
        return "0"
    text = " ".join(f"{sign} {term}" for sign, term in terms)
    return text[2:] if text.startswith("+ ") else "-" + text[2:]


def one_place(rng, pattern, replacement, text):
    """The text with one of the matches replaced; None if there is none."""
    places = list(re.finditer(pattern, text))
    if not places:
        return None
    at = rng.choice(places)
    return text[:at.start()] + at.expand(replacement) + text[at.end():]


def slip_in(rng, formula, coordinates):
    """The formula with a random slip, and the kinds by which it may be called; None if none is possible there."""
    left, right = formula.split(" = ", 1)
    is_equation = re.search(r"\\ddot", formula) is not None and not re.fullmatch(r"\S+", left)
    sides = [("left", left), ("right", right)] if is_equation else [("right", right)]
    terms = [(side, k, *term) for side, text in sides for k, term in enumerate(terms_of(text)) if term[1] != "0"]
    if left in ("T", "V", "L", "H"):
        terms = [one for one in terms if varies(one[3], coordinates)]
    if not terms or (is_equation and len(terms) < 2):
        return None
    side, k, sign, term = rng.choice(terms)
    kind = rng.choice(["sign", "factor", "lost_dot", "swapped_trig", "missing_term", "wrong_argument"])
    kinds = {kind}
    if kind == "sign":
        changed = ("-" if sign == "+" else "+", term)
    elif kind == "factor":
        halves = one_place(rng, r"\\frac\{1\}\{2\} ", "", term)
        number = re.match(r"\d+(?= )", term)
        doubled = f"{2 * int(number.group())}{term[number.end():]}" if number else "2 " + term
        changed = (sign, halves if halves else doubled)
    elif kind == "lost_dot":
        new = one_place(rng, r"\\ddot", r"\\dot", term) or one_place(
            rng, rf"\\dot\{{({LETTER})\}}", r"\1", term)
        changed = (sign, new) if new else None
    elif kind == "swapped_trig":
        new = one_place(rng, r"\\sin", r"\\cos", term) if rng.random() < 0.5 else one_place(rng, r"\\cos", r"\\sin", term)
        changed = (sign, new) if new else None
    elif kind == "wrong_argument":
        new = one_place(rng, r"(\\(?:sin|cos)(?:\^\{2\})?\([^()]*) - ([^()]*\))", r"\1 + \2", term)
        changed = (sign, new) if new else None
    else:
        changed = ("", "") if len(terms) > 2 else None
        kinds |= {"factor"}
    if changed is None:
        return None
    whole = dict(sides)
    parts = terms_of(whole[side])
    parts[k:k + 1] = [changed] if changed[1] else []
    whole[side] = joined(parts)
    result = f"{whole.get('left', left)} = {whole['right']}"
    return (result, kinds) if result != formula else None


def is_plain(formula):
    """Whether a slip in this line is one of mechanics: an energy, a momentum, a force or an equation."""
    left = formula.split(" = ")[0]
    return " = " in formula and (left in ("T", "V", "L", "H") or r"\frac{\partial" in left or left.startswith(
        ("Q_", "p_")) or r"\ddot" in formula)


def carried(program, rng, scene, folder):
    """The steps of a scene whose T or V has a slip: (formulas, index of the slip, kinds, which lines follow), or None
    where forces or constraints stand beside the energies."""
    with open(scene, encoding="utf-8") as file:
        text = file.read()
    if re.search(r"^\[\[(force|torque|damper|constraint|rolling|friction|unilateral|impulse|joint)\]\]|"
                 r"^\[(dissipation|forces|energy|speeds|definitions|functions)\]", text, re.M):
        return None
    found = run(program, "derive", scene, "--json")
    if found.returncode != 0:
        return None
    energies = json.loads(found.stdout)
    wrong = rng.choice(["kinetic", "potential"])
    if energies.get(wrong) in (None, "0", ""):
        return None
    latex = formulas_of(steps_of(program, scene, "lagrange") or "")
    terms = re.split(r" (?=[+-] )", energies[wrong])
    k = rng.randrange(len(terms))
    if not any(re.search(rf"\b{name}\b", terms[k]) for name in energies["coordinates"]):
        return None
    kind = rng.choice(["sign", "factor"] + (["missing_term"] if len(terms) > 1 else []))
    if kind == "sign":
        terms[k] = f"- ({terms[k].lstrip('+ ')})" if not terms[k].startswith("-") else "+ " + terms[k][1:].strip()
    elif kind == "factor":
        terms[k] = (terms[k][:2] if terms[k][:2] in ("+ ", "- ") else "") + "2*" + terms[k].removeprefix("+ ").removeprefix("- ")
        if terms[k].startswith("2*-"):
            terms[k] = "-2*" + terms[k][3:]
    else:
        del terms[k]
    energies[wrong] = " ".join(terms).removeprefix("+ ")
    if wrong == "kinetic" and kind == "missing_term" and energies[wrong].count("'") == 0:
        return None
    head = re.split(r"^\[\[", text, maxsplit=1, flags=re.M)[0]
    head = re.sub(r"^(gravity|title|source|notes)\b.*$", "", head, flags=re.M)
    slipped = os.path.join(folder, "slipped.toml")
    with open(slipped, "w", encoding="utf-8") as file:
        file.write(head + f'\n[energy]\nkinetic = "{energies["kinetic"]}"\npotential = "{energies["potential"]}"\n')
    steps_now = steps_of(program, slipped, "lagrange")
    if steps_now is None or not latex:
        return None
    now = formulas_of(steps_now)
    if len(now) != len(latex):
        return None
    changed = [new != old for new, old in zip(now, latex)]
    first = next((i for i, one in enumerate(changed) if one), None)
    if first is None or now[first].split(" = ")[0] not in ("T", "V"):
        return None
    return now, first, {kind, "factor"} if kind == "missing_term" else {kind}, changed


def made_one(job):
    """One machine-made derivation: what was expected and what `check` said."""
    program, seed, folder = job
    rng = random.Random(seed)
    for _ in range(200):
        scene = rng.choice(SCENE_LIST)
        with open(scene, encoding="utf-8") as file:
            text = file.read()
        hand = Hand(rng, text)
        mode = rng.choice(["right", "slip", "slip", "carried", "carried"])
        follow = None
        if mode == "carried":
            with tempfile.TemporaryDirectory(dir=folder) as inner:
                made = carried(program, rng, scene, inner)
            if made is None:
                continue
            formulas, slip, kinds, follow = made
        else:
            text = steps_of(program, scene, rng.choice(FORMALISMS)) or ""
            formulas = formulas_of(text)
            slip, kinds = None, set()
            plain = [k for k, formula in enumerate(formulas) if is_plain(formula)]
            if not plain or len(formulas) > 40 or sum(map(len, formulas)) > 6000:
                continue
            if mode == "slip":
                slip = rng.choice(plain)
                changed = slip_in(rng, formulas[slip], coordinates_of(text))
                if changed is None:
                    continue
                formulas[slip], kinds = changed
        page, ending = hand.page(formulas)
        file = os.path.join(folder, f"{seed}{ending}")
        with open(file, "w", encoding="utf-8") as out:
            out.write(page)
        result, seconds, errors = checked(program, scene, file)
        return {"file": file, "scene": scene, "mode": mode, "slip": slip, "kinds": kinds, "follow": follow,
                "formulas": formulas, "result": result, "seconds": seconds, "errors": errors}  # yapf: disable
    raise RuntimeError("no derivation could be made")


SCENE_LIST = sorted(glob.glob(SCENES + "/*.toml"))


def hold_made(one, tally):
    result, slip = one["result"], one["slip"]
    name = f"{os.path.basename(one['file'])} of {os.path.basename(one['scene'])}"
    if result is None:
        return tally.add("read", False, f"{name}: {one['errors'].strip()}")
    lines = result["lines"]
    same = len(lines) == len(one["formulas"])
    tally.add("read", same, f"{name}: {len(lines)} lines instead of {len(one['formulas'])}")
    if not same:
        return None
    first = result["first_mistake"]
    if slip is None:
        tally.add("right derivations without a mistake", first is None, f"{name}: line {first}")
    else:
        tally.add("slips found at their line", first == slip,
                  f"{name}: {first} instead of {slip}: {one['formulas'][slip]}: {lines[slip]['status']} {lines[slip]['reason']}")
        if first == slip:
            tally.add("kinds of slips", kind_of(lines[slip]) in one["kinds"],
                      f"{name}: {kind_of(lines[slip])} instead of {sorted(one['kinds'])}: {one['formulas'][slip]}")
    for k, line in enumerate(lines):
        if k == slip:
            continue
        told = f"{name}:{line['line']}: {line['status']}: {one['formulas'][k]} {line['reason']}"
        if one["follow"] is not None and one["follow"][k]:
            tally.add("lines that follow", line["status"] == "follows", told)
            continue
        tally.add("right lines not called wrong", line["status"] not in WRONG, told)
        tally.add("right lines judged", line["status"] in RIGHT | {"definition", "unfounded"}, told)
    return None


def made(program, options):
    tally, times, modes = Tally(), [], []
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or temporary
        os.makedirs(folder, exist_ok=True)
        jobs = [(program, options.seed * 1_000_003 + k, folder) for k in range(options.count or 60)]
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for one in pool.map(made_one, jobs):
                hold_made(one, tally)
                modes.append(one["mode"])
                if one["result"] and one["result"]["lines"]:
                    times.append(1000 * one["seconds"] / len(one["result"]["lines"]))
    print("\n".join(tally.told[:options.show]))
    print(f"{len(jobs)} derivations ({dict(collections.Counter(modes))}), seed {options.seed}\n{tally.shown()}")
    if times:
        print(f"  milliseconds a line: median {statistics.median(times):.1f}, most {max(times):.1f}")
    return (tally.share("slips found at their line") >= 0.99 and tally.share("right lines not called wrong") == 1 and
            tally.share("right derivations without a mistake") == 1 and tally.share("read") >= 0.99)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("what", choices=["corpus", "steps", "made"])
    parser.add_argument("--only", default="", help="corpus, steps: files, or scenes and formalisms, with this in their name")
    parser.add_argument("--format", choices=["latex", "text"], default="latex", help="steps: how they are printed")
    parser.add_argument("--all", action="store_true", help="steps: all scenes of the textbook and the gallery")
    parser.add_argument("--limit", type=float, default=600, help="steps: seconds for a scene by a formalism")
    parser.add_argument("--count", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--show", type=int, default=40, help="how many failures are told")
    parser.add_argument("--keep", default="", help="a folder in which the derivations stay")
    options = parser.parse_args()
    work = {"corpus": corpus, "steps": steps, "made": made}[options.what]
    return 0 if work(os.path.realpath(options.program), options) else 1


if __name__ == "__main__":
    sys.exit(main())
