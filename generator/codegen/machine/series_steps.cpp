// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/machine/series_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

#include "alembert/base/error.hpp"
#include "codegen/emit/series_lanes.hpp"
#include "codegen/emit/series_times.hpp"
#include "program/processor.hpp"
#include "program/solve.hpp"

namespace alembert::machine {

namespace {

using Of = SeriesNode::Kind;

/// The solution of the linear system in a program, from the values of its matrix and of its residuals.
std::vector<int> solved(Program& p, const Recurrences& r, const std::function<int(const SeriesEntry&)>& entry,
                        const std::function<int(int)>& residual) {
    std::vector<int> lower, right;
    for (const SeriesEntry& e : r.matrix) lower.push_back(entry(e));
    for (const int id : r.residuals) right.push_back(residual(id));
    auto solution = solve_symmetric(p, lower, right, r.preferred);
    if (!solution)
        throw ModelError("the mass matrix is singular at every state: there are no accelerations to emit");
    return *std::move(solution);
}

/// The values of all nodes at order 0, by the functions themselves.
class ZeroOrder {
public:
    explicit ZeroOrder(const Recurrences& r) : r_(r), p_(r.program) {
        p_.roots.clear();
        p_.is_textbook = false;
        for (int id = 0; id < static_cast<int>(r_.nodes.size()); ++id) values_.push_back(value(id));
    }

    Program& program() { return p_; }
    int operator[](int id) const { return values_[id]; }
    int weight(const Weight& w) {
        return w.constant >= 0 ? p_.product(w.number, {{w.constant, 1}}) : p_.number(w.number);
    }

private:
    int product(const Weight& w, std::vector<Program::Factor> factors) {
        if (w.constant >= 0) factors.emplace_back(w.constant, 1);
        return p_.product(w.number, factors);
    }

    int sum(const SeriesNode& x) {
        std::vector<Program::Term> terms;
        for (const auto& [w, a] : x.linear) terms.emplace_back(1, product(w, {{values_[a], 1}}));
        for (const auto& [w, a, b] : x.bilinear)
            terms.emplace_back(1, product(w, {{values_[a], 1}, {values_[b], 1}}));
        for (const Weight& w : x.constants) terms.emplace_back(1, weight(w));
        return p_.sum(0, terms);
    }

    int unknown(int index) {
        if (solution_.empty())
            solution_ = solved(
                p_, r_, [&](const SeriesEntry& e) { return e.node >= 0 ? values_[e.node] : weight(e.constant); },
                [&](int id) { return values_[id]; });
        return solution_[index];
    }

    int value(int id) {
        const SeriesNode& x = r_.nodes[id];
        const auto of = [&](int arg) { return values_[arg]; };
        switch (x.kind) {
            case Of::time:
                return p_.variable({Variable::Kind::time, 0});
            case Of::coordinate:
                return p_.variable({Variable::Kind::coordinate, x.index});
            case Of::speed:
                return p_.variable({Variable::Kind::rate, x.index});
            case Of::work:
                return p_.number(0);  // nothing depends on it
            case Of::unknown:
                return unknown(x.index);
            case Of::quotient:
                return p_.product(1, {{sum(x), 1}, {of(x.w), -1}});
            case Of::root:
                return p_.call(Op::sqrt, {of(x.a)});
            case Of::power:
                return x.exponent.constant < 0 ? p_.power(of(x.a), x.exponent.number)
                                               : p_.call(Op::pow, {of(x.a), weight(x.exponent)});
            case Of::sine:
                return p_.call(Op::sin, {of(x.a)});
            case Of::cosine:
                return p_.call(Op::cos, {of(x.a)});
            case Of::hyperbolic_sine:
                return p_.call(Op::sinh, {of(x.a)});
            case Of::hyperbolic_cosine:
                return p_.call(Op::cosh, {of(x.a)});
            case Of::exponential:
                return p_.call(Op::exp, {of(x.a)});
            case Of::area:
            case Of::ratio:
                return p_.call(x.op, {of(x.a)});
            case Of::turn:
                return p_.call(Op::atan2, {of(x.a), of(x.b)});
            case Of::sum:
            case Of::residual:
                return sum(x);
        }
        throw std::logic_error("a series of an unknown kind");
    }

    const Recurrences& r_;
    Program p_;
    std::vector<int> values_, solution_;
};

/// The coefficients of all nodes at any further order, from those of lower orders.
class NextOrder {
public:
    NextOrder(const Recurrences& r, const SeriesLanes& lanes, ZeroOrder& zero, bool in_packs)
        : r_(r),
          lanes_(lanes),
          zero_(zero),
          n_(static_cast<int>(r.program.coordinates.size())),
          is_packed_(in_packs) {
        p_.name = r.program.name;
        places_.lanes = static_cast<int>(lanes.padded());
        places_.width = n_ + static_cast<int>(r.accelerations.size()) + (r.work >= 0 ? 1 : 0);
        if (in_packs || lanes.has_edges())
            for (const SeriesLane& lane : lanes.lanes()) {
                factors_.try_emplace({lane.a, lane.a_rate}, static_cast<int>(factors_.size()));
                factors_.try_emplace({lane.b, lane.b_rate}, static_cast<int>(factors_.size()));
            }
        if (!in_packs) describe_rows();
        for (int id = 0; id < static_cast<int>(r_.nodes.size()); ++id) values_.push_back(value(id));
    }

    void finish(SeriesSteps& steps) {
        FunctionTask& next = steps.next;
        next = {.name = "next",
                .about = {},
                .arguments = {{"Real", "t"},
                              {"const Real*", "par"},
                              {"const Real*", "given"},
                              {"Real*", "next"},
                              {"Real*", "row"},
                              {"Real*", "out"}},
                .goals = {},
                .results = {}};
        next.elsewhere = elsewhere_;
        const auto put = [&](const char* array, int place, int node) {
            next.results.push_back({array, {static_cast<std::size_t>(place)}, node});
            p_.roots.push_back({Group::output, fmt::format("{}{}", array, place), node});
        };
        for (int i = 0; i < places_.width; ++i) {
            put("out", (is_packed_ ? 0 : places_.width) + i, state(i));
            if (i >= places_.positions) put("next", places_.rates() + i, values_[rate_node(r_, i)]);
        }
        if (is_packed_) {
            for (const auto& [factor, place] : factors_)
                put("row", PackSeries::place_of_factor(place), now(factor.first, factor.second));
            for (const SeriesLane& lane : lanes_.lanes())
                steps.pairs.push_back({factors_.at({lane.a, lane.a_rate}), factors_.at({lane.b, lane.b_rate})});
        } else {
            for (int l = 2 * places_.lanes; const SeriesLane& lane : lanes_.lanes()) {
                put("row", l, now(lane.a, lane.a_rate));
                put("row", places_.lanes + l++, now(lane.b, lane.b_rate));
            }
        }
        steps.factors = static_cast<int>(factors_.size());
        for (const auto& [factor, place] : place_before_) steps.place_of_factor.push_back(place);
        FunctionTask& first = steps.first;
        first = {.name = "first",
                 .about = {},
                 .arguments = {{"Real", "t"},
                               {"const Real*", "state"},
                               {"const Real*", "par"},
                               {"Real*", "fixed"},
                               {"Real*", "given"}},
                 .goals = {},
                 .results = {}};
        Program& zero = zero_.program();
        const auto put_first = [&](const char* array, int place, int node) {
            first.results.push_back({array, {static_cast<std::size_t>(place)}, node});
            zero.roots.push_back({Group::output, fmt::format("{}{}", array, place), node});
        };
        for (const auto& [node, place] : fixed_) put_first("fixed", place, node);
        for (int i = 0; i < places_.width; ++i) put_first("given", places_.rates() + i, zero_[rate_node(r_, i)]);
        steps.places = places_;
        steps.at_zero = std::move(zero);
        steps.at_order = std::move(p_);
    }

private:
    /// Where `next` finds what the order before has left in rows, and whether positions follow from rates there.
    void describe_rows() {
        places_.factors = static_cast<int>(factors_.size());
        for (int l = 0; const SeriesLane& lane : lanes_.lanes()) {
            if (places_.factors == 0) break;
            place_before_.try_emplace(factors_.at({lane.a, lane.a_rate}), l);
            place_before_.try_emplace(factors_.at({lane.b, lane.b_rate}), places_.lanes + l++);
        }
        const auto is_rate = [&](int i) {
            const SeriesNode& rate = r_.nodes[rate_node(r_, i)];
            return rate.kind == Of::speed && rate.index == i;
        };
        int count = 0;
        while (count < n_ && is_rate(count)) ++count;
        if (count == n_) places_.positions = n_;
    }

    int given(int place) { return p_.variable({Variable::Kind::unknown, place}); }
    /// What stands in another array; its number is behind those of what is given.
    int given_elsewhere(const char* array, int place) {
        const auto found = std::find_if(elsewhere_.begin(), elsewhere_.end(), [&](const auto& one) {
            return one.second == std::pair(std::string(array), place);
        });
        if (found != elsewhere_.end()) return given(found->first);
        const int number = places_.size() + static_cast<int>(elsewhere_.size());
        elsewhere_.emplace(number, std::pair(array, place));
        return given(number);
    }

    /// A value of order 0.
    int fixed(int node) {
        const Node& value = zero_.program()[node];
        if (value.is_number()) return p_.number(value.number);
        const auto [known, is_new] = fixed_.try_emplace(node, static_cast<int>(fixed_.size()));
        if (is_new) p_.parameters.push_back({.name = fmt::format("f{}", known->second), .unit = {}});
        return p_.variable({Variable::Kind::parameter, known->second});
    }
    int first(int id) { return fixed(zero_[id]); }
    int weight(const Weight& w) {
        return w.constant >= 0 ? p_.product(w.number, {{fixed(w.constant), 1}}) : p_.number(w.number);
    }
    int product(const Weight& w, std::vector<Program::Factor> factors) {
        if (w.constant >= 0) factors.emplace_back(fixed(w.constant), 1);
        return p_.product(w.number, factors);
    }

    /// The coefficient, or k times that.
    int now(int id, bool rate) {
        return rate ? p_.product(1, {{values_[id], 1}, {p_.variable({Variable::Kind::time, 0}), 1}}) : values_[id];
    }

    int state(int i) {
        const int rate = i < places_.positions ? given_elsewhere("out", n_ + i) : given(places_.rates() + i);
        return p_.product(1, {{given(places_.inverse()), 1}, {rate, 1}});
    }

    /// The sum of a product over all lower orders but 0.
    void add_inner(std::vector<Program::Term>& terms, const SeriesProduct& x) {
        terms.emplace_back(1, product(x.weight, {{given(lanes_.number_of(x)), 1}}));
        if (places_.factors == 0) return;
        const SeriesLane lane = SeriesLanes::lane_of(x);
        const int a = factors_.at({lane.a, lane.a_rate}), b = factors_.at({lane.b, lane.b_rate});
        const auto one = [&](int factor) { return given(places_.ones() + factor); };
        const auto before = [&](int factor) { return given_elsewhere("row", place_before_.at(factor)); };
        terms.emplace_back(a == b ? 2 : 1, product(x.weight, {{one(a), 1}, {before(b), 1}}));
        if (a != b) terms.emplace_back(1, product(x.weight, {{one(b), 1}, {before(a), 1}}));
    }

    int unknown(int index) {
        if (solution_.empty())
            solution_ = solved(
                p_, r_, [&](const SeriesEntry& e) { return e.node >= 0 ? first(e.node) : weight(e.constant); },
                [&](int id) { return values_[id]; });
        return solution_[index];
    }

    int value(int id) {
        const SeriesNode& x = r_.nodes[id];
        switch (x.kind) {
            case Of::time:
                return given(places_.is_one());
            case Of::coordinate:
                return state(x.index);
            case Of::speed:
                return state(n_ + x.index);
            case Of::work:
                return state(places_.width - 1);
            case Of::unknown:
                return unknown(x.index);
            default:
                break;
        }
        std::vector<Program::Term> inner;
        for (const SeriesProduct& one : lanes_.products(id)) add_inner(inner, one);
        std::vector<Program::Term> terms;
        const bool by_order =
            x.kind != Of::sum && x.kind != Of::residual && x.kind != Of::quotient && x.kind != Of::root;
        if (by_order && !inner.empty())
            terms.emplace_back(1, p_.product(1, {{given(places_.inverse()), 1}, {p_.sum(0, inner), 1}}));
        else
            terms = std::move(inner);
        const auto add = [&](const Weight& w, int arg, int with = -1) {
            std::vector<Program::Factor> factors{{values_[arg], 1}};
            if (with >= 0) factors.emplace_back(with, 1);
            terms.emplace_back(1, product(w, factors));
        };
        for (const auto& [w, a] : x.linear) add(w, a);
        for (const auto& [w, a, b] : x.bilinear) add(w, a, first(b)), add(w, b, first(a));
        for (const auto& [w, m, a] : x.implied) add(w, m, first(a));
        const Weight plus{1, -1}, minus{-1, -1};
        switch (x.kind) {
            case Of::quotient:
                add(minus, x.w, first(id));
                break;
            case Of::root:
            case Of::ratio:
                add(plus, x.a);
                break;
            case Of::power:
                add(x.exponent, x.a, first(id));
                break;
            case Of::cosine:
                add(minus, x.a, first(x.w));
                break;
            case Of::sine:
            case Of::hyperbolic_sine:
            case Of::hyperbolic_cosine:
            case Of::area:
                add(plus, x.a, first(x.w));
                break;
            case Of::exponential:
                add(plus, x.a, first(id));
                break;
            case Of::turn:
                add(plus, x.a, first(x.b));
                add(minus, x.b, first(x.a));
                break;
            default:
                break;
        }
        const int sum = p_.sum(0, terms), divisor = divisor_of(r_, id);
        if (divisor < 0) return sum;
        const Rational share = x.kind == Of::root ? Rational(1) / 2 : Rational(1);
        return p_.product(share, {{sum, 1}, {p_.power(first(divisor), -1), 1}});
    }

    const Recurrences& r_;
    const SeriesLanes& lanes_;
    ZeroOrder& zero_;
    int n_;
    bool is_packed_;
    Program p_;
    GivenPlaces places_;
    std::map<std::pair<int, bool>, int> factors_;  // a node, and whether its rate is meant
    std::map<int, int> place_before_;              // of a factor, in the row of the order before
    std::map<int, std::pair<std::string, int>> elsewhere_;
    std::map<int, int> fixed_;  // a node of order 0, and its place
    std::vector<int> values_, solution_;
};

}  // namespace

std::vector<int> nodes_of(const FunctionTask& task) {
    std::vector<int> nodes;
    for (const FunctionResult& result : task.results) nodes.push_back(result.node);
    return nodes;
}

SeriesSteps series_steps(const Recurrences& recurrences, bool in_packs) {
    const SeriesLanes lanes(recurrences, false);
    ZeroOrder zero(recurrences);
    SeriesSteps steps;
    steps.products = lanes.products_eight_wide();
    NextOrder(recurrences, lanes, zero, in_packs).finish(steps);
    return steps;
}

SeriesCost cost_in_memory(const SeriesSteps& steps) {
    const std::vector<int> nodes = nodes_of(steps.next);
    const int operations = steps.at_order.count(nodes).total() + static_cast<int>(nodes.size());
    return {.order = processor::order_in_memory + processor::operation_in_memory * operations,
            .product = processor::product_cost * steps.products};
}

}  // namespace alembert::machine
