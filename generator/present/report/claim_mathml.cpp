// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/claim_mathml.hpp"

#include "algebra/notation/lettering.hpp"
#include "present/report/html.hpp"
#include "present/report/written_mathml.hpp"
#include "scene/functions.hpp"

namespace alembert {

namespace {

using Node = Tree::Kind;
using Mark = Math::Kind;

MathPtr math_of(const Tree& tree);

MathPtr node(Math math, const Tree& at) {
    math.offset = static_cast<std::size_t>(std::max(at.offset, 0));
    math.length = static_cast<std::size_t>(at.length);
    return std::make_shared<const Math>(std::move(math));
}

/// x'(-) is the rate before an impact.
MathPtr letter_of(const Tree& name, const std::string& raised = "") {
    const Lettering letters = lettering(name.text);
    return node({.kind = Mark::letter,
                 .letter = {.base = letters.stem, .index = letters.index, .raised = raised},
                 .dots = name.primes},
                name);
}

MathPtr product_of(std::vector<MathPtr> factors, const Tree& at) {
    if (factors.empty()) return node({.kind = Mark::number, .text = "1"}, at);
    if (factors.size() == 1) return factors[0];
    return node({.kind = Mark::product, .args = std::move(factors)}, at);
}

/// 1/2*m*l^2 with the number in front, and a*b/c as one fraction.
MathPtr product_of(const Tree& product) {
    std::vector<MathPtr> front, above, below;
    std::size_t k = 0;
    const auto& args = product.args;
    if (args.size() > 2 && args[0]->kind == Node::number && args[1]->kind == Node::reciprocal &&
        args[1]->args[0]->kind == Node::number) {
        front.push_back(
            node({.kind = Mark::quotient, .args = {math_of(*args[0]), math_of(*args[1]->args[0])}}, product));
        k = 2;
    }
    for (; k < args.size(); ++k)
        if (args[k]->kind == Node::reciprocal)
            below.push_back(math_of(*args[k]->args[0]));
        else
            above.push_back(math_of(*args[k]));
    MathPtr rest = product_of(std::move(above), product);
    if (!below.empty())
        rest = node({.kind = Mark::quotient, .args = {rest, product_of(std::move(below), product)}}, product);
    if (front.empty()) return rest;
    if (rest->kind == Mark::product)
        front.insert(front.end(), rest->args.begin(), rest->args.end());
    else
        front.push_back(rest);
    return product_of(std::move(front), product);
}

MathPtr call_of(const Tree& call) {
    if (call.text == "(-)") return letter_of(*call.args[0], "−");
    Math math{.kind = Mark::call, .text = call.text};
    if (!is_reserved_function(call.text)) {
        const Lettering letters = lettering(call.text);
        math = {.kind = Mark::applied, .letter = {.base = letters.stem, .index = letters.index}};
    }
    for (const TreePtr& arg : call.args) math.args.push_back(math_of(*arg));
    return node(std::move(math), call);
}

MathPtr math_of(const Tree& tree) {
    Math math{.kind = Mark::sum};
    switch (tree.kind) {
        case Node::number:
            return node({.kind = Mark::number, .text = tree.text}, tree);
        case Node::name:
            return letter_of(tree);
        case Node::call:
            return call_of(tree);
        case Node::product:
            return product_of(tree);
        case Node::reciprocal:
            return node({.kind = Mark::quotient,
                         .args = {node({.kind = Mark::number, .text = "1"}, tree), math_of(*tree.args[0])}},
                        tree);
        case Node::sum:
            break;
        case Node::negate:
            math.kind = Mark::negate;
            break;
        case Node::power:
            math.kind = Mark::power;
            break;
        case Node::derivative:
            math.kind = Mark::rate;
            math.dots = tree.primes;
            break;
    }
    for (const TreePtr& arg : tree.args) math.args.push_back(math_of(*arg));
    return node(std::move(math), tree);
}

/// Where the term stands in the side, with or without its sign.
WrongPart part_of(const std::string& side, std::string term) {
    if (term.empty()) return {};
    std::size_t at = side.find(term);
    if (at == std::string::npos && (term[0] == '-' || term[0] == '+')) {
        term.erase(0, 1);
        at = side.find(term);
    }
    return at == std::string::npos ? WrongPart{} : WrongPart{at, term.size()};
}

}  // namespace

std::string typeset_equality(const Equality& equation, const std::string& wrong) {
    const WrongPart left = part_of(equation.lhs.text, wrong);
    const WrongPart right = left.length > 0 ? WrongPart{} : part_of(equation.rhs.text, wrong);
    return breakable({written_mathml(*math_of(*equation.lhs.tree), left), "<mo>=</mo>",
                      written_mathml(*math_of(*equation.rhs.tree), right)});
}

}  // namespace alembert
