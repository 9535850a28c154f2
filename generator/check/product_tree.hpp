// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A term multiplied or divided as a person writes it.
///
///     ProductTree product(term, is_steady);            // m*L^2/12*theta''
///     product.times(4, 1);                             // m*L^2/3*theta''
///     product.times(name_tree("L"), -1);               // m*L/3*theta''
///     product.tree()

#include <functional>

#include "check/claim_tree.hpp"

namespace alembert {

class ProductTree {
public:
    /// `term` has no sign in front of it. `is_steady` must outlive this.
    ProductTree(const TreePtr& term, const std::function<bool(const Tree&)>& is_steady);

    /// n/d, positive.
    void times(long n, long d);
    /// A power of something that is no number; returns whether it was a factor before.
    bool times(const TreePtr& base, int exponent);

    TreePtr tree() const;

    /// The exponent with which this is a factor, negative below the line.
    int exponent_of(const TreePtr& base) const;

private:
    struct Item {
        TreePtr base;
        int exponent = 1;
    };
    struct Group {
        bool below = false;
        std::vector<Item> items;
    };

    void take(const TreePtr& factor, bool below);
    void erase(std::size_t group, std::size_t item);
    int rank(const Item& item) const;
    std::size_t position_after(int rank) const;
    void insert_above(Item item);
    void insert_below(Item item);

    const std::function<bool(const Tree&)>& is_steady_;
    std::vector<Group> groups_;
};

/// The size of the numbers in a product: 3 + 2 for 3/2*m*x''.
long size_of_numbers(const TreePtr& product);

/// A product in which equal factors stand together, numbers and steady ones first.
TreePtr merged(const TreePtr& product, const std::function<bool(const Tree&)>& is_steady);

}  // namespace alembert
