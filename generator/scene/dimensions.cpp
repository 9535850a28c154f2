// SPDX-License-Identifier: GPL-2.0-or-later
// A dimension is a product of powers of base units; all terms of a sum have the same dimension (Bridgman,
// Dimensional Analysis (1922), chapter 2).
#include "check/dimensions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "scene/unit_text.hpp"

namespace alembert {

namespace {

using Dimension = UnitExponents;         ///< without rad, which is a number here
using Known = std::optional<Dimension>;  ///< nothing if it may be any

Known dimension_of_unit(const std::string& text) {
    const std::optional<UnitMeaning> unit = meaning_of_unit(text);
    if (!unit) return {};
    Dimension result = unit->exponents;
    result.erase("rad");
    return result;
}

class Dimensions {
public:
    explicit Dimensions(const Mechanism& m) {
        const auto know = [this](const std::string& name, const std::string& unit) {
            if (!unit.empty())
                if (const Known dimension = dimension_of_unit(unit)) names_[name] = *dimension;
        };
        for (const Mechanism::Parameter& p : m.parameters) know(p.symbol.get_name(), p.unit);
        for (std::size_t i = 0; i < m.units.size(); ++i) know(m.q[i].get_name(), m.units[i]);
        for (const Mechanism::Speed& speed : m.speeds) know(speed.u.get_name(), speed.unit);
        for (const Mechanism::Input& input : m.inputs) know(input.derivative[0].get_name(), input.unit);
        names_.emplace(m.t.get_name(), Dimension{{"s", 1}});
        names_.emplace("pi", Dimension{});
        is_useful_ = std::any_of(names_.begin(), names_.end(), [](const auto& entry) {
            return entry.second != Dimension{} && entry.second != Dimension{{"s", 1}};
        });
    }

    std::optional<std::string> wrong_term(const Claim& claim) {
        if (!is_useful_) return std::nullopt;
        Terms terms;
        for (const Expression* side : {&claim.equation.lhs, &claim.equation.rhs}) {
            text_ = &side->text;
            if (side->tree->kind == Tree::Kind::sum)
                for (const TreePtr& arg : side->tree->args) add(terms, *arg);
            else
                add(terms, *side->tree);
        }
        common(terms);
        return wrong_;
    }

    /// With lengths in m also where they are numbers in the scene.
    Known of(const Expression& expression) {
        if (!expression.tree) return {};
        has_metres_ = true;
        text_ = &expression.text;
        Known found = of(*expression.tree);
        return wrong_ ? Known() : found;
    }

private:
    using Terms = std::vector<std::pair<std::string, Known>>;

    void add(Terms& terms, const Tree& tree) {
        const Tree& inner = tree.kind == Tree::Kind::negate ? *tree.args[0] : tree;
        std::string text =
            text_->substr(static_cast<std::size_t>(inner.offset), static_cast<std::size_t>(inner.length));
        while (!text.empty() && text.back() == ' ') text.pop_back();
        Known dimension = of(tree);
        const bool zero = tree.kind == Tree::Kind::number && text.find_first_not_of("0.") == std::string::npos;
        terms.emplace_back(std::move(text), zero ? Known() : std::move(dimension));
    }

    /// The dimension of most terms; a term with another dimension is wrong.
    Known common(const Terms& terms) {
        std::map<Dimension, int> votes;
        for (const auto& [text, dimension] : terms)
            if (dimension) ++votes[*dimension];
        const Dimension* most = nullptr;
        for (const auto& [text, dimension] : terms)
            if (dimension && (most == nullptr || votes[*dimension] > votes[*most])) most = &*dimension;
        for (const auto& [text, dimension] : terms)
            if (dimension && *dimension != *most && !wrong_) wrong_ = text;
        return most == nullptr ? Known() : Known(*most);
    }

    Known of(const Tree& tree) {
        using Kind = Tree::Kind;
        switch (tree.kind) {
            case Kind::number:
                return Dimension{};
            case Kind::name: {
                const auto found = names_.find(tree.text);
                return found == names_.end() ? Known() : Known(over_time(found->second, tree.primes));
            }
            case Kind::negate:
                return of(*tree.args[0]);
            case Kind::derivative: {
                const Known inner = of(*tree.args[0]);
                return inner ? Known(over_time(*inner, tree.primes)) : Known();
            }
            case Kind::reciprocal: {
                const Known inner = of(*tree.args[0]);
                return inner ? Known(multiplied({}, *inner, -1)) : Known();
            }
            case Kind::product:
                return of_product(tree);
            case Kind::sum: {
                Terms terms;
                for (const TreePtr& arg : tree.args) add(terms, *arg);
                return common(terms);
            }
            case Kind::power:
                return of_power(tree);
            case Kind::call:
                return of_call(tree);
        }
        return {};
    }

    Known of_product(const Tree& tree) {
        Known result = Dimension{};
        for (const TreePtr& arg : tree.args) {
            const Known factor = of(*arg);
            result = result && factor ? Known(multiplied(*std::move(result), *factor)) : Known();
        }
        return result;
    }

    Known of_power(const Tree& tree) {
        const Known base = of(*tree.args[0]);
        of(*tree.args[1]);
        if (base && base->empty()) return base;
        if (!base || tree.args[1]->kind != Tree::Kind::number) return {};
        return multiplied({}, *base, std::stod(tree.args[1]->text));
    }

    Known of_call(const Tree& tree) {
        static const std::set<std::string> numbers{"sin",  "cos",  "tan",  "asin", "acos", "atan",
                                                   "sinh", "cosh", "tanh", "exp",  "log",  "sign"};
        std::vector<Known> args;
        for (const TreePtr& arg : tree.args) args.push_back(of(*arg));
        if (numbers.contains(tree.text)) return Dimension{};
        if ((tree.text == "abs" || tree.text == "norm") && args.size() == 1) return args[0];
        if ((tree.text == "dot" || tree.text == "cross") && args.size() == 2 && args[0] && args[1])
            return multiplied(*args[0], *args[1]);
        static const std::map<std::string, Dimension> geometry{{"pos", {{"m", 1}}},
                                                               {"vel", {{"m", 1}, {"s", -1}}},
                                                               {"acc", {{"m", 1}, {"s", -2}}},
                                                               {"omega", {{"s", -1}}},
                                                               {"alpha", {{"s", -2}}},
                                                               {"ex", {}},
                                                               {"ey", {}},
                                                               {"ez", {}}};
        if (const auto known = geometry.find(tree.text); has_metres_ && known != geometry.end())
            return known->second;
        if (tree.text == "sqrt" && args.size() == 1 && args[0]) return multiplied({}, *args[0], 0.5);
        return {};
    }

    static Dimension over_time(Dimension dimension, int times) {
        return multiplied(std::move(dimension), {{"s", 1}}, -times);
    }

    std::map<std::string, Dimension> names_;
    const std::string* text_ = nullptr;
    std::optional<std::string> wrong_;
    bool is_useful_ = false, has_metres_ = false;
};

/// "kg*m^2/s^2"; "s^-1" if no exponent is positive.
std::string text_of(const Dimension& dimension) {
    std::string above, below;
    for (const auto& [unit, exponent] : dimension) {
        const bool is_above = exponent > 0;
        std::string& part = is_above ? above : below;
        const double size = std::abs(exponent);
        part += (is_above ? part.empty() ? "" : "*" : "/") + unit + (size == 1 ? "" : fmt::format("^{}", size));
    }
    if (!above.empty()) return above + below;
    for (const auto& [unit, exponent] : dimension)
        above += (above.empty() ? "" : "*") + unit + fmt::format("^{}", exponent);
    return above;
}

}  // namespace

std::optional<std::string> si_unit_of(const Expression& expression, const Mechanism& m) {
    const Known found = Dimensions(m).of(expression);
    if (!found || found->empty()) return {};
    const std::set<std::string> base{"kg", "m", "s", "A", "K", "mol", "cd"};
    for (const auto& [unit, exponent] : *found)
        if (!base.contains(unit) || exponent != std::round(exponent)) return {};
    return text_of(*found);
}

std::optional<std::string> term_of_wrong_unit(const Claim& claim, const Mechanism& m) {
    return Dimensions(m).wrong_term(claim);
}

}  // namespace alembert
