// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/lower.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <set>

#include "alembert/base/dense.hpp"
#include "base/language/say.hpp"
#include "model/formalism/joint_tree.hpp"
#include "model/formalism/kinematics.hpp"
#include "program/lower/articulated_bodies.hpp"
#include "program/lower/energy_roots.hpp"
#include "program/lower/lowering.hpp"
#include "program/lower/normal_forces.hpp"
#include "program/lower/project.hpp"
#include "program/solve.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;

namespace {

/// Whether the mass matrix of n rows is singular for these values of nodes, in whatever units.
bool is_singular(const std::vector<int>& mass, Eigen::Index n, const std::vector<double>& value) {
    constexpr double negligible = 1e-12;
    if (value.empty()) return false;
    Eigen::MatrixXd M(n, n);
    for (Eigen::Index i = 0, k = 0; i < n; ++i)
        for (Eigen::Index j = 0; j <= i; ++j, ++k)
            M(i, j) = M(j, i) = value[static_cast<std::size_t>(mass[static_cast<std::size_t>(k)])];
    const Eigen::VectorXd scale = unit_scale(M);
    const Eigen::MatrixXd unit = scale.asDiagonal() * M * scale.asDiagonal();
    return unit.allFinite() && eigenpairs(unit).values[0] < negligible;
}

/// A state for the pivots, if the constraints have to give some to coordinates without mass, or to combinations of
/// them that have none where the constraints hold (massless cranks that carry the middle of their coupler).
Witness witness_of(const Program& program, const Mechanism& m, const Equations& e, const std::vector<int>& mass,
                   const std::function<Start()>& admissible) {
    bool is_massless = false;
    for (int i = 0; i < e.size(); ++i) is_massless = is_massless || program.is_zero(mass[i * (i + 1) / 2 + i]);
    if (m.constraints.empty() || !admissible) return {};
    const Witness witness(state_of(admissible(), m, e));
    return is_massless || is_singular(mass, e.size(), witness.values(program)) ? witness : Witness();
}

/// Defines q' = h(q,u,t) and q'' if the speeds are not the rates; u' are the nodes of `udot`.
void define_rates(Lowering& lowering, Program& program, const Mechanism& m, const Equations& e,
                  const std::vector<int>& udot) {
    if (e.speeds_are_rates()) return;
    for (int k = 0; k < e.size(); ++k) {
        lowering.define(e.u[k], program.variable({Variable::Kind::rate, k}));
        lowering.define(e.udot[k], udot[k]);
    }
    const std::vector<ex> second = accelerations(m, e);
    lowering.lower_definitions(e.h);
    lowering.lower_definitions(second);
    std::vector<int> first(e.h.size()), then(e.h.size());
    for (std::size_t i = 0; i < e.h.size(); ++i) first[i] = lowering(e.h[i]);
    for (std::size_t i = 0; i < e.h.size(); ++i) then[i] = lowering(second[i]);
    for (std::size_t i = 0; i < e.h.size(); ++i) {
        lowering.define(m.qdot[i], first[i]);
        lowering.define(m.qddot[i], then[i]);
    }
}

/// Adds roots for the scene's generalized speeds and their rates.
void add_speed_roots(Lowering& lowering, Program& program, const Mechanism& m, const Equations& e) {
    const bool in_state = !e.speeds_are_rates();
    std::vector<ex> values, rates;
    for (const Mechanism::Speed& speed : m.speeds) {
        values.push_back(in_state ? speed.u : speed.form);
        rates.push_back(in_state ? ex(speed.udot) : m.time_derivative({speed.form})[0]);
    }
    lowering.lower_definitions(values);
    lowering.lower_definitions(rates);
    for (std::size_t k = 0; k < values.size(); ++k)
        program.roots.push_back({Group::speed, m.speeds[k].u.get_name(), lowering(values[k])});
    for (std::size_t k = 0; k < rates.size(); ++k)
        program.roots.push_back({Group::speed_rate, m.speeds[k].u.get_name(), lowering(rates[k])});
}

/// For redundant constraints, takes the multipliers of least norm that give the same forces, Σ_all rowᵀ λ = Σ_kept
/// rowᵀ λ'. With B = A_all A_keptᵀ they are λ = B w, BᵀB w = A_kept A_keptᵀ λ'.
void share_out(Lowering& lowering, Program& program, const Mechanism& m, const ex& power) {
    lowering.lower_definitions({power});
    // The work of moving constraints is expressed by the multipliers of the constraints that are kept.
    lowering(power);
    std::vector<const Mechanism::Constraint*> all;
    for (const auto* list : {&m.constraints, &m.redundant})
        for (const Mechanism::Constraint& c : *list) all.push_back(&c);
    const std::size_t kept = m.constraints.size();
    std::vector<ex> wanted;
    for (const auto* c : all) wanted.insert(wanted.end(), c->row.begin(), c->row.end());
    lowering.lower_definitions(wanted);
    const auto dot = [&](const std::vector<int>& a, const std::vector<int>& b) {
        std::vector<Program::Term> terms;
        for (std::size_t i = 0; i < a.size(); ++i)
            terms.emplace_back(1, program.product(1, {{a[i], 1}, {b[i], 1}}));
        return program.sum(0, terms);
    };
    std::vector<std::vector<int>> rows, B(kept);  // B is stored by columns
    for (const auto* c : all) {
        rows.emplace_back();
        for (const ex& e : c->row) rows.back().push_back(lowering(e));
    }
    for (std::size_t k = 0; k < kept; ++k)
        for (const auto& row : rows) B[k].push_back(dot(row, rows[k]));
    std::vector<int> square, right, lambda;
    for (std::size_t k = 0; k < kept; ++k) lambda.push_back(lowering(m.constraints[k].multiplier));
    for (std::size_t k = 0; k < kept; ++k) {
        for (std::size_t j = 0; j <= k; ++j) square.push_back(dot(B[k], B[j]));
        right.push_back(dot({B[k].begin(), B[k].begin() + static_cast<std::ptrdiff_t>(kept)}, lambda));
    }
    const auto w = solve_symmetric(program, square, right, static_cast<int>(kept));
    for (std::size_t c = 0; c < all.size(); ++c) {
        std::vector<Program::Term> terms;
        for (std::size_t k = 0; k < kept && w; ++k)
            terms.emplace_back(1, program.product(1, {{B[k][c], 1}, {(*w)[k], 1}}));
        if (w || c >= kept) lowering.define(all[c]->multiplier, program.sum(0, terms));
    }
}

}  // namespace

Program begun(const Mechanism& m, bool fold) {
    Program program;
    program.source_labels = m.z->source_labels();
    for (const Mechanism::Parameter& p : m.parameters)
        if (p.independent && !fold)
            program.parameters.push_back(
                {p.symbol.get_name(), p.unit, ex_to<GiNaC::numeric>(p.value).to_double()});
    for (int i = 0; i < m.size(); ++i) program.coordinates.push_back({m.q[i].get_name(), m.units[i]});
    program.name = m.name;
    return program;
}

Program lower(const Mechanism& mechanism, const Equations& equations, const Energy& energy,
              const LowerOptions& options) {
    const Mechanism m = in_terms_of(energy, in_terms_of(equations, mechanism));
    Program program = begun(m, options.fold);
    program.formulation = equations.formalism;
    program.is_textbook = options.is_textbook;
    Lowering lowering(program, m, options.fold);

    const int n = equations.size();
    const bool has_speeds = !equations.speeds_are_rates();
    std::vector<int> udot;
    for (int k = 0; k < n && has_speeds; ++k) {
        const SymbolInfo& info = m.symbols->info(equations.u[k]);
        const bool is_rate = info.kind == SymbolInfo::Kind::coordinate;
        program.speeds.push_back({.name = equations.u[k].get_name() + (is_rate ? "'" : ""),
                                  .unit = m.speeds.empty() ? "" : m.speeds[k].unit,
                                  .rate_of = is_rate ? info.index : -1});
        udot.push_back(program.variable({Variable::Kind::acceleration, k}));
    }
    define_rates(lowering, program, m, equations, udot);

    std::vector<ex> wanted{energy.kinetic, energy.potential, energy.energy, energy.jacobi};
    const bool recursive = options.recursion && equations.tree, has_matrix = equations.M.rows() > 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i && !recursive; ++j) wanted.push_back(equations.M(i, j));
        wanted.push_back(recursive ? equations.tree->forces[i] : equations.forcing(i));
    }
    const std::vector<int> kept = equations.kept(m);
    for (std::size_t k = 0; k < equations.A.size(); ++k) {
        wanted.insert(wanted.end(), equations.A[k].begin(), equations.A[k].end());
        wanted.push_back(equations.gamma[k]);
    }
    for (const Mechanism::Constraint& constraint : m.constraints) {
        if (has_speeds) wanted.insert(wanted.end(), constraint.row.begin(), constraint.row.end());
        if (constraint.position) wanted.push_back(*constraint.position);
        wanted.push_back(constraint.drift);
    }
    // e·e = 1 of a quaternion: there is no inertia for the rate along e. Adding c Aᵀ(A u' − γ), which is 0, makes
    // the matrix regular. c is a fourth of the mean diagonal element, so that the new eigenvalue has the size of
    // the others.
    std::vector<std::tuple<ex, const std::vector<ex>*, ex>> norms;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        if (!m.constraints[kept[k]].norm || !has_matrix) continue;
        GiNaC::exvector diagonal;
        for (int i = 0; i < n && !recursive; ++i)
            if (!equations.A[k][i].is_zero()) diagonal.push_back(equations.M(i, i));
        const int count = std::max<int>(1, static_cast<int>(diagonal.size()));
        norms.emplace_back(m.z->name(GiNaC::add(std::move(diagonal)) / (4 * count)), &equations.A[k],
                           equations.gamma[k]);
        wanted.push_back(std::get<0>(norms.back()));
    }
    // Open contacts exert no force; contacts that the equations keep closed get their multipliers below. f is
    // taken without friction whose normal force is a multiplier.
    Lowering acting_alone(program, m, options.fold);
    for (const Mechanism::Unilateral& contact : m.unilateral)
        for (Lowering* const one : {&lowering, &acting_alone})
            one->define(contact.gap.multiplier, program.number(0));
    const NormalForces normal_forces(m, equations);
    program.friction_on_multipliers = normal_forces.any();
    if (normal_forces.any()) {
        normal_forces.leave_out(acting_alone, program);
        define_rates(acting_alone, program, m, equations, udot);
        acting_alone.lower_definitions(wanted);
    }
    Lowering& acting = normal_forces.any() ? acting_alone : lowering;
    std::vector<ex> others;
    for (const ex& e : wanted)
        if (!normal_forces.any() || !m.z->depends(e, normal_forces.multipliers())) others.push_back(e);
    lowering.lower_definitions(others);

    const auto blame_row = [&](int i) {
        if (equations.row_sources.empty()) return;
        std::vector<int> sources;
        for (const std::string& label : equations.row_sources[i]) {
            const auto found = std::find(program.source_labels.begin(), program.source_labels.end(), label);
            sources.push_back(static_cast<int>(found - program.source_labels.begin()));
            if (found == program.source_labels.end()) program.source_labels.push_back(label);
        }
        program.set_sources(sources);
    };
    std::vector<int> mass, forcing;
    RecursionNodes by_tree;
    if (recursive)
        by_tree = recursion(program, *equations.tree, *m.z, *options.recursion, has_matrix,
                            [&](const ex& e) { return acting(e); });
    std::vector<int> weights;  // c of each norm
    for (const auto& [c, row, gamma] : norms) {
        std::vector<Program::Term> diagonal;
        for (int i = 0; i < n && recursive; ++i)
            if (!(*row)[i].is_zero()) diagonal.emplace_back(1, by_tree.mass[i * (i + 1) / 2 + i]);
        const Rational quarter = Rational(1) / (4 * std::max<int>(1, static_cast<int>(diagonal.size())));
        weights.push_back(recursive ? program.sum(0, {{quarter, program.sum(0, diagonal)}}) : lowering(c));
    }
    for (int i = 0; i < n && has_matrix; ++i)
        for (int j = 0; j <= i; ++j) {
            blame_row(i);
            std::vector<Program::Term> terms{
                {1, recursive ? by_tree.mass[i * (i + 1) / 2 + j] : lowering(equations.M(i, j))}};
            for (std::size_t k = 0; k < norms.size(); ++k) {
                const std::vector<ex>& row = *std::get<1>(norms[k]);
                terms.emplace_back(
                    1, program.product(1, {{weights[k], 1}, {lowering(row[i]), 1}, {lowering(row[j]), 1}}));
            }
            mass.push_back(program.sum(0, terms));
            program.roots.push_back({Group::mass, fmt::format("M{}{}{}", i, n > 10 ? "_" : "", j), mass.back()});
        }
    for (int i = 0; i < n && has_matrix; ++i) {
        blame_row(i);
        std::vector<Program::Term> terms{{1, recursive ? by_tree.forcing[i] : acting(equations.forcing(i))}};
        for (std::size_t k = 0; k < norms.size(); ++k) {
            const auto& [c, row, gamma] = norms[k];
            terms.emplace_back(
                1, program.product(1, {{weights[k], 1}, {lowering((*row)[i]), 1}, {lowering(gamma), 1}}));
        }
        forcing.push_back(program.sum(0, terms));
        program.roots.push_back({Group::forcing, fmt::format("f{}", i), forcing.back()});
    }
    program.set_sources({0});
    // [M Aᵀ; A 0] (u', −λ) = (f, γ)
    std::vector<int> row_of(m.constraints.size(), -1);  // the row in A
    for (std::size_t k = 0; k < kept.size(); ++k) row_of[kept[k]] = static_cast<int>(k);
    for (std::size_t c = 0; c < m.constraints.size(); ++c) {
        const Mechanism::Constraint& constraint = m.constraints[c];
        std::vector<Program::Term> velocity{{1, lowering(constraint.drift)}};
        for (int i = 0; i < m.size(); ++i) {
            const int entry = lowering(has_speeds ? constraint.row[i] : equations.A[c][i]);
            program.roots.push_back({Group::row, fmt::format("A{}_{}", c, i), entry});
            velocity.emplace_back(1, program.product(1, {{entry, 1}, {lowering(m.qdot[i]), 1}}));
        }
        if (const int k = row_of[c]; k >= 0) {
            for (int i = 0; i < n; ++i) mass.push_back(lowering(equations.A[k][i]));
            for (int j = 0; j <= k; ++j) mass.push_back(program.number(0));
            forcing.push_back(lowering(equations.gamma[k]));
            program.roots.push_back(
                {Group::gamma, fmt::format("gamma{}", c), forcing.back(), static_cast<int>(c)});
        }
        for (int i = 0; i < n && has_speeds; ++i)
            program.roots.push_back({Group::speed_row, fmt::format("B{}_{}", c, i),
                                     row_of[c] < 0 ? program.number(0) : lowering(equations.A[row_of[c]][i])});
        program.roots.push_back({Group::position, constraint.name,
                                 constraint.position ? lowering(*constraint.position) : program.number(0)});
        program.roots.push_back({Group::velocity, constraint.name, program.sum(0, velocity)});
    }
    if (n > 0 && !has_matrix && !by_tree.acceleration)
        throw ModelError(say(
            "the rates of the joints do not determine those of the coordinates; take the formalism 'recursive'"));
    const Witness witness = has_matrix ? witness_of(program, m, equations, mass, options.admissible) : Witness();
    // In a tree whose only constraints are e·e = 1 of its ball joints, the recursion gives all that is unknown.
    const std::optional<std::vector<int>> alone =
        by_tree.acceleration && !normal_forces.any() ? norms_alone(*equations.tree, m) : std::nullopt;
    if (alone) {
        by_tree.acceleration->resize(static_cast<std::size_t>(n) + alone->size());
        for (std::size_t b = 0; b < alone->size(); ++b)
            (*by_tree.acceleration)[n + row_of[(*alone)[b]]] = program.sum(0, {{-1, by_tree.multipliers[b]}});
    }
    const std::optional<NormalForces::Solution> rubbing =
        normal_forces.any() ? normal_forces.solve(lowering, program, mass, forcing) : std::nullopt;
    std::optional<std::vector<int>> solution;
    if (n == 0)
        solution.emplace();
    else if (alone)
        solution = by_tree.acceleration;
    else if (rubbing)
        solution = rubbing->unknowns;
    else if (!normal_forces.any())
        solution = solve_symmetric(program, mass, forcing, n, witness);
    if (solution) {
        for (int i = 0; i < n; ++i)
            program.roots.push_back({Group::acceleration, fmt::format("a{}", i), (*solution)[i]});
        for (std::size_t k = 0; k < kept.size(); ++k)
            lowering.define(equations.lambda[k], program.sum(0, {{-1, (*solution)[n + k]}}));
        if (!m.constraints.empty()) add_projection(program, m, equations, mass, options.fold, witness);
        Lowering motion(program, m, options.fold);  // with the solution for u'
        if (!equations.eliminated.empty()) {
            define_rates(motion, program, m, equations, {solution->begin(), solution->begin() + n});
            for (const GiNaC::symbol& lambda : equations.lambda) motion.define(lambda, lowering(lambda));
            wanted.clear();
            for (const Equations::Eliminated& e : equations.eliminated) wanted.push_back(e.multiplier);
            motion.lower_definitions(wanted);
            for (const Equations::Eliminated& e : equations.eliminated)
                lowering.define(m.constraints[e.constraint].multiplier, motion(e.multiplier));
        }
        if (!m.redundant.empty()) share_out(lowering, program, m, energy.power);
        for (const auto* list : {&m.constraints, &m.redundant})
            for (const Mechanism::Constraint& constraint : *list)
                program.roots.push_back(
                    {Group::multiplier, constraint.multiplier.get_name(), lowering(constraint.multiplier)});
    } else {
        program.singular = true;
        // The power and outputs may contain multipliers. Their values are never used, because there is no motion.
        for (const auto& lambda : equations.lambda) lowering.define(lambda, program.number(0));
        for (const Mechanism::Constraint& constraint : m.redundant)
            lowering.define(constraint.multiplier, program.number(0));
    }
    for (int i = 0; i < m.size() && has_speeds; ++i) {
        program.roots.push_back({Group::rate, m.q[i].get_name(), lowering(m.qdot[i])});
        program.roots.push_back({Group::second_rate, m.q[i].get_name(), lowering(m.qddot[i])});
    }
    add_speed_roots(lowering, program, m, equations);
    wanted = {energy.power};  // the power and outputs may contain multipliers, which are known by now
    for (const auto* parts : {&m.outputs, &m.events})
        for (const Mechanism::Definition& part : *parts) wanted.push_back(part.value);
    for (const Mechanism::Friction& f : m.frictions)
        wanted.insert(wanted.end(), {f.slip, f.across.value_or(0), f.coefficient, f.resting, f.normal});
    lowering.lower_definitions(wanted);
    add_energy_roots(lowering, program, m, equations, energy,
                     norms.empty() && has_matrix ? mass : std::vector<int>());
    for (const Mechanism::Definition& part : m.outputs)
        program.roots.push_back({Group::output, part.name, lowering(part.value)});
    for (const Mechanism::Definition& part : m.events)
        program.roots.push_back({Group::event, part.name, lowering(part.value)});
    for (const Mechanism::Friction& f : m.frictions) {
        const int bound = f.resting.is_equal(f.coefficient)
                              ? program.number(1)
                              : program.product(1, {{lowering(f.resting), 1}, {lowering(f.coefficient), -1}});
        program.roots.push_back({Group::slip, f.name, lowering(f.slip)});
        program.roots.push_back({Group::stick_bound, f.name, bound});
        program.roots.push_back({Group::friction, f.name, lowering(f.coefficient)});
        program.roots.push_back({Group::normal, f.name, lowering(f.normal)});
        program.roots.push_back(
            {Group::determinant, f.name,
             rubbing && normal_forces.determine(f) ? rubbing->determinant : program.number(1)});
        if (f.is_held)
            program.roots.push_back(
                {Group::across, f.name, lowering(*f.across), static_cast<int>(&f - m.frictions.data())});
    }
    for (std::size_t k = 0; rubbing && k < rubbing->columns.size(); ++k)
        for (const int node : rubbing->columns[k].nodes)
            program.roots.push_back({Group::friction_column, "friction", node, kept[rubbing->columns[k].row]});
    return program.canonical();
}

Program lower_constraints(const Mechanism& m) {
    Program program = begun(m, false);
    Lowering lowering(program, m, false);
    std::vector<ex> wanted;
    const auto want = [&](const std::vector<ex>& row, const ex& value, const ex& drift) {
        wanted.insert(wanted.end(), row.begin(), row.end());
        wanted.insert(wanted.end(), {value, drift});
    };
    for (const Mechanism::Constraint& c : m.constraints) want(c.row, c.position.value_or(0), c.drift);
    for (const Mechanism::Speed& s : m.speeds) want(s.row, s.form, s.drift);
    lowering.lower_definitions(wanted);
    const auto linear = [&](const std::vector<ex>& row, const ex& drift, Group group) {
        std::vector<Program::Term> value{{1, lowering(drift)}};
        for (int i = 0; i < m.size(); ++i) {
            const int entry = lowering(row[i]);
            program.roots.push_back({group, "", entry});
            value.emplace_back(1, program.product(1, {{entry, 1}, {lowering(m.qdot[i]), 1}}));
        }
        return program.sum(0, value);
    };
    for (const Mechanism::Constraint& c : m.constraints) {
        program.roots.push_back({Group::velocity, c.name, linear(c.row, c.drift, Group::row)});
        program.roots.push_back({Group::position, c.name, c.position ? lowering(*c.position) : program.number(0)});
    }
    for (const Mechanism::Speed& s : m.speeds)
        program.roots.push_back({Group::speed, s.u.get_name(), linear(s.row, s.drift, Group::form_row)});
    return program.canonical();
}

int lower_expression(Program& program, const Mechanism& mechanism, const ex& e) {
    return lower_expressions(program, mechanism, {e})[0];
}

std::vector<int> lower_expressions(Program& program, const Mechanism& mechanism, const std::vector<ex>& list,
                                   const std::vector<std::pair<GiNaC::symbol, int>>& given) {
    Lowering lowering(program, mechanism, false);
    for (const auto& [symbol, node] : given) lowering.define(symbol, node);
    lowering.lower_definitions(list);
    std::vector<int> nodes;
    for (const ex& e : list) nodes.push_back(lowering(e));
    return nodes;
}

std::function<int(const ex&)> lowering_into(Program& program, const Mechanism& mechanism,
                                            const std::vector<std::pair<GiNaC::symbol, int>>& given, bool fold) {
    const auto lowering = std::make_shared<Lowering>(program, mechanism, fold);
    for (const auto& [symbol, node] : given) lowering->define(symbol, node);
    return [lowering](const ex& e) {
        lowering->lower_definitions({e});
        return (*lowering)(e);
    };
}

}  // namespace alembert
