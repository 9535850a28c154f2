# SPDX-License-Identifier: MIT
"""Random valid scenes over the tables of the language, as dictionaries, and their text.

A scene is one mechanism (a kind below) with random additions: springs and dampers, loads, inputs, definitions,
generalized speeds, events, contacts, friction, numbers from 1e-9 to 1e9 as centres, names and units that are awkward
elsewhere. The same seed gives the same scene.
"""

import json
import random

AWKWARD = ["EOF", "NAN", "M_PI", "errno", "int", "lambda", "I", "E", "new", "y0", "signal", "stdin", "θ0", "par", "Real"]


def number(rng, low, high):
    """A decimal with few or many digits."""
    return float(f"{rng.uniform(low, high):.{rng.choice([1, 2, 3, 16])}g}")


class Draft:
    """A scene while it is made; `size` is that of its lengths."""

    def __init__(self, seed):
        self.rng = random.Random(seed)
        self.scene = {"title": f"cross-examination {seed}", "parameters": {}, "coordinates": {}}
        self.points = []  # (name, is in space)
        self.frames = []
        self.has_contacts = self.has_constraints = False
        rng = self.rng
        self.in_symbols = rng.random() < 0.5
        self.names = rng.sample(AWKWARD, len(AWKWARD)) if rng.random() < 0.2 else []

    def add(self, table, **entry):
        self.scene.setdefault(table, []).append(entry)

    def amount(self, name, low, high):
        """A number, as a parameter or as it is."""
        value = number(self.rng, low, high)
        if not self.in_symbols and self.rng.random() < 0.7:
            return value
        name = self.names.pop() if self.names and self.rng.random() < 0.5 else name
        while name in self.scene["parameters"] or name in self.scene["coordinates"]:
            name += "_"
        if self.rng.random() < 0.15:
            text = self.rng.choice([{}, {"about": "a */ int x; /*"}, {"unit": "m/s^2"}])
            self.scene["parameters"][name] = {"value": value, "unit": "kg", **text}
        else:
            self.scene["parameters"][name] = value
        return name

    def coordinate(self, name, initial, rate, **entry):
        self.scene["coordinates"][name] = {"initial": initial, "rate": rate, **entry}
        return name

    def centre(self):
        """A number that a coordinate starts near: 0, or one of any size."""
        if self.rng.random() < 0.6:
            return 0.0
        return float(f"{self.rng.choice([-1, 1]) * 10 ** self.rng.uniform(-9, 9):.{self.rng.choice([2, 4])}g}")

    def chance(self, share):
        return self.rng.random() < share


def pendulums(d):
    """Particles on rods one after another, on a cart or a driven support."""
    rng = d.rng
    support = rng.choice(["none", "cart", "driven"])
    d.scene["gravity"] = [0, f"-{d.amount('g', 1, 12)}"]
    before = "O"
    if support == "cart":
        x0 = d.centre()
        d.coordinate("x", x0 + number(rng, -0.2, 0.2), number(rng, -1, 1))
        d.add("particle", name="cart", mass=d.amount("M", 0.5, 3), position=["x", 0])
        k = d.amount("k", 1, 20)
        d.scene.setdefault("energy", {})["potential"] = f"{k}*(x - {x0})^2/2".replace("- -", "+ ")
        before = "cart"
    elif support == "driven":
        w = number(rng, 0.5, 5)
        d.scene["inputs"] = {"s": f"{number(rng, 0.01, 0.2)}*sin({w}*t)"}
        d.add("point", name="support", offset=["s", 0] if d.chance(0.5) else [0, "s"])
        before = "support"
    for k in range(1, rng.choice([1, 1, 2, 2, 3]) + 1):
        q = d.coordinate(f"q{k}", number(rng, -1.5, 1.5), number(rng, -1, 1))
        l = d.amount(f"l{k}", 0.3, 1.5)
        d.add("particle", name=f"P{k}", mass=d.amount(f"m{k}", 0.2, 2), position=[f"{l}*sin({q})", f"-{l}*cos({q})"],
              **({} if before == "O" else {"from": before}))
        before = f"P{k}"
        d.points.append(before)


def planets(d):
    """Particles in plane or space with springs and potentials about numbers of any size."""
    rng = d.rng
    axes = "xyz"[: rng.choice([1, 2, 2, 3])]
    terms = []
    for k in range(1, rng.choice([1, 1, 2]) + 1):
        place = []
        for axis in axes:
            c = d.centre()
            q = d.coordinate(f"{axis}{k}", c + number(rng, -1, 1) * max(1, abs(c) * 1e-9), number(rng, -1, 1))
            place.append(q)
            away = f"({q} - {c})" if c >= 0 else f"({q} + {-c})"
            terms.append(rng.choice([f"{d.amount('k', 0.5, 9)}*{away}^2/2", f"{d.amount('a', 0.1, 2)}*{away}^4/4",
                                     f"{number(rng, 0.1, 2)}*cosh({away})", f"-{number(rng, 0.1, 1)}*exp(-{away}^2)",
                                     f"{number(rng, 0.1, 2)}*sqrt({away}^2 + {number(rng, 0.1, 1)})",
                                     f"-0.5/({away}^2 + {number(rng, 0.05, 1)})"]))
        d.add("particle", name=f"P{k}", mass=d.amount(f"m{k}", 0.3, 3), position=place + [0] * (2 - len(place)))
        if abs(sum(c["initial"] for c in d.scene["coordinates"].values())) < 10:
            d.points.append(f"P{k}")
    d.scene["energy"] = {"potential": " + ".join(terms)}


def arm(d):
    """Bodies on joints in the plane or in space."""
    rng = d.rng
    flat = d.chance(0.5)
    d.scene["gravity"] = [0, f"-{d.amount('g', 1, 12)}", 0] if flat else [0, 0, f"-{d.amount('g', 1, 12)}"]
    parent = "N"
    for k in range(1, rng.choice([1, 2, 2, 3]) + 1):
        kind = rng.choice(["revolute", "revolute", "prismatic"] + ([] if flat else ["universal", "cylindrical", "screw",
                                                                                   "spherical"]))
        count = {"universal": 2, "cylindrical": 2, "spherical": 3}.get(kind, 1)
        q = {f"q{k}{'abc'[i] if count > 1 else ''}": {"initial": number(rng, 0.1, 0.9), "rate": number(rng, -1, 1)}
             for i in range(count)}
        l = d.amount(f"l{k}", 0.3, 1.2)
        joint = {"name": f"J{k}", "type": kind, "parent": parent, "child": f"B{k}", "coordinates": q,
                 "child_point": [f"-{l}/2", 0, 0]}
        if parent != "N":
            joint["parent_point"] = [number(rng, 0.1, 0.5), 0, 0]
        if kind == "spherical":
            joint["angles"] = rng.choice(["zxz", "xyz", "zyx"])
        if not flat:
            joint["parent_rotate"] = [[rng.choice("xyz"), number(rng, -1, 1)]]
            if d.chance(0.3):
                joint["child_rotate"] = [[[1, number(rng, -1, 1), 0.5], "pi/3"]]
        if kind == "prismatic":
            joint["axis"] = rng.choice(["x", "y"]) if flat else rng.choice([[1, 2, 2], "x", [0, 3, 4]])
        if kind == "screw":
            joint["pitch"] = number(rng, 0.01, 0.3)
        if count == 1 and d.chance(0.3):
            joint["drive"] = {next(iter(q)): f"-{number(rng, 0.1, 1)}*{next(iter(q))}'"}
        if count == 1 and d.chance(0.2):
            joint["armature"] = {next(iter(q)): number(rng, 0.01, 0.5)}
        d.add("joint", **joint)
        i = [number(rng, 0.02, 0.2) for _ in range(3)]
        inertia = d.amount(f"J{k}z", 0.02, 0.3) if flat else rng.choice(
            [[0.1 + i[0], 0.12 + i[1], 0.11 + i[2]], {"xx": 0.3 + i[0], "yy": 0.25, "zz": 0.28 + i[2], "xy": 0.02, "zx": -0.01}])
        d.add("body", name=f"B{k}", mass=d.amount(f"m{k}", 0.3, 2), inertia=inertia)
        parent = f"B{k}"
        d.points.append(parent)
        d.frames.append(parent)


def top(d):
    """A body that turns about a point by three angles or a quaternion."""
    rng = d.rng
    d.scene["gravity"] = [0, 0, f"-{d.amount('g', 1, 12)}"]
    if d.chance(0.5):
        q = [d.coordinate(name, number(rng, 0.4, 1.2), number(rng, -2, 2)) for name in ("psi", "theta", "phi")]
        d.add("frame", name="B", rotate=[[axis, angle] for axis, angle in zip(rng.choice(["zxz", "zyx", "xyz"]), q)])
    else:
        e = [1] + [number(rng, -0.5, 0.5) for _ in range(3)]
        size = sum(x * x for x in e) ** 0.5
        w = [number(rng, -2, 2) for _ in range(3)]
        e = [x / size for x in e]
        rates = [-(e[1] * w[0] + e[2] * w[1] + e[3] * w[2]) / 2, (e[0] * w[0] + e[2] * w[2] - e[3] * w[1]) / 2,
                 (e[0] * w[1] + e[3] * w[0] - e[1] * w[2]) / 2, (e[0] * w[2] + e[1] * w[1] - e[2] * w[0]) / 2]
        q = [f"e{k}" for k in range(4)]
        for name, value, rate in zip(q, e, rates):
            d.scene["coordinates"][name] = {"guess": value, "rate_guess": rate}
        d.add("frame", name="B", quaternion=q)
        d.has_constraints = True
    i = [0.3 + number(rng, 0, 0.1) for _ in range(3)]
    d.add("body", name="top", mass=d.amount("m", 0.5, 2), frame="B", inertia=i, axes="B",
          position=[0, 0, d.amount("l", 0.1, 0.5)])
    d.points.append("top")
    d.frames.append("B")


def loop(d):
    """A closed linkage of three bars in the plane, or a triangle of rods, closed by constraints with guesses."""
    rng = d.rng
    d.scene["gravity"] = [0, f"-{d.amount('g', 1, 12)}"]
    d.has_constraints = True
    if d.chance(0.5):
        lengths = [d.amount(f"l{k}", low, low + 0.4) for k, low in ((1, 0.4), (2, 1.2), (3, 0.9))]
        way = 1.2
        for k, angle in ((1, number(rng, 1.0, 2.0)), (2, number(rng, 0.3, 0.5)), (3, number(rng, 1.2, 1.7))):
            d.scene["coordinates"][f"q{k}"] = ({"initial": angle, "rate": number(rng, -1, 1)} if k == 1
                                               else {"guess": angle, "rate_guess": 0})
        tips = [f"{l}*cos(q{k})" for k, l in enumerate(lengths, 1)], [f"{l}*sin(q{k})" for k, l in enumerate(lengths, 1)]
        d.add("particle", name="P1", mass=d.amount("m1", 0.3, 2), position=[tips[0][0], tips[1][0]])
        d.add("particle", name="P2", mass=d.amount("m2", 0.3, 2), **{"from": "P1"}, position=[tips[0][1], tips[1][1]])
        d.add("constraint", name="across", holonomic=f"{tips[0][0]} + {tips[0][1]} = {way} + {tips[0][2]}")
        d.add("constraint", name="up", holonomic=f"{tips[1][0]} + {tips[1][1]} = {tips[1][2]}")
        d.points += ["P1", "P2"]
        return
    centre = d.centre() if d.chance(0.5) else 0.0
    l = d.amount("l", 0.5, 2)
    shifted = f"(x - {centre})" if centre >= 0 else f"(x + {-centre})"
    d.scene["coordinates"]["x"] = {"guess": centre + number(rng, 0.3, 0.9), "rate_guess": number(rng, -1, 1)}
    d.scene["coordinates"]["y"] = {"guess": number(rng, -1.5, -0.5), "rate_guess": 0}
    d.add("particle", name="P1", mass=d.amount("m", 0.3, 2), position=["x", "y"])
    d.add("constraint", name="rod", holonomic=rng.choice([f"{shifted}^2 + y^2 = {l}^2", f"sqrt({shifted}^2 + y^2) = {l}",
                                                          f"y = -{l}*cosh({shifted}/{l})", f"y = {l}*{shifted}^2 - 1.5"]))


def blade(d):
    """A body on a plane with a blade or a wheel."""
    rng = d.rng
    d.has_constraints = True
    d.coordinate("x", 0.0, 0.0)
    d.scene["coordinates"]["x"] = {"initial": d.centre(), "rate_guess": number(rng, 0.2, 1)}
    d.scene["coordinates"]["y"] = {"initial": 0.0, "rate_guess": 0.3}
    d.coordinate("phi", number(rng, -1, 1), number(rng, -2, 2))
    a = d.amount("a", 0.05, 0.4)
    d.add("frame", name="H", rotate=[["z", "phi"]])
    d.add("body", name="sled", mass=d.amount("m", 0.5, 2), frame="H", inertia=d.amount("J", 0.1, 1),
          position=[f"x + {a}*cos(phi)", f"y + {a}*sin(phi)"])
    d.add("constraint", name="blade", nonholonomic=f"x'*sin(phi) - y'*cos(phi) = {rng.choice(['0', '0.1*sin(t)'])}")
    d.add("force", at="sled", vector=[number(rng, -1, 1), 0], axes="H")
    d.frames.append("H")


def made(d):
    """Energies given as they are."""
    rng = d.rng
    c = d.centre() if d.chance(0.5) else 0.0
    d.coordinate("u", c + number(rng, -0.8, 0.8), number(rng, -1, 1))
    d.coordinate("v", number(rng, -0.8, 0.8), number(rng, -1, 1))
    away = f"(u - {c})" if c >= 0 else f"(u + {-c})"
    kinetic = f"{d.amount('A', 0.5, 2)}*u'^2/2 + (1 + {number(rng, 0.1, 0.5)}*sin({away}))*v'^2/2 + 0.2*u'*v'*cos(v)"
    potential = f"{d.amount('k', 1, 9)}*{away}^2/2 + {number(rng, 0.5, 2)}*{rng.choice(['v^2', 'cosh(v)', '(v^4 + v^2)'])}"
    d.scene["energy"] = (dict(kinetic=kinetic, potential=potential) if d.chance(0.5)
                         else dict(lagrangian=f"{kinetic} - ({potential})"))


def falling(d):
    """Particles over floors and between walls."""
    rng = d.rng
    d.has_contacts = True
    d.scene["gravity"] = [0, f"-{d.amount('g', 2, 12)}"]
    c = d.centre()
    d.coordinate("x", c, number(rng, -2, 2))
    d.coordinate("y", number(rng, 0.3, 1.5), number(rng, -1, 1))
    d.add("particle", name="ball", mass=d.amount("m", 0.3, 2), position=["x", "y"])
    d.add("unilateral", name="floor", gap=rng.choice(["y", "y + 0.05*sin(3*t) + 0.1"]), restitution=number(rng, 0.5, 0.95))
    away = f"(x - {c})" if c >= 0 else f"(x + {-c})"
    d.add("unilateral", name="wall", gap=f"1.1 - {away}", restitution=number(rng, 0.3, 1))


def sliding(d):
    """A block on a belt or a slope with dry friction and a spring."""
    rng = d.rng
    d.has_contacts = True
    c = d.centre()
    d.coordinate("s", c + number(rng, -1, 1), number(rng, 0.2, 1.5))
    away = f"(s - {c})" if c >= 0 else f"(s + {-c})"
    d.add("particle", name="block", mass=1, position=["s", 0])
    d.scene["energy"] = {"potential": f"{d.amount('k', 1, 9)}*{away}^2/2"}
    d.add("friction", name="belt", coefficient=d.amount("mu", 0.1, 0.5), slip=rng.choice(["s'", "s' - 0.4", "s' - 0.2*sin(t)"]),
          normal=number(rng, 0.5, 3))


def drifting(d):
    """Motions that are easy to follow in long steps, past things that are narrow or repeat."""
    rng = d.rng
    c = d.centre() if d.chance(0.3) else 0.0
    d.coordinate("x", c + number(rng, -1, 1), number(rng, 0.5, 2))
    d.add("particle", name="P1", mass=d.amount("m", 0.5, 2), position=["x", 0])
    away = f"(x - {c})" if c >= 0 else f"(x + {-c})"
    force = rng.choice(["none", "spring", "far"])
    if force == "spring":
        d.scene["energy"] = {"potential": f"{d.amount('k', 0.5, 5)}*{away}^2/2"}
    elif force == "far":
        place = [float(f"{10 ** rng.uniform(2, 6):.3g}"), float(f"{10 ** rng.uniform(2, 6):.3g}")]
        length = (place[0] ** 2 + place[1] ** 2) ** 0.5
        d.add("point", name="far", offset=place)
        d.add("spring", between=["far", "P1"], stiffness=0.1, length=float(f"{length:.9g}"))
    when = rng.choice([f"cos({number(rng, 2, 20)}*{away})", f"sin({number(rng, 5, 25)}*{away} + 0.3)"])
    event = dict(name="tick", when=when)
    if d.chance(0.5):
        event["impulses"] = {"x": f"{number(rng, 0.01, 0.05)}*x'"}
    d.add("event", **event)


def flat(d):
    """A parallelogram that turns through its flat poses."""
    rng = d.rng
    d.has_constraints = True
    l, way = number(rng, 0.5, 1.2), number(rng, 1, 2)
    start = number(rng, 0.5, 1.2)
    d.scene["coordinates"].update({"q0": {"initial": start, "rate": number(rng, 2, 4)}, "q1": {"guess": 0.0, "rate_guess": 0.0},
                                   "q2": {"guess": start, "rate_guess": 3.0}})
    d.add("particle", name="P1", mass=1, position=[f"{l}*cos(q0)", f"{l}*sin(q0)"])
    d.add("particle", name="P2", mass=number(rng, 0.5, 2), **{"from": "P1"}, position=[f"{way}*cos(q1)", f"{way}*sin(q1)"])
    d.add("constraint", name="across", holonomic=f"{l}*cos(q0) + {way}*cos(q1) = {way} + {l}*cos(q2)")
    d.add("constraint", name="up", holonomic=f"{l}*sin(q0) + {way}*sin(q1) = {l}*sin(q2)")


def bouncing(d):
    """A ball that an event throws back."""
    rng = d.rng
    d.scene["gravity"] = [0, f"-{number(rng, 5, 12)}"]
    d.coordinate("h", number(rng, 0.5, 2), 0.0)
    d.add("particle", name="ball", mass=1, position=[0, "h"])
    d.add("event", name="floor", when="h", direction="down", impulses={"h": f"-{number(rng, 1.6, 1.9)}*h'"})


KINDS = {f.__name__: f for f in (pendulums, planets, arm, top, loop, blade, made, falling, sliding, drifting, flat, bouncing)}


def _loads(d):
    rng, q = d.rng, list(d.scene["coordinates"])
    near = [name for name in q if abs(d.scene["coordinates"][name].get("initial", 1)) < 10]
    if d.points and d.chance(0.4):
        place = [number(rng, -1, 1), number(rng, 1, 2)]
        d.add("point", name="anchor", offset=place)
        d.add("spring", between=["anchor", rng.choice(d.points)], stiffness=d.amount("ks", 1, 20), length=d.amount("l0", 0.2, 1))
    if d.points and d.chance(0.3):
        d.add("damper", between=["O", rng.choice(d.points)], damping=d.amount("c", 0.05, 0.5))
    if d.points and d.chance(0.3):
        if d.chance(0.5):
            d.scene.setdefault("inputs", {})["F"] = f"{number(rng, 0.1, 2)}*{rng.choice(['cos(3*t)', 'exp(-t)', 'sin(t)^2', 't'])}"
            d.add("force", at=rng.choice(d.points), vector=["F", 0, 0])
        else:
            d.add("force", at=rng.choice(d.points), vector=[0, number(rng, -1, 1), 0])
    if d.frames and d.chance(0.3):
        d.add("torque", on=rng.choice(d.frames), vector=[0, 0, number(rng, -0.5, 0.5)])
    if q and d.chance(0.25):
        name = rng.choice(q)
        d.scene.setdefault("forces", {})[name] = f"-{d.amount('cq', 0.05, 0.5)}*{name}'" + (f"*abs({name}')" if d.chance(0.3) else "")
    if near and d.chance(0.15):
        d.scene["definitions"] = {"bend": f"sin({rng.choice(near)})"}
        name = rng.choice(near)
        d.scene.setdefault("forces", {}).setdefault(name, "0.3*bend")
    if q and d.chance(0.15):
        d.scene["dissipation"] = {"rayleigh": f"{d.amount('cr', 0.05, 0.4)}*{rng.choice(q)}'^2/2"}


def _speeds(d):
    q = list(d.scene["coordinates"])
    if d.has_constraints or d.has_contacts or d.scene.get("joint") or len(q) < 2 or not d.chance(0.25):
        return
    if d.chance(0.5):
        angle = number(d.rng, 0, 1.5)
        d.scene["speeds"] = {"w1": f"{q[0]}'*cos({angle}) + {q[1]}'*sin({angle})", "w2": f"{q[1]}'*cos({angle}) - {q[0]}'*sin({angle})"}
        d.scene["speeds"].update({f"w{k + 1}": f"{name}'" for k, name in enumerate(q) if k > 1})
    else:
        d.scene["speeds"] = {f"w{k + 1}": f"{2 + k}*{name}'" for k, name in enumerate(q)}


def _events(d):
    """Zeros of something that changes fast along the motion; some kick."""
    rng, q = d.rng, list(d.scene["coordinates"])
    if not q or not d.chance(0.5):
        return
    name = rng.choice(q)
    entry = d.scene["coordinates"][name]
    c = entry.get("initial", entry.get("guess"))
    away = f"({name} - {c})" if c >= 0 else f"({name} + {-c})"
    wave = number(rng, 2, 25)
    when = rng.choice([f"cos({wave}*{away} + 1.3)", f"sin({wave}*{away} + 0.7) - 0.5", f"{away}^2 - {number(rng, 0.01, 0.1)}",
                       f"sin({number(rng, 3, 12)}*t + 0.5) - 0.3*cos({away})"])
    event = dict(name="tick", when=when, direction=rng.choice(["both", "up", "down"]))
    if d.chance(0.4) and not d.has_constraints and not d.has_contacts:
        event["impulses"] = {name: f"{number(rng, 0.005, 0.05)}*sign({name}')"}
    d.add("event", **event)


def _states(d, rng):
    """A first-order state that follows a coordinate and acts on it, by draws of their own."""
    near = [name for name, e in d.scene["coordinates"].items() if abs(e.get("initial", e.get("guess", 1))) < 10]
    if not near or rng.random() >= 0.35:
        return
    name = rng.choice(near)
    rate = rng.choice([f"{name}' - {number(rng, 0.2, 2)}*zs1", f"({name} - zs1)/{number(rng, 0.1, 0.8)}",
                       f"{number(rng, 0.1, 1)}*sin({name}) - {number(rng, 0.1, 1)}*zs1*{name}'"])
    d.scene["states"] = {"zs1": {"rate": rate, "initial": number(rng, -0.5, 0.5)}}
    if rng.random() < 0.4:
        d.scene["states"]["zs2"] = {"rate": f"zs1 - {number(rng, 0.5, 3)}*zs2"}
    forces = d.scene.setdefault("forces", {})
    last = list(d.scene["states"])[-1]
    forces[name] = (f"{forces[name]} " if name in forces else "") + f"- {number(rng, 0.1, 1)}*{last}"


def _tables(d, rng):
    """A force by points over a coordinate that starts among them, by draws of their own: also over its rate or a second
    argument, with a period, and with a pulse that no step may pass."""
    near = [name for name, e in d.scene["coordinates"].items() if abs(e.get("initial", e.get("guess", 1))) < 10]
    if not near or rng.random() >= 0.3:
        return
    name = rng.choice(near)
    entry = d.scene["coordinates"][name]
    x, points = entry.get("initial", entry.get("guess")) - number(rng, 1, 2), []
    for _ in range(rng.randint(4, 8)):
        points.append([float(f"{x:.6g}"), number(rng, -1, 1)])
        x += number(rng, 0.2, 0.9)
    how, argument = rng.choice(["linear", "cubic", "pchip"]), name
    table = {"arguments": ["s"], "interpolation": how, "outside": "line", "points": points}
    kind = rng.choice(["plain", "plain", "narrow", "grid", "rate", "period"])
    if kind == "narrow":
        table["interpolation"], k = "linear", rng.randint(1, len(points) - 1)
        width = 10 ** -rng.uniform(2, 4)
        middle = (points[k - 1][0] + points[k][0]) / 2
        base = (points[k - 1][1] + points[k][1]) / 2
        points[k:k] = [[middle, base], [middle + width, base + number(rng, 0.02, 0.1) / width], [middle + 2 * width, base]]
    elif kind == "grid":
        table.update(arguments=["s", "r"], interpolation="linear")
        table["points"] = [[x, r, float(f"{y * (1 + 0.3 * r):.6g}")] for x, y in points for r in (-0.7, 0.2, 1.5)]
        argument = f"{name}, {rng.choice(['t', name + chr(39)])}"
    elif kind == "rate":
        argument = f"{name}'"
    elif kind == "period":
        del table["outside"]
        table["period"] = float(f"{points[-1][0] - points[0][0] + number(rng, 0.2, 0.9):.6g}")
    d.scene["tables"] = {"by_points": table}
    forces = d.scene.setdefault("forces", {})
    forces[name] = (f"{forces[name]} " if name in forces else "") + f"- {number(rng, 0.1, 1)}*by_points({argument})"


def has_close_knots(scene):
    """Whether a table has knots that only a run which ends steps there is sure to see."""
    return any(b[0] - a[0] < 0.03 for table in scene.get("tables", {}).values() if len(table["arguments"]) == 1
               for a, b in zip(table["points"], table["points"][1:]))


def _modes(d, rng):
    """What is measured at instants is held between them, a counter counts these, and another event resets it."""
    near = [name for name, e in d.scene["coordinates"].items() if abs(e.get("initial", e.get("guess", 1))) < 10]
    if not near or d.scene.get("friction") or rng.random() >= 0.25:
        return
    name = rng.choice(near)
    states = d.scene.setdefault("states", {})
    states["held"] = {"initial": number(rng, -0.3, 0.3)}
    states["passed"] = {}
    forces = d.scene.setdefault("forces", {})
    forces[name] = (f"{forces[name]} " if name in forces else "") + f"- {number(rng, 0.1, 1)}*held"
    d.add("event", name="sample", when=f"sin({number(rng, 4, 15)}*t + 0.4)", set={"held": f"{name}'", "passed": "passed + 1"})
    reset = dict(name="reset", when="passed - 2.5", direction="up", set={"passed": 0})
    if not d.has_constraints and not d.has_contacts and "speeds" not in d.scene and rng.random() < 0.5:
        reset["rates"] = {name: f"{number(rng, 0.7, 1.1)}*{name}'"}
    d.add("event", **reset)


def make(seed):
    """(kind, scene) of a seed."""
    d = Draft(seed)
    kind = d.rng.choice(list(KINDS))
    KINDS[kind](d)
    if kind not in ("drifting", "flat", "bouncing"):
        _loads(d)
        _speeds(d)
        _events(d)
        _states(d, random.Random(seed * 31 + 5))
        _tables(d, random.Random(seed * 37 + 11))
        _modes(d, random.Random(seed * 41 + 13))
    d.scene["simulation"] = {"duration": number(d.rng, 1, 4), "tolerance": 10.0 ** -d.rng.choice([7, 9, 10, 12])}
    for table in ("coordinates", "parameters"):
        if not d.scene[table]:
            del d.scene[table]
    return kind, d.scene


def _value(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    return repr(value).lower() if isinstance(value, bool) else repr(value)


def _key(name):
    return name if name.replace("_", "a").isalnum() and name.isascii() else json.dumps(name, ensure_ascii=False)


def text(scene):
    """The scene in TOML."""
    plain = [f"{_key(k)} = {_value(v)}" for k, v in scene.items() if not isinstance(v, dict)
             and not (isinstance(v, list) and v and isinstance(v[0], dict))]
    for key, table in scene.items():
        if isinstance(table, dict):
            plain += ["", f"[{key}]"] + [f"{_key(k)} = {_value(v)}" for k, v in table.items()]
        elif isinstance(table, list) and table and isinstance(table[0], dict):
            for entry in table:
                plain += ["", f"[[{key}]]"] + [f"{_key(k)} = {_value(v)}" for k, v in entry.items()]
    return "\n".join(plain) + "\n"
