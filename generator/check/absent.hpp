// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds a term that a claim lacks, for claims that are no multiple of an equation of motion: integrals,
/// eliminated equations.
///
///     // "m*l^2*theta'^2/2", "r'*phi'" …
///     const std::vector<std::string> terms = terms_of_mechanics(claim, m, e, equation_terms(m, e));
///     // residual + (3/2)·m·terms[7] = 0 on every motion
///     absent_term(program, residual, nodes_of_terms, steady, states)
///
/// A term t is missing from r if −r/t is the same number times powers of parameters at all states
/// (check/steady_factor.hpp).

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/exact/motions.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// The terms of the equations and of the energies as text, the same for all claims.
struct EquationTerms {
    bool is_short = true;  ///< whether the equations are short enough to be read
    std::vector<std::string> of_equations, of_energies;
    std::set<std::string> angles;  ///< of the sines and cosines in them
    std::set<std::string> steady;  ///< the terms of sums of parameters in them: "m1", "J/R^2"
};
EquationTerms equation_terms(const Mechanism& mechanism, const Equations& equations);

/// Terms that may stand in an equation about this mechanism, as text: those of its equations, constraints,
/// energies and momenta, and products of two coordinates, rates, accelerations, multipliers or inputs with sines
/// and cosines. If the claim differentiates, also derivatives of such terms. At most a few thousand.
/// `integral`: only those that may stand in an integral of the motion.
std::vector<std::string> terms_of_mechanics(const Claim& claim, const Mechanism& mechanism,
                                            const Equations& equations, const EquationTerms& known,
                                            bool integral = false);

/// Parameters, and the sums of parameters in the claim.
std::vector<std::string> steady_sums(const Claim& claim, const Mechanism& mechanism);

struct Absent {
    std::size_t term = 0;     ///< the position of the term
    std::string coefficient;  ///< "-2*m/l", "1"
    int effort = 0;           ///< how much is in it: 0 for ±1
};

/// A constant value, as a node and as text: parameters and sums of them.
struct Steady {
    std::string text;
    int node = 0;
};

/// All such terms, those with the simplest coefficient first. `points`: at least three states of the mechanism.
std::vector<Absent> absent_terms(const Program& program, int residual, const std::vector<int>& terms,
                                 const std::vector<Steady>& steady, const std::vector<ModularPoint>& points);

}  // namespace alembert
