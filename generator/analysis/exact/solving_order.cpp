// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/solving_order.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "analysis/exact/angle_sum.hpp"
#include "program/prime_polynomial.hpp"

namespace alembert {

namespace {

/// How a variable occurs in an expression.
struct Occurrence {
    bool plain = false, turned = false;  // outside and inside of sines and cosines
    // Under a root, so that no polynomial in the variable has the zeros of the condition.
    bool rooted = false;
};
using Occurrences = std::map<std::pair<Variable::Kind, int>, Occurrence>;
using TakenVariables = std::set<std::pair<Variable::Kind, int>>;

/// Whether no polynomial in a variable in the node's arguments has the zeros of the condition: in exp(x), in a
/// function of [functions], and in sin(k*x), whose turn is no power of that of x.
bool hides(const Node& node, bool turned) {
    switch (node.op) {
        case Op::sum:
        case Op::sin:
        case Op::cos:
        case Op::tan:
        case Op::sqrt:
            return false;
        case Op::product:
            return turned && (node.args.size() > 1 || node.is_reciprocal() || node.exponents[0] != 1);
        default:
            return true;
    }
}

Occurrences occurrences(const Program& p, int root) {
    Occurrences result;
    std::set<std::tuple<int, bool, bool>> seen;
    std::vector<std::tuple<int, bool, bool>> stack{{root, false, false}};
    while (!stack.empty()) {
        const auto [id, turned, rooted] = stack.back();
        stack.pop_back();
        if (!seen.emplace(id, turned, rooted).second) continue;
        const Node& node = p[id];
        if (node.op == Op::variable) {
            Occurrence& o = result[{node.variable.kind, node.variable.index}];
            (turned ? o.turned : o.plain) = true;
            o.rooted = o.rooted || rooted;
        }
        const bool inside = turned || node.op == Op::sin || node.op == Op::cos || node.op == Op::tan;
        const bool under = rooted || node.op == Op::sqrt;
        for (const int arg : node.args) {
            stack.emplace_back(arg, inside, under);
            // Outside and inside of sines, so that no condition is solved for it.
            if (hides(node, turned)) stack.emplace_back(arg, !inside, under);
        }
    }
    return result;
}

/// Leaves out the coordinates that cancel, as φ does in sin²φ + cos²φ: no value of theirs makes the condition
/// vanish.
void leave_out_cancelling(Occurrences& held, const Program& p, int condition) {
    constexpr std::size_t most_work = 100000;  // in nodes
    constexpr std::uint64_t seeds = 2;
    const std::array<int, 1> root{condition};
    if (p.needed(root).size() * held.size() > most_work) return;
    const auto value = [&](const ModularPoint& point) -> std::optional<Prime> {
        const auto at = evaluate_mod(p, point, root);
        return at ? std::optional(at->value[condition]) : std::nullopt;
    };
    const auto cancels = [&](const std::pair<Variable::Kind, int>& variable) {
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            ModularPoint point{.seed = seed};
            const auto here = value(point);
            point.given[variable] = point.random(950, seed);
            const auto there = value(point);
            if (!here || !there || !(*here - *there).is_zero()) return false;
        }
        return true;
    };
    std::erase_if(held, [&](const auto& entry) {
        return entry.first.first == Variable::Kind::coordinate && cancels(entry.first);
    });
}

/// Whether the condition, as a polynomial in the parameter, has a root that is the same for other values of the
/// coordinates; also where that is not known.
bool has_common_root(const Program& p, const SolvedUnknown& unknown) {
    if (unknown.turned) return true;
    const std::pair key{unknown.variable.kind, unknown.variable.index};
    const auto polynomial = [&](std::uint64_t seed) -> std::optional<PrimePolynomial> {
        ModularPoint point{.seed = 1};
        for (const int id : p.needed(std::vector<int>{unknown.node}))
            if (const Node& node = p[id];
                node.op == Op::variable && node.variable.kind != Variable::Kind::parameter)
                point.given[{node.variable.kind, node.variable.index}] =
                    point.random(951 + seed, 100 * static_cast<std::uint64_t>(node.variable.kind) +
                                                 static_cast<std::uint64_t>(node.variable.index));
        constexpr std::size_t highest = 8;
        std::vector<Prime> x, y;
        for (std::size_t k = 0; k < highest + 3; ++k) {
            x.push_back(point.random(960, k));
            point.given[key] = x.back();
            const auto at = evaluate_mod(p, point, std::array{unknown.node});
            if (!at) return std::nullopt;
            y.push_back(at->value[unknown.node]);
        }
        PrimePolynomial f = interpolate(x, y);
        return f.size() <= highest + 1 ? std::optional(std::move(f)) : std::nullopt;
    };
    constexpr std::uint64_t most_seeds = 40;  // a root may have no value at some
    std::optional<PrimePolynomial> here;
    for (std::uint64_t seed = 1; seed <= most_seeds; ++seed) {
        auto there = polynomial(seed);
        if (here && there) return prime_polynomial::divisor(*here, *there).size() > 1;
        if (there) here = std::move(there);
    }
    return true;
}

/// Two conditions, each with two variables that no other condition contains.
struct Coupled {
    std::size_t first, second;
    SolvingStep step;
};

std::optional<Coupled> coupled(const std::vector<int>& conditions, const std::vector<Occurrences>& held,
                               const TakenVariables& taken, const OwnSlopes* slopes) {
    const auto usable = [&](const auto& variable, std::size_t a, std::size_t b) {
        if (taken.contains(variable) || !held[b].contains(variable)) return false;
        for (std::size_t c = 0; c < held.size(); ++c) {
            const auto found = held[c].find(variable);
            if (found != held[c].end() && ((c != a && c != b) || (found->second.plain && found->second.turned)))
                return false;
        }
        return held[a].at(variable).turned == held[b].at(variable).turned &&
               variable.first != Variable::Kind::time;
    };
    for (std::size_t a = 0; a < held.size(); ++a)
        for (std::size_t b = a + 1; b < held.size(); ++b) {
            std::vector<SolvedUnknown> found;
            for (const auto& [variable, how] : held[a])
                if (usable(variable, a, b)) found.push_back({0, {variable.first, variable.second}, how.turned});
            // The variables that were declared last are taken, because driving coordinates are usually declared
            // first.
            for (std::size_t later = found.size(); later-- > 1;)
                for (std::size_t earlier = later; earlier-- > 0;) {
                    SolvedUnknown one = found[earlier], other = found[later];
                    one.node = conditions[a];
                    other.node = conditions[b];
                    if (slopes == nullptr || slopes->determine(one, other)) return Coupled{a, b, {{one}, other}};
                }
        }
    return std::nullopt;
}

/// The position of the condition that is solved before those chosen so far, and how it is solved.
using ChosenStep = std::pair<std::size_t, SolvingStep>;

/// A condition with a variable that no other contains. In a sum of angles, a variable that follows from the turns
/// of the others is preferred; a variable under a root is the last choice.
std::optional<ChosenStep> with_own_variable(const Program& program, const std::vector<int>& conditions,
                                            const std::vector<Occurrences>& held, const TakenVariables& taken,
                                            const std::set<int>& irreducible, const OwnSlopes* slopes) {
    constexpr std::array kinds{Variable::Kind::unknown, Variable::Kind::coordinate, Variable::Kind::parameter};
    constexpr std::array<std::pair<int, bool>, 4> orders{{{0, false}, {1, false}, {1, true}, {2, true}}};
    for (std::size_t choice = 0; choice < 2 * orders.size(); ++choice) {
        const bool roots = choice >= orders.size();
        const Variable::Kind kind = kinds[orders[choice % orders.size()].first];
        const bool any_multiple = orders[choice % orders.size()].second;
        for (std::size_t c = 0; c < conditions.size(); ++c)
            for (const auto& [variable, how] : held[c]) {
                if (variable.first != kind || taken.contains(variable)) continue;
                const auto holds_it = [&, index = variable.second](const Occurrences& other) {
                    return &other != &held[c] && other.contains({kind, index});
                };
                const bool elsewhere = std::any_of(held.begin(), held.end(), holds_it);
                const bool only_parameters = std::all_of(held[c].begin(), held[c].end(), [](const auto& o) {
                    return o.first.first == Variable::Kind::parameter || o.first.first == Variable::Kind::time;
                });
                if (elsewhere || (only_parameters && !irreducible.contains(conditions[c])) ||
                    (how.rooted && !roots) || (how.plain && how.turned))
                    continue;
                const Variable unknown{variable.first, variable.second};
                if (!any_multiple && is_sum_of_variables(program, conditions[c]) &&
                    !angle_sum(program, conditions[c], unknown))
                    continue;
                const SolvedUnknown chosen{conditions[c], unknown, how.turned};
                if (kind == Variable::Kind::parameter && !irreducible.contains(conditions[c]) &&
                    has_common_root(program, chosen))
                    continue;
                if (slopes != nullptr && !slopes->determine(chosen)) continue;
                return ChosenStep{c, {chosen, std::nullopt}};
            }
    }
    return std::nullopt;
}

}  // namespace

bool holds_parameters_alone(const Program& program, int condition) {
    const Occurrences held = occurrences(program, condition);
    return !held.empty() && std::all_of(held.begin(), held.end(), [](const auto& variable) {
        return variable.first.first == Variable::Kind::parameter;
    });
}

SolvingOrder solving_order(const Program& program, std::vector<int> conditions, const std::set<int>& irreducible,
                           const OwnSlopes* slopes, const std::set<std::pair<Variable::Kind, int>>& fixed) {
    std::sort(conditions.begin(), conditions.end());
    conditions.erase(std::unique(conditions.begin(), conditions.end()), conditions.end());
    std::vector<Occurrences> held;
    for (const int node : conditions) {
        held.push_back(occurrences(program, node));
        leave_out_cancelling(held.back(), program, node);
    }
    TakenVariables taken = fixed;
    SolvingOrder result;
    while (!conditions.empty()) {
        std::optional<ChosenStep> chosen =
            with_own_variable(program, conditions, held, taken, irreducible, slopes);
        std::optional<std::size_t> partner;
        if (!chosen)
            if (auto pair = coupled(conditions, held, taken, slopes)) {
                partner = pair->second;
                chosen = {pair->first, pair->step};
            }
        if (!chosen) break;
        const SolvingStep& step = chosen->second;
        taken.insert({step.variable.kind, step.variable.index});
        if (step.second) taken.insert({step.second->variable.kind, step.second->variable.index});
        result.steps.insert(result.steps.begin(), step);
        const auto drop = [&](std::size_t c) {
            conditions.erase(conditions.begin() + static_cast<std::ptrdiff_t>(c));
            held.erase(held.begin() + static_cast<std::ptrdiff_t>(c));
        };
        if (partner) drop(*partner);  // the one that stands later
        drop(chosen->first);
    }
    result.left = std::move(conditions);
    return result;
}

bool holds(const Program& program, int node, const SolvedUnknown& unknown) {
    const std::vector<int> needed = program.needed(std::vector{node});
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        const Variable& v = program[id].variable;
        return program[id].op == Op::variable && v.kind == unknown.variable.kind &&
               v.index == unknown.variable.index;
    });
}

}  // namespace alembert
