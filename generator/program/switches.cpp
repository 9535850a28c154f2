// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/switches.hpp"

#include <fmt/format.h>

#include <map>

#include "program/partials.hpp"
#include "program/rewriting.hpp"

namespace alembert {

namespace {

constexpr unsigned bit(Variable::Kind kind) {
    return 1U << static_cast<unsigned>(kind);
}

/// Copies the program and collects the functions whose signs are held.
class Holding {
public:
    explicit Holding(const Program& old)
        : old_(old), rewriting_(old), first_(static_cast<int>(old.parameters.size())) {}

    Program finish() {
        return rewriting_.finish([this](int id) { return rebuilt(id); });
    }

    const std::vector<int>& conditions() const { return conditions_; }  ///< nodes of the new program
    const std::vector<int>& functions() const { return functions_; }    ///< nodes of the old one

private:
    int rebuilt(int id) {
        const Node& node = old_[id];
        const bool bends = node.op == Op::sign || node.op == Op::abs || node.op == Op::min || node.op == Op::max;
        if (!bends || node.is_constant()) return rewriting_.plain(id);
        Program& made = rewriting_.made();
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

    /// ±σ, where the sign of `g` is asked for; one σ for g and c·g.
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
    std::map<int, int> places_;  // node → position
    std::vector<int> conditions_, functions_;
};

/// ġ for the accelerations that stand for u'; nothing where it would be too long.
std::optional<std::vector<int>> rates_of(Program& p, const std::vector<int>& conditions) {
    const std::vector<int> second = p.nodes_of(Group::rate);  // q' = h, where the speeds are not the rates
    const auto n = static_cast<int>(p.coordinates.size());
    const auto s = static_cast<int>(p.speeds.empty() ? p.coordinates.size() : p.speeds.size());
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

}  // namespace

std::optional<Switched> switched(const Program& program) {
    if (program.singular) return std::nullopt;
    Holding holding(program);
    Program made = holding.finish();
    const std::vector<int>& conditions = holding.conditions();
    if (conditions.empty()) return std::nullopt;
    for (const int g : conditions)
        if ((made[g].depends & (bit(Variable::Kind::acceleration) | bit(Variable::Kind::unknown))) != 0)
            return std::nullopt;
    const auto rates = rates_of(made, conditions);
    if (!rates) return std::nullopt;
    for (std::size_t k = 0; k < conditions.size(); ++k)
        made.parameters.push_back({.name = fmt::format("side_{}", k + 1), .unit = "", .value = 1});
    for (std::size_t k = 0; k < conditions.size(); ++k)
        made.roots.push_back({Group::event, fmt::format("side function {}", k + 1), conditions[k]});
    for (std::size_t k = 0; k < conditions.size(); ++k)
        made.roots.push_back({Group::event, fmt::format("rate of side function {}", k + 1), (*rates)[k]});
    return Switched{made.canonical(), holding.functions()};
}

}  // namespace alembert
