// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims that speak of the quantities of a derivation by the letters of the textbook (model/book_letters.hpp):
/// T, V, L, E, H, Q_q, deltaW …
///
///     V = m*g*l*(1 - cos(theta))     right up to a constant, and so is an energy
///     L = …                          right up to the time derivative of a function of coordinates and time
///     Q_theta = …                    right if it is the whole generalized force, or that of the loads that are
///     not in V deltaW = …                     right for the virtual displacements that the constraints allow

#include <string>

#include "check/comparison.hpp"

namespace alembert {

/// What the letters in a claim leave open.
struct SpokenLetters {
    bool any = false, forces = false, displacements = false;
    bool constant = false;                ///< V, E or H as a term, perhaps with a steady factor
    bool derivative = false;              ///< L likewise
    bool kinetic = false;                 ///< T likewise
    std::vector<std::string> terms = {};  ///< each of these, as it is written
    int sign = 0;  ///< with which the first of V, E, H, L stands in left − right; 0 if it has a factor
};
SpokenLetters letters_in(const Claim& claim, const Claims& read);

bool speaks_of_letters(const Comparison& now, std::size_t claim);
/// Why a claim holds that needs no forces: by the rates of the states that it holds, by what its letters mean, or,
/// where it has neither, `otherwise`.
std::string words_without_forces(const Comparison& now, std::size_t claim, std::string otherwise);

/// Why a claim about such letters needs no equation of motion.
std::string words_of_identity();

/// States of any motion that the constraints allow, whatever the forces are.
class AnyStates {
public:
    AnyStates(const Mechanism& mechanism, const Equations& equations, int halvings);
    /// Null if none was found.
    ExactStates* get() { return states_ ? &*states_ : nullptr; }

private:
    std::optional<ExactStates> states_;
};

}  // namespace alembert
