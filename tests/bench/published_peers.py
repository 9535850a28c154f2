# SPDX-License-Identifier: MIT
"""Random states of published robots and their accelerations by MuJoCo, Pinocchio and Drake, for published.py.

Each function of `states` takes a file, what `import --json` says of it, and a source of random numbers. It returns
coordinates and rates of the scene, the accelerations that the other program finds, and values of the scene's inputs;
or a text that says why it cannot.
"""

import contextlib
import math
import os
import re


def packages(*names):
    try:
        return [__import__(name) for name in names]
    except ImportError:
        return None


@contextlib.contextmanager
def silence():
    """The other programs' own messages are not printed."""
    kept, nothing = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nothing)


def product(a, b):
    return [a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]]


def turning(e, w, alpha):
    """The rates and second derivatives of a quaternion; w and alpha are along the axes of the body."""
    rate = [x / 2 for x in product(e, [0, *w])]
    second = [(x + y) / 2 for x, y in zip(product(rate, [0, *w]), product(e, [0, *alpha]))]
    return rate, second


class State:
    """Of the scene: values by name, and accelerations."""

    def __init__(self):
        self.at, self.expected = {}, {}

    def add(self, name, q, rate, second):
        self.at[name], self.at[name + "'"], self.expected[name] = float(q), float(rate), float(second)

    def add_turn(self, names, e, w, alpha):
        rate, second = turning(e, w, alpha)
        for k, name in enumerate(names):
            self.add(name, e[k], rate[k], second[k])


def by_mujoco(path, told, dice):
    if not (found := packages("mujoco")):
        return "no MuJoCo"
    mujoco = found[0]
    if "loops" in told or "couplings" in told:
        return "has constraints"
    if any("damping ratio" in warning["message"] for warning in told["warnings"]):
        return "MuJoCo 4 takes damping ratios otherwise"
    if re.search(r'\b(align|alignfree)\s*=\s*"true"', path.read_text(errors="replace")):
        return "MuJoCo moves the frames of free bodies"
    with silence():
        try:
            model = mujoco.MjModel.from_xml_path(str(path))
        except ValueError as problem:
            return "MuJoCo refuses it: " + str(problem)[:100]
    off = mujoco.mjtDisableBit
    model.opt.disableflags |= off.mjDSBL_CONTACT | off.mjDSBL_LIMIT | off.mjDSBL_CLAMPCTRL | off.mjDSBL_FRICTIONLOSS
    model.jnt_actfrclimited[:] = 0
    model.tendon_actfrclimited[:] = 0
    model.actuator_forcelimited[:] = 0
    data = mujoco.MjData(model)
    for k in range(model.nq):
        data.qpos[k] = model.qpos0[k] + dice.uniform(-0.5, 0.5)
    for k in range(model.nv):
        data.qvel[k] = dice.uniform(-1, 1)
    mujoco.mj_normalizeQuat(model, data.qpos)
    inputs = {}
    drives = dict.fromkeys(told.get("drives", []))
    for k in range(model.nu):
        name = "drive_" + re.sub(r"\W", "_", model.actuator(k).name or f"motor{k + 1}")
        if name in drives:
            inputs[name] = data.ctrl[k] = dice.uniform(-1, 1)
    names = told["names"]["coordinates"]
    joints = []
    for j in range(model.njnt):
        body = model.body(model.jnt_bodyid[j])
        several = model.body_jntnum[body.id] > 1
        k = j - model.body_jntadr[body.id] + 1
        own = model.joint(j).name or (body.name or f"body{body.id}") + (f"_joint{k}" if several else "_joint")
        joints.append(names.get(own))
        if joints[-1] is None:
            width = {0: 6, 1: 3}.get(int(model.jnt_type[j]), 1)
            data.qvel[model.jnt_dofadr[j]:model.jnt_dofadr[j] + width] = 0
    mujoco.mj_forward(model, data)
    state = State()
    for j, own in enumerate(joints):
        if own is None:
            continue
        q, v = model.jnt_qposadr[j], model.jnt_dofadr[j]
        if model.jnt_type[j] > 1:
            state.add(own[0], data.qpos[q] - model.qpos0[q], data.qvel[v], data.qacc[v])
            continue
        if model.jnt_type[j] == 0:
            for k in range(3):
                state.add(own[k], data.qpos[q + k], data.qvel[v + k], data.qacc[v + k])
            q, v, own = q + 3, v + 3, own[3:]
        state.add_turn(own, *([float(x) for x in part] for part in (
            data.qpos[q:q + 4], data.qvel[v:v + 3], data.qacc[v:v + 3])))
    return (state.at, state.expected, inputs) if state.expected else "nothing moves"


def by_pinocchio(path, told, dice):
    if not (found := packages("pinocchio", "numpy")):
        return "no Pinocchio"
    pin, np = found
    text = path.read_text(errors="replace")
    if re.search("rotor_?[iI]nertia|quat_xyzw", text):
        return "has rotors or quaternions, which Pinocchio does not read"
    with silence():
        try:
            model = pin.buildModelFromUrdf(str(path))
        except (ValueError, RuntimeError) as problem:
            return "Pinocchio refuses it: " + str(problem)[:100]
    names = told["names"]["coordinates"]
    # Coordinates of followers from those of leaders: q = G z + offset.
    follows = {}
    for joint in re.finditer(r'<joint\s[^>]*?name\s*=\s*"([^"]*)"[^>]*>(.*?)</joint>', re.sub(r"<!--.*?-->", "", text, flags=re.S),
                             re.S):
        if mimic := re.search(r"<mimic\s([^>]*)>", joint[2]):
            value = dict(re.findall(r'(\w+)\s*=\s*"([^"]*)"', mimic[1]))
            follows[joint[1]] = (value["joint"], float(value.get("multiplier", 1)), float(value.get("offset", 0)))
    order = [name for name in model.names[1:] if name in names]
    G, q, q_of = np.zeros((model.nv, len(order))), pin.neutral(model), {}
    rates = np.array([dice.uniform(-1, 1) for _ in order])
    for name in order:
        q_of[name] = dice.uniform(-0.7, 0.7)
    for k, name in enumerate(model.names[1:], 1):
        joint = model.joints[k]
        factor, offset, leader = 1, 0, name
        while leader in follows and leader not in q_of:
            leader, f, o = follows[leader]
            factor, offset = factor * f, factor * o + offset
        if joint.nv != 1:
            return "has joints with several coordinates"
        if leader not in q_of:
            value = offset if name in follows else 0
        else:
            value = factor * q_of[leader] + offset
            G[joint.idx_v, order.index(leader)] = factor
        q[joint.idx_q:joint.idx_q + joint.nq] = [value] if joint.nq == 1 else [math.cos(value), math.sin(value)]
    data = model.createData()
    v = G @ rates
    damping = np.zeros(model.nv)
    for k in range(1, model.njoints):
        damping[model.joints[k].idx_v] = model.damping[model.joints[k].idx_v]
    M = pin.crba(model, data, q)
    M = np.triu(M) + np.triu(M, 1).T
    f = -pin.nonLinearEffects(model, data, q, v) - damping * v
    try:
        second = np.linalg.solve(G.T @ M @ G, G.T @ f)
    except np.linalg.LinAlgError:
        return "has a singular mass matrix"
    state = State()
    for k, name in enumerate(order):
        state.add(names[name][0], q_of[name], rates[k], second[k])
    return (state.at, state.expected, {}) if state.expected else "nothing moves"


def by_drake(path, told, dice):
    if not (found := packages("pydrake.all", "numpy")):
        return "no Drake"
    drake, np = found[0].all, found[1]
    if "loops" in told or "couplings" in told or "<mimic" in path.read_text(errors="replace"):
        return "has constraints"
    if re.search(r"<mass>\s*0(\.0*)?\s*</mass>", path.read_text(errors="replace")):
        return "Drake takes no inertia without a mass"
    plant = drake.MultibodyPlant(0.0)
    parser = drake.Parser(plant)
    parser.SetAutoRenaming(True)
    with silence():
        try:
            parser.AddModels(str(path))
            gravity = re.search(r"<gravity>([^<]*)</gravity>", path.read_text(errors="replace"))
            in_world = "<world" in path.read_text(errors="replace")
            plant.mutable_gravity_field().set_gravity_vector(
                [float(x) for x in gravity[1].split()] if gravity and in_world else
                [0, 0, -9.8 if in_world else -9.81])
            plant.Finalize()
        except RuntimeError as problem:
            return "Drake refuses it: " + str(problem)[-100:]
    context = plant.CreateDefaultContext()
    names, moved = told["names"]["coordinates"], []
    for k in plant.GetJointIndices():
        joint = plant.get_joint(k)
        scope = plant.GetModelInstanceName(joint.model_instance()) + "::"
        own = [names[n] for n in (scope + joint.name(), joint.name()) if n in names]
        if joint.num_velocities() == 0:
            continue
        if joint.type_name() == "quaternion_floating":
            body = joint.child_body()
            own = [names[n] for n in (scope + body.name(), body.name()) if n in names]
            rpy = [dice.uniform(-1, 1) for _ in range(3)]
            plant.SetFreeBodyPose(context, body, drake.RigidTransform(
                drake.RollPitchYaw(rpy), [dice.uniform(-1, 1) for _ in range(3)]))
        elif joint.num_velocities() == 1:
            q = plant.GetPositions(context)
            q[joint.position_start()] = dice.uniform(-0.5, 0.5)
            plant.SetPositions(context, q)
        else:
            return "has joints with several coordinates"
        if len(own) != 1:
            return "a joint has no coordinate here"
        moved.append((joint, own[0]))
    v = np.array([dice.uniform(-1, 1) for _ in range(plant.num_velocities())])
    plant.SetVelocities(context, v)
    forces = drake.MultibodyForces(plant)
    plant.CalcForceElementsContribution(context, forces)
    # M v' + C v = tau, where tau holds gravity, springs and dampers.
    external = -plant.CalcInverseDynamics(context, np.zeros(len(v)), forces)
    second = np.linalg.solve(plant.CalcMassMatrix(context), external)
    state = State()
    for joint, own in moved:
        k = joint.velocity_start()
        if joint.num_velocities() == 1:
            state.add(own[0], joint.GetOnePosition(context), v[k], second[k])
            continue
        body = joint.child_body()
        pose = plant.EvalBodyPoseInWorld(context, body)
        R = pose.rotation().matrix()
        for i in range(3):
            state.add(own[i], pose.translation()[i], v[k + 3 + i], second[k + 3 + i])
        e = pose.rotation().ToQuaternion().wxyz()
        state.add_turn(own[3:], [float(x) for x in e], list(R.T @ v[k:k + 3]), list(R.T @ second[k:k + 3]))
    return (state.at, state.expected, {}) if state.expected else "nothing moves"


states = {"MJCF": by_mujoco, "URDF": by_pinocchio, "SDF": by_drake}
