// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A function that is nowhere positive, or nowhere negative, near a point, and where it is zero.
///
///     −c v²          ≤ 0, zero where v = 0
///     −x² v²         ≤ 0, zero where x = 0 or v = 0
///
/// There are two ways to see this. The first uses the factors of the function: those of even power have one sign,
/// the others must not vanish at the point or must have one sign themselves. The second uses its leading form, of
/// degree d: if this form is definite on a complement of the linear space on which it vanishes, and the function
/// with all its derivatives below the d-th vanishes identically on that space (which the normal form proves), then
/// f = Σ y^a B_a(z, y), |a| = d, where B(0) gives the leading form. Then f has one sign and is zero on that space
/// alone.

#include "stability/neighbourhood.hpp"
#include "stability/signs.hpp"

namespace alembert {

struct Semidefinite {
    int sign = 0;  ///< 0: identically zero
    /// The function is zero on the union of these sets; on each set all its `functions` vanish.
    struct ZeroSet {
        std::vector<Expansion> functions;
        std::vector<GiNaC::ex> texts;  ///< the functions as expressions, as far as these are exact
    };
    std::vector<ZeroSet> sets;
};

/// `f` is an expression in the states without symbols of parameters. Returns nothing if neither way succeeds.
std::optional<Semidefinite> semidefinite(const GiNaC::ex& f, const Neighbourhood& near);

/// Is the equilibrium the only motion that stays in the set? It is (proved) if the functions and their time
/// derivatives vanish together at the point alone. `false` only means that no proof was found.
bool holds_no_other_motion(const Semidefinite::ZeroSet& set, const Neighbourhood& near);

}  // namespace alembert
