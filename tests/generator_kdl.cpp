// SPDX-License-Identifier: MIT
// Functions of a chain with turning and sliding joints about oblique axes, against KDL (Orocos), which shares
// nothing with this program. Compiled where CMake finds it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/chainjnttojacdotsolver.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <map>
#include <random>

#include "analysis/state/prepared.hpp"
#include "program/interpret.hpp"
#include "program/lower/frame_functions.hpp"
#include "program/lower/robot_functions.hpp"
#include "program/lower/start.hpp"

namespace generator_kdl {

using namespace alembert;

namespace {

struct Robot {
    std::string scene;
    KDL::Chain chain;
};

/// Six joints at random places: about or along z, an oblique axis, and others.
Robot random_robot(std::mt19937_64& random) {
    const auto number = [&](double low, double high) {
        return std::round(std::uniform_real_distribution<double>(low, high)(random) * 1e3) / 1e3;
    };
    const auto triple = [&](double size) {
        return std::array<double, 3>{number(-size, size), number(-size, size), number(-size, size)};
    };
    const auto vector = [](const std::array<double, 3>& v) { return KDL::Vector(v[0], v[1], v[2]); };
    const auto list = [](const std::array<double, 3>& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); };
    Robot robot{.scene = "gravity = [0.4, -1.3, -9.81]\n", .chain = {}};
    KDL::Frame to_joint;
    std::string parent = "N";
    std::array<double, 3> parent_centre{0, 0, 0};
    for (int k = 1; k <= 6; ++k) {
        const bool slides = k == 3 || k == 5;
        const std::array<double, 3> at = triple(0.4), turn = triple(1.5), centre = triple(0.2),
                                    axis = k % 2 == 0 ? std::array<double, 3>{0.6, 0, 0.8}
                                                      : std::array<double, 3>{0, 0, 1},
                                    I{number(0.3, 0.4), number(0.3, 0.4), number(0.3, 0.4)}, D = triple(0.05);
        const double mass = number(1, 5);
        robot.scene += fmt::format(
            "[[body]]\nname = \"B{0}\"\nmass = {1}\ninertia = {{ xx = {2}, yy = {3}, zz = {4}, xy = {5}, yz = "
            "{6}, zx "
            "= {7} }}\n[[joint]]\nname = \"J{0}\"\ntype = \"{8}\"\nparent = \"{9}\"\nchild = "
            "\"B{0}\"\nparent_point = "
            "{10}\nparent_rotate = [[\"z\", {11}], [\"y\", {12}], [\"x\", {13}]]\nchild_point = {14}\naxis = "
            "{15}\ncoordinates = {{ q{0} = {{ initial = 0.1 }} }}\n",
            k, mass, I[0], I[1], I[2], D[0], D[1], D[2], slides ? "prismatic" : "revolute", parent,
            list({at[0] - parent_centre[0], at[1] - parent_centre[1], at[2] - parent_centre[2]}), turn[2], turn[1],
            turn[0], list({-centre[0], -centre[1], -centre[2]}), list(axis));
        to_joint = KDL::Frame(KDL::Rotation::RPY(turn[0], turn[1], turn[2]), vector(at));
        robot.chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), to_joint));
        robot.chain.addSegment(KDL::Segment(
            KDL::Joint(KDL::Vector::Zero(), vector(axis), slides ? KDL::Joint::TransAxis : KDL::Joint::RotAxis),
            KDL::Frame::Identity(),
            KDL::RigidBodyInertia(mass, vector(centre),
                                  KDL::RotationalInertia(I[0], I[1], I[2], D[0], D[2], D[1]))));
        parent = fmt::format("B{}", k);
        parent_centre = centre;
    }
    // The tip is the origin of the last link.
    robot.scene += fmt::format("[[point]]\nname = \"tip\"\nfrom = \"B6\"\noffset = {}\naxes = \"B6\"\n",
                               list({-parent_centre[0], -parent_centre[1], -parent_centre[2]}));
    return robot;
}

}  // namespace

TEST_CASE("functions: those of chains with turning and sliding joints are KDL's") {
    const unsigned seed = 4711;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> any(-2, 2);
    for (int robots = 0; robots < 3; ++robots) {
        const Robot robot = random_robot(random);
        const Scene scene = parse_scene(robot.scene, "chain.toml");
        const Mechanism m = prepared(scene).mechanism;
        State<double> state = start_of(m).state();
        KDL::JntArray q(6), qd(6), qdd(6);
        state.qddot.assign(6, 0);
        for (unsigned i = 0; i < 6; ++i) {
            state.q[i] = q(i) = any(random);
            state.qdot[i] = qd(i) = any(random);
            state.qddot[i] = qdd(i) = any(random);
        }
        const auto check = [&](const FunctionProgram& f, const std::function<double(unsigned, unsigned)>& theirs) {
            CAPTURE(f.name);
            const std::vector<double> value = interpret(f.program, state);
            const std::vector<int> nodes = f.program.nodes_of(Group::function);
            for (unsigned i = 0; i < static_cast<unsigned>(f.rows); ++i)
                for (unsigned k = 0; k < static_cast<unsigned>(f.columns); ++k) {
                    const double ours =
                        value[static_cast<std::size_t>(nodes[i * static_cast<unsigned>(f.columns) + k])];
                    CHECK(std::abs(ours - theirs(i, k)) < 1e-10 * std::max(1., std::abs(theirs(i, k))));
                }
        };
        const KDL::Vector g(0.4, -1.3, -9.81);
        const RobotFunctions functions(m, false);
        KDL::JntArray tau(6), weight(6), zero(6);
        KDL::ChainIdSolver_RNE rne(robot.chain, g);
        REQUIRE(rne.CartToJnt(q, qd, qdd, KDL::Wrenches(robot.chain.getNrOfSegments()), tau) >= 0);
        check(functions.dynamics("inverse"), [&](unsigned i, unsigned) { return tau(i); });
        KDL::ChainDynParam dynamics(robot.chain, g);
        KDL::JntSpaceInertiaMatrix M(6);
        REQUIRE(dynamics.JntToMass(q, M) >= 0);
        check(functions.dynamics("mass"), [&](unsigned i, unsigned k) { return M(i, k); });
        REQUIRE(dynamics.JntToGravity(q, weight) >= 0);
        check(functions.dynamics("gravity"), [&](unsigned i, unsigned) { return weight(i); });
        REQUIRE(rne.CartToJnt(q, qd, zero, KDL::Wrenches(robot.chain.getNrOfSegments()), tau) >= 0);
        check(functions.dynamics("bias"), [&](unsigned i, unsigned) { return tau(i); });

        std::map<std::string, FunctionProgram> hand;
        for (FunctionProgram& f : frame_functions(scene, m, "tip", "tip", false)) hand[f.name] = std::move(f);
        KDL::Frame pose;
        KDL::ChainFkSolverPos_recursive fk(robot.chain);
        REQUIRE(fk.JntToCart(q, pose) >= 0);
        check(hand.at("tip_pose"), [&](unsigned i, unsigned k) {
            return k < 3 ? pose.M(static_cast<int>(i), static_cast<int>(k)) : pose.p[static_cast<int>(i)];
        });
        KDL::Jacobian J(6);
        KDL::ChainJntToJacSolver jacobian(robot.chain);
        REQUIRE(jacobian.JntToJac(q, J) >= 0);
        check(hand.at("tip_jacobian"), [&](unsigned i, unsigned k) { return J(i, k); });
        KDL::Twist drift;
        KDL::ChainJntToJacDotSolver jac_dot(robot.chain);
        REQUIRE(jac_dot.JntToJacDot(KDL::JntArrayVel(q, qd), drift) >= 0);
        check(hand.at("tip_drift"), [&](unsigned i, unsigned) { return drift(static_cast<int>(i)); });
        check(hand.at("tip_acceleration"), [&](unsigned i, unsigned) {
            double sum = drift(static_cast<int>(i));
            for (unsigned k = 0; k < 6; ++k) sum += J(i, k) * qdd(k);
            return sum;
        });
    }
}

}  // namespace generator_kdl
