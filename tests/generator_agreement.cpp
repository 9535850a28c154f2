// SPDX-License-Identifier: MIT
// For every scene: the emitted function, the interpreter, and Lagrange's equations made by plain GiNaC derivatives
// of L without any intermediate symbol are one and the same.
#include <doctest/doctest.h>

#include "alembert/native/compilation.hpp"
#include "alembert/ode/rhs.hpp"
#include "analysis/state/prepared.hpp"
#include "codegen/emit/emit.hpp"
#include "model/formalism/lagrange.hpp"
#include "model/formalism/routh.hpp"
#include "program/interpret.hpp"
#include "program/lower/choose.hpp"
#include "scenes.hpp"

namespace generator_agreement {

using namespace alembert;
using GiNaC::ex;

namespace {

constexpr int states = 64;

/// d/dt ∂L/∂q' − ∂L/∂q − Q by GiNaC's own derivatives on expanded trees: another way than pull_back and
/// push_forward.
class PlainLagrange {
public:
    explicit PlainLagrange(const Mechanism& m) : m_(m) {
        const auto dot = [&](const ex& e) {
            ex sum = e.diff(m.t);
            for (std::size_t i = 0; i < m.q.size(); ++i)
                sum += e.diff(m.q[i]) * m.qdot[i] + e.diff(m.qdot[i]) * m.qddot[i];
            for (const Mechanism::Input& f : m.inputs)
                sum += e.diff(f.derivative[0]) * f.derivative[1] + e.diff(f.derivative[1]) * f.derivative[2];
            return sum;
        };
        const ex L = m.z->expand(m.lagrangian());
        for (int i = 0; i < m.size(); ++i) {
            ex Q = 0;
            for (const Load& load : m.loads)
                for (const Load::Pair& pair : load.pairs)
                    Q += m.z->expand(pair.force) * m.z->expand(pair.velocity).diff(m.qdot[i]);
            for (const Mechanism::Constraint& c : m.constraints) {
                const ex f = c.position ? m.z->expand(*c.position) : ex(0);
                Q += c.multiplier * (c.position ? f.diff(m.q[i]) : m.z->expand(c.row[i]));
            }
            residual_.push_back({dot(L.diff(m.qdot[i])), L.diff(m.q[i]), Q});
        }
    }

    /// The residual of equation i over the size of its largest part, at numbers in 30 digits.
    double relative_residual(int i, const State<double>& s, const std::vector<double>& acceleration,
                             const std::vector<double>& multipliers) const {
        GiNaC::Digits = 30;
        GiNaC::exmap at{{m_.t, s.t}};
        for (int k = 0; k < m_.size(); ++k) {
            at[m_.q[k]] = s.q[k];
            at[m_.qdot[k]] = s.qdot[k];
            at[m_.qddot[k]] = acceleration[k];
        }
        for (std::size_t k = 0; k < multipliers.size(); ++k) at[m_.constraints[k].multiplier] = multipliers[k];
        GiNaC::exmap inputs, parameters;
        for (const Mechanism::Input& f : m_.inputs) {
            ex value = m_.z->expand(f.value);
            for (const auto& symbol : f.derivative) {
                inputs[symbol] = value;
                value = value.diff(m_.t);
            }
        }
        std::size_t position = 0;
        for (const Mechanism::Parameter& p : m_.parameters)
            parameters[p.symbol] = p.independent ? ex(s.parameters[position++]) : p.value;
        const auto number = [&](const ex& e) {
            const ex value = e.subs(inputs).subs(parameters).subs(parameters).subs(at).evalf();
            return GiNaC::is_a<GiNaC::numeric>(value) ? GiNaC::ex_to<GiNaC::numeric>(value).to_double() : NAN;
        };
        const double a = number(residual_[i][0]), b = number(residual_[i][1]), c = number(residual_[i][2]);
        // Terms that cancel inside ∂L/∂q and the rest are at least as large as M q''.
        double largest = std::max({std::abs(a), std::abs(b), std::abs(c)});
        for (int k = 0; k < m_.size(); ++k)
            largest = std::max(largest, std::abs(number(residual_[i][0].diff(m_.qddot[k]) * m_.qddot[k])));
        return std::abs(a - b - c) / std::max(largest, 1e-300);
    }

private:
    const Mechanism& m_;
    std::vector<std::array<ex, 3>> residual_;
};

bool all_finite(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// T, V, E, power, h, M and f as emitted, against the interpreter.
void check_energy(const Module& module, const Program& program, State<double> state, const std::vector<double>& y,
                  const std::vector<double>& rate) {
    const std::size_t n = program.coordinates.size();
    const std::vector<double> par = prepared(module, state.parameters);
    state.qddot.assign(rate.begin() + static_cast<std::ptrdiff_t>(n), rate.end());
    const std::vector<double> value = interpret(program, state);
    std::vector<double> found(5 + n * n + n);
    module.table().energy(state.t, y.data(), rate.data(), par.data(), found.data(), found.data() + 4);
    module.table().mass_forcing(state.t, y.data(), par.data(), found.data() + 5, found.data() + 5 + n * n);
    std::vector<double> expected;
    for (const Group group : {Group::kinetic, Group::potential, Group::energy, Group::power, Group::jacobi})
        expected.push_back(value[program.nodes_of(group)[0]]);
    const std::vector<int> mass = program.nodes_of(Group::mass);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            expected.push_back(value[mass[std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j)]]);
    for (const int id : program.nodes_of(Group::forcing)) expected.push_back(value[id]);
    double size = 1;  // sums of terms of about this size
    for (const double x : expected) size = std::max(size, std::abs(x));
    // The power may hold multipliers: they come with the accelerations from one solve, whose errors are in
    // proportion to its largest result (near theta = 0 Euler's angles have accelerations that grow without bound).
    double solved = size;
    for (const double a : state.qddot) solved = std::max(solved, std::abs(a));
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK(std::abs(found[i] - expected[i]) <= 1e-12 * (i == 3 ? solved : size));
}

void agrees(const std::string& file, bool with_plain_derivatives) {
    CAPTURE(file);
    const Mechanism mechanism = prepared(read_scene(file)).mechanism;
    const Equations equations = routh(mechanism);  // Lagrange's where there are no constraints
    const Choice choice = choose(mechanism, equations);
    const Program& program = choice.program;
    const Program other = lower(mechanism, equations, energy_of(mechanism));
    const Start start = start_of(mechanism);
    const Module module = load(compile(emit(program).text, program.name, {}).object);
    const Rhs rhs = make_rhs(module, start.parameters);
    const std::optional<PlainLagrange> plain =
        with_plain_derivatives ? std::optional<PlainLagrange>(mechanism) : std::nullopt;

    const unsigned seed = 20040109;
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const int n = mechanism.size();
    int singular = 0;
    double emitted_error = 0, form_error = 0, plain_error = 0;
    for (int k = 0; k < states; ++k) {
        const State<double> state = test::random_state(start, random);
        const auto accelerations = [](const State<double>& at, const Program& p) {
            const std::vector<double> value = interpret(p, at);
            std::vector<double> a;
            for (const int id : p.nodes_of(Group::acceleration)) a.push_back(value[id]);
            return a;
        };
        const std::vector<double> a = accelerations(state, program), b = accelerations(state, other);
        std::vector<double> y = state.q, rate(2 * n);
        y.insert(y.end(), state.qdot.begin(), state.qdot.end());
        rhs(state.t, y.data(), rate.data());
        // The effect of a unit in the last place of the state, in both directions.
        double largest = 1e-300, moved = 0;
        for (const double side : {10.0, 0.1}) {
            State<double> beside = state;
            for (auto* list : {&beside.q, &beside.qdot})
                for (std::size_t i = 0; i < list->size(); ++i)
                    (*list)[i] = std::nextafter((*list)[i], (i % 2 == 0 ? side : 1 / side) * (*list)[i]);
            const std::vector<double> nearby = accelerations(beside, program);
            for (int i = 0; i < n; ++i) moved = std::max(moved, std::abs(nearby[i] - a[i]));
        }
        for (int i = 0; i < n; ++i) largest = std::max(largest, std::abs(a[i]));
        if (!all_finite(a)) {
            ++singular;
            continue;
        }
        const double harder = std::max(1.0, moved / (2e-14 * largest));
        // If rounding of the state alone changes them more, no better agreement can be required.
        largest *= harder;
        check_energy(module, program, state, y, rate);
        std::vector<double> multipliers;
        for (const int id : program.nodes_of(Group::multiplier))
            multipliers.push_back(interpret(program, state)[id]);
        for (int i = 0; i < n; ++i) {
            emitted_error = std::max(emitted_error, std::abs(rate[n + i] - a[i]) / largest);
            form_error = std::max(form_error, std::abs(b[i] - a[i]) / largest);
            if (plain && k < 3)
                plain_error = std::max(plain_error, plain->relative_residual(i, state, a, multipliers) / harder);
        }
    }
    CAPTURE(program.formulation);
    CAPTURE(singular);
    CHECK(singular < states / 2);
    // Rounding of a few dozen operations, and conditioning below 10²; in proportion beyond.
    CHECK(emitted_error < 1e-12);
    CHECK(form_error < 1e-10);
    CHECK(plain_error < 1e-12);
}

}  // namespace

TEST_CASE("generator: emitted function, interpreter and plain derivatives agree on textbook scenes") {
    for (const std::string& file : test::every_third(test::scenes_in("scenes/textbook"), 0)) agrees(file, true);
}

TEST_CASE("generator: every node of a program has the source of its term") {
    for (const std::string& file : test::every_third(test::scenes_in("scenes/textbook"), 1)) {
        CAPTURE(file);
        const Mechanism mechanism = prepared(read_scene(file)).mechanism;
        const Program program = choose(mechanism, routh(mechanism)).program;
        for (int id = 0; id < program.size(); ++id) CHECK_FALSE(program[id].sources.empty());
        int named = 0;  // more than "the scene"
        for (const int id : program.needed(program.nodes_of(Group::forcing)))
            named += program[id].sources[0] != 0 ? 1 : 0;
        CHECK(named > 0);
    }
}

TEST_CASE("generator: emitted function and interpreter agree on benchmark scenes and on odd ones") {
    for (const char* folder : {"scenes/benchmark", "tests/odd"})
        for (const std::string& file : test::every_third(test::scenes_in(folder), 2)) agrees(file, true);
}

// ½ k (|r| − l)² with k = 10¹⁰ multiplied out has terms of 10¹⁰, whose rounding is larger than V here.
TEST_CASE("generator: the potential of a stiff spring keeps its digits where the spring is hardly extended") {
    const double extension = std::ldexp(1, -30), expected = 0.5e10 * extension * extension;
    struct Given {
        std::string text;
        std::vector<double> q;
    };
    const std::string constants = "[parameters]\nm = 1\nk = 1e10\nl = 1\n";
    const std::string line = "[coordinates]\nx = 0.125\ny = 0.125\n";
    const Given scenes[] = {{R"s([coordinates]
r = 1
theta = 0.5
[[particle]]
name = "P"
position = ["r*sin(theta)", "-r*cos(theta)"]
mass = "m"
[[spring]]
between = ["O", "P"]
stiffness = "k"
length = "l"
)s",
                             {1 + extension, 0.5}},
                            {line + R"s([energy]
kinetic = "m*(x'^2 + y'^2)/2"
potential = "k*(y - x - 1)^2/2"
)s",
                             {0.125, 1.125 + extension}},
                            {line + R"s([[particle]]
name = "P"
position = ["x", "0"]
mass = "m"
[[particle]]
name = "Q"
position = ["y", "0"]
mass = "m"
[[spring]]
between = ["P", "Q"]
stiffness = "k"
)s",
                             {0.125, 0.125 + extension}}};
    for (const Given& given : scenes) {
        CAPTURE(given.text);
        const Mechanism m = build(parse_scene(constants + given.text, "stiff.toml"));
        const Program program = choose(m, lagrange(m)).program;
        State<double> state = start_of(m).state();
        state.q = given.q;
        const double V =
            interpret(program, state)[static_cast<std::size_t>(program.nodes_of(Group::potential)[0])];
        CHECK(std::abs(V - expected) < 1e-12 * expected);
    }
}

}  // namespace generator_agreement
