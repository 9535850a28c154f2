// SPDX-License-Identifier: GPL-2.0-or-later
//     [M Aᵀ; A 0] (u', −λ) = (f, γ),   its lower triangle K and its right-hand side as nodes
//
// e·e = 1 of a quaternion: there is no inertia for the rate along e. Adding c Aᵀ(A u' − γ), which is 0, makes the
// matrix regular. c is a fourth of the mean diagonal element, so that the new eigenvalue has the size of the
// others.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <map>

#include "alembert/base/dense.hpp"
#include "base/language/say.hpp"
#include "model/formalism/joint_tree.hpp"
#include "model/formalism/kinematics.hpp"
#include "model/formalism/with_states.hpp"
#include "program/lower/articulated_bodies.hpp"
#include "program/lower/energy_roots.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/lowering.hpp"
#include "program/lower/normal_forces.hpp"
#include "program/lower/project.hpp"
#include "program/solve.hpp"
#include "program/tie.hpp"

namespace alembert {

using GiNaC::ex;

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

bool is_state(const Mechanism& m, const GiNaC::symbol& u) {
    return m.symbols->info(u).kind == SymbolInfo::Kind::state;
}

/// Defines q' = h(q,u,t) and q'' if the speeds are not the rates; u' are the nodes of `udot`.
void define_rates(Lowering& lowering, Program& program, const Mechanism& m, const Equations& e,
                  const std::vector<int>& udot) {
    if (e.speeds_are_rates()) return;
    for (int k = 0; k < e.size(); ++k) lowering.define(e.u[k], program.variable({Variable::Kind::rate, k}));
    for (int k = 0; k < e.size(); ++k)
        if (!is_state(m, e.u[k])) lowering.define(e.udot[k], udot[k]);
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
    const bool in_state = std::any_of(m.speeds.begin(), m.speeds.end(), [&](const Mechanism::Speed& speed) {
        return std::any_of(e.u.begin(), e.u.end(), [&](const auto& u) { return u.is_equal(speed.u); });
    });
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
/// rowᵀ λ'. With B = A_all A_keptᵀ they are λ = B w, BᵀB w = A_kept A_keptᵀ λ'. Those that are tied in K are the
/// least already.
void share_out(Lowering& lowering, Program& program, const Mechanism& m, const ex& power, bool are_tied) {
    for (const Mechanism::Constraint& c : m.redundant)
        if (c.tie && !are_tied) lowering.define(c.multiplier, program.number(0));
    lowering.lower_definitions({power});
    // The work of moving constraints is expressed by the multipliers of the constraints that are kept.
    lowering(power);
    std::vector<const Mechanism::Constraint*> all;
    std::size_t kept = 0;
    for (const auto* list : {&m.constraints, &m.redundant}) {
        for (const Mechanism::Constraint& c : *list)
            if (!(are_tied && c.tie)) all.push_back(&c);
        if (list == &m.constraints) kept = all.size();
    }
    if (all.size() == kept) return;
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
    for (std::size_t k = 0; k < kept; ++k) lambda.push_back(lowering(all[k]->multiplier));
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

/// Adds the equations to a program, part by part in the order of its roots.
class EquationsLowering {
public:
    EquationsLowering(const Mechanism& m, const Equations& e, const Energy& energy, const LowerOptions& options)
        : m_(m),
          e_(e),
          energy_(energy),
          options_(options),
          n_(e.size()),
          states_(options.states_are_given ? 0 : static_cast<int>(m.states.size())),
          has_speeds_(!e.speeds_are_rates()),
          has_matrix_(e.M.rows() > 0),
          is_recursive_(options.recursion && e.tree),
          kept_(e.kept(m)),
          row_of_(m.constraints.size(), -1),
          program_(begun(m, options.fold)),
          lowering_(program_, m, options.fold),
          acting_alone_(program_, m, options.fold) {
        program_.formulation = e.formalism;
        program_.is_textbook = options.is_textbook;
        program_.states = states_;
        for (std::size_t k = 0; k < kept_.size(); ++k) row_of_[kept_[k]] = static_cast<int>(k);
        for (const Mechanism::Constraint& c : m.redundant)
            if (c.tie && has_matrix_ && !has_speeds_) tied_.push_back(&c);
    }

    Program run() {
        const std::vector<int> udot = add_speeds();
        define_rates(lowering_, program_, m_, e_, udot);
        std::vector<ex> wanted = entries();
        const std::vector<Norm> norms = norms_of_quaternions();
        program_.has_norm_terms = !norms.empty();
        for (const Norm& norm : norms) wanted.push_back(norm.share);
        // Open contacts exert no force; contacts that the equations keep closed get their multipliers below.
        for (const Mechanism::Unilateral& contact : m_.unilateral)
            for (Lowering* const one : {&lowering_, &acting_alone_})
                one->define(contact.gap.multiplier, program_.number(0));
        const bool has_letters = options_.reactions_are_letters && define_letters();
        const NormalForces normal_forces = has_letters ? NormalForces(e_) : NormalForces(m_, e_);
        lower_definitions(wanted, normal_forces, udot);

        Lowering& acting = normal_forces.any() ? acting_alone_ : lowering_;
        RecursionNodes by_tree;
        if (is_recursive_)
            by_tree = recursion(program_, *e_.tree, *m_.z, *options_.recursion, has_matrix_,
                                [&](const ex& expression) { return acting(expression); });
        const std::vector<int> weights = weights_of(norms, by_tree);
        std::vector<int> K = mass_nodes(norms, weights, by_tree);
        std::vector<int> right = forcing_nodes(norms, weights, by_tree, acting);
        program_.set_sources({0});
        add_constraints(K, right);
        add_ties(K, right);
        if (n_ > 0 && !has_matrix_ && !by_tree.acceleration)
            throw ModelError(
                say("the rates of the joints do not determine those of the coordinates; take the formalism "
                    "'recursive'"));
        const Witness witness = has_matrix_ ? witness_of(program_, m_, e_, K, options_.admissible) : Witness();
        const std::optional<std::vector<int>> by_recursion =
            normal_forces.any() ? std::nullopt : unknowns_by_recursion(by_tree);
        const std::optional<NormalForces::Solution> normal_forces_found =
            normal_forces.any() ? normal_forces.solve(lowering_, program_, K, right) : std::nullopt;
        std::optional<std::vector<int>> solution;
        if (n_ == 0)
            solution.emplace();
        else if (by_recursion)
            solution = by_recursion;
        else if (normal_forces_found)
            solution = normal_forces_found->unknowns;
        else if (!normal_forces.any() && !has_letters)
            solution = solve_symmetric(program_, K, right, n_, witness);

        if (solution)
            add_motion(*solution, K, witness);
        else
            leave_without_motion();
        if (!m_.redundant.empty()) add_redundant();
        add_rates();
        add_speed_roots(lowering_, program_, m_, e_);
        lower_outputs();
        add_energy_roots(lowering_, program_, m_, e_, energy_,
                         norms.empty() && has_matrix_ ? K : std::vector<int>());
        add_outputs();
        add_frictions(normal_forces, normal_forces_found);
        return program_.canonical();
    }

private:
    /// A row of e·e = 1 that is given an inertia.
    struct Norm {
        ex share;  ///< c
        const std::vector<ex>* row;
        ex gamma;
    };

    /// Names the speeds, and gives the nodes of u'.
    std::vector<int> add_speeds() {
        std::vector<int> udot;
        for (int k = 0; k < n_ && has_speeds_; ++k) {
            const SymbolInfo& info = m_.symbols->info(e_.u[k]);
            const bool is_rate = info.kind == SymbolInfo::Kind::coordinate;
            const bool is_of_scene = k >= n_ - states_;
            std::string unit;
            if (is_of_scene)
                unit = m_.states[static_cast<std::size_t>(k - (n_ - states_))].unit;
            else if (info.kind == SymbolInfo::Kind::speed && !m_.speeds.empty())
                unit = m_.speeds[static_cast<std::size_t>(info.index)].unit;
            if (is_rate && states_ > 0) unit = per_second(m_.units[static_cast<std::size_t>(info.index)]);
            program_.speeds.push_back({.name = info.text(), .unit = unit, .rate_of = is_rate ? info.index : -1});
            udot.push_back(program_.variable({Variable::Kind::acceleration, k}));
        }
        return udot;
    }

    /// Whether the row belongs to the joints of a tree, and to no state of the scene.
    bool is_of_tree(int i) const { return is_recursive_ && i < n_ - states_; }

    /// The expressions of the energies, of M, f, A and γ, and of the constraints.
    std::vector<ex> entries() const {
        std::vector<ex> wanted{energy_.kinetic, energy_.potential, energy_.energy, energy_.jacobi};
        for (int i = 0; i < n_; ++i) {
            for (int j = 0; j <= i && !is_recursive_; ++j) wanted.push_back(e_.M(i, j));
            wanted.push_back(is_of_tree(i) ? e_.tree->forces[i] : e_.forcing(i));
        }
        for (std::size_t k = 0; k < e_.A.size(); ++k) {
            wanted.insert(wanted.end(), e_.A[k].begin(), e_.A[k].end());
            wanted.push_back(e_.gamma[k]);
        }
        for (const Mechanism::Constraint& constraint : m_.constraints) {
            if (has_speeds_) wanted.insert(wanted.end(), constraint.row.begin(), constraint.row.end());
            if (constraint.position) wanted.push_back(*constraint.position);
            wanted.push_back(constraint.offset);
        }
        return wanted;
    }

    std::vector<Norm> norms_of_quaternions() const {
        std::vector<Norm> norms;
        for (std::size_t k = 0; k < kept_.size(); ++k) {
            if (!m_.constraints[kept_[k]].norm || !has_matrix_) continue;
            GiNaC::exvector diagonal;
            for (int i = 0; i < n_ && !is_recursive_; ++i)
                if (!e_.A[k][i].is_zero()) diagonal.push_back(e_.M(i, i));
            const int count = std::max<int>(1, static_cast<int>(diagonal.size()));
            norms.push_back({.share = m_.z->name(GiNaC::add(std::move(diagonal)) / (4 * count)),
                             .row = &e_.A[k],
                             .gamma = e_.gamma[k]});
        }
        return norms;
    }

    /// Makes variables of the reactions that give friction its normal force; false if there are none.
    bool define_letters() {
        bool any = false;
        for (auto k = static_cast<int>(m_.frictions.size()); k-- > 0;)
            if (const auto& reaction = m_.frictions[static_cast<std::size_t>(k)].multiplier) {
                lowering_.define(*reaction, program_.variable({Variable::Kind::unknown, k}));
                any = true;
            }
        return any;
    }

    /// f is taken without friction whose normal force is a multiplier.
    void lower_definitions(const std::vector<ex>& wanted, const NormalForces& normal_forces,
                           const std::vector<int>& udot) {
        program_.friction_on_multipliers = normal_forces.any();
        if (normal_forces.any()) {
            normal_forces.leave_out(acting_alone_, program_);
            define_rates(acting_alone_, program_, m_, e_, udot);
            acting_alone_.lower_definitions(wanted);
        }
        std::vector<ex> others;
        for (const ex& one : wanted)
            if (!normal_forces.any() || !m_.z->depends(one, normal_forces.multipliers())) others.push_back(one);
        lowering_.lower_definitions(others);
    }

    /// The nodes added next are blamed on the parts of the scene whose terms are in row i.
    void blame_row(int i) {
        if (e_.row_sources.empty()) return;
        std::vector<int> sources;
        for (const std::string& label : e_.row_sources[i]) {
            const auto found = std::find(program_.source_labels.begin(), program_.source_labels.end(), label);
            sources.push_back(static_cast<int>(found - program_.source_labels.begin()));
            if (found == program_.source_labels.end()) program_.source_labels.push_back(label);
        }
        program_.set_sources(sources);
    }

    /// c of each norm.
    std::vector<int> weights_of(const std::vector<Norm>& norms, const RecursionNodes& by_tree) {
        std::vector<int> weights;
        for (const Norm& norm : norms) {
            std::vector<Program::Term> diagonal;
            for (int i = 0; i < n_ && is_recursive_; ++i)
                if (!(*norm.row)[i].is_zero()) diagonal.emplace_back(1, by_tree.mass[i * (i + 1) / 2 + i]);
            const Rational quarter = Rational(1) / (4 * std::max<int>(1, static_cast<int>(diagonal.size())));
            weights.push_back(is_recursive_ ? program_.sum(0, {{quarter, program_.sum(0, diagonal)}})
                                            : lowering_(norm.share));
        }
        return weights;
    }

    /// The lower triangle of M.
    std::vector<int> mass_nodes(const std::vector<Norm>& norms, const std::vector<int>& weights,
                                const RecursionNodes& by_tree) {
        std::vector<int> mass;
        for (int i = 0; i < n_ && has_matrix_; ++i)
            for (int j = 0; j <= i; ++j) {
                blame_row(i);
                std::vector<Program::Term> terms{
                    {1, is_of_tree(i) ? by_tree.mass[i * (i + 1) / 2 + j] : lowering_(e_.M(i, j))}};
                for (std::size_t k = 0; k < norms.size(); ++k) {
                    const std::vector<ex>& row = *norms[k].row;
                    terms.emplace_back(
                        1, program_.product(1, {{weights[k], 1}, {lowering_(row[i]), 1}, {lowering_(row[j]), 1}}));
                }
                mass.push_back(program_.sum(0, terms));
                program_.roots.push_back(
                    {Group::mass, fmt::format("M{}{}{}", i, n_ > 10 ? "_" : "", j), mass.back()});
            }
        return mass;
    }

    std::vector<int> forcing_nodes(const std::vector<Norm>& norms, const std::vector<int>& weights,
                                   const RecursionNodes& by_tree, Lowering& acting) {
        std::vector<int> forcing;
        for (int i = 0; i < n_ && has_matrix_; ++i) {
            blame_row(i);
            std::vector<Program::Term> terms{{1, is_of_tree(i) ? by_tree.forcing[i] : acting(e_.forcing(i))}};
            for (std::size_t k = 0; k < norms.size(); ++k) {
                const auto& [c, row, gamma] = norms[k];
                terms.emplace_back(
                    1, program_.product(1, {{weights[k], 1}, {lowering_((*row)[i]), 1}, {lowering_(gamma), 1}}));
            }
            forcing.push_back(program_.sum(0, terms));
            program_.roots.push_back({Group::forcing, fmt::format("f{}", i), forcing.back()});
        }
        return forcing;
    }

    /// Adds the constraints as roots, and those that are kept to K and its right-hand side.
    void add_constraints(std::vector<int>& K, std::vector<int>& right) {
        for (std::size_t c = 0; c < m_.constraints.size(); ++c) {
            const Mechanism::Constraint& constraint = m_.constraints[c];
            std::vector<Program::Term> velocity{{1, lowering_(constraint.offset)}};
            for (int i = 0; i < m_.size(); ++i) {
                const int entry = lowering_(has_speeds_ ? constraint.row[i] : e_.A[c][i]);
                program_.roots.push_back({Group::row, fmt::format("A{}_{}", c, i), entry});
                velocity.emplace_back(1, program_.product(1, {{entry, 1}, {lowering_(m_.qdot[i]), 1}}));
            }
            if (const int k = row_of_[c]; k >= 0) {
                for (int i = 0; i < n_; ++i) K.push_back(lowering_(e_.A[k][i]));
                for (int j = 0; j <= k; ++j) K.push_back(program_.number(0));
                right.push_back(lowering_(e_.gamma[k]));
                program_.roots.push_back(
                    {Group::gamma, fmt::format("gamma{}", c), right.back(), static_cast<int>(c)});
            }
            for (int i = 0; i < n_ && has_speeds_; ++i)
                program_.roots.push_back({Group::speed_row, fmt::format("B{}_{}", c, i),
                                          row_of_[c] < 0 ? program_.number(0) : lowering_(e_.A[row_of_[c]][i])});
            program_.roots.push_back({Group::position, constraint.name,
                                      constraint.position ? lowering_(*constraint.position) : program_.number(0)});
            program_.roots.push_back({Group::velocity, constraint.name, program_.sum(0, velocity)});
        }
    }

    /// Constraints that follow from others with factors that change are unknowns of K too (tie.hpp).
    void add_ties(std::vector<int>& K, std::vector<int>& right) {
        if (tied_.empty()) return;
        std::vector<ex> wanted;
        for (const Mechanism::Constraint* c : tied_) {
            wanted.insert(wanted.end(), c->row.begin(), c->row.end());
            wanted.push_back(c->acceleration);
        }
        lowering_.lower_definitions(wanted);
        const std::size_t kept = kept_.size(), all = kept + tied_.size();
        std::map<int, std::vector<std::size_t>> groups;  // of rows, those of K below M being counted
        std::vector<std::vector<int>> rows(all);
        for (std::size_t k = 0; k < all; ++k) {
            const Mechanism::Constraint& c = k < kept ? m_.constraints[kept_[k]] : *tied_[k - kept];
            for (int i = 0; i < n_; ++i) rows[k].push_back(lowering_(k < kept ? e_.A[k][i] : c.row[i]));
            if (c.tie) groups[*c.tie].push_back(k);
            if (k < kept) continue;
            K.insert(K.end(), rows[k].begin(), rows[k].end());
            K.insert(K.end(), k + 1, program_.number(0));
            right.push_back(lowering_(c.acceleration));
            for (const int entry : rows[k]) program_.roots.push_back({Group::tied_row, c.name, entry});
            program_.roots.push_back({Group::tied_gamma, c.name, right.back()});
        }
        const auto entry = [&](std::size_t k, std::size_t j) -> int& {
            const std::size_t row = static_cast<std::size_t>(n_) + k;
            return K[row * (row + 1) / 2 + static_cast<std::size_t>(n_) + j];
        };
        std::vector<int> inertia;
        for (std::size_t i = 0; i < static_cast<std::size_t>(n_); ++i) inertia.push_back(K[i * (i + 1) / 2 + i]);
        for (const auto& [tie, group] : groups) {
            std::vector<std::vector<int>> own;
            for (const std::size_t k : group) own.push_back(rows[k]);
            const auto extra = std::count_if(group.begin(), group.end(), [&](std::size_t k) { return k >= kept; });
            const std::vector<int> E = tie_of_rows(
                program_, own, inertia, static_cast<int>(static_cast<std::ptrdiff_t>(group.size()) - extra));
            for (std::size_t a = 0, at = 0; a < group.size(); ++a)
                for (std::size_t b = 0; b <= a; ++b)
                    entry(group[a], group[b]) = program_.product(-1, {{E[at++], 1}});
        }
        for (std::size_t k = 0; k < all; ++k)
            for (std::size_t j = 0; j <= k; ++j)
                program_.roots.push_back({Group::tie, fmt::format("E{}_{}", k, j), entry(k, j)});
    }

    /// The constraints that follow from the others have multipliers too, so users get their rows.
    void add_redundant() {
        std::vector<ex> wanted;
        std::vector<std::vector<ex>> columns;  // ∂q'/∂u
        for (int k = 0; k < n_ && has_speeds_; ++k) {
            if (k < n_ - states_)
                columns.push_back(m_.z->push_forward(e_.h, {{e_.u[k], 1}}));
            else  // no displacement is along a state
                columns.emplace_back(m_.q.size(), 0);
            wanted.insert(wanted.end(), columns.back().begin(), columns.back().end());
        }
        for (const Mechanism::Constraint& constraint : m_.redundant) {
            wanted.insert(wanted.end(), constraint.row.begin(), constraint.row.end());
            wanted.insert(wanted.end(), {constraint.position.value_or(0), constraint.offset});
        }
        lowering_.lower_definitions(wanted);
        for (const Mechanism::Constraint& constraint : m_.redundant) {
            const auto along = [&](const auto& list, int offset) {
                std::vector<Program::Term> terms{{1, offset}};
                for (int i = 0; i < m_.size(); ++i)
                    terms.emplace_back(
                        1, program_.product(1, {{lowering_(constraint.row[i]), 1}, {lowering_(list[i]), 1}}));
                return program_.sum(0, terms);
            };
            for (const ex& entry : constraint.row)
                program_.roots.push_back({Group::redundant_row, constraint.name, lowering_(entry)});
            for (const std::vector<ex>& column : columns)
                program_.roots.push_back(
                    {Group::redundant_speed_row, constraint.name, along(column, program_.number(0))});
            program_.roots.push_back(
                {Group::redundant_position, constraint.name, lowering_(constraint.position.value_or(0))});
            program_.roots.push_back(
                {Group::redundant_velocity, constraint.name, along(m_.qdot, lowering_(constraint.offset))});
        }
    }

    /// In a tree whose only constraints are e·e = 1 of its ball joints, the recursion gives all that is unknown.
    std::optional<std::vector<int>> unknowns_by_recursion(const RecursionNodes& by_tree) {
        if (!by_tree.acceleration) return std::nullopt;
        const std::optional<std::vector<int>> norms = norms_alone(*e_.tree, m_);
        if (!norms) return std::nullopt;
        std::vector<int> unknowns = *by_tree.acceleration;
        for (int k = n_ - states_; k < n_; ++k) unknowns.push_back(lowering_(e_.forcing(k)));
        unknowns.resize(static_cast<std::size_t>(n_) + norms->size());
        for (std::size_t b = 0; b < norms->size(); ++b)
            unknowns[n_ + row_of_[(*norms)[b]]] = program_.sum(0, {{-1, by_tree.multipliers[b]}});
        return unknowns;
    }

    /// `solution` is u', then −λ.
    void add_motion(const std::vector<int>& solution, const std::vector<int>& K, const Witness& witness) {
        for (int i = 0; i < n_; ++i)
            program_.roots.push_back({Group::acceleration, fmt::format("a{}", i), solution[i]});
        for (std::size_t k = 0; k < kept_.size(); ++k)
            lowering_.define(e_.lambda[k], program_.sum(0, {{-1, solution[n_ + k]}}));
        for (std::size_t k = 0; k < tied_.size(); ++k)
            lowering_.define(tied_[k]->multiplier, program_.sum(0, {{-1, solution[n_ + kept_.size() + k]}}));
        if (!m_.constraints.empty()) add_projection(program_, m_, e_, {K, tied_, witness}, options_.fold);
        if (!e_.eliminated.empty()) define_eliminated(solution);
        if (!m_.redundant.empty()) share_out(lowering_, program_, m_, energy_.power, !tied_.empty());
        for (const auto* list : {&m_.constraints, &m_.redundant})
            for (const Mechanism::Constraint& constraint : *list)
                program_.roots.push_back(
                    {Group::multiplier, constraint.multiplier.get_name(), lowering_(constraint.multiplier)});
    }

    /// The multipliers of constraints that the speeds have eliminated, with the solution for u'.
    void define_eliminated(const std::vector<int>& solution) {
        Lowering motion(program_, m_, options_.fold);
        define_rates(motion, program_, m_, e_, {solution.begin(), solution.begin() + n_});
        for (const GiNaC::symbol& lambda : e_.lambda) motion.define(lambda, lowering_(lambda));
        std::vector<ex> wanted;
        for (const Equations::Eliminated& one : e_.eliminated) wanted.push_back(one.multiplier);
        motion.lower_definitions(wanted);
        for (const Equations::Eliminated& one : e_.eliminated)
            lowering_.define(m_.constraints[one.constraint].multiplier, motion(one.multiplier));
    }

    /// The power and outputs may contain multipliers. Their values are never used, because there is no motion.
    void leave_without_motion() {
        program_.singular = true;
        for (const auto& lambda : e_.lambda) lowering_.define(lambda, program_.number(0));
        for (const Mechanism::Constraint& constraint : m_.redundant)
            lowering_.define(constraint.multiplier, program_.number(0));
    }

    void add_rates() {
        for (int i = 0; i < m_.size() && has_speeds_; ++i) {
            program_.roots.push_back({Group::rate, m_.q[i].get_name(), lowering_(m_.qdot[i])});
            program_.roots.push_back({Group::second_rate, m_.q[i].get_name(), lowering_(m_.qddot[i])});
        }
    }

    /// The power and outputs may contain multipliers, which are known by now.
    void lower_outputs() {
        std::vector<ex> wanted{energy_.power};
        for (const auto* parts : {&m_.outputs, &m_.events})
            for (const Mechanism::Definition& part : *parts) wanted.push_back(part.value);
        for (const Mechanism::Friction& f : m_.frictions)
            wanted.insert(wanted.end(),
                          {f.sliding_velocity, f.across.value_or(0), f.coefficient, f.resting, f.normal});
        lowering_.lower_definitions(wanted);
    }

    void add_outputs() {
        for (const Mechanism::Definition& part : m_.outputs)
            program_.roots.push_back({Group::output, part.name, lowering_(part.value)});
        for (const Mechanism::Definition& part : m_.events)
            program_.roots.push_back({Group::event, part.name, lowering_(part.value)});
    }

    void add_frictions(const NormalForces& normal_forces,
                       const std::optional<NormalForces::Solution>& normal_forces_found) {
        for (const Mechanism::Friction& f : m_.frictions) {
            const int bound =
                f.resting.is_equal(f.coefficient)
                    ? program_.number(1)
                    : program_.product(1, {{lowering_(f.resting), 1}, {lowering_(f.coefficient), -1}});
            program_.roots.push_back({Group::sliding_velocity, f.name, lowering_(f.sliding_velocity)});
            program_.roots.push_back({Group::stick_bound, f.name, bound});
            program_.roots.push_back({Group::friction, f.name, lowering_(f.coefficient)});
            program_.roots.push_back({Group::normal, f.name, lowering_(f.normal)});
            program_.roots.push_back({Group::determinant, f.name,
                                      normal_forces_found && normal_forces.determine(f)
                                          ? normal_forces_found->determinant
                                          : program_.number(1)});
            if (f.is_held)
                program_.roots.push_back(
                    {Group::across, f.name, lowering_(*f.across), static_cast<int>(&f - m_.frictions.data())});
        }
        for (std::size_t k = 0; normal_forces_found && k < normal_forces_found->columns.size(); ++k)
            for (const int node : normal_forces_found->columns[k].nodes)
                program_.roots.push_back(
                    {Group::friction_column, "friction", node, kept_[normal_forces_found->columns[k].row]});
    }

    const Mechanism& m_;
    const Equations& e_;
    const Energy& energy_;
    const LowerOptions& options_;
    const int n_, states_;
    const bool has_speeds_, has_matrix_, is_recursive_;
    const std::vector<int> kept_;
    std::vector<int> row_of_;  ///< for each constraint its row in A, −1 if it is eliminated
    std::vector<const Mechanism::Constraint*> tied_;  ///< of Mechanism::redundant, those that are unknowns of K
    Program program_;
    Lowering lowering_, acting_alone_;
};

/// Whether `z` begins with the symbols of the equations and knows those of the energy, so that it is the table
/// that `in_terms_of` would make. To make it takes longer than to lower a form of a large system.
bool is_in_terms_of(const Intermediates& z, const Intermediates& equations, const Intermediates& energy) {
    const auto begins_with = [](const auto& list, const auto& first, const auto& same) {
        return list.size() >= first.size() && std::equal(first.begin(), first.end(), list.begin(), same);
    };
    using Entry = Intermediates::Entry;
    const std::vector<Entry>& others = energy.entries();
    return begins_with(z.entries(), equations.entries(),
                       [](const Entry& a, const Entry& b) { return a.symbol.is_equal(b.symbol); }) &&
           begins_with(z.source_labels(), equations.source_labels(), std::equal_to<>()) &&
           std::all_of(others.begin(), others.end(),
                       [&](const Entry& entry) { return z.find(entry.symbol) != nullptr; });
}

}  // namespace

Program lower(const Mechanism& mechanism, const Equations& equations, const Energy& energy,
              const LowerOptions& options) {
    const Mechanism m = is_in_terms_of(*mechanism.z, *equations.z, *energy.z)
                            ? with_own_intermediates(mechanism)
                            : in_terms_of(energy, in_terms_of(equations, mechanism));
    const Equations all = options.states_are_given ? equations : with_states(equations, m);
    return EquationsLowering(m, all, energy, options).run();
}

}  // namespace alembert
