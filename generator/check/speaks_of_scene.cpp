// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/speaks_of_scene.hpp"

#include <algorithm>
#include <set>

#include "scene/functions.hpp"

namespace alembert {

namespace {

/// The names that are variables, of which an identity says nothing.
std::set<std::string> names_of_variables(const Mechanism& m) {
    std::set<std::string> result{"t", "pi"};
    for (const GiNaC::symbol& q : m.q) result.insert(q.get_name());
    for (const Mechanism::Parameter& parameter : m.parameters)
        if (parameter.independent) result.insert(parameter.symbol.get_name());
    for (const Mechanism::Constraint& c : m.constraints) result.insert(c.multiplier.get_name());
    for (const Mechanism::Constraint* c : m.undetermined()) result.insert(c->multiplier.get_name());
    return result;
}

bool holds_parameter(const Tree& tree, const Mechanism& m) {
    const auto is_it = [&](const Mechanism::Parameter& parameter) {
        return parameter.symbol.get_name() == tree.text;
    };
    return (tree.kind == Tree::Kind::name && std::any_of(m.parameters.begin(), m.parameters.end(), is_it)) ||
           std::any_of(tree.args.begin(), tree.args.end(),
                       [&](const TreePtr& arg) { return holds_parameter(*arg, m); });
}

/// |r x| = r |x| says that the scene's r is positive.
bool asks_sign_of_parameter(const Tree& tree, const Mechanism& m) {
    const bool asks = tree.kind == Tree::Kind::call &&
                      (tree.text == "abs" || tree.text == "sign" || tree.text == "sqrt" || tree.text == "norm");
    return (asks && holds_parameter(tree, m)) ||
           std::any_of(tree.args.begin(), tree.args.end(),
                       [&](const TreePtr& arg) { return asks_sign_of_parameter(*arg, m); });
}

bool holds_other(const Tree& tree, const std::set<std::string>& variables) {
    if (tree.kind == Tree::Kind::name && !variables.contains(tree.text)) return true;
    if (tree.kind == Tree::Kind::call) {
        const Function* const function = find_function(tree.text);
        if (function == nullptr || function->takes != Function::Takes::scalars) return true;
    }
    return std::any_of(tree.args.begin(), tree.args.end(),
                       [&](const TreePtr& arg) { return holds_other(*arg, variables); });
}

}  // namespace

bool speaks_of_scene(const Claim& claim, const Mechanism& mechanism) {
    const std::set<std::string> variables = names_of_variables(mechanism);
    const auto speaks = [&](const Expression& side) {
        return holds_other(*side.tree, variables) || asks_sign_of_parameter(*side.tree, mechanism);
    };
    return speaks(claim.equation.lhs) || speaks(claim.equation.rhs);
}

}  // namespace alembert
