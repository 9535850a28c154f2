// SPDX-License-Identifier: GPL-2.0-or-later
// Values as C++: a value with a name is written by its name, a value in place with the brackets that it needs.
#include <fmt/format.h>

#include <algorithm>

#include "codegen/emit/dialect.hpp"
#include "codegen/emit/expression.hpp"
#include "codegen/emit/numbers.hpp"
#include "codegen/emit/table_text.hpp"
#include "codegen/emit/writer.hpp"

namespace alembert {

/// The statement for the text that was just made, with the names and operations in it.
CodeStatement Writer::finished(std::vector<std::string> names, std::string text) {
    CodeStatement result{
        .names = std::move(names), .uses = std::move(reading_), .cost = operations_, .text = std::move(text)};
    reading_.clear();
    operations_ = 0;
    return result;
}

CodeStatement Writer::assigned(const std::string& array, const std::string& to, int node) {
    const std::string value = text(node, additive);
    reading_.insert(array);
    return finished({}, dialect_of(language_).assigned(to, value));
}

CodeStatement Writer::evaluated(int node) {
    return finished({}, text(node, additive));
}

CodeStatement Writer::statement(int id) {
    const Node& node = program_[id];
    if (node.op == Op::sin || node.op == Op::cos) return trigonometric_statement(id);
    if (const auto negative = wanted_negatives_.find(id); negative != wanted_negatives_.end()) {
        const bool is_sum = node.op == Op::sum && !node.is_scaled();
        const std::string value = is_sum            ? sum_text(id, true)
                                  : is_negative(id) ? unsigned_text(id, additive)
                                                    : "-" + text(id, multiplicative);
        const std::string name = names_.fresh(negative->second);
        negatives_[id] = name;
        return finished({name}, declared(name, value));
    }
    const std::string value = text(id, additive);
    const std::string& wish = wanted_[id];
    const auto promised = promised_.find(id);
    const std::string name = promised != promised_.end() ? promised->second
                             : !wish.empty()             ? names_.fresh(wish)
                                                         : names_.numbered(sines_.contains(id) ? "phi" : "z");
    named_[id] = name;
    return finished({name}, declared(name, value));
}

std::string Writer::declared(const std::string& name, const std::string& value) const {
    return dialect_of(language_).declared(name, value);
}

std::string Writer::text(int id, int precedence) {
    if (const auto known = named_.find(id); known != named_.end()) {
        reading_.insert(known->second);
        return known->second;
    }
    const Node& node = program_[id];
    std::string result;
    int own = primary;
    if (is_negative(id)) {
        own = additive;
        result = "-" + unsigned_text(id, multiplicative);
    } else if (node.op == Op::number) {
        result = number_text(node.number, language_);
    } else if (node.op == Op::pi) {
        result = dialect_of(language_).pi;
    } else if (node.op == Op::sum) {
        own = node.is_scaled() && !cln::minusp(node.coefficients[0]) ? multiplicative : additive;
        result = sum_text(id, false);
    } else if (node.op == Op::product) {
        own = multiplicative;
        result = product_text(id);
    } else if (node.op == Op::unspecified) {
        ++operations_;
        result = table_call(program_, node) + "(";
        const Program::TableCall call = program_.table_call(node);
        std::vector<int> args(call.argument.begin(), call.argument.begin() + static_cast<long>(call.arguments));
        if (call.is_held)
            args.insert(args.end(), call.number.begin(), call.number.begin() + static_cast<long>(call.arguments));
        for (const int arg : args) result += (result.ends_with('(') ? "" : ", ") + text(arg, additive);
        result += ")";
    } else {
        ++operations_;
        result = dialect_of(language_).call(node.op, text(node.args[0], additive));
        for (std::size_t k = 1; k < node.args.size(); ++k) result += ", " + text(node.args[k], additive);
        result += ")";
    }
    return own < precedence ? "(" + result + ")" : result;
}

/// Whether the negative of a node has a name, or the node is a product in place with an odd number of such
/// factors.
bool Writer::is_negative(int id) const {
    if (named_.contains(id)) return false;
    if (negatives_.contains(id)) return true;
    const Node& node = program_[id];
    bool negative = false;
    for (std::size_t k = 0; node.op == Op::product && k < node.args.size(); ++k)
        negative = negative != (node.exponents[k] % 2 != 0 && is_negative(node.args[k]));
    return negative;
}

/// The text without the sign of a negative node.
std::string Writer::unsigned_text(int id, int precedence) {
    if (!is_negative(id)) return text(id, precedence);
    if (const auto negative = negatives_.find(id); negative != negatives_.end()) {
        reading_.insert(negative->second);
        return negative->second;
    }
    return multiplicative < precedence ? "(" + product_text(id) + ")" : product_text(id);
}

std::string Writer::sum_text(int id, bool negated) {
    const Node& node = program_[id];
    std::vector<Piece> pieces;
    const auto has_name = [&](int arg) { return named_.contains(arg) || negatives_.contains(arg); };
    for (const std::size_t k : ready_->order(id)) {
        const Rational& c = node.coefficients[k];
        const bool negative = (cln::minusp(c) != negated) != is_negative(node.args[k]);
        const Rational size = cln::abs(c);
        const Node& arg = program_[node.args[k]];
        if (cln::equal(size, 1)) {
            const bool is_sum = arg.op == Op::sum && !arg.is_scaled() && !has_name(node.args[k]);
            // −1·(a − b) reads better as b − a.
            if (negative && is_sum && node.args.size() == 1 && cln::zerop(node.number))
                return sum_text(node.args[k], true);
            pieces.push_back(
                {negative, unsigned_text(node.args[k], is_sum || negative ? multiplicative : additive)});
        } else {
            pieces.push_back(
                {negative, number_text(size, language_) + " * " + unsigned_text(node.args[k], multiplicative)});
            ++operations_;
        }
    }
    if (!cln::zerop(node.number))
        pieces.insert(ready_->is_ordered() ? pieces.begin() : pieces.end(),
                      {cln::minusp(node.number) != negated, number_text(cln::abs(node.number), language_)});
    operations_ += static_cast<int>(pieces.size()) - 1;
    // A positive term first, if there is one: b − a, not −a + b. But a late term stays last.
    const auto positive = std::find_if(pieces.begin(), pieces.end(), [](const Piece& p) { return !p.negative; });
    const bool late =
        ready_->is_ordered() && pieces.size() > 2 && positive != pieces.end() && positive + 1 == pieces.end();
    return (late ? in_order(pieces) : joined(std::move(pieces))).text;
}

std::string Writer::product_text(int sought) {
    const Node& node = program_[sought];
    std::string numerator, denominator;
    int divisors = 0;
    for (const std::size_t k : ready_->order(sought)) {
        const int id = node.args[k];
        const Node& arg = program_[id];
        if (node.exponents[k] < 0 || (arg.is_reciprocal() && !named_.contains(id))) {
            const int below = node.exponents[k] < 0 ? id : arg.args[0];
            for (int e = 0; e < std::abs(node.exponents[k]); ++e, ++operations_, ++divisors)
                denominator += (denominator.empty() ? "" : " * ") + unsigned_text(below, primary);
            continue;
        }
        for (int e = 0; e < node.exponents[k]; ++e) {
            if (!numerator.empty()) numerator += " * ", ++operations_;
            numerator += unsigned_text(id, multiplicative);
        }
    }
    if (numerator.empty()) numerator = literal("1", language_);
    if (divisors == 0) return numerator;
    // One division by a product takes half the time of two.
    return numerator + " / " + (divisors == 1 ? denominator : "(" + denominator + ")");
}

}  // namespace alembert
