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
    return holds_other(*claim.equation.lhs.tree, variables) || holds_other(*claim.equation.rhs.tree, variables);
}

}  // namespace alembert
