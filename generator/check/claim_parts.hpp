// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The parts of a claim with their places in its text: terms, names, numbers, powers and calls. Changes of the
/// claim (check/slip.hpp) are made in the text, so that a corrected claim looks as its author wrote it.
///
///     const ClaimParts parts(claim);              // m*x'' + k*x = 0
///     parts.slice(parts.summands()[1].at);        // "k*x"

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

/// A part of one side's text.
struct TextStretch {
    bool left = true;
    int offset = 0, length = 0;
};

/// A term of some sum at any depth, its position in the sum, and the outermost term of which it is a part.
struct ClaimSummand {
    TextStretch at;
    bool first = true, negated = false, compound = false;
    TextStretch whole;
    bool in_angle = false;
};

/// A name, a number, a power or a call.
struct ClaimLeaf {
    const Tree* tree;
    TextStretch at, whole;
    TextStretch term;  ///< the innermost term of a sum, a derivative or a side of which it is a part
    bool in_angle = false, exponent = false;
};

class ClaimParts {
public:
    /// The claim must outlive its parts.
    explicit ClaimParts(const Claim& claim);

    const std::array<std::string, 2>& sides() const { return sides_; }
    const std::vector<ClaimSummand>& summands() const { return summands_; }
    const std::vector<ClaimLeaf>& leaves() const { return leaves_; }

    static TextStretch stretch(const Tree& tree, bool left) { return {left, tree.offset, tree.length}; }
    const std::string& side(bool left) const { return sides_[left ? 0 : 1]; }
    std::string slice(const TextStretch& s) const;
    std::string trimmed(const TextStretch& s) const;  ///< without blanks at the end

    /// The sign before a summand that is not the first of its sum.
    std::optional<TextStretch> operator_before(const ClaimSummand& s) const;
    /// The factor with the star before it or, if it is the first, after it. Nothing if it has neither.
    std::optional<TextStretch> with_its_star(const TextStretch& factor) const;
    /// The summand times or over something, its sign before it.
    std::string scaled(const ClaimSummand& s, const std::string& operation, const std::string& by) const;

    /// Whether it is the only summand of the claim. "0 = 0" is no correction.
    bool is_only_one(const ClaimSummand& s) const;
    /// Whether its side has one term.
    bool is_alone_on_its_side(const ClaimSummand& s) const;

private:
    void collect_summand(const Tree& tree, bool left, bool first, const std::optional<TextStretch>& whole,
                         bool in_angle);
    void collect(const Tree& tree, bool left, const TextStretch& whole, const TextStretch& term, bool in_angle,
                 bool exponent = false);

    std::array<std::string, 2> sides_;
    std::vector<ClaimSummand> summands_;
    std::vector<ClaimLeaf> leaves_;
};

}  // namespace alembert
