// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Mathematics as written, in the language of claims.
///
///     const ClaimText text = claim_text(*math, letters);
///     // for \frac{d}{dt}\frac{\partial L}{\partial \dot\theta}:
///     text.text                            // "(diff(L,theta'))'"
///
/// Each part of the text knows where it stands in the document.

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "check/derivation/letters.hpp"

namespace alembert {

struct ClaimText {
    struct Part {
        std::size_t begin = 0, end = 0;      ///< bytes of `text`
        std::size_t offset = 0, length = 0;  ///< bytes of the document
    };
    std::string text;
    std::vector<Part> parts;
    std::set<std::string> names = {};  ///< that stand in it, without primes
};

/// Thrown for what has no meaning as a number in this scene.
struct NoMeaning {
    std::string reason;
    std::size_t offset = 0, length = 0;  ///< in the document
    std::optional<Letter> unknown = {};  ///< the letter that is not known
    int dots = 0;                        ///< of that letter
};

struct ClaimWriting {
    const Letters& letters;
    /// Expressions that the derivation has written out itself, by their text: "diff(L,theta')" → "step_3".
    const std::map<std::string, std::string>* steps = nullptr;
    /// Values of the virtual displacements of all coordinates, with which δx is Σ ∂x/∂q δq. Null where they have
    /// no meaning.
    const std::map<std::string, std::string>* displacements = nullptr;
    /// For each generalized speed, and for each independent rate as "psi'", the rates that change with it, with
    /// the names of ∂q'/∂u.
    const std::map<std::string, std::vector<std::pair<std::string, std::string>>>* speeds = nullptr;
    /// Whether a letter alone is the quantity of mechanics where the scene has this name, too: T = ½ m v² beside a
    /// force T.
    bool alone_is_quantity = false;
    /// Whether ∂/∂ψ' is that of the independent rates, the constraints having been solved for the others.
    bool rates_are_speeds = false;
    /// Whether nothing in the system changes with time by itself, so that ∂L/∂t is 0.
    bool is_autonomous = false;
    /// Whether dx is taken along the motion: x' of both sides.
    bool differentials_are_rates = false;
    /// Whether d/dθ is taken along the motion: of θ' it is θ''/θ'.
    bool slopes_are_of_motion = false;
};

/// Throws NoMeaning.
ClaimText claim_text(const Math& math, const ClaimWriting& writing);

/// Whether a root stands in it.
bool holds_root(const Math& math);

/// Whether an acceleration stands in it.
bool is_accelerated(const Math& math);

/// A letter alone on a side, U_eff(θ) too, or its square.
struct Lone {
    const Math* letter = nullptr;
    int power = 1;
};
Lone lone_letter(const Math& side);

/// Every letter of the tree, with the most dots that it has anywhere.
void collect_letters(const Math& math, std::map<Letter, int>& to);

/// The text of a claim without blanks.
std::string compact(std::string text);

}  // namespace alembert
