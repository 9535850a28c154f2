// SPDX-License-Identifier: MIT
// Imported MJCF against MuJoCo itself, which shares nothing with this program: accelerations at random states,
// with motors, and of closed loops by MuJoCo's own mass matrix and Jacobian of constraints. Compiled where CMake
// finds it.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Dense>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>

#include "alembert/base/dense.hpp"
#include "json.hpp"
#include "program.hpp"
#include "scenes.hpp"

namespace commands_mujoco {

using alembert::test::contents;
using alembert::test::Json;
using alembert::test::json_of;
using alembert::test::run;
using alembert::test::temporary;

namespace {

constexpr double tolerance = 1e-10;
/// MuJoCo turns a full tensor and the sum of several shapes to principal axes, with eigenvectors to about 1e-7
/// only.
constexpr double with_principal_axes = 1e-6;

const char* const arm = R"(<mujoco model="arm">
  <compiler angle="degree" eulerseq="zyx" autolimits="true"/>
  <option gravity="0.5 -0.3 -9.7" timestep="0.01"/>
  <default>
    <joint damping="0.3" armature="0.02"/>
    <geom density="700" rgba="1 0 0 1"/>
    <default class="heavy"><geom density="3000"/><joint armature="0.1"/></default>
  </default>
  <worldbody>
    <geom type="plane" size="5 5 0.1"/>
    <body name="base" pos="0.1 0.2 0.3" euler="20 -30 40">
      <joint name="yaw" axis="0 0 2" pos="0.05 -0.02 0.1" range="-90 120"/>
      <geom type="cylinder" size="0.1 0.2" pos="0.1 0 0"/>
      <body name="block" pos="0 0.1 0.2" euler="10 20 30"><geom type="box" size="0.1 0.05 0.2" class="heavy"/></body>
      <body name="upper" pos="0 0.1 0.4" quat="0.9 0.1 -0.3 0.2" childclass="heavy">
        <joint name="shoulder" axis="0 1 0.3" ref="15" stiffness="4" springref="40" damping="0.7"/>
        <joint name="slide" type="slide" axis="1 0 0.2" pos="0.3 0 0" stiffness="20" springref="0.1"/>
        <geom type="capsule" fromto="0 0 0 0.4 0.1 0.2" size="0.05"/>
        <body name="knob" pos="0.4 0.1 0.2"><geom type="sphere" size="0.08" mass="0.4"/></body>
        <site name="tool" pos="0.4 0.1 0.2" euler="0 90 0"/>
        <body name="fork" pos="0.4 0.1 0.2" axisangle="1 1 0 50">
          <inertial pos="0.1 -0.05 0.02" mass="0.8" quat="0.5 0.1 0.3 -0.2" diaginertia="0.02 0.03 0.025"/>
          <geom type="ellipsoid" size="0.1 0.2 0.3"/>
          <body name="plate" pos="0 0 0.1" xyaxes="1 0.1 0 0 1 0.2">
            <geom type="ellipsoid" size="0.1 0.05 0.15"/>
          </body>
          <body name="wrist" pos="0.2 0 0" zaxis="1 0.5 2">
            <joint name="roll" axis="1 0 0"/>
            <joint name="pitch" axis="0 1 0" pos="0 0 0.05"/>
            <inertial pos="0 0 0.1" quat="0.8 0.6 0 0" mass="0.3" diaginertia="0.002 0.003 0.001"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor name="m1" joint="yaw" gear="30"/>
    <position name="p" joint="shoulder" kp="7" gear="2" ctrlrange="-1 1"/>
    <velocity name="v" joint="roll" kv="3"/>
    <general name="g" joint="slide" gainprm="4" biastype="affine" biasprm="0.3 -5 -0.6" gear="1.5"/>
    <motor name="m2" joint="yaw" gear="-0.5"/>
  </actuator>
</mujoco>
)";

const char* const merged = R"(<mujoco model="merged">
  <compiler boundmass="0.5" settotalmass="20"/>
  <worldbody>
    <body name="base">
      <joint name="a" axis="1 2 3"/>
      <geom type="cylinder" size="0.1 0.2" pos="0.1 0 0"/>
      <geom type="box" size="0.1 0.05 0.2" pos="0 0.1 0.2" euler="10 20 30"/>
      <body name="arm" pos="0.3 0 0">
        <joint name="b" axis="0 1 1"/>
        <inertial pos="0.1 -0.05 0.02" mass="0.8" fullinertia="0.2 0.3 0.25 0.04 -0.03 0.02"/>
      </body>
    </body>
  </worldbody>
</mujoco>
)";

const char* const floating = R"(<mujoco model="walker">
  <worldbody>
    <body name="trunk" pos="0.3 -0.2 1.1" euler="10 20 30">
      <freejoint name="root"/>
      <geom type="box" size="0.3 0.2 0.1" pos="0.02 0.01 -0.03"/>
      <body name="left" pos="0.1 0.2 -0.1" euler="0 25 0">
        <joint name="hip" type="ball" pos="0 0 0.02"/>
        <geom type="capsule" size="0.04 0.15" pos="0 0 -0.2"/>
        <body name="shin" pos="0 0 -0.4">
          <joint name="knee" axis="0 1 0" damping="0.2" armature="0.01"/>
          <geom type="capsule" size="0.03 0.15" pos="0 0.01 -0.2"/>
        </body>
      </body>
    </body>
    <body name="crate" pos="2 0 0.5">
      <freejoint/>
      <geom type="box" size="0.1 0.2 0.3"/>
    </body>
  </worldbody>
</mujoco>
)";

// Tendons with their lengths of rest from the file, from the pose of the springs, and with play; through sites of
// bodies and of the world, over a pulley; springs by time constants; dampers and rotors of joints in space.
const char* const tied = R"(<mujoco model="tied">
  <compiler angle="radian"/>
  <default>
    <geom type="capsule" size="0.05 0.1"/>
    <tendon stiffness="30" damping="0.7"/>
    <default class="soft"><tendon stiffness="3"/></default>
  </default>
  <worldbody>
    <site name="hook" pos="0.3 -0.4 1.5"/>
    <body name="trunk" pos="0.3 -0.2 1.1" euler="0.2 0.3 -0.4">
      <joint name="root" type="free" damping="0.8" armature="0.3"/>
      <geom pos="0.02 0.01 -0.03"/>
      <site name="eye" pos="0.1 0.05 0.2"/>
      <site name="back" pos="-0.1 0.02 0.1"/>
      <body name="left" pos="0.1 0.2 -0.1" euler="0 0.4 0">
        <joint name="hip" type="ball" pos="0 0 0.02" damping="0.4" armature="0.05"/>
        <geom pos="0 0 -0.2"/>
        <site name="knuckle" pos="0.02 0 -0.3"/>
        <body name="shin" pos="0 0 -0.4">
          <joint name="knee" axis="0 1 0.2" springdamper="0.3 0.8" ref="0.2" springref="0.4" armature="0.01"/>
          <joint name="slip" type="slide" axis="0 0.1 1" springref="0.1" damping="0.2"/>
          <geom pos="0 0.01 -0.2"/>
          <site name="toe" pos="0 0.05 -0.4"/>
        </body>
      </body>
      <body name="right" pos="0.1 -0.2 -0.1">
        <joint name="arm" type="ball"/>
        <geom pos="0 0 -0.2"/>
        <body name="hand" pos="0 0 -0.4">
          <joint name="bend" axis="1 0 0" springdamper="0.5 1.2" damping="99" ref="-0.3"/>
          <geom pos="0 0.1 -0.1"/>
        </body>
      </body>
    </body>
  </worldbody>
  <tendon>
    <fixed name="cord" springlength="0.5"><joint joint="knee" coef="0.6"/><joint joint="bend" coef="-1.5"/></fixed>
    <fixed name="rest" class="soft"><joint joint="knee" coef="2"/><joint joint="slip" coef="3"/></fixed>
    <spatial name="string"><site site="hook"/><site site="eye"/><site site="back"/><site site="knuckle"/></spatial>
    <spatial name="rope" springlength="0.1" damping="0">
      <site site="hook"/><site site="toe"/><pulley divisor="2"/><site site="eye"/><site site="toe"/><site site="hook"/>
    </spatial>
    <spatial name="plain" stiffness="0" damping="0" rgba="1 0 0 1"><site site="hook"/><site site="eye"/></spatial>
  </tendon>
  <actuator>
    <position name="pull" tendon="cord" kp="5" gear="1.5"/>
    <motor name="twist" tendon="rest" gear="2"/>
  </actuator>
</mujoco>
)";

const char* const loops = R"(<mujoco model="loops">
  <compiler angle="radian"/>
  <default><geom type="capsule" size="0.02"/></default>
  <worldbody>
    <body name="crank" pos="0 0 1" euler="0.1 0.4 0">
      <joint name="a" axis="0 1 0"/>
      <geom fromto="0 0 0 0.3 0 0"/>
      <body name="coupler" pos="0.3 0 0" euler="0 0.9 0">
        <joint name="b" axis="0 1 0" pos="0.01 0 0"/>
        <geom fromto="0 0 0 0.5 0 0"/>
      </body>
    </body>
    <body name="rocker" pos="0.6 0.05 1.1">
      <joint name="c" type="ball"/>
      <geom fromto="0 0 0 0 0.1 -0.5"/>
    </body>
    <body name="gear1" pos="2 0 0"><joint name="g1" axis="0 1 0"/><geom fromto="0 0 0 0.2 0 0"/></body>
    <body name="gear2" pos="3 0 0"><joint name="g2" axis="0 1 0"/><geom fromto="0 0 0 0.4 0 0.1"/></body>
    <body name="loose" pos="4 0 1"><freejoint name="f"/><geom fromto="0 0 0 0.4 0 0.1"/></body>
    <body name="held" pos="4 0 1.5" euler="0 0.3 0"><joint name="h" axis="0 1 0"/><geom fromto="0 0 0 0.4 0 0.1"/></body>
  </worldbody>
  <equality>
    <connect name="pin" body1="coupler" body2="rocker" anchor="0.4 0 0"/>
    <joint name="mesh" joint1="g1" joint2="g2" polycoef="0 -2 0.5 0 0"/>
    <weld name="glue" body1="held" body2="loose"/>
    <connect body1="gear1" body2="gear2" anchor="0 0 0" active="false"/>
  </equality>
</mujoco>
)";

struct Loaded {
    explicit Loaded(const std::string& file) {
        std::array<char, 1000> error{};
        model.reset(mj_loadXML(file.c_str(), nullptr, error.data(), error.size()));
        CAPTURE(std::string(error.data()));
        REQUIRE(model);
        model->opt.disableflags |=
            mjDSBL_CONTACT | mjDSBL_LIMIT | mjDSBL_CLAMPCTRL | mjDSBL_FRICTIONLOSS | mjDSBL_WARMSTART;
        data.reset(mj_makeData(model.get()));
    }
    struct Free {
        void operator()(mjModel* m) const { mj_deleteModel(m); }
        void operator()(mjData* d) const { mj_deleteData(d); }
    };
    std::unique_ptr<mjModel, Free> model;
    std::unique_ptr<mjData, Free> data;
};

using Q4 = Eigen::Vector4d;  // scalar first
Q4 product(const Q4& a, const Q4& b) {
    Q4 r;
    const Eigen::Vector3d v = a.tail<3>(), w = b.tail<3>();
    r << a[0] * b[0] - v.dot(w), a[0] * w + b[0] * v + v.cross(w);
    return r;
}
Q4 pure(const double* w) {
    return {0, w[0], w[1], w[2]};
}

/// Coordinates, rates and accelerations of the imported scene from those of MuJoCo.
struct InScene {
    std::vector<std::string> at;
    std::map<std::string, double> accelerations;
};
InScene in_scene(const Loaded& mj, const Json& coordinates, const double* acceleration) {
    InScene result;
    const mjModel& m = *mj.model;
    const auto add = [&](const std::string& name, double q, double rate, double second) {
        result.at.push_back(fmt::format("{}={}", name, q));
        result.at.push_back(fmt::format("{}'={}", name, rate));
        result.accelerations[name] = second;
    };
    for (int j = 0; j < m.njnt; ++j) {
        const char* const given = mj_id2name(&m, mjOBJ_JOINT, j);
        const std::string body = mj_id2name(&m, mjOBJ_BODY, m.jnt_bodyid[j]);
        const Json& names = coordinates.at(given != nullptr ? std::string(given) : body + "_joint");
        const double *q = mj.data->qpos + m.jnt_qposadr[j], *v = mj.data->qvel + m.jnt_dofadr[j],
                     *a = acceleration + m.jnt_dofadr[j];
        std::size_t next = 0;
        if (m.jnt_type[j] == mjJNT_HINGE || m.jnt_type[j] == mjJNT_SLIDE) {
            add(names[0], q[0] - m.qpos0[m.jnt_qposadr[j]], v[0], a[0]);
            continue;
        }
        if (m.jnt_type[j] == mjJNT_FREE) {
            for (; next < 3; ++next) add(names[next], q[next], v[next], a[next]);
            q += 3, v += 3, a += 3;
        }
        const Q4 e(q[0], q[1], q[2], q[3]), rate = product(e, pure(v)) / 2,
                                            second = (product(rate, pure(v)) + product(e, pure(a))) / 2;
        for (int k = 0; k < 4; ++k) add(names[next++], e[k], rate[k], second[k]);
    }
    return result;
}

void check_against(const InScene& expected, const std::string& scene, double within = tolerance) {
    std::vector<std::string> eval{"eval", scene, "--json"};
    for (const std::string& value : expected.at) {
        eval.emplace_back("--at");
        eval.push_back(value);
    }
    const auto result = run(eval);
    CAPTURE(result.err);
    REQUIRE(result.exit == 0);
    const Json accelerations = Json::parse(result.out)["accelerations"];
    REQUIRE(accelerations.size() == expected.accelerations.size());
    double size = 1;
    for (const auto& [name, value] : expected.accelerations) size = std::max(size, std::abs(value));
    for (const auto& [name, value] : expected.accelerations) {
        CAPTURE(name);
        CHECK(std::abs(accelerations[name].get<double>() - value) < within * size);
    }
}

Json imported(const std::string& file, const std::string& scene, std::vector<std::string> options) {
    return json_of({"import", file, "-o", scene, "--quaternion"}, options);
}

void set_randomly(Loaded& mj, std::mt19937_64& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    const mjModel& m = *mj.model;
    for (int k = 0; k < m.nq; ++k) mj.data->qpos[k] = m.qpos0[k] + any(random);
    for (int k = 0; k < m.nv; ++k) mj.data->qvel[k] = 2 * any(random);
    for (int k = 0; k < m.nu; ++k) mj.data->ctrl[k] = 3 * any(random);
    mj_normalizeQuat(&m, mj.data->qpos);
}

}  // namespace

TEST_CASE("import: MJCF with every kind of joint, shape and motor accelerates as in MuJoCo") {
    const unsigned seed = 20261123;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (const char* text : {arm, floating, merged, tied}) {
        const std::string file = temporary("model.xml", text), scene = temporary("model.toml", "");
        const Json told = imported(file, scene, {"--drives"});

        Loaded mj(file);
        for (int trial = 0; trial < 2; ++trial) {
            set_randomly(mj, random);
            mj_forward(mj.model.get(), mj.data.get());
            std::string driven = contents(scene);
            for (int k = 0; k < mj.model->nu; ++k) {
                const std::string unset =
                    fmt::format("\ndrive_{} = 0\n", mj_id2name(mj.model.get(), mjOBJ_ACTUATOR, k));
                const std::size_t place = driven.find(unset);
                REQUIRE(place != std::string::npos);
                driven.replace(place, unset.size(),
                               fmt::format("{}{}\n", unset.substr(0, unset.size() - 2), mj.data->ctrl[k]));
            }
            check_against(in_scene(mj, told["names"]["coordinates"], mj.data->qacc),
                          temporary("driven.toml", driven), text == merged ? with_principal_axes : tolerance);
        }
    }
}

TEST_CASE("import: equalities of MJCF accelerate from rest as MuJoCo's mass matrix and constraint Jacobian say") {
    const std::string file = temporary("loops.xml", loops), scene = temporary("loops.toml", "");
    const Json told = imported(file, scene, {});
    CHECK(told["loops"] == Json({"pin", "glue"}));
    CHECK(told["couplings"] == Json({"mesh"}));
    CHECK(told["dropped"]["<connect> of <equality>"] == Json({"connect4"}));
    Loaded mj(file);
    const mjModel& m = *mj.model;
    mjData& d = *mj.data;
    mj_forward(&m, &d);
    Eigen::MatrixXd M(m.nv, m.nv), J(d.nefc, m.nv);
    std::vector<double> full(static_cast<std::size_t>(m.nv * m.nv));
    mj_fullM(&m, full.data(), d.qM);
    for (int i = 0; i < m.nv; ++i)
        for (int j = 0; j < m.nv; ++j) M(i, j) = full[static_cast<std::size_t>(i * m.nv + j)];
    REQUIRE(mj_isSparse(&m) == 0);
    for (int i = 0; i < d.nefc; ++i)
        for (int j = 0; j < m.nv; ++j) J(i, j) = d.efc_J[i * m.nv + j];
    CHECK(d.nefc == 3 + 1 + 6);
    Eigen::VectorXd f(m.nv);
    for (int i = 0; i < m.nv; ++i) f[i] = d.qfrc_passive[i] - d.qfrc_bias[i];
    // M a = f + Jᵀλ, J a = 0. Some rows of J depend on others.
    const Eigen::MatrixXd W = alembert::solve_symmetric(M, J.transpose());
    const Eigen::VectorXd free = alembert::solve_symmetric(M, f), lambda = alembert::least_norm(J * W, J * free).x,
                          a = free - W * lambda;
    check_against(in_scene(mj, told["names"]["coordinates"], a.data()), scene);
}

}  // namespace commands_mujoco
