// SPDX-License-Identifier: GPL-2.0-or-later
// The cells that have states modulo the prime are an affine space over GF(2), since Legendre's symbol multiplies,
// and its states are shared out evenly among them: 60 states more than its dimension span it but for a chance of
// 2⁻⁶⁰. Where |·| stands within |·| they are several such spaces together; of k sides each cell that has states
// has a share of about 2⁻ᵏ of them at least, and so many states are looked at that none of this share is missed.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "algebra/symbolic/impossible.hpp"
#include "algebra/symbolic/on_sides.hpp"
#include "analysis/exact/cells.hpp"
#include "analysis/exact/expression_of.hpp"
#include "base/language/say.hpp"
#include "check/in_print.hpp"
#include "check/multiple.hpp"
#include "check/vanishing.hpp"
#include "check/ways.hpp"
#include "model/parameter_values.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr std::size_t most_sides = 8;
constexpr int enough_in_numbers = 3;

/// What the equations of motion and the constraints are made of.
std::vector<ex> parts_of(const Equations& law, const Mechanism& m) {
    std::vector<ex> list;
    for (int i = 0; i < law.size(); ++i) {
        for (int j = 0; j <= i; ++j) list.push_back(law.M(i, j));
        list.push_back(law.forcing(i));
    }
    for (const auto& row : law.A) list.insert(list.end(), row.begin(), row.end());
    list.insert(list.end(), law.gamma.begin(), law.gamma.end());
    for (const Mechanism::Constraint& c : m.constraints) {
        list.push_back(c.offset);
        if (c.position) list.push_back(*c.position);
    }
    return list;
}

/// The dimension of the affine space that these cells span.
int dimension(const std::map<Cell, double>& cells) {
    std::vector<Cell> basis;
    for (const auto& [cell, count] : cells) {
        Cell rest = cell ^ cells.begin()->first;
        for (const Cell one : basis) rest = std::min(rest, rest ^ one);
        if (rest != 0) basis.push_back(rest);
    }
    return static_cast<int>(basis.size());
}

class InCells {
public:
    InCells(Question& q, ExactStates& states) : q_(q), now_(q.now), states_(states) {
        std::vector<ex> list{q.form().residual};
        if (states.motions.has_sides())
            for (ex& part : parts_of(now_.law, now_.m)) list.push_back(std::move(part));
        const std::vector<int> roots = now_.claims.lower(program_, list);
        root_ = roots[0];
        cells_.emplace(program_, roots);
        const std::vector<int> needed = program_.needed(roots);
        has_roots_ =
            std::any_of(needed.begin(), needed.end(), [&](int id) { return program_[id].op == Op::sqrt; });
        for (const int side : cells_->sides())
            sides_.push_back(expression_of(program_, side, now_.m, now_.e.lambda));
    }

    /// Whether there are sides, and states can be found in each cell: where positions obey constraints, or states
    /// are those of rest, nothing steers a state into a cell.
    bool any() const {
        const Motions& motions = states_.motions;
        return !cells_->empty() && motions.where() == Motions::At::motion && motions.steps().empty() &&
               motions.loose().empty();
    }

    std::optional<CheckedClaim> settle() {
        if (cells_->sides().size() > most_sides) {
            if (const auto shown = counterexample(told(now_), states_.motions, program_, root_))
                return refuted(*shown);
            return refuse(
                say("signs, absolute values, smaller and larger values cut the states into too many cells: {} "
                    "expressions decide, and at most {} are tried",
                    cells_->sides().size(), most_sides));
        }
        const bool has_visited_all = visit();
        seen_ = survey(told(now_), states_.motions, {program_, root_, *cells_});
        // A cell that exact arithmetic does not reach: Legendre's symbol of 3x may be another than that of x.
        bool is_beyond = false;
        for (const auto& [cell, seen] : seen_) {
            is_beyond = is_beyond || !visited_.contains(cell);
            if (!shown_) shown_ = seen.fails;
        }
        for (const auto& [cell, exact] : visited_) known_[cell] = look(cell, exact);
        const bool has_others = look_beside();
        if (shown_) {
            shown_ = on_own_branch(*shown_);
            if (!shown_)
                return refuse(
                    say("it fails on a branch of the constraints, and it could not be decided whether it holds on "
                        "that of the initial state"));
            CheckedClaim c = refuted(*shown_);
            c.holds_where = where_it_holds();
            q_.explained_at = &states_;
            return c;
        }
        const auto unknown = std::find_if(known_.begin(), known_.end(),
                                          [](const auto& one) { return one.second == Known::unknown; });
        if (unknown != known_.end())
            return refuse(
                visited_[unknown->first].is_zero
                    ? say("it holds in exact arithmetic, which knows no order and may turn the signs of "
                          "roots, and too "
                          "few states in numbers were found with which to compare it where {}",
                          words(unknown->first))
                    : say("in exact arithmetic it fails where {}, and no state in numbers was found there",
                          words(unknown->first)));
        if (!has_visited_all || is_beyond || has_others)
            return refuse(
                say("it holds at all states that were tried, and these do not reach every choice of signs"));
        double failure = -INFINITY;
        for (const auto& [cell, exact] : visited_) failure = std::max(failure, exact.failure);
        return proved(failure);
    }

    bool fails() {
        if (cells_->sides().size() > most_sides)
            return counterexample(told(now_), states_.motions, program_, root_).has_value();
        visit();
        for (const auto& [cell, exact] : visited_)
            if (look(cell, exact) == Known::fails) return true;
        return false;
    }

private:
    /// What exact arithmetic says of a cell.
    struct Exact {
        bool is_zero = true;
        double failure = 0;  ///< log₂ of the probability that it is zero by chance
    };
    /// What is known of a cell in the end; `empty`: it has no states.
    enum class Known { holds, fails, empty, unknown };

    /// Visits all cells that have states modulo the prime; false if some may have been missed.
    bool visit() {
        constexpr int beyond_dimension = 60;
        std::vector<int> roots = cells_->sides();
        roots.push_back(root_);
        std::map<Cell, double> count;
        int usable = 0;
        for (std::size_t s = 0; s < most_states && states_.get(s) != nullptr; ++s) {
            const ExactState& state = *states_.get(s);
            const auto at = evaluate_mod(program_, state.point, roots);
            const auto cell = at ? cells_->of(*at) : std::nullopt;
            if (!cell) continue;
            Exact& exact = visited_[*cell];
            exact.is_zero = exact.is_zero && at->value[static_cast<std::size_t>(root_)].is_zero();
            const double degree =
                std::max(1.0, at->degree[static_cast<std::size_t>(root_)]) * std::max(1.0, state.degree);
            const double chance = chance_at(state, degree, *at) + static_cast<double>(cells_->sides().size());
            if (chance > -1) return false;
            exact.failure += chance;
            ++count[*cell];
            ++usable;
            const int dimensions = dimension(count);
            const bool is_spanned =
                usable >= beyond_dimension + dimensions && visited_.size() >= (std::size_t{1} << dimensions);
            const double missed =
                usable * std::log2(1 - std::ldexp(1.0, -static_cast<int>(cells_->sides().size())));
            if (!is_spanned && missed > wanted_failure) continue;
            if (std::all_of(visited_.begin(), visited_.end(), [](const auto& one) {
                    return !one.second.is_zero || one.second.failure <= wanted_failure;
                }))
                return true;
        }
        return false;
    }

    bool is_empty(Cell cell) const {
        std::vector<ex> positive = now_.positive;
        for (ex& e : positive) e = now_.m.z->expand(e);
        for (std::size_t k = 0; k < sides_.size(); ++k)
            if (sides_[k]) positive.push_back((cell >> k & 1U) != 0 ? *sides_[k] : ex(-*sides_[k]));
        std::vector<ex> in_cell;
        for (const ex& e : positive) in_cell.push_back(where_positive(e, positive));
        return is_impossible(in_cell, positive_parameters(now_.m));
    }

    Known look(Cell cell, const Exact& exact) {
        SeenInCell& seen = seen_[cell];
        if (seen.states == 0 && is_empty(cell)) return Known::empty;
        look_in_cell(told(now_), states_.motions, {program_, root_, *cells_}, cell, enough_in_numbers, seen);
        if (seen.fails) {
            if (!shown_) shown_ = seen.fails;
            return Known::fails;
        }
        if (!exact.is_zero) return Known::unknown;
        return seen.states >= enough_in_numbers || (!has_roots_ && states_.motions.loose().empty())
                   ? Known::holds
                   : Known::unknown;
    }

    std::string side_in_words(std::size_t k, bool is_positive) const {
        if (!sides_[k]) return {};
        const ex side = sides_[k]->expand();
        for (const auto* list : {&now_.m.q, &now_.m.qdot, &now_.m.qddot})
            for (const GiNaC::symbol& x : *list) {
                if (!side.is_polynomial(x) || side.degree(x) != 1) continue;
                const ex slope = side.coeff(x, 1), bound = -side.coeff(x, 0) / slope;
                const auto moves = [&](const std::vector<GiNaC::symbol>& symbols) {
                    return std::any_of(symbols.begin(), symbols.end(),
                                       [&](const auto& s) { return bound.has(s); });
                };
                if (!GiNaC::is_a<GiNaC::numeric>(slope) || moves(now_.m.q) || moves(now_.m.qdot) ||
                    moves(now_.m.qddot))
                    continue;
                const bool is_above = is_positive == slope.info(GiNaC::info_flags::positive);
                return fmt::format("{} {} {}", in_print(x, now_.m), is_above ? '>' : '<', in_print(bound, now_.m));
            }
        return fmt::format("{} {} 0", in_print(side, now_.m), is_positive ? '>' : '<');
    }

    std::string words(Cell cell) const {
        std::vector<std::string> list;
        for (std::size_t k = 0; k < sides_.size(); ++k) list.push_back(side_in_words(k, (cell >> k & 1U) != 0));
        return fmt::format("{}", fmt::join(list, ", "));
    }

    /// The signs that all cells in which it holds have in common, if it fails in all others that have these;
    /// otherwise these cells one by one.
    std::vector<std::string> where_it_holds() const {
        constexpr std::size_t most_shown = 3;
        std::vector<Cell> holds;
        for (const auto& [cell, known] : known_)
            if (known == Known::holds) holds.push_back(cell);
        if (holds.empty()) return {};
        Cell shared = (Cell{1} << sides_.size()) - 1;
        for (const Cell cell : holds) shared &= ~(cell ^ holds.front());
        const auto has_shared = [&](Cell cell) { return ((cell ^ holds.front()) & shared) == 0; };
        const bool decides = std::none_of(known_.begin(), known_.end(), [&](const auto& one) {
            return (one.second == Known::fails || one.second == Known::unknown) && has_shared(one.first);
        });
        std::vector<std::string> result;
        if (!decides) {
            for (const Cell cell : holds) result.push_back(words(cell));
            if (result.size() > most_shown) result.clear();
            return result;
        }
        // Signs without which the others still tell these cells apart are left out.
        for (std::size_t k = 0; k < sides_.size(); ++k) {
            const Cell without = shared & ~(Cell{1} << k);
            if (without == shared) continue;
            const bool is_needed = std::any_of(known_.begin(), known_.end(), [&](const auto& one) {
                return one.second != Known::holds && one.second != Known::empty &&
                       ((one.first ^ holds.front()) & without) == 0;
            });
            if (!is_needed) shared = without;
        }
        std::vector<std::string> signs;
        for (std::size_t k = 0; k < sides_.size(); ++k)
            if ((shared >> k & 1U) != 0) signs.push_back(side_in_words(k, (holds.front() >> k & 1U) != 0));
        return {fmt::format("{}", fmt::join(signs, ", "))};
    }

    /// Looks into cells that exact arithmetic has not visited though they may have states; returns whether there
    /// are any. Where |·| stands within |·|, as in ||x − 7| − |x||, a side may be a number in a cell, −7, which
    /// counts as positive where it is a square modulo the prime. Then a cell without states is visited in the
    /// place of its neighbour across that side.
    bool look_beside() {
        bool has_others = false;
        for (const auto& [cell, known] : known_) {
            if (known != Known::empty) continue;
            for (std::size_t k = 0; k < sides_.size(); ++k) {
                const Cell neighbour = cell ^ (Cell{1} << k);
                if (!depends_on_sides(program_, {cells_->sides()[k]}) || known_.contains(neighbour) ||
                    is_empty(neighbour))
                    continue;
                has_others = true;
                SeenInCell& seen = seen_[neighbour];
                look_in_cell(told(now_), states_.motions, {program_, root_, *cells_}, neighbour, enough_in_numbers,
                             seen);
                if (!shown_) shown_ = seen.fails;
            }
        }
        return has_others;
    }

    /// A counterexample of the scene's own branch, if it has branches; nothing if none was found there.
    std::optional<Counterexample> on_own_branch(const Counterexample& shown) {
        if (now_.on_own_branch != nullptr || !has_branches(now_)) return shown;
        Told own = told(now_);
        own.on_own_branch = true;
        return counterexample(own, states_.motions, program_, root_);
    }

    /// With friction another way may decide it.
    std::optional<CheckedClaim> refuse(const std::string& reason) const {
        return states_.motions.rows_with_friction().empty() ? std::optional(undecided(reason)) : std::nullopt;
    }

    Question& q_;
    Comparison& now_;
    ExactStates& states_;
    Program program_;
    int root_ = 0;
    bool has_roots_ = false;  ///< square roots, whose signs may be others in exact arithmetic
    std::optional<Cells> cells_;
    std::vector<std::optional<GiNaC::ex>> sides_;
    std::map<Cell, Exact> visited_;
    std::map<Cell, SeenInCell> seen_;
    std::map<Cell, Known> known_;
    std::optional<Counterexample> shown_;
};

/// Whether the claim is the scene's own equation as it stands, whatever sides its functions have.
bool is_own_equation(const Question& q) {
    Program p;
    std::vector<ex> inertia;
    for (int i = 0; i < q.now.law.size(); ++i)
        for (int j = 0; j <= i; ++j) inertia.push_back(q.now.law.M(i, j));
    return !depends_on_sides(p, q.now.claims.lower(p, inertia)) &&
           is_multiple(q.form().residual, q.now.m, q.now.law);
}

}  // namespace

std::optional<CheckedClaim> in_cells(Question& q) {
    ExactStates* const own = q.now.on_own_branch;
    InCells sided(q, own != nullptr && own->get(0) != nullptr ? *own : *q.together.states);
    if (!sided.any()) return std::nullopt;
    if (!is_own_equation(q)) return sided.settle();
    CheckedClaim c = proved(0);
    c.normal_form = true;
    return c;
}

bool fails_in_a_cell(Question& q, ExactStates& states) {
    InCells sided(q, states);
    return sided.any() && sided.fails();
}

}  // namespace alembert
