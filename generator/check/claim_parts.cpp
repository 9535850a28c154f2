// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/claim_parts.hpp"

#include <algorithm>

#include "scene/functions.hpp"

namespace alembert {

namespace {

/// pos(P), ex(B) …
bool is_of_geometry(const Tree& tree) {
    const Function* const function = tree.kind == Tree::Kind::call ? find_function(tree.text) : nullptr;
    return function && (function->takes == Function::Takes::points || function->takes == Function::Takes::frames);
}

}  // namespace

ClaimParts::ClaimParts(const Claim& claim) : sides_{claim.equation.lhs.text, claim.equation.rhs.text} {
    for (const bool left : {true, false}) {
        const Tree& tree = left ? *claim.equation.lhs.tree : *claim.equation.rhs.tree;
        if (tree.kind == Tree::Kind::sum)
            for (std::size_t k = 0; k < tree.args.size(); ++k)
                collect_summand(*tree.args[k], left, k == 0, std::nullopt, false);
        else
            collect_summand(tree, left, true, std::nullopt, false);
    }
}

void ClaimParts::collect_summand(const Tree& tree, bool left, bool first, const std::optional<TextStretch>& whole,
                                 bool in_angle) {
    const Tree& inner = tree.kind == Tree::Kind::negate ? *tree.args[0] : tree;
    if (tree.kind == Tree::Kind::number && trimmed(stretch(tree, left)) == "0") return;
    const TextStretch at = stretch(tree, left);
    summands_.push_back(
        {at, first, tree.kind == Tree::Kind::negate, inner.kind == Tree::Kind::sum, whole.value_or(at), in_angle});
    collect(tree, left, whole.value_or(at), at, in_angle);
}

void ClaimParts::collect(const Tree& tree, bool left, const TextStretch& whole, const TextStretch& term,
                         bool in_angle, bool exponent) {
    if (tree.kind == Tree::Kind::name || tree.kind == Tree::Kind::number || tree.kind == Tree::Kind::power ||
        tree.kind == Tree::Kind::call)
        leaves_.push_back({&tree, stretch(tree, left), whole, term, in_angle, exponent});
    if (is_of_geometry(tree)) return;  // its names are those of points and frames
    const bool turns =
        tree.kind == Tree::Kind::call && (tree.text == "sin" || tree.text == "cos" || tree.text == "tan");
    for (std::size_t k = 0; k < tree.args.size(); ++k)
        if (tree.kind == Tree::Kind::sum)
            collect_summand(*tree.args[k], left, k == 0, whole, in_angle);
        else
            collect(*tree.args[k], left, whole,
                    tree.kind == Tree::Kind::derivative ? stretch(*tree.args[k], left) : term, in_angle || turns,
                    tree.kind == Tree::Kind::power && k == 1);
}

std::string ClaimParts::slice(const TextStretch& s) const {
    return side(s.left).substr(static_cast<std::size_t>(s.offset), static_cast<std::size_t>(s.length));
}
std::string ClaimParts::trimmed(const TextStretch& s) const {
    std::string text = slice(s);
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

std::optional<TextStretch> ClaimParts::operator_before(const ClaimSummand& s) const {
    if (s.negated) return TextStretch{s.at.left, s.at.offset, 1};
    int at = s.at.offset - 1;
    while (at >= 0 && (side(s.at.left)[static_cast<std::size_t>(at)] == ' ' ||
                       side(s.at.left)[static_cast<std::size_t>(at)] == '('))
        --at;
    if (at < 0 || side(s.at.left)[static_cast<std::size_t>(at)] != '+') return std::nullopt;
    return TextStretch{s.at.left, at, 1};
}

std::optional<TextStretch> ClaimParts::with_its_star(const TextStretch& factor) const {
    const std::string& text = side(factor.left);
    const auto begin = static_cast<std::size_t>(factor.offset),
               end = begin + static_cast<std::size_t>(factor.length);
    const std::size_t before = text.find_last_not_of(' ', begin - 1), after = text.find_first_not_of(' ', end);
    if (begin > 0 && before != std::string::npos && text[before] == '*')
        return TextStretch{factor.left, static_cast<int>(before), static_cast<int>(end - before)};
    const bool divides = begin > 0 && before != std::string::npos && text[before] == '/';
    if (!divides && after != std::string::npos && text[after] == '*')
        return TextStretch{factor.left, factor.offset, static_cast<int>(after + 1 - begin)};
    return std::nullopt;
}

std::string ClaimParts::scaled(const ClaimSummand& s, const std::string& operation, const std::string& by) const {
    const std::string inside = s.negated ? slice({s.at.left, s.at.offset + 1, s.at.length - 1}) : slice(s.at);
    return (s.negated ? "-" : "") + std::string("(") + inside + ")" + operation + by;
}

bool ClaimParts::is_only_one(const ClaimSummand& s) const {
    return s.whole.offset == s.at.offset && s.whole.length == s.at.length &&
           std::none_of(summands_.begin(), summands_.end(), [&](const ClaimSummand& other) {
               return other.at.left != s.at.left || other.at.offset < s.at.offset ||
                      other.at.offset >= s.at.offset + s.at.length;
           });
}

bool ClaimParts::is_alone_on_its_side(const ClaimSummand& s) const {
    return std::count_if(summands_.begin(), summands_.end(), [&](const ClaimSummand& other) {
               return other.whole.left == s.whole.left && other.whole.offset == other.at.offset;
           }) == 1;
}

}  // namespace alembert
