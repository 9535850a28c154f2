// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/fmu/clocks.hpp"

#include <algorithm>
#include <optional>

namespace alembert {

namespace {

class ClockSearch {
public:
    ClockSearch(Program& program, const SetParameters& set) : p_(program), set_(set) {}

    /// The clocks of one function and their arguments; nothing if its zeros are not known.
    bool find(int node, int watched) {
        const Node here = p_[node];
        if (const std::optional<int> degree = degree_of(node)) {
            if (*degree == 1) add(watched, TimedZero::Kind::zero, node);
            return true;  // a constant is no clock
        }
        if (here.is_scaled()) return find(here.args[0], watched);
        if (here.op == Op::product && !here.is_reciprocal()) {
            for (std::size_t k = 0; k < here.args.size(); ++k)
                if (here.exponents[k] != 1 || !find(here.args[k], watched)) return false;
            return true;
        }
        if (here.op == Op::sum) return find_level(here, watched);
        if ((here.op != Op::sin && here.op != Op::cos) || degree_of(here.args[0]) != 1) return false;
        add(watched, here.op == Op::sin ? TimedZero::Kind::sine : TimedZero::Kind::cosine, here.args[0]);
        return true;
    }

    std::vector<TimedZero> clocks;
    std::vector<int> arguments;

private:
    void add(int watched, TimedZero::Kind kind, int argument) {
        clocks.push_back({watched, kind});
        arguments.push_back(argument);
    }

    /// A sine or cosine, perhaps with a constant factor, and constants: it is at a level at two places of a turn.
    bool find_level(const Node& sum, int watched) {
        std::vector<Program::Term> constants;
        std::optional<std::size_t> wave;
        for (std::size_t k = 0; k < sum.args.size(); ++k) {
            if (degree_of(sum.args[k]) == 0)
                constants.emplace_back(sum.coefficients[k], sum.args[k]);
            else if (wave)
                return false;
            else
                wave = k;
        }
        if (!wave) return false;
        std::vector<Program::Factor> height;
        int function = sum.args[*wave];
        if (const Node product = p_[function]; product.op == Op::product && !product.is_reciprocal()) {
            function = -1;
            for (std::size_t k = 0; k < product.args.size(); ++k)
                if (degree_of(product.args[k]) == 0)
                    height.emplace_back(product.args[k], product.exponents[k]);
                else if (function >= 0 || product.exponents[k] != 1)
                    return false;
                else
                    function = product.args[k];
            if (function < 0) return false;
        }
        const Node waving = p_[function];
        if ((waving.op != Op::sin && waving.op != Op::cos) || degree_of(waving.args[0]) != 1) return false;
        const int rest = p_.sum(sum.number, constants),
                  factor = p_.power(p_.product(sum.coefficients[*wave], height), -1),
                  level = p_.product(-1, {{rest, 1}, {factor, 1}}), argument = waving.args[0];
        const bool is_sine = waving.op == Op::sin;
        const int arc = p_.call(is_sine ? Op::asin : Op::acos, {level});
        add(watched, TimedZero::Kind::turn, p_.sum(0, {{1, argument}, {-1, arc}}));
        add(watched, TimedZero::Kind::turn,
            is_sine ? p_.sum(0, {{1, argument}, {1, arc}, {-1, p_.pi()}}) : p_.sum(0, {{1, argument}, {1, arc}}));
        return true;
    }

    /// 0 or 1 for what is constant or linear in time.
    std::optional<int> degree_of(int node) const {
        const Node& here = p_[node];
        if (here.op == Op::variable) {
            const Variable& v = here.variable;
            if (v.kind == Variable::Kind::time) return 1;
            const bool is_set = v.index >= set_.first && v.index < set_.behind;
            return v.kind == Variable::Kind::parameter && !is_set ? std::optional(0) : std::nullopt;
        }
        int degree = 0;
        for (std::size_t k = 0; k < here.args.size(); ++k) {
            const std::optional<int> one = degree_of(here.args[k]);
            if (!one || (*one > 0 && here.op != Op::sum && (here.op != Op::product || here.exponents[k] != 1)))
                return std::nullopt;
            degree = here.op == Op::product ? degree + *one : std::max(degree, *one);
        }
        return degree <= 1 ? std::optional(degree) : std::nullopt;
    }

    Program& p_;
    SetParameters set_;
};

}  // namespace

std::vector<TimedZero> add_clocks(Program& program, int watched, const SetParameters& set) {
    constexpr double largest = 1000;  // operations; a function is looked at as a tree
    std::vector<int> events = program.nodes_of(Group::event);
    std::vector<TimedZero> clocks;
    events.resize(static_cast<std::size_t>(watched));
    for (int k = 0; k < watched; ++k) {
        const int node = events[static_cast<std::size_t>(k)];
        ClockSearch search(program, set);
        if (program[node].size > largest || !search.find(node, k)) continue;
        clocks.insert(clocks.end(), search.clocks.begin(), search.clocks.end());
        for (const int argument : search.arguments)
            program.roots.push_back({Group::event, "clock " + std::to_string(clocks.size()), argument});
    }
    return clocks;
}

}  // namespace alembert
