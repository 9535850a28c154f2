// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// All small changes of a claim in one place, each with its size: what a person may have written wrongly.
///
///     const Edits edits(claim, words);       // m*x'' + k*x = 0
///     edits.list[0]                               // a sign: m*x'' - k*x = 0
///
/// The size grows from a sign over sine for cosine, an angle, a dot, a number, a parameter, a factor that moves to
/// a whole term. A quantity that stands alone on the left is what the claim is about: changes of it count as
/// larger. A change is made in the tree and leaves everything else as its author wrote it.

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "check/product_tree.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// The names that may stand for each other in an equation about the scene.
struct ClaimWords {
    std::vector<std::string> parameters;
    std::set<std::string> lengths;
    std::vector<std::string> coordinates, inputs, multipliers;
    std::vector<TreePtr> angles;  ///< the arguments of sines and cosines
    std::vector<TreePtr> steady;  ///< terms of sums of parameters in the equations: m1, J/R^2

    bool is_steady(const Tree& tree) const;
    bool is_parameter(const std::string& name) const;
    bool has_rate(const std::string& name) const;
};

struct Edit {
    double size = 0;
    std::string kind;
    TreePtr lhs, rhs;
    std::string term;       ///< what is changed, as the claim has it, without sign; or what is missing
    std::string should_be;  ///< what it becomes; empty for a sign and for a term too many
    TreePtr changed = {};   ///< the same as a tree
    std::string written = {}, meant = {};  ///< what is exchanged in it, as in Slip
    std::string also = {};                 ///< a second term whose sign is changed with that of `term`
};

/// A term of some sum, or a side that is none.
struct Summand {
    bool left = true;
    TreePtr whole, body;  ///< with its sign, and without
    bool negative = false;
    bool first = true, alone = true;  ///< in its sum; whether there is none
    bool in_angle = false, in_derivative = false;
};

class Edits {
public:
    Edits(const Claim& claim, const ClaimWords& words);
    Edits(const Edits&) = delete;
    Edits& operator=(const Edits&) = delete;

    std::vector<Edit> list;
    std::vector<Summand> summands;
    /// Whether `list` has all: each change is a claim of its own, so that those of a sum of thousands of terms
    /// would take gigabytes.
    bool complete = true;

    /// This says what is exchanged.
    static Edit named(Edit edit, std::string written, std::string meant);
    /// The same where a factor of `body` is multiplied by a power of `base`.
    void name_factor(Edit& edit, const TreePtr& body, const TreePtr& base, int exponent) const;
    /// The claim with another body of this summand.
    Edit with_body(const Summand& summand, const TreePtr& body, std::string kind, double size) const;
    /// The claim with another tree in place of `part`, which stands in `summand`.
    Edit with_part_of(const Summand& summand, const Tree* part, const TreePtr& by, std::string kind,
                      double size) const;
    /// The claim with one more term, on the side where a person would put it.
    Edit with_term(const TreePtr& term, bool accelerated, double size) const;
    /// The claim with one more term beside `part`, a factor in `summand`: (M + m)*x'' for M*x''.
    Edit with_inner_term(const Summand& summand, const TreePtr& part, const TreePtr& term, double size) const;
    /// The claim without this summand.
    Edit without(const Summand& summand, double size) const;
    /// The claim in which a force that belongs to another equation, `alien` on the left, is left out, or replaced
    /// by `own`, which may be null.
    std::vector<Edit> in_place_of(const TreePtr& alien, const TreePtr& own, double size) const;
    /// The claim with two signs turned; nothing if one of the summands is a part of the other.
    std::optional<Edit> with_two_signs(const Summand& a, const Summand& b, double size) const;
    /// The claims in which a factor of the first term of a sum stands on the others too: n*a + b + c for
    /// n*(a + b + c).
    std::vector<Edit> with_factor_on_rest(double size) const;

    /// How much larger changes of a summand count, by its place.
    double burden(const Summand& summand) const;
    /// Whether it is a whole side and the other is zero, so that no factor of it matters.
    bool is_whole(const Summand& summand) const;
    /// Whether inner sums of the claim have blanks around their signs.
    bool is_loose() const { return loose_; }

private:
    const TreePtr& side(bool left) const { return left ? claim_.equation.lhs.tree : claim_.equation.rhs.tree; }
    const std::string& source(bool left) const {
        return left ? claim_.equation.lhs.text : claim_.equation.rhs.text;
    }
    std::string in_source(const Tree& tree, bool left) const { return text_of(tree, source(left)); }

    void terms_of(const TreePtr& tree, bool left, bool in_angle, bool in_derivative);
    void summand(const TreePtr& tree, bool left, bool first, bool alone, bool in_angle, bool in_derivative);
    static TreePtr turned(const Summand& s);
    void sign(const Summand& s);
    void numbers(const Summand& s);
    void factors(const Summand& s);
    void leaves(const TreePtr& tree, std::size_t summand, bool is_power_base);
    void name(const TreePtr& tree, std::size_t summand, bool is_power_base);
    void power(const TreePtr& tree, std::size_t summand);
    void turn(const TreePtr& tree, std::size_t summand);
    void steady_sum(const TreePtr& tree, std::size_t summand);
    void dots(const TreePtr& tree, std::size_t summand);
    TreePtr with_dots(const TreePtr& tree, int more) const;

    const Claim& claim_;
    const ClaimWords& words_;
    std::function<bool(const Tree&)> steady_;
    bool has_room();

    std::size_t width_ = 0;  ///< the terms of all sums and factors of all products, of which a change copies some
    bool loose_ = false;     ///< whether inner sums are written with blanks
};

/// Whether an acceleration stands in it.
bool is_accelerated(const Tree& tree);

/// Whether a time derivative is written out in it.
bool has_derivative(const Tree& tree);

}  // namespace alembert
