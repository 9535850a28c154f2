// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/normal_forces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/language/say.hpp"
#include "program/partials.hpp"
#include "program/solve.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_that_pull = 3;  // see NormalForces::forces

/// ∂v/∂u for a node v.
std::vector<int> row_of(Program& program, int v, int speeds) {
    std::vector<int> inputs, row(static_cast<std::size_t>(speeds), program.number(0));
    for (int i = 0; i < speeds; ++i) inputs.push_back(program.variable({Variable::Kind::rate, i}));
    const std::vector<int> outputs{v};
    if (const auto found = partials(program, outputs, inputs, EliminationOrder::forward))
        for (const Partial& one : *found) row[static_cast<std::size_t>(one.input)] = one.node;
    return row;
}

struct Eliminated {
    std::vector<int> x;
    int determinant;
};

/// Solves a small system without row exchanges, because its diagonal dominates for friction of usual size.
Eliminated eliminated(Program& program, std::vector<std::vector<int>> a, std::vector<int> b) {
    const std::size_t n = b.size();
    std::vector<Program::Factor> pivots;
    const auto less = [&](int x, int factor, int y) {
        return program.sum(0, {{1, x}, {-1, program.product(1, {{factor, 1}, {y, 1}})}});
    };
    for (std::size_t k = 0; k < n; ++k) {
        pivots.emplace_back(a[k][k], 1);
        for (std::size_t i = k + 1; i < n; ++i) {
            const int factor = program.product(1, {{a[i][k], 1}, {a[k][k], -1}});
            for (std::size_t j = k + 1; j < n; ++j) a[i][j] = less(a[i][j], factor, a[k][j]);
            b[i] = less(b[i], factor, b[k]);
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) b[k] = less(b[k], a[k][j], b[j]);
        b[k] = program.product(1, {{b[k], 1}, {a[k][k], -1}});
    }
    return {.x = std::move(b), .determinant = program.product(1, pivots)};
}

/// sign λ, with a source that says which friction acts on this reaction.
int sign_of_reaction(Program& program, int lambda, const std::string& friction, bool is_trial) {
    const auto source = static_cast<int>(program.source_labels.size());
    program.source_labels.push_back(fmt::format("the reaction of friction '{}'", friction));
    program.reaction_signs.push_back({.source = source, .friction = friction, .is_trial = is_trial});
    const std::span<const int> former = program.set_sources({source});
    const int sign = program.call(Op::sign, {lambda});
    program.set_sources(former);
    return sign;
}

}  // namespace

NormalForces::NormalForces(const Mechanism& m, const Equations& e) : e_(e) {
    for (const Mechanism::Friction& f : m.frictions) {
        if (!f.multiplier) continue;
        const auto is_it = [&](const GiNaC::symbol& s) { return s.is_equal(*f.multiplier); };
        const auto row = std::find_if(e.lambda.begin(), e.lambda.end(), is_it);
        const bool presses = std::any_of(m.unilateral.begin(), m.unilateral.end(),
                                         [&](const auto& contact) { return is_it(contact.gap.multiplier); });
        if (row == e.lambda.end() && presses) continue;  // the contact is open
        if (row == e.lambda.end())
            throw ModelError(
                say("friction '{}' needs {}, which the equations do not have: its constraint follows from "
                    "others, or the speeds leave it out; give the normal force as an expression instead, "
                    "or leave out what is redundant",
                    f.name, f.multiplier->get_name()));
        const auto known =
            std::find_if(pressed_.begin(), pressed_.end(), [&](const Pressed& p) { return is_it(p.multiplier); });
        if (known != pressed_.end()) {
            known->frictions.push_back(&f);
            continue;
        }
        pressed_.push_back({.row = static_cast<std::size_t>(row - e.lambda.begin()),
                            .multiplier = *f.multiplier,
                            .may_pull = !presses,
                            .frictions = {&f}});
        multipliers_.push_back(*f.multiplier);
    }
    const auto pull = std::count_if(pressed_.begin(), pressed_.end(), [](const Pressed& p) { return p.may_pull; });
    if (pull > 0 && pressed_.size() > most_that_pull)
        throw ModelError(say(
            "friction acts on {} reactions that are coupled, {} of them of constraints, which press from either "
            "side; "
            "at most {} can be followed; give the other normal forces as expressions by 'normal' in place of 'on'",
            pressed_.size(), pull, most_that_pull));
}

void NormalForces::leave_out(Lowering& lowering, Program& program) const {
    for (const GiNaC::symbol& lambda : multipliers_) lowering.define(lambda, program.number(0));
}

std::optional<NormalForces::Solution> NormalForces::solve(Lowering& lowering, Program& program,
                                                          const std::vector<int>& matrix,
                                                          const std::vector<int>& right) const {
    std::vector<std::vector<int>> sides{right};
    for (const Pressed& pressed : pressed_) {
        std::vector<std::vector<Program::Term>> terms(right.size());
        for (const Mechanism::Friction* f : pressed.frictions) {
            lowering.lower_definitions({f->sliding_velocity, f->coefficient});
            const int mu = lowering(f->coefficient);
            const auto add = [&](int sliding_velocity, int side) {
                const std::vector<int> row = row_of(program, sliding_velocity, e_.size());
                for (std::size_t i = 0; i < row.size(); ++i)
                    terms[i].emplace_back(1, program.product(-1, {{mu, 1}, {side, 1}, {row[i], 1}}));
            };
            const int sliding_velocity = lowering(f->sliding_velocity);
            if (!f->across) {
                add(sliding_velocity, program.call(Op::sign, {sliding_velocity}));
                continue;
            }
            lowering.lower_definitions({*f->across, f->direction[0], f->direction[1]});
            add(sliding_velocity, lowering(f->direction[0]));
            add(lowering(*f->across), lowering(f->direction[1]));
        }
        sides.emplace_back();
        for (const auto& list : terms) sides.back().push_back(program.sum(0, list));
    }
    const auto found = solve_for_sides(program, matrix, sides, e_.size());
    if (!found) return std::nullopt;
    const auto [normal, signs, determinant] = forces(program, *found);
    Solution solution{.unknowns = (*found)[0], .determinant = determinant, .columns = {}};
    for (std::size_t k = 0; k < pressed_.size(); ++k) {
        std::vector<int> nodes(sides[k + 1].begin(), sides[k + 1].begin() + e_.size());
        for (int& node : nodes) node = program.product(1, {{signs[k], 1}, {node, 1}});
        solution.columns.push_back({.row = pressed_[k].row, .nodes = std::move(nodes)});
    }
    std::vector<int>& x = solution.unknowns;
    for (std::size_t i = 0; i < x.size(); ++i) {
        std::vector<Program::Term> terms{{1, x[i]}};
        for (std::size_t k = 0; k < normal.size(); ++k)
            terms.emplace_back(1, program.product(1, {{normal[k], 1}, {(*found)[k + 1][i], 1}}));
        x[i] = program.sum(0, terms);
    }
    for (std::size_t k = 0; k < pressed_.size(); ++k)
        if (pressed_[k].may_pull) lowering.define(pressed_[k].frictions[0]->normal, normal[k]);
    return solution;
}

/// N for the solutions x and y_k, and the signs s_k. The signs of reactions that may pull are those for N = 0;
/// where there are several, they are chosen again with the N that follow from them, which is Newton's method for N
/// = |λ(x) + D N| (Mangasarian, Optim. Lett. 3 (2009) 101). It ends when no sign changes. Of 24,700 random systems
/// of two and three reactions with D up to 2 all had ended after as many rounds; of four and five one in 23,700
/// had not, which is why they are refused.
NormalForces::Forces NormalForces::forces(Program& program, const std::vector<std::vector<int>>& found) const {
    const auto n = static_cast<std::size_t>(e_.size());
    const std::size_t count = pressed_.size();
    std::vector<int> alone, lambda;
    std::vector<std::vector<int>> D(count);
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t row = n + pressed_[k].row;
        alone.push_back(program.sum(0, {{-1, found[0][row]}}));
        for (std::size_t j = 0; j < count; ++j) D[k].push_back(program.sum(0, {{-1, found[j + 1][row]}}));
    }
    const bool may_pull =
        std::any_of(pressed_.begin(), pressed_.end(), [](const Pressed& p) { return p.may_pull; });
    const std::size_t rounds = may_pull ? count : 1;
    lambda = alone;
    for (std::size_t round = 0;; ++round) {
        std::vector<std::vector<int>> a(count);
        std::vector<int> b, signs;
        for (std::size_t k = 0; k < count; ++k) {
            const int s =
                pressed_[k].may_pull
                    ? sign_of_reaction(program, lambda[k], pressed_[k].frictions[0]->name, round + 1 < rounds)
                    : program.number(1);
            signs.push_back(s);
            b.push_back(program.product(1, {{s, 1}, {alone[k], 1}}));
            for (std::size_t j = 0; j < count; ++j)
                a[k].push_back(program.sum(j == k ? 1 : 0, {{-1, program.product(1, {{s, 1}, {D[k][j], 1}})}}));
        }
        Eliminated solved = eliminated(program, a, b);
        if (round + 1 == rounds)
            return {.normal = std::move(solved.x), .signs = std::move(signs), .determinant = solved.determinant};
        for (std::size_t k = 0; k < count; ++k) {
            std::vector<Program::Term> terms{{1, alone[k]}};
            for (std::size_t j = 0; j < count; ++j)
                terms.emplace_back(1, program.product(1, {{D[k][j], 1}, {solved.x[j], 1}}));
            lambda[k] = program.sum(0, terms);
        }
    }
}

bool NormalForces::determine(const Mechanism::Friction& f) const {
    return f.multiplier && std::any_of(pressed_.begin(), pressed_.end(),
                                       [&](const Pressed& p) { return p.multiplier.is_equal(*f.multiplier); });
}

}  // namespace alembert
