// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/closed_contacts.hpp"

#include <algorithm>

namespace alembert {

namespace {

bool contains(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

/// Whether the claim assumes lambda_NAME > 0.
bool presses(const Claim& claim, const std::string& contact) {
    return std::any_of(claim.where.begin(), claim.where.end(), [&](const Inequality& assumed) {
        const auto is_name = [](const Expression& e) { return e.tree && e.tree->kind == Tree::Kind::name; };
        const auto is_zero = [](const Expression& e) {
            return e.tree && e.tree->kind == Tree::Kind::number && e.tree->text == "0";
        };
        return is_name(assumed.greater) && is_zero(assumed.less) &&
               assumed.greater.tree->text == "lambda_" + contact && assumed.greater.tree->primes == 0;
    });
}

}  // namespace

Scene with_closed_contacts(Scene scene, const std::vector<std::string>& contacts) {
    for (const UnilateralRule& contact : scene.unilateral) {
        if (!contains(contacts, contact.name.text)) continue;
        std::vector<Diagnostic> none;
        ConstraintRule held{.name = contact.name,
                            .holonomic = true,
                            .equation = parse_equality("0 = 0", {}, none),
                            .multiplier = std::nullopt};
        held.equation.lhs = contact.gap;
        scene.constraints.push_back(std::move(held));
    }
    std::erase_if(scene.unilateral, [&](const UnilateralRule& u) { return contains(contacts, u.name.text); });
    for (Coordinate& q : scene.coordinates) q.initial_is_guess = q.rate_is_guess = true;
    return scene;
}

std::vector<std::string> closed_in(const Claim& claim, const Scene& scene) {
    std::vector<std::string> result;
    for (const UnilateralRule& contact : scene.unilateral) {
        const std::string& name = contact.name.text;
        const bool is_named =
            claim.at == Claim::At::closed && (claim.closed.empty() || contains(claim.closed, name));
        if (is_named || presses(claim, name)) result.push_back(name);
    }
    return result;
}

}  // namespace alembert
