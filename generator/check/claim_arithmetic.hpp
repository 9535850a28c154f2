// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Evaluates the tree of a claim at exact states, thousands of times: names and calls are read once, and the rest
/// is arithmetic modulo 2⁶¹ − 1.
///
///     ClaimArithmetic arithmetic(claims, points, 0);
///     arithmetic.vanishes(lhs, rhs)              // at all points
///
/// A value comes with as many of its time derivatives as mechanics gives: that of an acceleration is unknown. What
/// has to vanish is a time derivative of the claim if it leaves a constant of the motion open. This finds
/// candidates; what they are worth is decided by the check itself.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "analysis/exact/exact_state.hpp"
#include "check/claim_tree.hpp"
#include "check/claims.hpp"

namespace alembert {

/// A value and its first two time derivatives, as far as they are known.
struct TimeValue {
    std::array<Prime, 3> value = {};
    int known = 3;
};

class ClaimArithmetic {
public:
    /// `derivative`: which time derivative of left − right is zero on every motion if a claim is right.
    /// `is_closed`: the constants in the claim have the values that other claims give. `claim` must outlive this.
    ClaimArithmetic(Claims& claims, const Claim& claim, std::vector<ModularPoint> points, int derivative,
                    bool is_closed);

    std::size_t points() const { return points_.size(); }

    /// Nothing if something in it cannot be read or has no value.
    std::optional<TimeValue> at(const Tree& tree, std::size_t point);
    std::optional<Prime> value(const Tree& tree, std::size_t point);
    /// Of left − right, the derivative that must vanish.
    std::optional<Prime> residual(const Tree& lhs, const Tree& rhs, std::size_t point);
    bool vanishes(const Tree& lhs, const Tree& rhs);

    /// Multiplies this part of every tree by a number from now on.
    void scale(const Tree* part, Prime by) { scaled_ = part, scale_ = by; }

    /// How many nodes have been evaluated.
    std::size_t effort() const { return effort_; }

private:
    /// A name or a call at each point.
    using Atom = std::vector<std::optional<TimeValue>>;
    const Atom& atom(const Tree& tree);
    GiNaC::ex reading(const Tree& tree);
    Atom read(const Tree& tree);
    void remember(const Tree& tree);
    std::optional<TimeValue> unscaled(const Tree& tree, std::size_t point);

    Claims& claims_;
    std::vector<ModularPoint> points_;
    int derivative_;
    bool is_closed_, at_impact_;
    Program program_;
    std::unordered_map<std::string, Atom> atoms_;
    std::unordered_map<const Tree*, const Atom*> own_;  ///< of the claim itself
    const Tree* scaled_ = nullptr;
    Prime scale_ = 1;
    std::size_t effort_ = 0;
};

}  // namespace alembert
