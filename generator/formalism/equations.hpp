// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What every formalism gives: q' = h(q,u,t), M u' = f + Aᵀλ, A u' = γ (no A without constraints).
///
///     const Equations equations = lagrange(mechanism);
///     equations.M(0, 1); equations.f[0];
///
/// The speeds are the rates, h = u, or others: then constraints whose rates they leave out are eliminated; those
/// have no row of A, and their multipliers are recovered from the motion.
///
/// For the readable form f is kept in three parts, as a textbook writes the equation:
/// M u' − own − dissipative = applied + Aᵀλ.

#include <algorithm>
#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

struct JointTree;

/// Are all rates q' = h speeds, each u being its own form? A scene's [speeds] are symbols of their own, whatever
/// they stand for.
inline bool speeds_are_rates(const std::vector<GiNaC::symbol>& u, const std::vector<GiNaC::ex>& form,
                             const std::vector<GiNaC::ex>& h) {
    return u.size() == h.size() &&
           std::equal(u.begin(), u.end(), form.begin(),
                      [](const GiNaC::symbol& a, const GiNaC::ex& b) { return b.is_equal(a); });
}

struct Equations {
    std::string formalism;            ///< its name: "lagrange"
    std::vector<GiNaC::symbol> q, u;  ///< coordinates; speeds
    std::vector<GiNaC::symbol> udot;  ///< the unknowns
    GiNaC::matrix M;                  ///< n×n, symmetric; no rows where it is left out (recursive_without_matrix)
    std::vector<GiNaC::ex> own;       ///< velocity terms and potential forces
    std::vector<GiNaC::ex> dissipative;     ///< generalized forces of dampers
    std::vector<GiNaC::ex> applied;         ///< all other generalized forces
    std::vector<std::vector<GiNaC::ex>> A;  ///< m rows of n
    std::vector<GiNaC::ex> gamma;           ///< m
    std::vector<GiNaC::symbol> lambda;      ///< m
    /// Whose terms row i holds, as labels; only where no intermediate symbol is left to tell.
    std::vector<std::vector<std::string>> row_sources;
    std::shared_ptr<Intermediates> z;  ///< what the intermediate symbols stand for: a table of their own

    std::vector<GiNaC::ex> h = {};     ///< q' in q, u, t
    std::vector<GiNaC::ex> form = {};  ///< u in q, q', t
    struct Eliminated {
        int constraint;        ///< position in Mechanism::constraints
        GiNaC::ex multiplier;  ///< in q, q', q'', t and the lambdas above
    };
    std::vector<Eliminated> eliminated = {};
    std::vector<GiNaC::ex> poles = {};           ///< where one of these vanishes h has no value
    std::shared_ptr<const JointTree> tree = {};  ///< of the recursive formalism: what its programs are made from

    int size() const { return static_cast<int>(u.size()); }
    /// u = q', symbol by symbol.
    bool speeds_are_rates() const { return alembert::speeds_are_rates(u, form, h); }
    /// Positions in Mechanism::constraints of the rows of A.
    std::vector<int> kept(const Mechanism& mechanism) const {
        std::vector<int> result;
        for (int k = 0; k < static_cast<int>(mechanism.constraints.size()); ++k)
            if (std::none_of(eliminated.begin(), eliminated.end(),
                             [&](const Eliminated& e) { return e.constraint == k; }))
                result.push_back(k);
        return result;
    }
    /// f = own + dissipative + applied
    GiNaC::ex forcing(int i) const { return own[i] + dissipative[i] + applied[i]; }
};

/// The same mechanism with a copy of its table of intermediate symbols. What a derivation names goes into the
/// copy, and the mechanism that it was asked for stays as it is.
Mechanism with_own_intermediates(const Mechanism& mechanism);

/// The mechanism with the table of the equations, which takes over what the mechanism's own has beyond it: the
/// expressions of both can be used with the result.
Mechanism in_terms_of(const Equations& equations, const Mechanism& mechanism);

}  // namespace alembert
