// SPDX-License-Identifier: MIT
// Functions that are emitted for robots, against Schiehlen's projection, against the verb `inverse`, and against
// differences.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <map>
#include <random>

#include "alembert/base/error.hpp"
#include "alembert/native/compilation.hpp"
#include "alembert/native/module.hpp"
#include "analysis/state/prepared.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/schiehlen.hpp"
#include "program/lower/frame_functions.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/operational_space.hpp"
#include "program/lower/robot_functions.hpp"
#include "program/tape.hpp"
#include "robot_functions.hpp"
#include "scenes.hpp"
#include "simulate/emission.hpp"
#include "simulate/inverse.hpp"
#include "simulate/wrenches.hpp"

namespace generator_robot_functions {

using namespace alembert;
using test::check_near;
using test::random_motion;
using test::values;

namespace {

/// M row by row, then f of M q'' = f, by Schiehlen's equations.
std::vector<double> by_schiehlen(const Mechanism& m, const State<double>& state) {
    const Equations e = schiehlen(m);
    std::vector<GiNaC::ex> list;
    for (int i = 0; i < m.size(); ++i)
        for (int j = 0; j < m.size(); ++j) list.push_back(e.M(i, j));
    for (int i = 0; i < m.size(); ++i) list.push_back(e.forcing(i));
    Program program;
    std::vector<std::pair<GiNaC::symbol, int>> open;
    for (const Mechanism::Unilateral& contact : m.unilateral)
        open.emplace_back(contact.gap.multiplier, program.number(0));
    const std::vector<int> nodes = lower_expressions(program, in_terms_of(e, m), list, open);
    const std::vector<double> all = interpret(program, state);
    std::vector<double> result;
    for (const int node : nodes) result.push_back(all[static_cast<std::size_t>(node)]);
    return result;
}

/// The derivatives of each node by the coordinates: differences of fourth order in 34 digits, to about 1e-19.
std::vector<std::vector<double>> slopes(const std::vector<int>& nodes, const Program& program,
                                        const State<double>& s) {
    const Quad h = 1e-5;
    Tape<Quad> tape(program, nodes, {s.parameters.begin(), s.parameters.end()});
    const std::vector<Quad> q(s.q.begin(), s.q.end()), u(s.qdot.begin(), s.qdot.end()),
        udot(s.qddot.begin(), s.qddot.end());
    std::vector<std::vector<double>> result(nodes.size(), std::vector<double>(q.size()));
    std::vector<Quad> value(nodes.size());
    for (std::size_t i = 0; i < q.size(); ++i) {
        std::vector<Quad> sums(nodes.size(), 0), at = q;
        for (const int step : {-2, -1, 1, 2}) {
            at[i] = q[i] + step * h;
            tape(s.t, at.data(), u.data(), value.data(), udot.data());
            const Quad weight = (step * step == 1 ? 8 : -1) * (step > 0 ? 1 : -1) / (12 * h);
            for (std::size_t k = 0; k < nodes.size(); ++k) sums[k] += weight * value[k];
        }
        for (std::size_t k = 0; k < nodes.size(); ++k) result[k][i] = static_cast<double>(sums[k]);
    }
    return result;
}

/// ∂V/∂q of gravity, or of everything else.
std::vector<double> slope(const Mechanism& m, const State<double>& s, bool of_gravity) {
    GiNaC::ex V = 0;
    for (const Part& part : m.potential)
        if ((part.origin.kind == Origin::Kind::gravity) == of_gravity) V += part.value;
    Program program;
    const int node = lower_expression(program, m, V);
    return slopes({node}, program, s)[0];
}

}  // namespace

TEST_CASE("functions: inverse, mass, bias, gravity and loads are those of Schiehlen's equations in every scene") {
    std::vector<std::string> files = test::every_third(test::scenes_in("scenes/textbook"), 0);
    for (const char* name : {"benchmark/trees/arm7", "benchmark/trees/pend8", "gallery/six_joint_arm",
                             "gallery/universal_double_pendulum", "gallery/furuta_joints", "gallery/rssr"})
        files.push_back(test::source_path(fmt::format("scenes/{}.toml", name)));
    files.push_back(test::source_path("tests/odd/armature.toml"));
    const unsigned seed = 20261123;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    int checked = 0;
    for (const std::string& file : files) {
        CAPTURE(file);
        const Mechanism m = prepared(read_scene(file)).mechanism;
        if (obstacle_to_schiehlen(m) || m.given_lagrangian) continue;
        const State<double> state = random_motion(m, random);
        const auto n = static_cast<std::size_t>(m.size());
        const std::vector<double> Mf = by_schiehlen(m, state);
        std::vector<double> mass(Mf.begin(), Mf.begin() + static_cast<std::ptrdiff_t>(n * n)), tau, bias;
        for (std::size_t i = 0; i < n; ++i) {
            bias.push_back(-Mf[n * n + i]);
            tau.push_back(bias.back());
            for (std::size_t j = 0; j < n; ++j) tau.back() += mass[i * n + j] * state.qddot[j];
        }
        const RobotFunctions functions(m, false);
        check_near(values(functions.dynamics("mass"), state), mass);
        check_near(values(functions.dynamics("bias"), state), bias);
        check_near(values(functions.dynamics("inverse"), state), tau);
        const bool formula = std::any_of(m.potential.begin(), m.potential.end(), [](const Part& part) {
            return part.origin.kind == Origin::Kind::given_potential;
        });
        if (formula) {
            CHECK_THROWS_AS(functions.dynamics("gravity"), ModelError);
            continue;
        }
        check_near(values(functions.dynamics("gravity"), state), slope(m, state, true));
        std::vector<double> loads;
        for (const double force : slope(m, state, false)) loads.push_back(-force);
        for (const bool dissipative : {true, false}) {
            Program program;
            const std::vector<int> nodes = lower_expressions(program, m, m.generalized_forces(dissipative));
            const std::vector<double> all = interpret(program, state);
            for (std::size_t i = 0; i < n; ++i) loads[i] += all[static_cast<std::size_t>(nodes[i])];
        }
        check_near(values(functions.dynamics("loads"), state), loads);
        ++checked;
    }
    CHECK(checked > test::at_least(20));
}

TEST_CASE("functions: a frame's Jacobian, velocity and acceleration are the derivatives of its pose") {
    const unsigned seed = 71;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (const auto& [file, place] :
         std::map<std::string, std::string>{{"gallery/six_joint_arm", "flange@fore"},
                                            {"gallery/universal_double_pendulum", "lower"},
                                            {"textbook/rotating_hoop", "bead"},
                                            {"textbook/free_body_quaternion", "body"},
                                            {"textbook/double_pendulum_joints", "lower"},
                                            {"textbook/moving_support", "bob"}}) {
        CAPTURE(file);
        const Scene scene = read_scene(test::source_path("scenes/" + file + ".toml"));
        const Mechanism m = prepared(scene).mechanism;
        const State<double> state = random_motion(m, random);
        const auto n = static_cast<std::size_t>(m.size());
        std::map<std::string, FunctionProgram> all;
        for (FunctionProgram& f : frame_functions(scene, m, place, "P", false)) all[f.name] = std::move(f);
        const auto value = [&](const char* name) { return values(all.at(name), state); };
        const auto derivative = [&](const char* name) {
            const FunctionProgram& f = all.at(name);
            return slopes(f.program.nodes_of(Group::function), f.program, state);
        };
        const std::vector<double> pose = value("P_pose"), J = value("P_jacobian"), v = value("P_velocity"),
                                  a = value("P_acceleration"), drift = value("P_drift");
        const auto pose_slopes = derivative("P_pose"), v_slopes = derivative("P_velocity");
        State<double> resting = state;
        resting.qdot.assign(n, 0);
        const std::vector<double> by_itself = values(all.at("P_velocity"), resting);
        const bool is_moved = std::any_of(by_itself.begin(), by_itself.end(), [](double x) { return x != 0; });
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t i = 0; i < 3; ++i) {
                CHECK(std::abs(J[i * n + k] - pose_slopes[4 * i + 3][k]) < 1e-10);
                const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;  // (∂R/∂q Rᵀ)_lj = ω_i
                double omega = 0;
                for (std::size_t c = 0; c < 3; ++c) omega += pose_slopes[4 * l + c][k] * pose[4 * j + c];
                CHECK(std::abs(J[(i + 3) * n + k] - omega) < 1e-10);
            }
        for (std::size_t i = 0; i < 6; ++i) {
            double by_J = 0, by_rates = drift[i];
            for (std::size_t k = 0; k < n; ++k) by_J += J[i * n + k] * state.qdot[k];
            for (std::size_t k = 0; k < n; ++k) by_rates += J[i * n + k] * state.qddot[k];
            if (!is_moved) CHECK(std::abs(by_J - v[i]) < 1e-10);
            CHECK(std::abs(by_rates - a[i]) < 1e-10 * std::max(1., std::abs(a[i])));
            // J' q' = ∂(J q')/∂q q' where nothing moves by itself.
            double change = 0;
            for (std::size_t k = 0; k < n; ++k) change += v_slopes[i][k] * state.qdot[k];
            if (!is_moved) CHECK(std::abs(change - drift[i]) < 1e-10 * std::max(1., std::abs(drift[i])));
        }
    }
}

TEST_CASE("functions: the mass centre, its Jacobian and the momentum are sums over the bodies") {
    const unsigned seed = 72;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (const char* file : {"gallery/six_joint_arm", "gallery/bicycle", "textbook/free_body_quaternion",
                             "textbook/watt_governor", "textbook/rattleback"}) {
        CAPTURE(file);
        const Scene scene = read_scene(test::source_path(fmt::format("scenes/{}.toml", file)));
        const Mechanism m = prepared(scene).mechanism;
        const State<double> state = random_motion(m, random);
        std::map<std::string, std::vector<double>> value;
        for (const std::string& name : functions_of_masses())
            value[name] = values(mass_function(scene, m, name, false), state);
        // The same from positions and velocities of the mechanism.
        std::vector<GiNaC::ex> list;
        for (const MassElement& body : m.masses) {
            list.push_back(body.mass);
            for (const Vector3* v : {&body.position, &body.velocity})
                list.insert(list.end(), v->begin(), v->end());
            for (std::size_t i = 0; i < 3; ++i) {
                GiNaC::ex spin = 0;
                if (body.rotation) {
                    const auto& w = body.rotation->w_NB_B;
                    const std::array<GiNaC::ex, 6> I = central_inertia(body, *m.z);
                    const std::array<GiNaC::ex, 3> L{I[0] * w[0] + I[3] * w[1] + I[5] * w[2],
                                                     I[3] * w[0] + I[1] * w[1] + I[4] * w[2],
                                                     I[5] * w[0] + I[4] * w[1] + I[2] * w[2]};
                    for (std::size_t k = 0; k < 3; ++k) spin += body.rotation->axes[k][i] * L[k];
                }
                list.push_back(spin);
            }
        }
        Program program;
        const std::vector<int> nodes = lower_expressions(program, m, list);
        const std::vector<double> at = interpret(program, state);
        const auto entry = [&](std::size_t body, std::size_t k) {
            return at[static_cast<std::size_t>(nodes[10 * body + k])];
        };
        double mass = 0;
        std::vector<double> centre(3), momentum(6);
        for (std::size_t b = 0; b < m.masses.size(); ++b) {
            mass += entry(b, 0);
            for (std::size_t i = 0; i < 3; ++i) centre[i] += entry(b, 0) * entry(b, 1 + i);
        }
        for (double& x : centre) x /= mass;
        for (std::size_t b = 0; b < m.masses.size(); ++b)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
                momentum[i] += entry(b, 0) * entry(b, 4 + i);
                momentum[3 + i] +=
                    entry(b, 7 + i) + entry(b, 0) * ((entry(b, 1 + j) - centre[j]) * entry(b, 4 + k) -
                                                     (entry(b, 1 + k) - centre[k]) * entry(b, 4 + j));
            }
        check_near(value["com"], centre);
        check_near(value["momentum"], momentum);
        for (std::size_t i = 0; i < 3; ++i) {
            double by_J = 0;
            for (std::size_t k = 0; k < state.q.size(); ++k)
                by_J += value["com_jacobian"][i * state.q.size() + k] * state.qdot[k];
            CHECK(std::abs(mass * by_J - momentum[i]) < 1e-10 * std::max(1., std::abs(momentum[i])));
        }
        // The momentum is linear in the rates, and its derivative at q'' = 0 that along q'.
        const std::size_t n = state.q.size();
        std::vector<double> by_matrix(6), change(6);
        const FunctionProgram f = mass_function(scene, m, "momentum", false);
        const auto by_q = slopes(f.program.nodes_of(Group::function), f.program, state);
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t k = 0; k < n; ++k) {
                by_matrix[i] += value["centroidal"][i * n + k] * state.qdot[k];
                change[i] += by_q[i][k] * state.qdot[k];
            }
        State<double> resting = state;
        resting.qdot.assign(n, 0);
        const std::vector<double> by_itself = values(f, resting);  // what moves when all rates are zero
        for (std::size_t i = 0; i < 6; ++i) by_matrix[i] += by_itself[i];
        check_near(by_matrix, momentum);
        check_near(value["centroidal_drift"], change);
    }
}

TEST_CASE("functions: operational-space inertia and mobility are those of J and M, and a wrench acts by its J") {
    const unsigned seed = 75;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    Scene scene = read_scene(test::source_path("scenes/gallery/six_joint_arm.toml"));
    with_wrench(scene, "flange", "w");
    const Mechanism m = prepared(scene).mechanism;
    State<double> state = random_motion(m, random);
    const std::size_t n = 6, first = state.parameters.size() - 6;
    const auto named = [&](const char* name) {
        return values(operational_function(scene, m, "flange", "w", name, false), state);
    };
    std::vector<double> J;
    for (const FunctionProgram& f : frame_functions(scene, m, "flange", "w", false))
        if (f.name == "w_jacobian") J = values(f, state);
    const RobotFunctions functions(m, false);
    const std::vector<double> W = values(functions.dynamics("mass_inverse"), state), mobility = named("mobility"),
                              inertia = named("operational_inertia");
    std::vector<double> expected, unity, product;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t k = 0; k < 6; ++k) {
            double sum = 0, one = 0;
            for (std::size_t a = 0; a < n; ++a)
                for (std::size_t b = 0; b < n; ++b) sum += J[i * n + a] * W[a * n + b] * J[k * n + b];
            for (std::size_t a = 0; a < 6; ++a) one += inertia[i * 6 + a] * mobility[a * 6 + k];
            expected.push_back(sum);
            product.push_back(one);
            unity.push_back(i == k ? 1 : 0);
        }
    check_near(mobility, expected);
    check_near(product, unity);
    const std::vector<double> before = values(functions.dynamics("inverse"), state);
    for (std::size_t k = 0; k < 6; ++k) state.parameters[first + k] = 1 + 0.5 * static_cast<double>(k);
    std::vector<double> change = values(functions.dynamics("inverse"), state), by_J(n);
    for (std::size_t a = 0; a < n; ++a) {
        change[a] = before[a] - change[a];
        for (std::size_t k = 0; k < 6; ++k) by_J[a] += J[k * n + a] * state.parameters[first + k];
    }
    check_near(change, by_J);
    CHECK_THROWS_WITH_AS(
        operational_function(
            read_scene(test::source_path("scenes/textbook/double_pendulum.toml")),
            prepared(read_scene(test::source_path("scenes/textbook/double_pendulum.toml"))).mechanism, "M2", "w",
            "operational_inertia", false),
        doctest::Contains("does not move in all six directions"), ModelError);
}

TEST_CASE("functions: the derivatives of inverse dynamics are those of differences, and the inverse of M is one") {
    const unsigned seed = 74;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    for (const char* file : {"gallery/six_joint_arm", "textbook/double_pendulum", "textbook/elastic_pendulum"}) {
        CAPTURE(file);
        const Mechanism m = prepared(read_scene(test::source_path(fmt::format("scenes/{}.toml", file)))).mechanism;
        const State<double> state = random_motion(m, random);
        const auto n = static_cast<std::size_t>(m.size());
        const RobotFunctions functions(m, false);
        const FunctionProgram inverse = functions.dynamics("inverse");
        const std::vector<double> D = values(functions.dynamics("inverse_jacobian"), state);
        std::vector<double> by_rates(n * n), by_coordinates;
        for (const auto& row : slopes(inverse.program.nodes_of(Group::function), inverse.program, state))
            by_coordinates.insert(by_coordinates.end(), row.begin(), row.end());
        for (std::size_t k = 0; k < n;
             ++k) {  // τ is quadratic in the rates, so that central differences are exact
            State<double> up = state, down = state;
            up.qdot[k] += 0.5;
            down.qdot[k] -= 0.5;
            const std::vector<double> above = values(inverse, up), below = values(inverse, down);
            for (std::size_t i = 0; i < n; ++i) by_rates[i * n + k] = above[i] - below[i];
        }
        std::vector<double> left, right;
        for (std::size_t i = 0; i < n; ++i) {
            left.insert(left.end(), D.begin() + static_cast<std::ptrdiff_t>(2 * n * i),
                        D.begin() + static_cast<std::ptrdiff_t>(2 * n * i + n));
            right.insert(right.end(), D.begin() + static_cast<std::ptrdiff_t>(2 * n * i + n),
                         D.begin() + static_cast<std::ptrdiff_t>(2 * n * (i + 1)));
        }
        check_near(left, by_coordinates);
        check_near(right, by_rates);
        const std::vector<double> M = values(functions.dynamics("mass"), state),
                                  W = values(functions.dynamics("mass_inverse"), state);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < n; ++k) {
                double sum = 0;
                for (std::size_t j = 0; j < n; ++j) sum += M[i * n + j] * W[j * n + k];
                CHECK(std::abs(sum - (i == k ? 1 : 0)) < 1e-10);
            }
    }
}

TEST_CASE("functions: those in the compiled file are those of the verb inverse, for eight systems at once too") {
    const Scene scene = read_scene(test::source_path("scenes/gallery/six_joint_arm.toml"));
    const Emission e =
        emission(scene, {.batch = true, .functions = {"inverse", "mass", "bias", "gravity", "mass"}});
    REQUIRE(e.functions.size() == 4);
    const Module module = load(compile(e.source.text, e.choice.program.name, {}).object);
    const std::size_t n = e.mechanism.q.size();
    const auto called = [&](const char* name, const State<double>& s, bool packed) {
        const alembert_named_function* f = module.function(name);
        REQUIRE(f != nullptr);
        std::vector<double> state = s.q, rate = s.qdot, par = prepared(module, s.parameters);
        state.insert(state.end(), s.qdot.begin(), s.qdot.end());
        rate.insert(rate.end(), s.qddot.begin(), s.qddot.end());
        std::vector<double> out(static_cast<std::size_t>(f->rows * f->columns), NAN);
        if (!packed) {
            f->call(s.t, state.data(), rate.data(), par.data(), out.data());
            return out;
        }
        const auto lanes = static_cast<std::size_t>(module.pack()->lanes);
        constexpr std::align_val_t aligned{64};
        std::vector<double*> arrays;
        for (const std::vector<double>& values : {std::vector<double>{s.t}, state, rate, par, out}) {
            arrays.push_back(new (aligned) double[(values.size() + 1) * lanes]);
            for (std::size_t k = 0; k < values.size() * lanes; ++k) arrays.back()[k] = values[k / lanes];
        }
        f->pack(arrays[0], arrays[1], arrays[2], arrays[3], arrays[4]);
        for (std::size_t k = 0; k < out.size(); ++k) out[k] = arrays[4][k * lanes + 5];
        for (double* array : arrays) ::operator delete[](array, aligned);
        return out;
    };
    CHECK(module.function("forward") == nullptr);
    CHECK(module.function("mass")->columns == static_cast<int>(n));
    CHECK(module.function("inverse")->operations == e.functions[0].operations.total());
    const unsigned seed = 5;
    std::mt19937_64 random(seed);
    const State<double> state = random_motion(e.mechanism, random);
    Overrides at;
    for (std::size_t i = 0; i < n; ++i) {
        const std::string q = e.mechanism.q[i].get_name();
        at.insert(at.end(), {{q, state.q[i]}, {q + "'", state.qdot[i]}, {q + "''", state.qddot[i]}});
    }
    at.emplace_back("t", state.t);
    const std::vector<double> tau = called("inverse", state, false), mass = called("mass", state, false),
                              bias = called("bias", state, false);
    check_near(tau, inverse(scene, {.at = at}).loads);
    check_near(called("inverse", state, true), tau);
    check_near(called("gravity", state, true), called("gravity", state, false));
    for (std::size_t i = 0; i < n; ++i) {
        double sum = bias[i];
        for (std::size_t j = 0; j < n; ++j) sum += mass[i * n + j] * state.qddot[j];
        CHECK(std::abs(sum - tau[i]) < 1e-10 * std::max(1., std::abs(tau[i])));
    }
    CHECK_THROWS_AS(emission(scene, {.functions = {"centrifugal"}}), ModelError);
    CHECK_THROWS_WITH_AS(emission(read_scene(test::source_path("scenes/textbook/chaplygin_sleigh_in_speeds.toml")),
                                  {.functions = {"mass"}}),
                         doctest::Contains("leave out the table [speeds]"), ModelError);
}

TEST_CASE(
    "functions: inverse dynamics of a generic arm takes a few hundred operations, of a chain as many a link") {
    const auto operations = [](const std::string& scene, const std::string& name) {
        const FunctionProgram f =
            RobotFunctions(prepared(read_scene(test::source_path("scenes/" + scene))).mechanism, true)
                .dynamics(name);
        return f.program.count(f.program.nodes_of(Group::function)).total();
    };
    // Right angles between the axes, a general mass distribution; then angles of any size too.
    CHECK(operations("gallery/six_joint_arm.toml", "inverse") < 500);
    CHECK(operations("benchmark/trees/arm7.toml", "inverse") < 600);
    CHECK(operations("benchmark/trees/arm7g.toml", "inverse") < 900);
    CHECK(operations("benchmark/trees/arm7g.toml", "gravity") < 200);
    const int shorter = operations("benchmark/trees/pend8.toml", "inverse"),
              middle = operations("benchmark/trees/pend16.toml", "inverse"),
              longer = operations("benchmark/trees/pend32.toml", "inverse");
    CHECK(std::abs((longer - middle) - 2 * (middle - shorter)) <= shorter / 4);
}

}  // namespace generator_robot_functions
