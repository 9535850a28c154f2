// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/counterexample.hpp"

#include <cln/dfloat.h>
#include <cln/rational.h>

#include <algorithm>
#include <memory>
#include <numeric>

#include "algebra/notation/readable.hpp"
#include "algebra/notation/text.hpp"
#include "analysis/exact/expression_of.hpp"
#include "check/table_rounding.hpp"

namespace alembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

constexpr int enough_states = 3;

bool is_small(const numeric& value) {
    return value.is_rational() ? value.is_zero() : GiNaC::abs(value) < GiNaC::pow(numeric(10), numeric(-25));
}

void add_value(const Told& told, const std::string& name, const ex& e, const RealState& state,
               Counterexample& result) {
    Program p;
    const std::vector<int> node = told.claims.lower(p, {told.mechanism.z->name(e)});
    if (const auto value = evaluate(p, state, node)) result.values.emplace_back(name, text_of((*value)[0]));
}

/// Whether the claim fails as much when the values are put in with the digits that are shown.
bool is_as_typed(const Program& p, int root, RealState state, const numeric& residual) {
    for (auto& [key, value] : state.value)
        if (!state.angle.contains(key) && !value.is_rational())
            value = numeric(cln::cl_N(cln::rational(cln::cl_DF(value.to_double()))));
    const auto typed = evaluate(p, state, {root});
    return typed && GiNaC::abs((*typed)[0] - residual) * 1000000 < GiNaC::abs(residual);
}

void describe_impact(const Told& told, const RealState& state, Counterexample& result) {
    const Impact::Exact& impact = *told.claims.after_impact();
    const auto add = [&](const std::string& name, const ex& e) {
        add_value(told, name, e.subs(impact.pose, GiNaC::subs_options::no_pattern), state, result);
    };
    const auto& q = told.mechanism.q;
    for (const auto& x : q) add(x.get_name(), x);
    for (std::size_t i = 0; i < q.size(); ++i) add(q[i].get_name() + "'(-)", impact.before[i]);
    for (std::size_t i = 0; i < q.size(); ++i) add(q[i].get_name() + "'", impact.after[i]);
    for (const auto& [multiplier, impulse] : impact.reactions) add(multiplier.get_name(), impulse);
}

/// The values that the functions of [functions] and their derivatives have there, in the claim and in the
/// equations.
void add_unspecified(const Told& told, const Program& p, const std::vector<int>& roots, const RealState& state,
                     Counterexample& result) {
    std::vector<int> calls;
    for (const int id : p.needed(roots))
        if (p[id].op == Op::unspecified) calls.push_back(id);
    const auto value = evaluate(p, state, calls);
    for (std::size_t k = 0; value && k < calls.size(); ++k) {
        const auto call = expression_of(p, calls[k], told.mechanism, told.equations.lambda);
        if (!call) continue;
        const auto normal = fourier(told.mechanism.z->expand(*call), *told.mechanism.symbols);
        if (!normal) continue;
        const std::string name = text(readable(*normal));
        const bool is_new = std::none_of(result.values.begin(), result.values.end(),
                                         [&](const auto& known) { return known.first == name; });
        if (is_new) result.values.emplace_back(name, text_of((*value)[k]));
    }
}

void add_unspecified(const Told& told, const Motions& motions, const Program& p, const std::vector<int>& roots,
                     const RealState& state, Counterexample& result) {
    add_unspecified(told, p, roots, state, result);
    const Motions::System& system = motions.entries();
    for (const auto* entries : {&system.M, &system.f, &system.A, &system.offset, &system.gamma})
        add_unspecified(told, motions.program(), *entries, state, result);
}

/// The scene's own speeds and their rates.
void add_speeds(const Told& told, const RealState& state, Counterexample& result) {
    const Mechanism& m = told.mechanism;
    for (const Mechanism::Speed& speed : m.speeds) {
        add_value(told, speed.u.get_name(), speed.form, state, result);
        add_value(told, speed.u.get_name() + "'", m.time_derivative({speed.form})[0], state, result);
    }
}

}  // namespace

Counterexample described(const Told& told, const RealState& state, const numeric& residual,
                         const std::vector<int>& open) {
    using Kind = Variable::Kind;
    const Mechanism& m = told.mechanism;
    Counterexample result{.values = {}, .residual = text_of(residual), .residual_value = residual.to_double()};
    const auto add = [&](const std::string& name, const RealState::Key& key) {
        if (state.value.contains(key)) result.values.emplace_back(name, text_of(state, key));
    };
    int independent = 0;
    for (const Mechanism::Parameter& p : m.parameters)
        if (p.independent) add(p.symbol.get_name(), {Kind::parameter, independent++});
    if (told.is_impact) {
        describe_impact(told, state, result);
        return result;
    }
    add("t", {Kind::time, 0});
    for (int i = 0; i < m.size(); ++i) add(m.q[i].get_name(), {Kind::coordinate, i});
    for (int i = 0; i < m.size(); ++i)
        if (const auto driven = told.claims.driven().find(m.qdot[i]); driven == told.claims.driven().end())
            add(m.q[i].get_name() + "'", {Kind::rate, i});
        else
            add_value(told, m.q[i].get_name() + "'", m.qdot[i] + driven->second, state, result);
    for (int k = 0; k < static_cast<int>(m.states.size()); ++k)
        add(m.states[k].derivative[0].get_name(), {Kind::rate, m.size() + k});
    for (int i = 0; i < m.size(); ++i) add(m.q[i].get_name() + "''", {Kind::acceleration, i});
    add_speeds(told, state, result);
    const auto& lambda = told.equations.lambda;
    for (std::size_t k = 0; k < lambda.size(); ++k)
        if (!m.constraints[k].balance) add(lambda[k].get_name(), {Kind::unknown, static_cast<int>(k)});
    for (const std::size_t k : told.spoken)
        add(m.undetermined()[k]->multiplier.get_name(), {Kind::unknown, static_cast<int>(lambda.size() + k)});
    for (const int o : open) {
        const Open& name = told.claims.open()[static_cast<std::size_t>(o)];
        add(name.name, {name.variable.kind, name.variable.index});
    }
    return result;
}

namespace {

/// States on the sheet of roots on which claims are checked, at which some roots of a program will be evaluated.
class StatesOnSheet {
public:
    StatesOnSheet(const Told& told, const Motions& motions, const Program& program, const std::vector<int>& roots)
        : motions_(motions),
          program_(program),
          positive_(told.claims.lower(program_, told.positive)),
          needed_(roots),
          on_own_branch_(told.on_own_branch) {
        needed_.insert(needed_.end(), positive_.begin(), positive_.end());
        zero_ = told.claims.lower(program_, told.own_factors);
        needed_.insert(needed_.end(), zero_.begin(), zero_.end());
        if (motions.has_sides()) borders_ = std::make_unique<Borders>(motions);
    }

    std::optional<RealState> operator()(unsigned seed) const {
        return on_sheet(on_own_branch_ ? real_state_on_own_branch(motions_, program_, needed_, seed)
                                       : real_state(motions_, program_, needed_, seed));
    }

    /// A state of the cell. `cells` are those of the program that was given.
    std::optional<RealState> in_cell(const Cells& cells, Cell cell, unsigned seed) const {
        auto state = on_sheet(
            on_own_branch_ ? real_state_on_own_branch(motions_, program_, needed_, seed)
                           : real_state_towards(motions_, program_, needed_, {cells, cell, positive_}, seed));
        return state && cells.of(*state) == cell ? state : std::nullopt;
    }

private:
    /// The sides in the equations: on a border they have other rates of change on either side.
    struct Borders {
        explicit Borders(const Motions& motions) : program(motions.program()), cells(program, roots_of(motions)) {}

        static std::vector<int> roots_of(const Motions& motions) {
            const Motions::System& system = motions.entries();
            std::vector<int> result;
            for (const auto* entries : {&system.M, &system.f, &system.A, &system.offset, &system.gamma})
                result.insert(result.end(), entries->begin(), entries->end());
            return result;
        }

        Program program;
        Cells cells;
    };

    std::optional<RealState> on_sheet(std::optional<RealState> state) const {
        if (state && borders_ && !borders_->cells.of(*state)) return std::nullopt;
        if (state && motions_.where() == Motions::At::rest && !is_at_rest(*state)) return std::nullopt;
        if (!state || positive_.empty()) return state;
        const auto value = evaluate(program_, *state, positive_);
        const bool is_on_sheet =
            value && std::all_of(value->begin(), value->end(), [](const numeric& x) { return x.is_positive(); });
        return is_on_sheet ? state : std::nullopt;
    }

    /// On the scene's own branch of constraints that are products, and not where two branches cross: there the
    /// constraint has no direction, and a multiplier beyond all numbers would balance a force.
    bool is_at_rest(const RealState& state) const {
        const numeric beyond_all = GiNaC::pow(numeric(10), numeric(15));
        if (std::any_of(state.value.begin(), state.value.end(), [&](const auto& item) {
                return item.first.first == Variable::Kind::unknown && GiNaC::abs(item.second) > beyond_all;
            }))
            return false;
        const auto value = zero_.empty() ? std::nullopt : evaluate(program_, state, zero_);
        return !value || std::all_of(value->begin(), value->end(), [](const numeric& x) { return is_small(x); });
    }

    const Motions& motions_;
    Program program_;
    std::vector<int> positive_, zero_, needed_;
    bool on_own_branch_;
    std::unique_ptr<Borders> borders_;  ///< nothing where there are none
};

}  // namespace

std::optional<int> sign_on_own_branch(const Told& told, const Motions& motions, const Program& p, int root) {
    if (!motions.own()) return std::nullopt;
    constexpr unsigned tries = 12;
    constexpr int enough = 4;
    Told own = told;
    own.on_own_branch = true;
    const StatesOnSheet states(own, motions, p, {root});
    std::optional<int> sign;
    int found = 0;
    for (unsigned seed = 0; seed < tries; ++seed) {
        const auto state = states(seed);
        const auto value = state ? evaluate(p, *state, {root}) : std::nullopt;
        if (!value) continue;
        if (is_small((*value)[0]) || (sign && *sign != (*value)[0].csgn())) return std::nullopt;
        sign = (*value)[0].csgn();
        ++found;
    }
    return found >= enough ? sign : std::nullopt;
}

InNumbers in_many_digits(const Told& told, const Motions& motions, const Program& program, int root) {
    constexpr long digits = 2000, zeros = 1500;
    constexpr unsigned tries = 12;
    const ManyDigits many(digits);
    const numeric least = GiNaC::pow(numeric(10), numeric(-zeros));
    Program p = program;
    std::vector<int> roots = told.claims.lower(p, told.positive);
    roots.push_back(root);
    int found = 0;
    for (unsigned seed = 1; seed <= tries && found < enough_states; ++seed) {
        const auto state = real_state_on_own_branch(motions, p, roots, seed, Draws::at_random);
        const auto value = state ? evaluate(p, *state, roots) : std::nullopt;
        if (!value ||
            !std::all_of(value->begin(), value->end() - 1, [](const numeric& x) { return x.is_positive(); }))
            continue;
        if (!(GiNaC::abs(value->back()) < least)) return InNumbers::fails;
        ++found;
    }
    return found >= enough_states ? InNumbers::holds : InNumbers::unknown;
}

bool is_possible(const Told& told, const Motions& motions) {
    constexpr unsigned tries = 60;
    Program p;
    const Cells none(p, {});
    const StatesOnSheet states(told, motions, p, {});
    for (const unsigned first : {0U, first_float_seed})
        for (unsigned seed = first; seed < first + tries; ++seed)
            if (states.in_cell(none, {}, seed)) return true;
    return false;
}

std::optional<FoundState> state_where(const Told& told, const Motions& motions, const Program& p, int root,
                                      bool is_zero) {
    constexpr unsigned tries = 40;
    Told anywhere = told;
    anywhere.on_own_branch = false;
    const StatesOnSheet states(anywhere, motions, p, {root});
    for (unsigned seed = first_float_seed; seed < first_float_seed + tries; ++seed) {
        const auto state = states(seed);
        const auto value = state ? evaluate(p, *state, {root}) : std::nullopt;
        if (!value || is_small((*value)[0]) != is_zero) continue;
        FoundState result{.where = {}, .values = described(told, *state, (*value)[0]).values};
        for (int i = 0; i < told.mechanism.size(); ++i)
            result.where.emplace_back(told.mechanism.q[i].get_name(),
                                      text_of(*state, {Variable::Kind::coordinate, i}));
        return result;
    }
    return std::nullopt;
}

std::optional<Counterexample> counterexample(const Told& told, const Motions& motions, const Program& p,
                                             int root) {
    const StatesOnSheet states(told, motions, p, {root});
    const TableRounding rounding(told);
    // Operations in exact numbers, which take microseconds each. Nearly always one of the first few states will
    // do.
    constexpr int most_operations = 1'000'000;
    const auto tries = static_cast<unsigned>(std::clamp(most_operations / std::max(1, p.size()), 40, 1200));
    for (unsigned seed = 0; seed < tries; ++seed) {
        const auto state = states(seed);
        if (!state) continue;
        const auto value = evaluate(p, *state, {root});
        if (!value || is_small((*value)[0]) || rounding.explains(p, root, *state, (*value)[0]) ||
            !is_as_typed(p, root, *state, (*value)[0]))
            continue;
        Counterexample result = described(told, *state, (*value)[0]);
        add_unspecified(told, motions, p, {root}, *state, result);
        return result;
    }
    return std::nullopt;
}

std::vector<bool> hold_in_numbers(const Told& told, const Motions& motions, const Program& p,
                                  const std::vector<int>& roots) {
    const StatesOnSheet states(told, motions, p, roots);
    int found = 0;
    std::vector<bool> holds(roots.size(), true);
    for (unsigned seed = first_float_seed; seed < first_float_seed + 60 && found < enough_states; ++seed) {
        const auto state = states(seed);
        if (!state) continue;
        for (std::size_t k = 0; k < roots.size(); ++k) {
            const auto value = evaluate(p, *state, {roots[k]});
            if (!value || !is_small((*value)[0])) holds[k] = false;
        }
        ++found;
    }
    if (found < enough_states) holds.assign(roots.size(), false);
    return holds;
}

InNumbers in_numbers(const Told& told, const Motions& motions, const Program& p, int root) {
    const StatesOnSheet states(told, motions, p, {root});
    // Of states of rest there may be few, of which those in fractions are only some.
    const bool is_rest = motions.where() == Motions::At::rest;
    const int wanted = is_rest ? 24 : 2 * enough_states;
    int found = 0;
    for (const unsigned first :
         {0U, first_float_seed}) {  // fractions, which are exact, and floats if they are few
        const int before = found;
        for (unsigned seed = first; seed < first + 60 && found < before + wanted; ++seed) {
            const auto state = states(seed);
            if (!state) continue;
            const auto value = evaluate(p, *state, {root});
            if (!value) continue;
            if (!is_small((*value)[0])) return InNumbers::fails;
            ++found;
        }
        if (!is_rest && found >= enough_states) return InNumbers::holds;
    }
    return found >= enough_states ? InNumbers::holds : InNumbers::unknown;
}

namespace {

/// Adds a state of a cell.
void add_seen(const Told& told, const TableRounding& rounding, const Motions& motions, const NodeInCells& of,
              const RealState& state, SeenInCell& seen) {
    const auto value = evaluate(of.program, state, {of.node});
    if (!value) return;
    ++seen.states;
    if (seen.fails || is_small((*value)[0]) || rounding.explains(of.program, of.node, state, (*value)[0]) ||
        !is_as_typed(of.program, of.node, state, (*value)[0]))
        return;
    seen.fails = described(told, state, (*value)[0]);
    add_unspecified(told, motions, of.program, {of.node}, state, *seen.fails);
}

std::vector<int> roots_of(const NodeInCells& of) {
    std::vector<int> roots = of.cells.sides();
    roots.push_back(of.node);
    return roots;
}

}  // namespace

std::map<Cell, SeenInCell> survey(const Told& told, const Motions& motions, const NodeInCells& of) {
    constexpr unsigned enough = 16;
    const StatesOnSheet states(told, motions, of.program, roots_of(of));
    const TableRounding rounding(told);
    std::map<Cell, SeenInCell> result;
    unsigned found = 0;
    for (unsigned seed = 0; seed < 4 * enough && found < enough; ++seed) {
        const auto state = states(seed);
        const auto cell = state ? of.cells.of(*state) : std::nullopt;
        if (!cell) continue;
        ++found;
        add_seen(told, rounding, motions, of, *state, result[*cell]);
    }
    return result;
}

void look_in_cell(const Told& told, const Motions& motions, const NodeInCells& of, Cell cell, int wanted,
                  SeenInCell& seen) {
    const StatesOnSheet states(told, motions, of.program, roots_of(of));
    const TableRounding rounding(told);
    constexpr unsigned tries = 60;
    for (unsigned seed = 0; seed < tries && seen.states < wanted && !seen.fails; ++seed)
        if (const auto state = states.in_cell(of.cells, cell, seed))
            add_seen(told, rounding, motions, of, *state, seen);
}

std::optional<Counterexample> counterexample(const Told& told, const Motions& motions, const OpenRows& rows,
                                             const OpenClaim& of) {
    const std::vector<Open>& names = told.claims.open();
    const std::vector<int> roots = rows.roots();
    const std::size_t columns = names.size();
    Program cut = rows.program;
    const Cells cells(cut, roots);
    const StatesOnSheet states(told, motions, cut, roots);
    constexpr std::size_t most_steered = 4;
    constexpr unsigned in_each_cell = 12;
    const std::size_t sides = cells.sides().size();
    const bool may_steer = sides > 0 && sides <= most_steered;
    const unsigned steered = may_steer ? in_each_cell << sides : 0;
    for (unsigned seed = 0; seed < steered + of.tries; ++seed) {
        auto state = seed < steered ? states.in_cell(cells, seed / in_each_cell, seed % in_each_cell)
                                    : states(seed - steered);
        if (!state) continue;
        if (!cells.empty() && !cells.of(*state)) continue;  // on a border rates of change have no value
        for (const Open& o : names) state->value[{o.variable.kind, o.variable.index}] = 0;
        const auto value = evaluate(rows.program, *state, roots);
        if (!value) continue;
        // The rows of the right claims come first, then those of the other wrong ones, then those of this claim.
        // The first row that contradicts is shown.
        std::vector<std::size_t> sequence(rows.list.size());
        std::iota(sequence.begin(), sequence.end(), std::size_t{0});
        std::stable_sort(sequence.begin(), sequence.end(), [&](std::size_t a, std::size_t b) {
            const auto place = [&](std::size_t r) {
                return rows.list[r].claim == of.claim ? 2 : of.wrong.contains(rows.list[r].claim) ? 1 : 0;
            };
            return place(a) < place(b);
        });
        std::vector<std::vector<numeric>> kept;
        std::vector<std::size_t> pivots;
        for (const std::size_t r : sequence) {
            std::vector<numeric> row(columns + 1);
            const std::size_t base = r * (columns + 1);
            row[columns] = -(*value)[base];
            for (std::size_t j = 0; j < columns; ++j) row[j] = (*value)[base + 1 + j];
            for (std::size_t p = 0; p < pivots.size(); ++p) {
                const numeric factor = row[pivots[p]];
                for (std::size_t j = 0; j <= columns; ++j) row[j] -= factor * kept[p][j];
                row[pivots[p]] = 0;
            }
            const auto pivot =
                std::find_if(row.begin(), row.end() - 1, [](const numeric& x) { return !is_small(x); });
            if (pivot == row.end() - 1) {
                if (rows.list[r].claim != of.claim || is_small(row[columns])) continue;
                for (std::size_t p = pivots.size(); p-- > 0;) {
                    numeric x = kept[p][columns];
                    for (std::size_t j = pivots[p] + 1; j < columns; ++j)
                        x -= kept[p][j] * state->value[{names[j].variable.kind, names[j].variable.index}];
                    state->value[{names[pivots[p]].variable.kind, names[pivots[p]].variable.index}] = x;
                }
                Counterexample result = described(told, *state, -row[columns], of.open);
                add_unspecified(told, motions, rows.program, roots, *state, result);
                result.of_derivative = rows.list[r].derived;
                return result;
            }
            const numeric lead = *pivot;
            pivots.push_back(static_cast<std::size_t>(pivot - row.begin()));
            for (numeric& x : row) x /= lead;
            kept.push_back(std::move(row));
        }
    }
    return std::nullopt;
}

}  // namespace alembert
