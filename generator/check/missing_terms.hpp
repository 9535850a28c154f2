// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Finds a term that a claim lacks, for claims that are no multiple of an equation of motion: integrals,
/// eliminated equations.
///
///     // m*l^2*theta'^2/2, r'*phi' …
///     const std::vector<Factors> terms = terms_of_mechanics(claim, m, e, equation_terms(m, e));
///     // residual + (3/2)·m·terms[7] = 0 on every motion
///     missing_terms(program, residual, nodes_of_terms, steady, states)
///
/// A term t is missing from r if −r/t is the same number times powers of parameters at all states
/// (check/steady_factor.hpp).

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/exact/motions.hpp"
#include "check/claim_tree.hpp"
#include "check/steady_factor.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// The factors of a product, or one tree that is none.
using Factors = std::vector<TreePtr>;
/// Trees in the order of their text.
using TreesByText = std::map<std::string, TreePtr>;

/// The terms of the equations and of the energies, the same for all claims.
struct EquationTerms {
    bool is_short = true;  ///< whether the equations are short enough to be read
    std::vector<TreePtr> of_equations, of_energies;
    TreesByText angles;  ///< of the sines and cosines in them
    TreesByText steady;  ///< the terms of sums of parameters in them: m1, J/R^2
};
EquationTerms equation_terms(const Mechanism& mechanism, const Equations& equations);

/// Terms that may stand in an equation about this mechanism, those of its equations, constraints,
/// energies and momenta, and products of two coordinates, rates, accelerations, multipliers or inputs with sines
/// and cosines. If the claim differentiates, also derivatives of such terms. At most a few thousand.
/// `integral`: only those that may stand in an integral of the motion.
std::vector<Factors> terms_of_mechanics(const Claim& claim, const Mechanism& mechanism, const Equations& equations,
                                        const EquationTerms& known, bool integral = false);

/// Parameters, and the sums of parameters in the claim.
std::vector<TreePtr> steady_sums(const Claim& claim, const Mechanism& mechanism);

struct MissingFactor {
    std::size_t term = 0;      ///< the position of the term
    SteadyFactor coefficient;  ///< in the steady values
    int effort = 0;            ///< how much is in it: 0 for ±1
};

/// All such terms, those with the simplest coefficient first. `steady`: the nodes of constant values, parameters
/// and sums of them. `points`: at least three states of the mechanism.
std::vector<MissingFactor> missing_terms(const Program& program, int residual, const std::vector<int>& terms,
                                         const std::vector<int>& steady, const std::vector<ModularPoint>& points);

}  // namespace alembert
