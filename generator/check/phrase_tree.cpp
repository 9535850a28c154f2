// SPDX-License-Identifier: GPL-2.0-or-later
// Products and quotients are flat in trees: a·(b/c) is the product of a, b and 1/c. A sign belongs to the first
// factor of what follows it, as it does in text.
#include "check/phrase_tree.hpp"

#include <cln/integer.h>
#include <cln/integer_io.h>

#include <sstream>

#include "algebra/notation/text.hpp"
#include "algebra/notation/unspecified.hpp"
#include "check/claim_tree.hpp"

namespace alembert {

namespace {

using Form = Phrase::Kind;
using Kind = Tree::Kind;

bool stands_in_parentheses(const Phrase& phrase) {
    return phrase.kind == Form::sum || phrase.kind == Form::negative;
}

TreePtr number(const cln::cl_I& value) {
    std::ostringstream stream;
    stream << value;
    return made(Kind::number, {}, stream.str());
}

TreePtr product(std::vector<TreePtr> factors) {
    return factors.size() == 1 ? factors[0] : made(Kind::product, std::move(factors));
}

/// The factors of a phrase that stands in a product.
std::vector<TreePtr> factors_of(const Phrase& phrase) {
    std::vector<TreePtr> result;
    switch (phrase.kind) {
        case Form::number:
            if (const std::string plain = digits(phrase); !plain.empty()) return {made(Kind::number, {}, plain)};
            return {number(cln::numerator(phrase.value)),
                    made(Kind::reciprocal, {number(cln::denominator(phrase.value))})};
        case Form::product:
            for (const Phrase& factor : phrase.args)
                for (TreePtr& part : factors_of(factor)) result.push_back(std::move(part));
            return result;
        case Form::quotient:
            result = factors_of(phrase.args[0]);
            result.push_back(made(Kind::reciprocal, {tree_of(phrase.args[1])}));
            return result;
        default:
            return {tree_of(phrase)};
    }
}

TreePtr negative(const Phrase& of) {
    if (stands_in_parentheses(of)) return made(Kind::negate, {tree_of(of)});
    std::vector<TreePtr> factors = factors_of(of);
    factors[0] = made(Kind::negate, {factors[0]});
    return product(std::move(factors));
}

TreePtr sum(const Phrase& phrase) {
    std::vector<TreePtr> terms;
    for (const Phrase& term : phrase.args)
        if (term.kind == Form::negative && !terms.empty())
            terms.push_back(made(Kind::negate, {tree_of(term.args[0])}));
        else
            terms.push_back(tree_of(term));
    return terms.size() == 1 ? terms[0] : made(Kind::sum, std::move(terms));
}

TreePtr unspecified(const UnspecifiedPhrase& call) {
    std::vector<TreePtr> args;
    for (const Phrase* const arg : call.arguments) args.push_back(tree_of(*arg));
    TreePtr value = made(Kind::call, args, call.function->info.name);
    if (call.order == 0) return value;
    std::vector<TreePtr> differentiated{value};
    for (std::size_t k = 0; k < call.orders.size(); ++k) {
        if (call.orders[k] == 0) continue;
        const bool by_itself = call.is_by_itself(k);
        differentiated.push_back(by_itself ? args[k] : number(k + 1));
        if (call.orders[k] > 1 || !by_itself) differentiated.push_back(number(call.orders[k]));
    }
    return made(Kind::call, std::move(differentiated), "diff");
}

TreePtr symbol(const Phrase& phrase) {
    const TreePtr name = made(Kind::name, {}, phrase.info.name, phrase.info.order);
    return phrase.info.before ? made(Kind::call, {name}, "(-)") : name;
}

TreePtr call(const Phrase& phrase) {
    if (const auto of = unspecified_phrase(phrase)) return unspecified(*of);
    std::vector<TreePtr> args;
    for (const Phrase& arg : phrase.args) args.push_back(tree_of(arg));
    return made(Kind::call, std::move(args), language_name(phrase.name));
}

}  // namespace

TreePtr tree_of(const Phrase& phrase) {
    switch (phrase.kind) {
        case Form::number:
        case Form::product:
        case Form::quotient:
            return product(factors_of(phrase));
        case Form::symbol:
            return symbol(phrase);
        case Form::sum:
            return sum(phrase);
        case Form::power:
            return made(Kind::power, {tree_of(phrase.args[0]), tree_of(phrase.args[1])});
        case Form::call:
            return call(phrase);
        case Form::negative:
            return negative(phrase.args[0]);
    }
    return nullptr;
}

}  // namespace alembert
