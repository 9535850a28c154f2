// SPDX-License-Identifier: GPL-2.0-or-later
// A dimension is a product of powers of base units; all terms of a sum have the same dimension (Bridgman,
// Dimensional Analysis (1922), chapter 2).
#include "scene/dimensions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

bool consists_of_numbers(const Tree& tree) {
    using Kind = Tree::Kind;
    if (tree.kind == Kind::name || tree.kind == Kind::call || !tree.unit.empty()) return false;
    return std::all_of(tree.args.begin(), tree.args.end(),
                       [](const TreePtr& arg) { return consists_of_numbers(*arg); });
}

/// What a whole number up to this size is in a formula: a coefficient, as in 1/2 or 3*x^2.
constexpr double most_pure = 12;

const std::set<std::string>& functions_of_numbers() {
    static const std::set<std::string> names{"sin",  "cos",  "tan",  "asin", "acos", "atan",
                                             "sinh", "cosh", "tanh", "exp",  "log"};
    return names;
}

const std::map<std::string, Dimension>& dimensions_of_geometry() {
    static const std::map<std::string, Dimension> table{{"pos", {{"m", 1}}},
                                                        {"vel", {{"m", 1}, {"s", -1}}},
                                                        {"acc", {{"m", 1}, {"s", -2}}},
                                                        {"omega", {{"s", -1}}},
                                                        {"alpha", {{"s", -2}}},
                                                        {"ex", {}},
                                                        {"ey", {}},
                                                        {"ez", {}}};
    return table;
}

}  // namespace

std::optional<Dimension> dimension_of_unit(const std::string& unit) {
    if (unit.empty()) return {};
    const std::optional<UnitMeaning> meaning = meaning_of_unit(unit);
    if (!meaning) return {};
    Dimension result = meaning->exponents;
    result.erase("rad");
    return result;
}

Dimension over_time(Dimension dimension, int times) {
    return multiplied(std::move(dimension), {{"s", 1}}, -times);
}

std::string text_of(const Dimension& dimension) {
    if (dimension.empty()) return "1";
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

Dimensions::Dimensions(const Scene& scene, Numbers numbers) : numbers_(numbers), functions_(scene.functions) {
    for (const Parameter& p : scene.parameters) know(p.name.text, p.unit);
    for (const Coordinate& q : scene.coordinates) know(q.name.text, q.unit);
    for (const Speed& u : scene.speeds) know(u.name.text, u.unit);
    for (const FirstOrderState& z : scene.states) know(z.name.text, z.unit);
    for (const Input& f : scene.inputs) know(f.name.text, f.unit);
    is_useful_ = std::any_of(names_.begin(), names_.end(), [](const auto& entry) {
        return entry.second != Dimension{} && entry.second != Dimension{{"s", 1}};
    });
    names_.emplace("t", Dimension{{"s", 1}});
    names_.emplace("pi", Dimension{});
    for (const Definition& d : scene.definitions)
        if (!d.has_components) definitions_.emplace(d.name.text, &d.value);
    for (const Speed& u : scene.speeds)
        if (u.unit.empty()) definitions_.emplace(u.name.text, &u.form);
}

void Dimensions::know(const std::string& name, const std::string& unit) {
    if (const Known dimension = dimension_of_unit(unit)) names_[name] = *dimension;
}

std::optional<Dimension> Dimensions::of(const Expression& expression) {
    if (!expression.tree) return {};
    const Expression* const before = std::exchange(current_, &expression);
    const Known result = of(*expression.tree);
    current_ = before;
    return result;
}

void Dimensions::hold(const Equality& equation) {
    std::vector<Term> terms;
    for (const Expression* side : {&equation.lhs, &equation.rhs}) {
        if (!side->tree) continue;
        current_ = side;
        if (side->tree->kind == Tree::Kind::sum)
            for (const TreePtr& arg : side->tree->args) add(terms, *arg);
        else
            add(terms, *side->tree);
    }
    common(terms);
    current_ = nullptr;
}

std::string Dimensions::text(const Tree& tree) const {
    std::string result =
        current_->text.substr(static_cast<std::size_t>(tree.offset), static_cast<std::size_t>(tree.length));
    while (!result.empty() && result.back() == ' ') result.pop_back();
    return result;
}

void Dimensions::add(std::vector<Term>& terms, const Tree& tree) {
    const Tree& inner = tree.kind == Tree::Kind::negate ? *tree.args[0] : tree;
    Known dimension = of(tree);
    // A number alone may be 0, and in a scene anything: x − 5 is as far from 5 as x is.
    const bool is_number = consists_of_numbers(inner);
    const bool is_zero =
        inner.kind == Tree::Kind::number && inner.text.find_first_not_of("0.") == std::string::npos;
    if (is_zero || (is_number && numbers_ == Numbers::any)) dimension = {};
    terms.push_back({text(inner), current_->place(inner.offset), std::move(dimension)});
}

/// The dimension of most terms; a term with another dimension is wrong.
std::optional<Dimension> Dimensions::common(const std::vector<Term>& terms, const std::string* in) {
    std::map<Dimension, int> votes;
    for (const Term& term : terms)
        if (term.dimension) ++votes[*term.dimension];
    const Term* most = nullptr;
    for (const Term& term : terms)
        if (term.dimension && (most == nullptr || votes[*term.dimension] > votes[*most->dimension])) most = &term;
    if (most == nullptr) return {};
    for (const Term& term : terms) {
        if (!term.dimension || *term.dimension == *most->dimension) continue;
        if (!wrong_) wrong_ = term.text;
        contradictions_.push_back(
            {term.place,
             in == nullptr
                 ? say("terms of different dimensions are added: {} is in {}, {} in {}", in_quotes(term.text),
                       text_of(*term.dimension), in_quotes(most->text), text_of(*most->dimension))
                 : say("the arguments of {} have different dimensions: {} is in {}, {} in {}", *in,
                       in_quotes(term.text), text_of(*term.dimension), in_quotes(most->text),
                       text_of(*most->dimension)),
             Severity::warning, "unit_mismatch"});
        break;
    }
    return most->dimension;
}

std::optional<Dimension> Dimensions::of(const Tree& tree) {
    using Kind = Tree::Kind;
    switch (tree.kind) {
        case Kind::number:
            return of_number(tree);
        case Kind::name:
            return of_name(tree);
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
            return tree.unit.empty() ? of_product(tree) : dimension_of_unit(tree.unit);
        case Kind::sum: {
            std::vector<Term> terms;
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

std::optional<Dimension> Dimensions::of_number(const Tree& tree) const {
    if (numbers_ == Numbers::pure) return Dimension{};
    const double value = value_of_digits(tree.text);
    const bool is_pure = (value == std::floor(value) && value <= most_pure) || value == 0.5 || value == 0.25;
    return is_pure ? Known(Dimension{}) : Known();
}

std::optional<Dimension> Dimensions::of_name(const Tree& tree) {
    if (const auto found = names_.find(tree.text); found != names_.end())
        return over_time(found->second, tree.primes);
    const auto defined = definitions_.find(tree.text);
    if (defined == definitions_.end()) return {};
    const Expression* const value = defined->second;
    definitions_.erase(defined);  // its contradictions are told once, and a circle ends
    const Known dimension = of(*value);
    if (!dimension) return {};
    names_[tree.text] = *dimension;
    return over_time(*dimension, tree.primes);
}

std::optional<Dimension> Dimensions::of_product(const Tree& tree) {
    Known result = Dimension{};
    for (const TreePtr& arg : tree.args) {
        const Known factor = of(*arg);
        result = result && factor ? Known(multiplied(*std::move(result), *factor)) : Known();
    }
    return result;
}

std::optional<Dimension> Dimensions::of_power(const Tree& tree) {
    const Known base = of(*tree.args[0]);
    if (const Known exponent = of(*tree.args[1]); exponent && !exponent->empty())
        contradictions_.push_back(
            {current_->place(tree.args[1]->offset),
             say("an exponent is a number; {} is in {}", in_quotes(text(*tree.args[1])), text_of(*exponent)),
             Severity::warning, "unit_mismatch"});
    if (base && base->empty()) return base;
    if (!base || tree.args[1]->kind != Tree::Kind::number) return {};
    return multiplied({}, *base, value_of_digits(tree.args[1]->text));
}

std::optional<Dimension> Dimensions::of_call(const Tree& tree) {
    if (const auto known = dimensions_of_geometry().find(tree.text); known != dimensions_of_geometry().end())
        return known->second;
    if (tree.text == "min" || tree.text == "max" || tree.text == "atan2") {
        std::vector<Term> terms;
        for (const TreePtr& arg : tree.args) add(terms, *arg);
        const Known all = common(terms, &tree.text);
        return tree.text == "atan2" ? Known(Dimension{}) : all;
    }
    std::vector<Known> args;
    for (const TreePtr& arg : tree.args) args.push_back(of(*arg));
    if (const UnspecifiedFunction* const table = table_named(tree.text)) return of_table(*table, tree, args);
    if (tree.text == "sign") return Dimension{};
    if (functions_of_numbers().contains(tree.text)) {
        if (args.size() == 1 && args[0] && !args[0]->empty())
            contradictions_.push_back({current_->place(tree.offset),
                                       say("the argument of {} is a number or an angle; {} is in {}", tree.text,
                                           in_quotes(text(*tree.args[0])), text_of(*args[0])),
                                       Severity::warning, "unit_mismatch"});
        return Dimension{};
    }
    if ((tree.text == "abs" || tree.text == "norm") && args.size() == 1) return args[0];
    if ((tree.text == "dot" || tree.text == "cross") && args.size() == 2 && args[0] && args[1])
        return multiplied(*args[0], *args[1]);
    if (tree.text == "sqrt" && args.size() == 1 && args[0]) return multiplied({}, *args[0], 0.5);
    return {};
}

const UnspecifiedFunction* Dimensions::table_named(const std::string& name) const {
    for (const UnspecifiedFunction& function : functions_)
        if (function.table && function.name.text == name) return &function;
    return nullptr;
}

std::optional<Dimension> Dimensions::of_table(const UnspecifiedFunction& table, const Tree& tree,
                                              const std::vector<Known>& args) {
    for (std::size_t k = 0; k < std::min(args.size(), table.units.size()); ++k) {
        const Known wanted = dimension_of_unit(table.units[k]);
        if (wanted && args[k] && *wanted != *args[k])
            contradictions_.push_back({current_->place(tree.args[k]->offset),
                                       say("the argument of the table {} is in {}; {} is in {}", tree.text,
                                           text_of(*wanted), in_quotes(text(*tree.args[k])), text_of(*args[k])),
                                       Severity::warning, "unit_mismatch"});
    }
    return dimension_of_unit(table.unit);
}

std::optional<Dimension> Dimensions::of_name(const std::string& name) {
    return of_name(Tree{.kind = Tree::Kind::name, .text = name});
}

bool Dimensions::learn(const std::string& name, const Dimension& dimension) {
    return names_.emplace(name, dimension).second;
}

bool Dimensions::learn(const Expression& expression, const std::optional<Dimension>& wanted) {
    const Expression* const before = std::exchange(current_, &expression);
    const bool is_new = learn(*expression.tree, wanted);
    current_ = before;
    return is_new;
}

/// Of a product in which all factors but one are known, that one.
bool Dimensions::learn_factor(const Tree& product, const Dimension& wanted) {
    Dimension rest = wanted;
    const Tree* unknown = nullptr;
    for (const TreePtr& arg : product.args) {
        if (const Known factor = of(*arg)) {
            rest = multiplied(std::move(rest), *factor, -1);
            continue;
        }
        if (unknown != nullptr) return false;
        unknown = arg.get();
    }
    return unknown != nullptr && learn(*unknown, rest);
}

bool Dimensions::learn(const Tree& tree, const Known& wanted) {
    using Kind = Tree::Kind;
    bool is_new = false;
    const auto learn_all = [&](const Known& dimension) {
        for (const TreePtr& arg : tree.args) is_new = learn(*arg, dimension) || is_new;
    };
    switch (tree.kind) {
        case Kind::number:
            return false;
        case Kind::name:
            return wanted && !of(tree) && learn(tree.text, over_time(*wanted, -tree.primes));
        case Kind::negate:
            return learn(*tree.args[0], wanted);
        case Kind::derivative:
            return learn(*tree.args[0], wanted ? Known(over_time(*wanted, -tree.primes)) : Known());
        case Kind::reciprocal:
            return learn(*tree.args[0], wanted ? Known(multiplied({}, *wanted, -1)) : Known());
        case Kind::product:
            if (!tree.unit.empty()) return false;
            learn_all({});
            return (wanted && learn_factor(tree, *wanted)) || is_new;
        case Kind::sum: {
            const Known common = wanted ? wanted : of(tree);
            learn_all(common);
            return is_new;
        }
        case Kind::power: {
            const Tree& exponent = *tree.args[1];
            const bool is_known = wanted && exponent.kind == Kind::number && value_of_digits(exponent.text) != 0;
            return learn(*tree.args[0],
                         is_known ? Known(multiplied({}, *wanted, 1 / value_of_digits(exponent.text))) : Known());
        }
        case Kind::call:
            if (functions_of_numbers().contains(tree.text)) {
                learn_all(Dimension{});
            } else if (tree.text == "abs") {
                learn_all(wanted);
            } else if (tree.text == "sqrt") {
                learn_all(wanted ? Known(multiplied({}, *wanted, 2)) : Known());
            }
            return is_new;
    }
    return is_new;
}

std::optional<std::string> si_unit_of(const Expression& expression, const Scene& scene) {
    Dimensions dimensions(scene, Dimensions::Numbers::pure);
    const std::optional<Dimension> found = dimensions.of(expression);
    if (!found || found->empty() || dimensions.wrong_term()) return {};
    const std::set<std::string> base{"kg", "m", "s", "A", "K", "mol", "cd"};
    for (const auto& [unit, exponent] : *found)
        if (!base.contains(unit) || exponent != std::round(exponent)) return {};
    return text_of(*found);
}

std::optional<std::string> term_of_wrong_unit(const Claim& claim, const Scene& scene) {
    Dimensions dimensions(scene, Dimensions::Numbers::pure);
    if (!dimensions.are_useful()) return {};
    dimensions.hold(claim.equation);
    return dimensions.wrong_term();
}

}  // namespace alembert
