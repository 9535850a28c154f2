// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/printed_names.hpp"

#include <algorithm>
#include <functional>

#include "analysis/derive/derive.hpp"
#include "check/phrase_tree.hpp"
#include "scene/book_letters.hpp"

namespace alembert {

namespace {

bool is_printed_name(const std::string& name) {
    return name.size() > 1 && (name[0] == 'z' || name[0] == 'u') &&
           name.find_first_not_of("0123456789", 1) == std::string::npos;
}

using IsName = std::function<bool(const std::string&)>;

bool holds_one(const Tree& tree, const IsName& is_it) {
    return (tree.kind == Tree::Kind::name && is_it(tree.text)) ||
           std::any_of(tree.args.begin(), tree.args.end(),
                       [&](const TreePtr& arg) { return holds_one(*arg, is_it); });
}

bool hold_one(const Scene& scene, const IsName& is_it) {
    return std::any_of(scene.claims.begin(), scene.claims.end(), [&](const Claim& claim) {
        return holds_one(*claim.equation.lhs.tree, is_it) || holds_one(*claim.equation.rhs.tree, is_it);
    });
}

}  // namespace

bool speaks_of_printed_names(const Scene& scene) {
    return hold_one(scene, is_printed_name);
}

PrintedNames reaction_names(const Scene& scene) {
    PrintedNames result;
    if (scene.rolling.empty() && scene.joints.empty()) return result;
    std::vector<Diagnostic> mistakes;
    const std::vector<std::string> letters = reaction_letters(scene, declare(scene, mistakes));
    const auto is_reaction = [&](const std::string& name) {
        return std::find(letters.begin(), letters.end(), name) != letters.end();
    };
    if (letters.empty() || !hold_one(scene, is_reaction)) return result;
    const DerivedScene derived = derive(scene, {.reactions = true});
    for (const auto* list : {&derived.joint_loads, &derived.normal_reactions})
        for (const Statement& s : *list)
            if (const std::string name = s.letter + "_" + s.of; is_reaction(name))
                result.emplace_back(name, Expression{.text = {}, .places = {}, .tree = tree_of(s.value)});
    return result;
}

PrintedNames printed_names(const Derivation& shown) {
    PrintedNames result;
    for (const auto* list : {&shown.speeds, &shown.definitions})
        for (const auto& [name, value] : *list)
            result.emplace_back(name.info.text(), Expression{.text = {}, .places = {}, .tree = tree_of(value)});
    return result;
}

}  // namespace alembert
