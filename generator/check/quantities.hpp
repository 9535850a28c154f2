// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Claims that speak of the quantities of a derivation by the letters of the textbook (model/book_letters.hpp):
/// T, V, L, E, H, Q_q, deltaW …
///
///     V = m*g*l*(1 - cos(theta))     right up to a constant, and so is an energy
///     L = …                          right up to the time derivative of a function of coordinates and time
///     Q_theta = …                    right if it is the whole generalized force, or that of the loads that are
///     not in V deltaW = …                     right for the virtual displacements that the constraints allow

#include <memory>
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

/// A claim that may speak of letters, as one of the ways to decide it (decide.hpp). `settle`, then, if that is
/// false, the comparison of the sides as they stand, then `tell`.
class LetterClaim {
public:
    explicit LetterClaim(Question& q);
    ~LetterClaim();
    LetterClaim(const LetterClaim&) = delete;
    LetterClaim& operator=(const LetterClaim&) = delete;

    /// Decides a claim that is right though its sides are not equal as they were read; returns whether it did. A
    /// claim that is wrong is left in the reading that is nearer.
    bool settle();
    /// Adds to the verdict how the letters were read, and of a wrong claim what the quantity is.
    void tell();

private:
    bool vanishes(const GiNaC::ex& residual);
    bool prove();
    ExactStates* any(const GiNaC::ex& e);
    std::optional<std::vector<GiNaC::ex>> coefficients(const GiNaC::ex& residual) const;
    bool holds_for_allowed(const ClaimForm& form);
    GiNaC::ex excess() const;
    bool is_steady(const GiNaC::ex& e) const;
    bool is_constant();
    bool is_derivative();
    void choose(const std::vector<ClaimForm>& readings);
    void tell_right_side();
    void tell_reading();

    Comparison& now_;
    std::size_t k_;
    ExactStates& states_;
    const SpokenLetters spoken_;
    CheckedClaim& c_;
    std::unique_ptr<AnyStates> any_;
    bool loads_ = false;            ///< whether the forces are those of the loads alone
    std::optional<int> displaced_;  ///< the coordinate whose virtual displacement alone is not zero
};

}  // namespace alembert
