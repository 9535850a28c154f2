// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/printed_names.hpp"

#include <algorithm>

#include "algebra/notation/tree.hpp"

namespace alembert {

namespace {

bool is_printed_name(const std::string& name) {
    return name.size() > 1 && (name[0] == 'z' || name[0] == 'u') &&
           name.find_first_not_of("0123456789", 1) == std::string::npos;
}

bool holds_printed_name(const Tree& tree) {
    return (tree.kind == Tree::Kind::name && is_printed_name(tree.text)) ||
           std::any_of(tree.args.begin(), tree.args.end(),
                       [](const TreePtr& arg) { return holds_printed_name(*arg); });
}

}  // namespace

bool speaks_of_printed_names(const Scene& scene) {
    return std::any_of(scene.claims.begin(), scene.claims.end(), [](const Claim& claim) {
        return holds_printed_name(*claim.equation.lhs.tree) || holds_printed_name(*claim.equation.rhs.tree);
    });
}

PrintedNames printed_names(const Derivation& shown) {
    PrintedNames result;
    for (const auto* list : {&shown.speeds, &shown.definitions})
        for (const auto& [name, value] : *list)
            result.emplace_back(name.info.text(), Expression{.text = {}, .places = {}, .tree = tree_of(value)});
    return result;
}

}  // namespace alembert
