// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/product_tree.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace alembert {

using Kind = Tree::Kind;

namespace {

std::optional<long> whole_number(const Tree& tree) {
    constexpr std::size_t most_digits = 9;
    if (tree.kind != Kind::number || tree.text.size() > most_digits ||
        tree.text.find_first_not_of("0123456789") != std::string::npos)
        return std::nullopt;
    return std::stol(tree.text);
}

/// The base and the whole exponent of a factor.
std::pair<TreePtr, int> power_of(const TreePtr& factor) {
    if (factor->kind == Kind::power)
        if (const auto exponent = whole_number(*factor->args[1]); exponent && *exponent < 64)
            return {factor->args[0], static_cast<int>(*exponent)};
    return {factor, 1};
}

TreePtr raised(const TreePtr& base, int exponent) {
    return exponent == 1 ? base : made(Kind::power, {base, number_tree(exponent)});
}

}  // namespace

ProductTree::ProductTree(const TreePtr& term, const std::function<bool(const Tree&)>& is_steady)
    : is_steady_(is_steady) {
    if (term->kind == Kind::product)
        for (const TreePtr& factor : term->args) take(factor, false);
    else
        take(term, false);
}

void ProductTree::take(const TreePtr& factor, bool below) {
    if (factor->kind == Kind::reciprocal) return take(factor->args[0], !below);
    groups_.push_back({below, {}});
    std::vector<TreePtr> factors{factor};
    if (below && factor->kind == Kind::product &&
        std::none_of(factor->args.begin(), factor->args.end(),
                     [](const TreePtr& arg) { return arg->kind == Kind::reciprocal; }))
        factors = factor->args;
    for (const TreePtr& part : factors) {
        const auto [base, exponent] = power_of(part);
        groups_.back().items.push_back({base, exponent});
    }
}

void ProductTree::erase(std::size_t group, std::size_t item) {
    std::vector<Item>& items = groups_[group].items;
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(item));
    if (items.empty()) groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(group));
}

/// In a term numbers come first, then what is steady, then what moves, then functions.
int ProductTree::rank(const Item& item) const {
    if (item.base->kind == Kind::number) return 0;
    if (item.base->kind == Kind::call) return 3;
    return is_steady_(*item.base) ? 1 : 2;
}

/// The position after the last factor above the line whose rank is not larger.
std::size_t ProductTree::position_after(int rank) const {
    std::size_t at = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g)
        if (!groups_[g].below && this->rank(groups_[g].items[0]) <= rank) at = g + 1;
    return at;
}

void ProductTree::insert_above(Item item) {
    const std::size_t at = position_after(rank(item));
    groups_.insert(groups_.begin() + static_cast<std::ptrdiff_t>(at), Group{false, {std::move(item)}});
}

void ProductTree::insert_below(Item item) {
    const auto last = std::find_if(groups_.rbegin(), groups_.rend(), [](const Group& g) { return g.below; });
    const bool is_number = item.base->kind == Kind::number;
    if (last != groups_.rend()) {
        last->items.insert(is_number ? last->items.begin() : last->items.end(), std::move(item));
        return;
    }
    const std::size_t steady = position_after(1), at = is_number || steady == 0 ? groups_.size() : steady;
    groups_.insert(groups_.begin() + static_cast<std::ptrdiff_t>(at), Group{true, {std::move(item)}});
}

void ProductTree::times(long n, long d) {
    struct Position {
        std::size_t group, item;
    };
    std::optional<Position> above, below;
    for (std::size_t g = 0; g < groups_.size(); ++g)
        for (std::size_t i = 0; i < groups_[g].items.size(); ++i) {
            const Item& item = groups_[g].items[i];
            const auto number = whole_number(*item.base);
            if (!number || *number == 0 || item.exponent != 1) continue;
            (groups_[g].below ? d : n) *= *number;
            auto& first = groups_[g].below ? below : above;
            if (!first)
                first = Position{g, i};
            else
                groups_[g].items[i].base = number_tree(1);
        }
    const long common = std::gcd(n, d);
    n /= common;
    d /= common;
    const bool stays_one = above && n == 1 && groups_[above->group].items[above->item].base->text == "1";
    if (above) groups_[above->group].items[above->item].base = number_tree(n);
    if (below) groups_[below->group].items[below->item].base = number_tree(d);
    const auto is_one = [](const Item& item) { return item.base->kind == Kind::number && item.base->text == "1"; };
    for (std::size_t g = groups_.size(); g-- > 0;)
        for (std::size_t i = groups_[g].items.size(); i-- > 0;)
            if (is_one(groups_[g].items[i]) && !(stays_one && above->group == g && above->item == i)) erase(g, i);
    if (!above && n != 1) groups_.insert(groups_.begin(), Group{false, {{number_tree(n)}}});
    if (!below && d != 1) insert_below({number_tree(d)});
}

bool ProductTree::times(const TreePtr& base, int exponent) {
    for (std::size_t g = 0; g < groups_.size(); ++g)
        for (std::size_t i = 0; i < groups_[g].items.size(); ++i) {
            Item& item = groups_[g].items[i];
            if (!same(*item.base, *base)) continue;
            const bool below = groups_[g].below;
            const int sum = (below ? -item.exponent : item.exponent) + exponent;
            if (sum != 0 && (sum < 0) == below) {
                item.exponent = std::abs(sum);
                return true;
            }
            erase(g, i);
            if (sum > 0) insert_above({base, sum});
            if (sum < 0) insert_below({base, -sum});
            return true;
        }
    if (exponent > 0) insert_above({base, exponent});
    if (exponent < 0) insert_below({base, -exponent});
    return false;
}

int ProductTree::exponent_of(const TreePtr& base) const {
    for (const Group& group : groups_)
        for (const Item& item : group.items)
            if (same(*item.base, *base)) return group.below ? -item.exponent : item.exponent;
    return 0;
}

TreePtr ProductTree::tree() const {
    std::vector<TreePtr> factors;
    for (const Group& group : groups_) {
        std::vector<TreePtr> parts;
        for (const Item& item : group.items) parts.push_back(raised(item.base, item.exponent));
        const TreePtr all = parts.size() == 1 ? parts[0] : made(Kind::product, parts);
        if (group.below)
            factors.push_back(made(Kind::reciprocal, {all}));
        else
            factors.insert(factors.end(), parts.begin(), parts.end());
    }
    if (factors.empty()) return number_tree(1);
    return factors.size() == 1 ? factors[0] : made(Kind::product, std::move(factors));
}

namespace {

void multiply(ProductTree& product, const TreePtr& factor, bool below, bool& negative) {
    if (factor->kind == Kind::reciprocal) return multiply(product, factor->args[0], !below, negative);
    if (factor->kind == Kind::negate) {
        negative = !negative;
        return multiply(product, factor->args[0], below, negative);
    }
    if (factor->kind == Kind::product) {
        for (const TreePtr& arg : factor->args) multiply(product, arg, below, negative);
        return;
    }
    const auto [base, exponent] = power_of(factor);
    if (const auto number = whole_number(*base); number && exponent == 1)
        below ? product.times(1, *number) : product.times(*number, 1);
    else
        product.times(base, below ? -exponent : exponent);
}

}  // namespace

TreePtr merged(const TreePtr& product, const std::function<bool(const Tree&)>& is_steady) {
    ProductTree result(made(Kind::product, {}), is_steady);
    bool negative = false;
    multiply(result, product, false, negative);
    return negative ? made(Kind::negate, {result.tree()}) : result.tree();
}

long size_of_numbers(const TreePtr& product) {
    long above = 1, below = 1;
    const std::function<void(const Tree&, bool)> take = [&](const Tree& tree, bool is_below) {
        if (const auto number = whole_number(tree)) return void((is_below ? below : above) *= *number);
        if (tree.kind == Kind::reciprocal) return take(*tree.args[0], !is_below);
        if (tree.kind == Kind::product)
            for (const TreePtr& factor : tree.args) take(*factor, is_below);
    };
    take(*product, false);
    return above + below;
}

}  // namespace alembert
