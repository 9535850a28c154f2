// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/explanation.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "check/claim_tree.hpp"

namespace alembert {

namespace {

TreePtr tree_of(const std::string& text) {
    std::vector<Diagnostic> mistakes;
    return parse_expression(text, {}, mistakes).tree;
}

std::size_t terms_of(const Tree& side) {
    if (side.kind == Tree::Kind::number && side.text == "0") return 0;
    return side.kind == Tree::Kind::sum ? side.args.size() : 1;
}

int rates_in(const Tree& tree) {
    if (tree.kind == Tree::Kind::name) return tree.primes == 1 ? 1 : 0;
    if (tree.kind == Tree::Kind::power && tree.args[1]->text == "2") return 2 * rates_in(*tree.args[0]);
    int rates = 0;
    for (const TreePtr& arg : tree.args) rates += rates_in(*arg);
    return rates;
}

/// One term, or terms such as x'^2 + y'^2, which one forgets together when one differentiates x*x' + y*y'.
bool is_one_thought(const Tree& missing) {
    if (missing.kind != Tree::Kind::sum) return true;
    return std::all_of(missing.args.begin(), missing.args.end(),
                       [](const TreePtr& term) { return rates_in(*term) == 2; });
}

bool holds_one_of(const std::vector<std::string>& names, const Tree& tree) {
    const bool is_one =
        tree.kind == Tree::Kind::name && std::find(names.begin(), names.end(), tree.text) != names.end();
    return is_one || std::any_of(tree.args.begin(), tree.args.end(),
                                 [&](const TreePtr& arg) { return holds_one_of(names, *arg); });
}

/// Whether a term stands in a sum beside what cancels it: 1 − cos θ + cos θ.
bool cancels_itself(const Tree& tree) {
    if (tree.kind == Tree::Kind::sum) {
        std::set<std::string> above, below;
        for (const TreePtr& term : tree.args) {
            const auto [plain, is_negative] = without_sign(term);
            (is_negative ? below : above).insert(plain_text_of(*plain));
        }
        if (std::any_of(above.begin(), above.end(), [&](const std::string& term) { return below.contains(term); }))
            return true;
    }
    return std::any_of(tree.args.begin(), tree.args.end(),
                       [](const TreePtr& part) { return cancels_itself(*part); });
}

bool cancels_itself(const std::string& equation) {
    const std::size_t middle = equation.find('=');
    if (middle == std::string::npos) return false;
    for (const std::string& side : {equation.substr(0, middle), equation.substr(middle + 1)})
        if (const TreePtr tree = tree_of(side); tree && cancels_itself(*tree)) return true;
    return false;
}

}  // namespace

bool is_plausible(const Slip& slip, const LineClaim& claim, const OrderOf& order) {
    if (slip.repair.empty()) return false;
    constexpr std::size_t fewest_left = 3;
    if (slip.kind == "extra_term") {
        const TreePtr lhs = tree_of(claim.lhs), rhs = tree_of(claim.rhs);
        return lhs && rhs && terms_of(*lhs) + terms_of(*rhs) > fewest_left;
    }
    const TreePtr term = tree_of(slip.term);
    if (slip.kind == "missing_term")
        return !cancels_itself(slip.repair) &&
               (!term || (is_one_thought(*without_sign(term).first) &&
                          order(slip.term).value_or(0) <=
                              std::max(order(claim.lhs).value_or(2), order(claim.rhs).value_or(2))));
    // The derivative of a function of a coordinate, V' of V(θ), has no dot to lose.
    if (slip.kind == "lost_dot") return !term || term->kind != Tree::Kind::derivative;
    return true;
}

bool is_plausible_at_rest(const Slip& slip, const LineClaim& claim, const OrderOf& order,
                          const std::vector<std::string>& coordinates) {
    const TreePtr meant = slip.meant.empty() ? nullptr : tree_of(slip.meant);
    const bool is_of_place = meant && slip.kind == "factor" && holds_one_of(coordinates, *meant);
    return is_plausible(slip, claim, order) && !is_of_place;
}

}  // namespace alembert
