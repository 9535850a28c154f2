// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/robot_functions.hpp"

#include <algorithm>

#include "base/language/say.hpp"
#include "model/formalism/needs.hpp"
#include "model/formalism/recursive.hpp"
#include "model/friction.hpp"
#include "program/lower/articulated_bodies.hpp"
#include "program/lower/choose.hpp"
#include "program/lower/tree_functions.hpp"
#include "program/partials.hpp"
#include "program/solve.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// With more coordinates, Lagrange's equations never take fewer operations than the recursions over a tree.
constexpr int most_by_lagrange = 4;

/// The full matrix from its lower triangle.
std::vector<int> mirrored(const std::vector<int>& triangle, int n) {
    std::vector<int> full;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int row = std::max(i, j), column = std::min(i, j);
            full.push_back(triangle[static_cast<std::size_t>(row * (row + 1) / 2 + column)]);
        }
    return full;
}

/// M q'' − f
std::vector<int> inverse_of(Program& program, const std::vector<int>& mass, const std::vector<int>& forcing) {
    const int n = static_cast<int>(forcing.size());
    const std::vector<int> full = mirrored(mass, n);
    std::vector<int> loads;
    for (int i = 0; i < n; ++i) {
        std::vector<Program::Term> terms{{-1, forcing[static_cast<std::size_t>(i)]}};
        for (int j = 0; j < n; ++j)
            terms.emplace_back(1, program.product(1, {{full[static_cast<std::size_t>(i * n + j)], 1},
                                                      {program.variable({Variable::Kind::acceleration, j}), 1}}));
        loads.push_back(program.sum(0, terms));
    }
    return loads;
}

/// ∂V/∂q of gravity.
std::vector<ex> gravity_of(const Mechanism& m) {
    std::vector<std::pair<ex, ex>> targets;
    for (const Part& part : m.potential)
        if (part.origin.kind == Origin::Kind::gravity) targets.emplace_back(part.value, 1);
    return m.z->pull_back(targets, m.q);
}

void need_gravity_of_its_own(const Mechanism& m, const std::string& name) {
    const bool by_formula =
        m.given_lagrangian || std::any_of(m.potential.begin(), m.potential.end(), [](const Part& part) {
            return part.origin.kind == Origin::Kind::given_potential;
        });
    if (by_formula)
        throw ModelError(say(
            "the scene gives its potential or Lagrangian as a formula, in which gravity is not told apart from "
            "other forces, so that there is no function '{}'; ask for 'bias', which has all of them",
            name));
}

/// The program with the fewest operations.
Program with_fewest_operations(std::vector<Program> forms) {
    std::vector<int> costs;
    for (const Program& p : forms) costs.push_back(p.count(p.nodes_of(Group::function)).total());
    return std::move(
        forms[static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin())]);
}

/// The values alone of those programs that may have the fewest operations when they are cleaned, which takes most
/// of the time and saves up to a twentieth of the operations.
std::vector<Program> cleaned(std::vector<std::pair<Program, std::vector<int>>> programs) {
    constexpr double saved = 0.05;
    std::vector<int> counts;
    for (const auto& [program, values] : programs) counts.push_back(program.count(values).total());
    std::vector<Program> forms;
    for (std::size_t k = 0; k < programs.size(); ++k)
        if (counts[k] * (1 - saved) <= *std::min_element(counts.begin(), counts.end()))
            forms.push_back(with_values_only(std::move(programs[k].first), programs[k].second));
    return forms;
}

const char* sentence_for(const std::string& name) {
    if (name == "inverse") return "Inverse dynamics: the loads M q'' + C q' + g - Q that bring q'' about.";
    if (name == "mass") return "The mass matrix M(q).";
    if (name == "bias") return "C q' + g - Q: inverse dynamics at q'' = 0.";
    if (name == "gravity") return "g(q): the loads that hold the system at rest against gravity.";
    return "Q: generalized forces of springs, dampers and applied loads.";
}

const Mechanism::Constraint* norm_of_quaternion(const Mechanism& m) {
    const auto found = std::find_if(m.constraints.begin(), m.constraints.end(),
                                    [](const Mechanism::Constraint& c) { return c.norm; });
    return found == m.constraints.end() ? nullptr : &*found;
}

/// All entries of a Jacobian, row by row.
std::optional<std::vector<int>> jacobian_of(Program& program, const std::vector<int>& outputs, Variable::Kind kind,
                                            int n, EliminationOrder order) {
    std::vector<int> inputs;
    for (int i = 0; i < n; ++i) inputs.push_back(program.variable({kind, i}));
    const auto found = partials(program, outputs, inputs, order);
    if (!found) return std::nullopt;
    std::vector<int> values(outputs.size() * inputs.size(), program.number(0));
    for (const Partial& partial : *found)
        values[static_cast<std::size_t>(partial.output) * inputs.size() +
               static_cast<std::size_t>(partial.input)] = partial.node;
    return values;
}

constexpr EliminationOrder every_order[] = {EliminationOrder::forward, EliminationOrder::reverse,
                                            EliminationOrder::least_fill};

}  // namespace

RobotFunctions::RobotFunctions(const Mechanism& mechanism, bool fold)
    : m_(with_own_intermediates(mechanism)), fold_(fold) {
    need_given_normal_forces(m_, "emit --functions");
    if (Possible<JointTree> tree = loaded_tree(m_); tree.exists()) tree_ = std::move(tree).value();
}

const std::vector<std::string>& RobotFunctions::of_dynamics() {
    static const std::vector<std::string> names{"inverse",          "mass",         "bias",    "gravity", "loads",
                                                "inverse_jacobian", "mass_inverse", "coriolis"};
    return names;
}

std::vector<Program> RobotFunctions::tree_forms(const std::string& name) const {
    std::vector<Program> programs;
    for (const LinkAxes axes : {LinkAxes::own, LinkAxes::still}) {
        if (!tree_ || (axes == LinkAxes::still && !has_parallel_axes(*tree_))) continue;
        Program program = begun(m_, fold_);
        const auto lowering = lowering_into(program, m_, {}, fold_);
        const TreeFunctions tree(program, *tree_, axes, *m_.z, lowering);
        std::vector<int> values;
        if (name == "mass") {
            values = mirrored(tree.mass(), m_.size());
        } else {
            using Terms = TreeFunctions::Terms;
            values = tree.loads(name == "inverse" ? Terms::inverse
                                : name == "bias"  ? Terms::bias
                                                  : Terms::gravity);
            if (name == "inverse") add_rotors(program, *tree_, *m_.z, m_.qddot, lowering, values);
            for (std::size_t a = 0; a < values.size() && name != "gravity"; ++a)
                values[a] = program.sum(0, {{1, values[a]}, {-1, lowering(tree_->forces[a])}});
        }
        programs.push_back(with_values_only(std::move(program), values));
    }
    return programs;
}

Program RobotFunctions::by_expressions(const std::vector<ex>& values) const {
    Program program = begun(m_, fold_);
    const auto lowering = lowering_into(program, m_, {}, fold_);
    std::vector<int> nodes;
    for (const ex& value : values) nodes.push_back(lowering(value));
    return with_values_only(std::move(program), nodes);
}

Program RobotFunctions::from_lagrange(const std::string& name) const {
    const Equations e = formalism_in_rates(m_).derive(m_);
    Program program = begun(m_, fold_);
    std::vector<int> mass, forcing;
    // A program for runs has an inertia along the e of each quaternion, which is not part of M.
    if (std::any_of(m_.constraints.begin(), m_.constraints.end(), [](const auto& c) { return c.norm; })) {
        const Mechanism own = in_terms_of(e, m_);
        const auto lowering = lowering_into(program, own, {}, fold_);
        for (int i = 0; i < m_.size(); ++i)
            for (int j = 0; j <= i; ++j) mass.push_back(lowering(e.M(i, j)));
        for (int i = 0; i < m_.size(); ++i) forcing.push_back(lowering(e.forcing(i)));
    } else {
        program = choose(m_, e, {.fold = fold_}).program;
        mass = program.nodes_of(Group::mass);
        forcing = program.nodes_of(Group::forcing);
    }
    std::vector<int> values = name == "mass" ? mirrored(mass, m_.size()) : forcing;
    if (name == "inverse") values = inverse_of(program, mass, forcing);
    if (name == "bias")
        for (int& node : values) node = program.sum(0, {{-1, node}});
    return with_values_only(std::move(program), values);
}

FunctionProgram RobotFunctions::dynamics(const std::string& name) const {
    const int n = m_.size();
    if (name == "inverse_jacobian") return inverse_jacobian();
    if (name == "mass_inverse") return mass_inverse();
    if (name == "coriolis") return coriolis();
    FunctionProgram result{
        .name = name, .about = sentence_for(name), .rows = n, .columns = name == "mass" ? n : 1};
    std::vector<Program> forms;
    if (name == "loads" || name == "gravity") need_gravity_of_its_own(m_, name);
    if (name != "loads") forms = tree_forms(name);
    if (name == "loads") {
        forms.push_back(by_expressions(forces_besides_gravity(m_)));
    } else if (name == "gravity") {
        std::vector<ex> loads = gravity_of(m_);
        if (n <= most_by_lagrange || forms.empty()) {
            forms.push_back(by_expressions(loads));
            if (std::all_of(loads.begin(), loads.end(), [&](ex& load) {
                    const std::optional<ex> readable = readable_form(load, m_);
                    if (readable) load = *readable;
                    return readable.has_value();
                }))
                forms.push_back(by_expressions(loads));
        }
    } else if (n <= most_by_lagrange || forms.empty()) {
        forms.push_back(from_lagrange(name));
    }
    result.program = with_fewest_operations(std::move(forms));
    return result;
}

FunctionProgram RobotFunctions::inverse_jacobian() const {
    const int n = m_.size();
    const Program inverse = dynamics("inverse").program;
    const std::vector<int> loads = inverse.nodes_of(Group::function);
    std::vector<std::pair<Program, std::vector<int>>> found_values;
    for (const EliminationOrder order : every_order) {
        Program program = inverse;
        std::vector<int> inputs;
        for (const auto kind : {Variable::Kind::coordinate, Variable::Kind::rate})
            for (int i = 0; i < n; ++i) inputs.push_back(program.variable({kind, i}));
        const auto found = partials(program, loads, inputs, order);
        if (!found) continue;
        std::vector<int> values(static_cast<std::size_t>(n * 2 * n), program.number(0));
        for (const Partial& partial : *found)
            values[static_cast<std::size_t>(partial.output * 2 * n + partial.input)] = partial.node;
        found_values.emplace_back(std::move(program), std::move(values));
    }
    if (auto closed = closed_inverse_jacobian()) found_values.push_back(*std::move(closed));
    std::vector<Program> forms = cleaned(std::move(found_values));
    if (forms.empty())
        throw ModelError(
            say("the derivatives of inverse dynamics are too long to be written out; leave "
                "'inverse_jacobian' out"));
    return {.name = "inverse_jacobian",
            .about = "d tau / d q, then d tau / d q', of inverse dynamics; d tau / d q'' is M.",
            .rows = n,
            .columns = 2 * n,
            .program = with_fewest_operations(std::move(forms))};
}

std::optional<std::pair<Program, std::vector<int>>> RobotFunctions::closed_inverse_jacobian() const {
    if (!tree_) return std::nullopt;
    const int n = m_.size();
    Program program = begun(m_, fold_);
    const auto lowering = lowering_into(program, m_, {}, fold_);
    auto values = TreeFunctions(program, *tree_, LinkAxes::own, *m_.z, lowering).inverse_partials();
    if (!values) return std::nullopt;
    // What the tree's joints do not need, J q'' − Q.
    std::vector<int> others(static_cast<std::size_t>(n), program.number(0)), inputs;
    add_rotors(program, *tree_, *m_.z, m_.qddot, lowering, others);
    for (std::size_t a = 0; a < others.size(); ++a)
        others[a] = program.sum(0, {{1, others[a]}, {-1, lowering(tree_->forces[a])}});
    for (const auto kind : {Variable::Kind::coordinate, Variable::Kind::rate})
        for (int i = 0; i < n; ++i) inputs.push_back(program.variable({kind, i}));
    const auto found = partials(program, others, inputs, EliminationOrder::least_fill);
    if (!found) return std::nullopt;
    for (const Partial& partial : *found) {
        int& value = (*values)[static_cast<std::size_t>(partial.output * 2 * n + partial.input)];
        value = program.sum(0, {{1, value}, {1, partial.node}});
    }
    return std::pair{std::move(program), *std::move(values)};
}

FunctionProgram RobotFunctions::mass_inverse() const {
    if (const auto* norm = norm_of_quaternion(m_))
        throw ModelError(
            say("the mass matrix has no inverse, because the quaternion of '{}' has no inertia along itself; turn "
                "it by angles instead, or leave 'mass_inverse' out",
                norm->name));
    const int n = m_.size();
    Program program = dynamics("mass").program;
    const std::vector<int> full = program.nodes_of(Group::function);
    std::vector<int> lower;
    std::vector<std::vector<int>> units;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i; ++j) lower.push_back(full[static_cast<std::size_t>(i * n + j)]);
        units.emplace_back();
        for (int j = 0; j < n; ++j) units.back().push_back(program.number(i == j ? 1 : 0));
    }
    std::optional<std::vector<std::vector<int>>> solutions;
    if (n > 0) solutions = solve_for_sides(program, lower, units, 0);
    if (!solutions) throw ModelError(say("the mass matrix is singular at every state, so that it has no inverse"));
    std::vector<int> values;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            values.push_back(
                (*solutions)[static_cast<std::size_t>(std::min(i, j))][static_cast<std::size_t>(std::max(i, j))]);
    return {.name = "mass_inverse",
            .about = "The inverse of the mass matrix: d q'' / d tau of forward dynamics.",
            .rows = n,
            .columns = n,
            .program = with_values_only(std::move(program), values)};
}

// C_ij = ½ Σ_k (∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i) q'_k  (Murray, Li & Sastry, A Mathematical Introduction to
// Robotic Manipulation (1994), (4.23)). With p = M q' at constant q' that is ½ (Σ_k ∂M/∂q_k q'_k + ∂p/∂q −
// (∂p/∂q)ᵀ).
std::optional<Program> RobotFunctions::christoffel() const {
    const int n = m_.size();
    const Program mass = dynamics("mass").program;
    std::vector<Program> forms;
    for (const EliminationOrder order : every_order) {
        Program program = mass;
        const std::vector<int> M = program.nodes_of(Group::function);
        const auto at = [n](int i, int j) { return static_cast<std::size_t>(i * n + j); };
        const auto by = jacobian_of(program, M, Variable::Kind::coordinate, n, order);  // of M_ij by q_k
        if (!by) continue;
        const auto slope = [&](int i, int j, int k) {
            return (*by)[at(i, j) * static_cast<std::size_t>(n) + static_cast<std::size_t>(k)];
        };
        const Rational half = Rational(1) / 2;
        std::vector<int> values;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                std::vector<Program::Term> terms;
                for (int k = 0; k < n; ++k)
                    terms.emplace_back(
                        half,
                        program.product(
                            1,
                            {{program.sum(0, {{1, slope(i, j, k)}, {1, slope(i, k, j)}, {-1, slope(j, k, i)}}), 1},
                             {program.variable({Variable::Kind::rate, k}), 1}}));
                values.push_back(program.sum(0, terms));
            }
        forms.push_back(with_values_only(std::move(program), values));
    }
    if (forms.empty()) return std::nullopt;
    return with_fewest_operations(std::move(forms));
}

// The velocity terms c_i = Σ Γ_ijk q'_j q'_k have ∂c_i/∂q'_j = 2 Σ_k Γ_ijk q'_k, if nothing but the state moves
// the bodies.
std::optional<Program> RobotFunctions::half_of_bias_by_rates(LinkAxes axes) const {
    if (!tree_ || (axes == LinkAxes::still && !has_parallel_axes(*tree_))) return std::nullopt;
    const int n = m_.size();
    std::vector<Program> forms;
    for (const EliminationOrder order : every_order) {
        Program program = begun(m_, fold_);
        const auto lowering = lowering_into(program, m_, {}, fold_);
        const TreeFunctions tree(program, *tree_, axes, *m_.z, lowering);
        const std::vector<int> bias = tree.loads(TreeFunctions::Terms::bias);
        constexpr unsigned time = 1U << static_cast<unsigned>(Variable::Kind::time);
        if (std::any_of(bias.begin(), bias.end(), [&](int node) { return (program[node].depends & time) != 0; }))
            return std::nullopt;
        auto values = jacobian_of(program, bias, Variable::Kind::rate, n, order);
        if (!values) continue;
        for (int& node : *values) node = program.sum(0, {{Rational(1) / 2, node}});
        forms.push_back(with_values_only(std::move(program), *values));
    }
    if (forms.empty()) return std::nullopt;
    return with_fewest_operations(std::move(forms));
}

FunctionProgram RobotFunctions::coriolis() const {
    if (const auto* norm = norm_of_quaternion(m_))
        throw ModelError(say(
            "the quaternion of '{}' has four coordinates for three degrees of freedom, so that there is no matrix "
            "C of its own; turn it by angles instead, or leave 'coriolis' out",
            norm->name));
    std::vector<Program> forms;
    for (const LinkAxes axes : {LinkAxes::own, LinkAxes::still})
        if (auto form = half_of_bias_by_rates(axes)) forms.push_back(*std::move(form));
    if (m_.size() <= most_by_lagrange || forms.empty())
        if (auto form = christoffel()) forms.push_back(*std::move(form));
    if (forms.empty())
        throw ModelError(
            say("the derivatives of the mass matrix are too long to be written out; leave 'coriolis' "
                "out"));
    return {.name = "coriolis",
            .about = "C(q, q') by Christoffel's symbols: M' - 2 C is skew, and C q' are the velocity terms.",
            .rows = m_.size(),
            .columns = m_.size(),
            .program = with_fewest_operations(std::move(forms))};
}

}  // namespace alembert
