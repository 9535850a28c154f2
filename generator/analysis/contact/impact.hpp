// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The change of the rates at the start that the scene's impulses, constraints that the rates break, and closed
/// contacts cause.
///
///     const Impact result = impact(build(read_scene("struck_rods.toml")));
///     result.numbers.after;                    // rates after
///     text(result.solution[0]);                // 3*S/(7*m*l)
///
/// With p = ∂L/∂q̇ the impulse equations are Δp = M (q'⁺ − q'⁻) = Q̂ + AᵀΛ + GᵀΠ (Zhang & Qin (1-62), with
/// multipliers); coordinates and time do not change, and finite forces do not enter. Bilateral constraints hold
/// after the impact; a constraint that the rates before break is imposed suddenly. A contact is closed if its gap
/// is zero; it obeys Newton's law of restitution. alembert/hybrid/frictionless_impact.hpp describes the complete
/// law, including several of these at the same instant.
///
/// As in claims with at = "impact", `x'` is the rate after the impact, `x'(-)` the rate before, and a multiplier
/// the impulse of its reaction.

#include <string>
#include <vector>

#include "alembert/hybrid/frictionless_impact.hpp"
#include "algebra/notation/readable.hpp"
#include "program/lower/start.hpp"

#include "analysis/state/prepared.hpp"

namespace alembert {

struct Impact {
    Start start;                        ///< t, q and the rates before
    std::vector<std::string> adjusted;  ///< a line for each guess that moved
    std::vector<int> contacts;          ///< the closed contacts, as positions in Mechanism::unilateral
    FrictionlessImpact numbers;         ///< the impulses of contacts in the order of `contacts`
    double kinetic_before = 0, kinetic_after = 0;
    double floors = 0;                 ///< the work of moving constraints and gaps
    std::vector<std::string> imposed;  ///< constraints that the rates before break
    bool nothing_happens = false;      ///< rates after = rates before, to rounding

    /// Symbolic results for readers. They are left out if they are too large; `silence` then says so.
    std::vector<ReadableEquation> equations;  ///< one for each coordinate
    std::vector<std::pair<std::string, ReadableEquation>>
        conditions;                ///< conditions on the rates after, by constraint or contact
    std::vector<Phrase> solution;  ///< the rates after; at the scene's pose, if that is known exactly
    std::vector<std::pair<std::string, Phrase>> reactions;
    /// The same as expressions, and the values that were substituted for coordinates, t, inputs and rates before.
    /// `before` are the symbols for rates before that are not known exactly.
    struct Exact {
        GiNaC::exmap pose;
        std::vector<GiNaC::symbol> before;
        std::vector<GiNaC::ex> after;
        std::vector<std::pair<GiNaC::symbol, GiNaC::ex>>
            reactions;  ///< by multiplier; empty if rows are redundant
    };
    std::optional<Exact> exact;
    std::optional<Phrase> energy_loss;  ///< T before − T after
    std::string silence;
};

/// Throws ModelError for a gap that is negative at the start, IntegrationError if there are no rates after the
/// impact (with the reason from `strike`), and what `assemble` throws for positions that break a constraint.
Impact impact(const Mechanism& mechanism);

/// The result of the verb: a scene with the effect of its impulses.
struct Struck : Prepared {
    Impact hit = {};
};
Struck impact(Scene scene);

}  // namespace alembert
