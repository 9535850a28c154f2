// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A function that is nowhere positive, or nowhere negative, near a point, and where it is zero.
///
///     −c v²          ≤ 0, zero where v = 0
///     −x² v²         ≤ 0, zero where x = 0 or v = 0
///
/// Two ways. Its factors: those of even power have one sign, the others must not vanish at the point or have one
/// sign themselves. Or its leading form, of degree d: if it is definite on a complement of the linear space on
/// which it vanishes, and the function with all its derivatives below the d-th vanishes identically on that space
/// (which the normal form proves), then f = Σ y^a B_a(z, y), |a| = d, with the form as B(0): one sign, and zero on
/// the space alone.

#include "stability/neighbourhood.hpp"
#include "stability/signs.hpp"

namespace alembert {

struct Semidefinite {
    int sign = 0;  ///< 0: identically zero
    /// Zero on the union of these sets; in each all functions vanish.
    struct ZeroSet {
        std::vector<Expansion> functions;
        std::vector<GiNaC::ex> texts;  ///< the same
    };
    std::vector<ZeroSet> sets;
};

/// `f`: an expression in the states, with numbers. Nothing where it is not seen.
std::optional<Semidefinite> semidefinite(const GiNaC::ex& f, const Neighbourhood& near);

/// Is the equilibrium the only motion that stays in the set? Yes (proved) if the functions with their time
/// derivatives, restricted to what they allow, vanish at the point alone; no answer means that this is not seen.
bool holds_no_other_motion(const Semidefinite::ZeroSet& set, const Neighbourhood& near);

}  // namespace alembert
