// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The result of every formalism: q' = h(q,u,t), M u' = f + Aᵀλ, A u' = γ (without constraints there is no A).
///
///     const Equations equations = lagrange(mechanism);
///     equations.M(0, 1); equations.f[0];
///
/// The speeds are the rates, h = u, or other speeds. The latter may eliminate constraints; such constraints have
/// no row in A, and their multipliers are recovered from the motion.
///
/// f is kept in three parts, so that the equation can be printed as in a textbook: M u' − own − dissipative =
/// applied + Aᵀλ.

#include <algorithm>
#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace alembert {

struct JointTree;

/// Are the speeds u the rates q'? The speeds of a scene's [speeds] are never counted as rates, whatever their
/// definition.
inline bool speeds_are_rates(const std::vector<GiNaC::symbol>& u, const std::vector<GiNaC::ex>& form,
                             const std::vector<GiNaC::ex>& h) {
    return u.size() == h.size() &&
           std::equal(u.begin(), u.end(), form.begin(),
                      [](const GiNaC::symbol& a, const GiNaC::ex& b) { return b.is_equal(a); });
}

struct Equations {
    // Defined in one file: inline, every file that holds one would compile the copies of all its parts.
    Equations();
    Equations(const Equations&);
    Equations(Equations&&) noexcept;
    Equations& operator=(const Equations&);
    Equations& operator=(Equations&&) noexcept;
    ~Equations();

    std::string formalism;            ///< its name: "lagrange"
    std::vector<GiNaC::symbol> q, u;  ///< coordinates; speeds
    std::vector<GiNaC::symbol> udot;  ///< the unknowns
    GiNaC::matrix M;             ///< n×n, symmetric; without rows if it is left out (recursive_without_matrix)
    std::vector<GiNaC::ex> own;  ///< velocity terms and potential forces
    std::vector<GiNaC::ex> dissipative;     ///< generalized forces of dampers
    std::vector<GiNaC::ex> applied;         ///< all other generalized forces
    std::vector<std::vector<GiNaC::ex>> A;  ///< m rows of n
    std::vector<GiNaC::ex> gamma;           ///< m
    std::vector<GiNaC::symbol> lambda;      ///< m
    /// The labels of the parts whose terms are in row i; only needed if no intermediate symbol is left that shows
    /// them.
    std::vector<std::vector<std::string>> row_sources;
    std::shared_ptr<Intermediates> z;  ///< the table of the intermediate symbols, which belongs to these equations

    std::vector<GiNaC::ex> h = {};     ///< q' in q, u, t
    std::vector<GiNaC::ex> form = {};  ///< u in q, q', t
    struct Eliminated {
        int constraint;        ///< position in Mechanism::constraints
        GiNaC::ex multiplier;  ///< in q, q', q'', t and the lambdas above
    };
    std::vector<Eliminated> eliminated = {};
    std::vector<GiNaC::ex> poles = {};  ///< h has no value where one of these vanishes
    /// Set by the recursive formalism, whose programs are made from it.
    std::shared_ptr<const JointTree> tree = {};

    int size() const { return static_cast<int>(u.size()); }
    /// Whether u = q', symbol by symbol.
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

/// The mechanism with a table that has the entries of the equations' table and of its own, so that the expressions
/// of both can be used with the result. What is named with it changes neither.
Mechanism in_terms_of(const Equations& equations, const Mechanism& mechanism);

}  // namespace alembert
