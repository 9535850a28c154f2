// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/switches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "program/interpret.hpp"
#include "program/known_knots.hpp"
#include "program/motion_system.hpp"
#include "program/partials.hpp"
#include "program/quotient_signs.hpp"
#include "program/rewriting.hpp"

namespace alembert {

namespace {

/// Beyond that steps are so short that their control sees the knots of a table by itself, for less.
constexpr std::size_t most_kinks = 1000;

/// Copies the program and collects the functions whose signs are kept constant.
class Holding {
public:
    explicit Holding(const Program& old)
        : old_(old),
          rewriting_(old),
          first_(static_cast<int>(old.parameters.size())),
          is_of_state_(static_cast<std::size_t>(old.size()), 0) {
        std::vector<int> roots;
        for (const Root& root : old.roots)
            if (root.group != Group::projected && root.group != Group::pivot) roots.push_back(root.node);
        for (const int id : old.needed(roots)) is_of_state_[static_cast<std::size_t>(id)] = 1;
    }

    Program finish() {
        return rewriting_.finish([this](int id) { return rebuilt(id); });
    }

    const std::vector<int>& conditions() const { return conditions_; }  ///< nodes of the new program
    const std::vector<int>& functions() const { return functions_; }    ///< nodes of the old one

private:
    int rebuilt(int id) {
        const Node& node = old_[id];
        const bool bends = node.op == Op::sign || node.op == Op::abs || node.op == Op::min || node.op == Op::max;
        Program& made = rewriting_.made();
        if ((node.op == Op::sqrt || node.op == Op::pow) && may_vanish(node.args[0])) {
            std::vector<int> args = {made.call(Op::abs, {rewriting_.image(node.args[0])})};
            for (std::size_t k = 1; k < node.args.size(); ++k) args.push_back(rewriting_.image(node.args[k]));
            return made.call(node.op, args);
        }
        if (node.op == Op::unspecified && old_.table_of(node) != nullptr) return table(id);
        if (!bends || node.is_constant()) return rewriting_.plain(id);
        const Rational half = Rational(1) / 2;
        const int a = rewriting_.image(node.args[0]);
        if (node.op == Op::sign) return side_of(a, id);
        if (node.op == Op::abs) return made.product(1, {{side_of(a, id), 1}, {a, 1}});
        int value = a;
        for (std::size_t k = 1; k < node.args.size(); ++k) {
            const int b = rewriting_.image(node.args[k]);
            const int difference = made.sum(0, {{1, value}, {-1, b}});
            const int apart = made.product(1, {{side_of(difference, id), 1}, {difference, 1}});
            value = made.sum(0, {{half, value}, {half, b}, {node.op == Op::max ? half : -half, apart}});
        }
        return value;
    }

    /// A call whose derivatives jump at some knots, with the sides of its arguments.
    int table(int id) {
        const Node& node = old_[id];
        const Program::TableCall call = old_.table_call(node);
        const TabulatedFunction& of = *old_.table_of(node);
        Program& made = rewriting_.made();
        const bool is_function =
            call.orders[0] < TabulatedFunction::side_function && !call.is_held && !node.is_constant();
        const auto is_kinked = [&](std::size_t k) {
            const std::size_t kinks = of.axes()[k].kinks.size();
            return kinks > 0 && kinks <= most_kinks && !old_[call.argument[k]].is_constant() &&
                   (of.tells_knots(k, call.orders) || !has_known_knots(old_, of, call, k));
        };
        bool any = false;
        for (std::size_t k = 0; k < call.arguments; ++k) any = any || (is_function && is_kinked(k));
        if (!any) return rewriting_.plain(id);
        std::vector<int> args, numbers;
        for (const int arg : node.args) args.push_back(rewriting_.image(arg));
        for (std::size_t k = 0; k < call.arguments; ++k)
            numbers.push_back(is_kinked(k) ? number_of_interval(id, k)
                                           : made.number(static_cast<int>(TabulatedFunction::free)));
        args.insert(args.end(), numbers.begin(), numbers.end());
        return made.call(Op::unspecified, args);
    }

    /// The number of the interval between knots in which an argument lies, by the signs of functions that are zero
    /// at the knots (alembert/base/tabulated_function.hpp). It is linear in each sign that changes at a jump.
    int number_of_interval(int id, std::size_t axis) {
        const Node& node = old_[id];
        const Program::TableCall call = old_.table_call(node);
        const TabulatedFunction& table = *old_.table_of(node);
        const TableAxis& of = table.axes()[axis];
        Program& made = rewriting_.made();
        const int x = rewriting_.image(call.argument[axis]), function = rewriting_.image(node.args[0]);
        const Rational half = Rational(1) / 2;
        const auto side = [&](int g, int knot) {
            return table_side(g, id, {node.args[0], static_cast<int>(axis), knot});
        };
        if (!table.tells_knots(axis, call.orders)) {
            const int order = made.number(TabulatedFunction::side_order(axis));
            return made.sum(half, {{-half, side(made.call(Op::unspecified, {function, order, x}), -1)}});
        }
        std::vector<Program::Term> passed;
        int first = -1;
        for (const int knot : of.kinks) {
            int g = made.sum(-exact(of.at[static_cast<std::size_t>(knot)]), {{1, x}});
            if (of.period > 0) {  // zero once in each period, with alternating signs
                const int turns = made.product(1, {{made.pi(), 1}, {g, 1}});
                g = made.call(Op::sin, {made.sum(0, {{1 / exact(of.period), turns}})});
            }
            passed.emplace_back(half, side(g, knot));
            if (first < 0) first = passed.back().second;
        }
        const auto count = static_cast<int>(passed.size());
        const int number = made.sum(Rational(count) / 2, passed);
        return of.period > 0 ? made.sum(2 * count, {{1, made.product(1, {{first, 1}, {number, 1}})}}) : number;
    }

    /// The step to the constraints looks at a second state, on the side of the first one.
    int table_side(int g, int id, const std::array<int, 3>& of) {
        std::set<int>& known = sides_of_tables_[of];
        if (is_of_state_[static_cast<std::size_t>(id)] == 0 && known.size() == 1) return *known.begin();
        const int side = side_of(g, id);
        if (is_of_state_[static_cast<std::size_t>(id)] != 0) known.insert(side);
        return side;
    }

    /// Whether a node may be zero where a sign in it changes, as max(0, x) and |x| − x are. With a sign that is
    /// held, it goes on to negative values, of which a root would have none: a step that passes the zero, and is
    /// cut short there, could not be taken. The root of its size continues it.
    bool may_vanish(int id) const {
        const Node& node = old_[id];
        if (node.is_constant()) return false;
        if (node.op == Op::abs || node.op == Op::min || node.op == Op::max) return true;
        return (node.op == Op::sum || node.op == Op::product) &&
               std::any_of(node.args.begin(), node.args.end(), [this](int a) { return may_vanish(a); });
    }

    /// ±σ for the sign of `g`; g and c·g have the same σ.
    int side_of(int g, int function) {
        Program& made = rewriting_.made();
        if (made[g].is_number()) return made.number(cln::signum(made[g].number));
        bool turned = false;
        while (made[g].is_scaled()) {
            turned = turned != (made[g].coefficients[0] < 0);
            g = made[g].args[0];
        }
        const auto [known, is_new] = places_.try_emplace(g, static_cast<int>(conditions_.size()));
        if (is_new) {
            conditions_.push_back(g);
            functions_.push_back(function);
        }
        const int sigma = made.variable({Variable::Kind::parameter, first_ + known->second});
        return turned ? made.sum(0, {{-1, sigma}}) : sigma;
    }

    const Program& old_;
    Rewriting rewriting_;
    int first_;
    std::vector<char> is_of_state_;  // whether more than the step to the constraints needs a node
    std::map<std::array<int, 3>, std::set<int>> sides_of_tables_;  // function, argument, knot → σ
    std::map<int, int> places_;                                    // node → position
    std::vector<int> conditions_, functions_;
};

/// ġ in terms of the given accelerations u'; nothing if it would be too long.
std::optional<std::vector<int>> rates_of(Program& p, const std::vector<int>& conditions) {
    const std::vector<int> second = p.nodes_of(Group::rate);  // q' = h, if the speeds are not the rates
    const auto n = static_cast<int>(p.coordinates.size());
    const auto s = static_cast<int>(speeds_of(p));
    std::vector<int> inputs{p.variable({Variable::Kind::time, 0})}, directions{p.number(1)};
    for (int i = 0; i < n; ++i) {
        inputs.push_back(p.variable({Variable::Kind::coordinate, i}));
        directions.push_back(second.empty() ? p.variable({Variable::Kind::rate, i})
                                            : second[static_cast<std::size_t>(i)]);
    }
    for (int i = 0; i < s; ++i) {
        inputs.push_back(p.variable({Variable::Kind::rate, i}));
        directions.push_back(p.variable({Variable::Kind::acceleration, i}));
    }
    const auto found = partials(p, conditions, inputs, EliminationOrder::forward);
    if (!found) return std::nullopt;
    std::vector<std::vector<Program::Term>> terms(conditions.size());
    for (const Partial& one : *found)
        terms[static_cast<std::size_t>(one.output)].emplace_back(
            1, p.product(1, {{one.node, 1}, {directions[static_cast<std::size_t>(one.input)], 1}}));
    std::vector<int> rates;
    for (const auto& list : terms) rates.push_back(p.sum(0, list));
    return rates;
}

/// Which g depend on positions and time alone; empty if none does.
std::vector<bool> positional(const Program& p, const std::vector<int>& conditions) {
    std::vector<bool> result;
    for (const int g : conditions) result.push_back((p[g].depends & bit(Variable::Kind::rate)) == 0);
    const bool any = std::find(result.begin(), result.end(), true) != result.end();
    return any ? result : std::vector<bool>();
}

/// +1 or −1 if b is a positive or negative multiple of a at three arbitrary states, else 0. (The nodes may differ
/// because one of them comes from a readable form.)
int ratio_of(const Program& p, int a, int b) {
    constexpr double same = 1e-9;
    double first = 0;
    for (int trial = 0; trial < 3; ++trial) {
        unsigned seed = 7U + static_cast<unsigned>(trial);
        const auto numbers = [&seed](std::size_t count) {
            std::vector<double> list(count);
            for (double& x : list) {
                seed = seed * 1664525U + 1013904223U;
                x = 0.1 + 0.8 * (seed >> 8) / 16777216.0;
            }
            return list;
        };
        const std::size_t n = p.coordinates.size(), s = speeds_of(p);
        State<double> state{.parameters = numbers(p.parameters.size()),
                            .t = 0.3,
                            .q = numbers(n),
                            .qdot = numbers(s),
                            .qddot = {}};
        const std::vector<double> value = interpret(p, state);
        const double ratio = value[static_cast<std::size_t>(b)] / value[static_cast<std::size_t>(a)];
        if (trial == 0) first = ratio;
        if (!std::isfinite(ratio) || ratio == 0 || std::abs(ratio - first) > same * std::abs(first)) return 0;
    }
    return first > 0 ? 1 : -1;
}

/// The frictions in planes, whose directions follow from parameters.
std::vector<int> frictions_in_planes(const Program& p) {
    std::vector<int> result;
    for (const Root& root : p.roots)
        if (root.group == Group::across) result.push_back(root.constraint);
    return result;
}

/// The two components of the sliding velocity of each friction in a plane.
std::vector<int> components_in_planes(const Program& p) {
    const std::vector<int> sliding_velocities = p.nodes_of(Group::sliding_velocity),
                           across = p.nodes_of(Group::across), frictions = frictions_in_planes(p);
    std::vector<int> result;
    for (std::size_t c = 0; c < frictions.size(); ++c)
        result.insert(result.end(), {sliding_velocities[static_cast<std::size_t>(frictions[c])], across[c]});
    return result;
}

/// The frictions to which each condition belongs. The first conditions are the components of those in planes.
std::vector<std::vector<Switched::Rubbing>> frictions_of(const Program& p, const std::vector<int>& conditions) {
    std::vector<std::vector<Switched::Rubbing>> result(conditions.size());
    const std::vector<int> sliding_velocities = p.nodes_of(Group::sliding_velocity),
                           planes = frictions_in_planes(p);
    for (std::size_t k = 0; k < 2 * planes.size(); ++k) result[k].push_back({planes[k / 2], 1});
    for (std::size_t i = 0; i < sliding_velocities.size(); ++i)
        for (std::size_t k = 2 * planes.size(); k < conditions.size(); ++k)
            if (const int direction = ratio_of(p, conditions[k], sliding_velocities[i]);
                direction != 0 && std::find(planes.begin(), planes.end(), static_cast<int>(i)) == planes.end())
                result[k].push_back({static_cast<int>(i), direction});
    return result;
}

/// Adds the bound, the largest static friction divided by the sliding friction, and the number that must not
/// become negative; both are 1 if there is no friction. If several frictions have the same sliding velocity, the
/// bound is that of all together.
void add_bounds(Program& p, const Switched& s) {
    const std::vector<int> bounds = p.nodes_of(Group::stick_bound), sliding = p.nodes_of(Group::friction),
                           normals = p.nodes_of(Group::normal), determinants = p.nodes_of(Group::determinant);
    const auto add = [&p](const char* what, std::size_t k, int node) {
        p.roots.push_back({Group::event, fmt::format("{} {}", what, k + 1), node});
    };
    for (std::size_t k = 0; k < s.frictions.size(); ++k) {
        std::vector<Program::Term> held, slid;
        for (const Switched::Rubbing& one : s.frictions[k]) {
            const auto i = static_cast<std::size_t>(one.friction);
            slid.emplace_back(1, p.product(1, {{sliding[i], 1}, {normals[i], 1}}));
            held.emplace_back(1, p.product(1, {{bounds[i], 1}, {slid.back().second, 1}}));
        }
        add("bound of side", k,
            held.empty()       ? p.number(1)
            : held.size() == 1 ? bounds[static_cast<std::size_t>(s.frictions[k][0].friction)]
                               : p.product(1, {{p.sum(0, held), 1}, {p.sum(0, slid), -1}}));
    }
    for (std::size_t k = 0; k < s.frictions.size(); ++k) {
        std::vector<int> all;
        for (const Switched::Rubbing& one : s.frictions[k]) {
            const auto i = static_cast<std::size_t>(one.friction);
            all.push_back(p[determinants[i]].is_number() ? normals[i] : determinants[i]);
        }
        add("limit at side", k, all.empty() ? p.number(1) : all.size() == 1 ? all[0] : p.call(Op::min, all));
    }
}

}  // namespace

bool Switched::has_frictions() const {
    return std::any_of(frictions.begin(), frictions.end(), [](const auto& list) { return !list.empty(); });
}

std::size_t Switched::events() const {
    return functions.size() * (positional.empty() ? 2U : 3U) + bounds();
}

std::optional<Switched> switched(const Program& program, SecondRates second) {
    if (program.singular) return std::nullopt;
    Holding holding(program);
    Program made = holding.finish();
    std::vector<int> conditions = components_in_planes(made), functions = components_in_planes(program);
    const std::size_t components = conditions.size();
    conditions.insert(conditions.end(), holding.conditions().begin(), holding.conditions().end());
    functions.insert(functions.end(), holding.functions().begin(), holding.functions().end());
    if (conditions.empty()) return std::nullopt;
    for (const int g : conditions)
        if ((made[g].depends & (bit(Variable::Kind::acceleration) | bit(Variable::Kind::unknown))) != 0)
            return std::nullopt;
    const auto rates = rates_of(made, conditions);
    if (!rates) return std::nullopt;
    for (std::size_t k = components; k < conditions.size(); ++k)
        made.parameters.push_back({.name = fmt::format("side_{}", k + 1), .unit = "", .value = 1});
    std::vector<bool> of_positions;
    if (second == SecondRates::wanted) of_positions = positional(made, conditions);
    std::vector<int> changing = *rates;  // 0 where it is not wanted
    for (std::size_t k = 0; k < of_positions.size(); ++k)
        if (!of_positions[k]) changing[k] = made.number(0);
    const auto second_rates = of_positions.empty() ? std::nullopt : rates_of(made, changing);
    if (!second_rates) of_positions.clear();
    const auto add = [&made](const char* what, const std::vector<int>& nodes) {
        for (std::size_t k = 0; k < nodes.size(); ++k)
            made.roots.push_back({Group::event, fmt::format("{} {}", what, k + 1), nodes[k]});
    };
    add("side function", conditions);
    add("rate of side function", *rates);
    if (second_rates) add("second rate of side function", *second_rates);
    Switched result{.program = {},
                    .functions = functions,
                    .pairs = static_cast<int>(components / 2),
                    .frictions = frictions_of(made, conditions),
                    .positional = std::move(of_positions)};
    if (result.has_frictions()) add_bounds(made, result);
    result.program = made.canonical();
    return result;
}

bool jumps_along_motion(const Program& program, const std::vector<int>& parameters) {
    std::vector<QuotientSign> signs;
    const Program p = with_quotient_signs(program, signs);
    const std::vector<int> needed = p.needed(p.right_hand_side());
    const unsigned fixed = bit(Variable::Kind::time) | bit(Variable::Kind::parameter);
    const auto is_moved = [&](int id) {
        return p[id].op == Op::variable && p[id].variable.kind == Variable::Kind::parameter &&
               std::find(parameters.begin(), parameters.end(), p[id].variable.index) != parameters.end();
    };
    const auto by_time_alone = [&](int argument) {
        if ((p[argument].depends & ~fixed) != 0) return false;
        const std::vector<int> inside = p.needed(std::vector<int>{argument});
        return std::none_of(inside.begin(), inside.end(), is_moved);
    };
    return std::any_of(needed.begin(), needed.end(), [&](int id) {
        if (p[id].op == Op::sign) return !by_time_alone(p[id].args[0]);
        const TabulatedFunction* const table = p[id].op == Op::unspecified ? p.table_of(p[id]) : nullptr;
        if (table == nullptr) return false;
        const Program::TableCall call = p.table_call(p[id]);
        const bool is_of_time =
            by_time_alone(call.argument[0]) && (call.arguments < 2 || by_time_alone(call.argument[1]));
        return !is_of_time && table->may_jump(call.orders);
    });
}

}  // namespace alembert
