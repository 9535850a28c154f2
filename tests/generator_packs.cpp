// SPDX-License-Identifier: MIT
// Functions over packs, compiled and in memory, against the scalar functions beside them, which
// generator_agreement.cpp holds against the interpreter: M, f, energies and outputs to 4 ulp of the largest term,
// accelerations to 4 ulp times the condition of M.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <bit>
#include <limits>

#include "alembert/base/dense.hpp"
#include "alembert/batch/packs.hpp"
#include "alembert/native/compilation.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/emit/emit.hpp"
#include "codegen/machine/can_run.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "model/formalism/formalisms.hpp"
#include "program/lower/choose.hpp"
#include "scenes.hpp"

namespace generator_packs {

using namespace alembert;

namespace {

/// The size that each node would have if nothing cancelled.
std::vector<double> sizes_of(const Program& program, const std::vector<double>& value) {
    std::vector<double> size(value.size());
    for (int id = 0; id < program.size(); ++id) {
        const Node& node = program[id];
        size[id] = std::abs(value[id]);
        if (node.op == Op::sum) {
            size[id] = std::abs(real_of<double>(node.number));
            for (std::size_t k = 0; k < node.args.size(); ++k)
                size[id] += std::abs(real_of<double>(node.coefficients[k])) * size[node.args[k]];
        } else if (node.op == Op::product) {
            size[id] = 1;
            for (std::size_t k = 0; k < node.args.size(); ++k)
                for (int e = 0; e < std::abs(node.exponents[k]); ++e)
                    size[id] *= node.exponents[k] > 0 ? size[node.args[k]] : 1 / std::abs(value[node.args[k]]);
        }
    }
    return size;
}

double largest(const Program& program, const std::vector<double>& size, Group group) {
    double result = 0;
    for (const int id : program.nodes_of(group)) result = std::max(result, size[id]);
    return result;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double result = 0;
    for (std::size_t i = 0; i < a.size(); ++i) result = std::max(result, std::abs(a[i] - b[i]));
    return result;
}

std::vector<double> lane_of(const std::vector<Lanes>& packs, int lane) {
    std::vector<double> result;
    for (const Lanes& pack : packs) result.push_back(pack[lane]);
    return result;
}

struct Values {
    explicit Values(std::size_t n) : mass(n * n), forcing(n), rate(2 * n), energy(5) {}
    std::vector<double> mass, forcing, rate, energy;
};

constexpr double four_ulp = 4 * std::numeric_limits<double>::epsilon();

void agrees(const Mechanism& mechanism, const Program& program, const Module& module) {
    const alembert_solver_table& one = module.table();
    const alembert_pack_table& eight = *module.pack();
    REQUIRE(eight.lanes == lanes);
    const auto n = static_cast<std::size_t>(mechanism.size());
    const Start start = start_of(mechanism);
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> factor(0.8, 1.2);
    for (int round = 0; round < 4; ++round) {
        std::vector<State<double>> states;
        std::vector<Lanes> y(2 * n), par(static_cast<std::size_t>(one.parameters + one.constants)), mass(n * n),
            forcing(n), rate(2 * n), energy(5);
        Lanes t;
        for (int lane = 0; lane < lanes; ++lane) {
            states.push_back(test::random_state(start, random));
            State<double>& state = states.back();
            for (std::size_t i = 0; i < state.parameters.size(); ++i)
                par[i][lane] = state.parameters[i] *= factor(random);
            for (std::size_t i = 0; i < n; ++i) y[i][lane] = state.q[i], y[n + i][lane] = state.qdot[i];
            t[lane] = state.t;
        }
        eight.prepare(reals(par.data()));
        eight.rhs(reals(&t), reals(y.data()), reals(par.data()), reals(rate.data()));
        eight.mass_forcing(reals(&t), reals(y.data()), reals(par.data()), reals(mass.data()),
                           reals(forcing.data()));
        eight.energy(reals(&t), reals(y.data()), reals(rate.data()), reals(par.data()), reals(energy.data()),
                     reals(&energy[4]));
        for (int lane = 0; lane < lanes; ++lane) {
            const State<double>& state = states[lane];
            const std::vector<double> p = prepared(module, state.parameters), s = lane_of(y, lane);
            Values expected(n);
            one.rhs(state.t, s.data(), p.data(), expected.rate.data());
            one.mass_forcing(state.t, s.data(), p.data(), expected.mass.data(), expected.forcing.data());
            one.energy(state.t, s.data(), lane_of(rate, lane).data(), p.data(), expected.energy.data(),
                       &expected.energy[4]);
            CHECK(distance(lane_of(par, lane), p) <= four_ulp * distance(p, std::vector<double>(p.size())));

            State<double> full = state;
            full.qddot.assign(expected.rate.begin() + static_cast<std::ptrdiff_t>(n), expected.rate.end());
            const std::vector<double> size = sizes_of(program, interpret(program, full));
            CHECK(distance(lane_of(mass, lane), expected.mass) <= four_ulp * largest(program, size, Group::mass));
            CHECK(distance(lane_of(forcing, lane), expected.forcing) <=
                  four_ulp * largest(program, size, Group::forcing));
            const std::vector<double> e = lane_of(energy, lane);
            for (std::size_t i = 0; const Group group : {Group::kinetic, Group::potential, Group::energy,
                                                         Group::power, Group::jacobi}) {
                CHECK(std::abs(e[i] - expected.energy[i]) <=
                      four_ulp * std::max(largest(program, size, group), std::abs(expected.energy[i])));
                ++i;
            }
            const Eigen::Map<const Eigen::MatrixXd> M(expected.mass.data(), static_cast<Eigen::Index>(n),
                                                      static_cast<Eigen::Index>(n));
            const Eigen::VectorXd sigma = singular_values(M).values;
            const double condition = sigma[0] / sigma[sigma.size() - 1],
                         scale = largest(program, size, Group::forcing) / sigma[sigma.size() - 1];
            if (condition < 1e6)
                CHECK(distance(lane_of(rate, lane), expected.rate) <= four_ulp * std::max(scale, condition * 3));
        }
    }
}

void agrees(const std::string& scene, const std::string& by, const std::vector<std::string>& flags) {
    CAPTURE(scene);
    const Mechanism mechanism = prepared(read_scene(scene)).mechanism;
    const Program program = choose(mechanism, formalism(by).derive(mechanism)).program;
    agrees(mechanism, program,
           load(compile(emit(program, {.batch = true}).text, program.name,
                        {.compiler = {}, .extra_flags = flags, .cache = {}})
                    .object));
    const auto memory = memory_solver(program, true);
    REQUIRE(memory.has_value() == machine::can_run());
    if (memory) agrees(mechanism, program, memory->module);
}

/// Every function of a program of x and y, for each pair of values in each lane.
void goes_lane_by_lane(const Module& module, std::size_t outputs) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::vector<double> values{0.0,    -0.0, 0.5,    -0.75,    1.0,       -2.0,
                                     1e-310, 1e9,  -1e300, infinity, -infinity, std::nan("")};
    int lane = 0;
    for (const double a : values)
        for (const double b : values) {
            std::vector<Lanes> state(4), found(outputs);
            for (int l = 0; l < lanes; ++l)
                state[0][l] = values[(l * 5) % values.size()], state[1][l] = values[(l * 7) % values.size()];
            state[0][lane] = a, state[1][lane] = b;
            const Lanes t;
            module.pack()->outputs_at(reals(&t), reals(state.data()), nullptr, nullptr, reals(found.data()));
            const std::vector<double> one{a, b, 0, 0};
            std::vector<double> expected(outputs);
            module.table().outputs_at(0, one.data(), nullptr, nullptr, expected.data());
            for (std::size_t i = 0; i < outputs; ++i) {
                const double value = found[i][lane];
                CAPTURE(i);
                CAPTURE(a);
                CAPTURE(b);
                if (std::isnan(expected[i]))
                    CHECK(std::isnan(value));
                else
                    CHECK(std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(expected[i]));
            }
            lane = (lane + 1) % lanes;
        }
}

}  // namespace

TEST_CASE(
    "packs: scalar and packed functions agree to 4 ulp of the largest term, accelerations to that times the "
    "condition") {
    for (const char* name : {"double_pendulum", "elastic_pendulum", "spherical_pendulum", "watt_governor",
                             "two_body", "double_pendulum_joints"})
        agrees(test::source_path(std::string("scenes/textbook/") + name + ".toml"), "lagrange", {});
    agrees(test::source_path("scenes/benchmark/trees/pend4.toml"), "kane", {});
    agrees(test::source_path("scenes/benchmark/trees/arm7g.toml"), "recursive",
           {});  // M and f one system after the other
    agrees(test::source_path("scenes/textbook/double_pendulum.toml"), "lagrange", {"-march=x86-64"});
}

TEST_CASE("packs: with addition theorems for sines of sums, M and f are the same as with direct sines") {
    for (const char* name : {"double_pendulum", "double_pendulum_joints"}) {
        CAPTURE(name);
        const Mechanism mechanism =
            prepared(read_scene(test::source_path(std::string("scenes/textbook/") + name + ".toml"))).mechanism;
        const Program program = choose(mechanism, formalism("lagrange").derive(mechanism)).program;
        const std::string with = emit(program, {.batch = true}).text, without = emit(program).text;
        CHECK(with.find("sin_phi0 = sin_") != std::string::npos);
        CHECK(without.find("sin_phi0 = sin_") == std::string::npos);
        const Module one = load(compile(with, "with", {}).object),
                     other = load(compile(without, "without", {}).object);
        const auto n = static_cast<std::size_t>(mechanism.size());
        const Start start = start_of(mechanism);
        std::mt19937_64 random(12);
        for (int round = 0; round < 20; ++round) {
            const State<double> state = test::random_state(start, random);
            std::vector<double> y = state.q;
            y.insert(y.end(), state.qdot.begin(), state.qdot.end());
            Values a(n), b(n);
            const std::vector<double> p = prepared(one, state.parameters);
            one.table().mass_forcing(state.t, y.data(), p.data(), a.mass.data(), a.forcing.data());
            other.table().mass_forcing(state.t, y.data(), p.data(), b.mass.data(), b.forcing.data());
            State<double> full = state;
            full.qddot.assign(n, 0.0);
            const std::vector<double> size = sizes_of(program, interpret(program, full));
            CHECK(distance(a.mass, b.mass) <= four_ulp * largest(program, size, Group::mass));
            CHECK(distance(a.forcing, b.forcing) <= four_ulp * largest(program, size, Group::forcing));
        }
    }
}

TEST_CASE(
    "packs: every function and comparison goes lane by lane, with zeros, infinities and NaN as in the scalar "
    "code") {
    Program program;
    program.name = "functions";
    program.coordinates = {{"x", "", 0}, {"y", "", 0}};
    const int x = program.variable({Variable::Kind::coordinate, 0}),
              y = program.variable({Variable::Kind::coordinate, 1});
    std::vector<int> outputs;
    for (const Op op : {Op::sin, Op::cos, Op::tan, Op::asin, Op::acos, Op::atan, Op::sinh, Op::cosh, Op::tanh,
                        Op::exp, Op::log, Op::sqrt, Op::abs, Op::sign})
        outputs.push_back(program.call(op, {x}));
    for (const Op op : {Op::pow, Op::atan2, Op::min, Op::max}) outputs.push_back(program.call(op, {x, y}));
    outputs.push_back(program.product(1, {{x, 1}, {program.power(y, -1), 1}}));
    for (std::size_t i = 0; i < outputs.size(); ++i)
        program.roots.push_back({Group::output, "o" + std::to_string(i), outputs[i]});
    for (int i = 0; i < 2; ++i) {
        for (int j = 0; j <= i; ++j) program.roots.push_back({Group::mass, "M", program.number(i == j ? 1 : 0)});
        program.roots.push_back({Group::forcing, "f", program.number(0)});
        program.roots.push_back({Group::acceleration, "a", program.number(0)});
    }
    goes_lane_by_lane(load(compile(emit(program, {.batch = true}).text, "functions", {}).object), outputs.size());
    const auto memory = memory_solver(program, true);
    REQUIRE(memory.has_value() == machine::can_run());
    if (memory) goes_lane_by_lane(memory->module, outputs.size());
}

}  // namespace generator_packs
