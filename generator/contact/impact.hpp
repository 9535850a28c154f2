// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the scene's impulses, its broken constraints and its closed contacts do to the rates, at the start.
///
///     const Impact result = impact(build(read_scene("struck_rods.toml")));
///     result.numbers.after;                    // rates after
///     text(result.solution[0]);                // 3*S/(7*m*l)
///
/// With p = ∂L/∂q̇ the impulse equations are Δp = M (q'⁺ − q'⁻) = Q̂ + AᵀΛ + GᵀΠ (Zhang & Qin (1-62), with
/// multipliers); coordinates, time and finite forces have no part in them. Bilateral constraints hold after; one
/// that the rates before break is imposed suddenly. A contact is closed where its gap is zero; it obeys Newton's
/// law of restitution. The law in full, with what happens when several of these meet in one instant, is in
/// alembert/impact.hpp.
///
/// `x'` is the rate after, `x'(-)` the one before, a multiplier the impulse of its reaction: as in claims with
/// at = "impact".

#include <string>
#include <vector>

#include "alembert/impact.hpp"
#include "lower/start.hpp"
#include "notation/readable.hpp"

#include "state/prepared.hpp"

namespace alembert {

struct Impact {
    Start start;                        ///< t, q and the rates before
    std::vector<std::string> adjusted;  ///< guesses that moved, a line each
    std::vector<int> contacts;          ///< closed ones, positions in Mechanism::unilateral
    ImpactResult numbers;               ///< contacts as in `contacts`
    double kinetic_before = 0, kinetic_after = 0;
    double floors = 0;                 ///< work of moving constraints and gaps
    std::vector<std::string> imposed;  ///< constraints that the rates before break
    bool nothing_happens = false;      ///< rates after = rates before, to rounding

    /// For people. Symbolic results are left out where they are too large; then `silence` says so.
    std::vector<ReadableEquation> equations;  ///< one for each coordinate
    std::vector<std::pair<std::string, ReadableEquation>>
        conditions;                ///< on the rates after, by constraint or contact
    std::vector<Phrase> solution;  ///< rates after; at the pose, where that is known exactly
    std::vector<std::pair<std::string, Phrase>> reactions;
    /// The same as expressions, with what was put in for coordinates, t, inputs and rates before; what stands for
    /// the latter where they are not known exactly are `before`.
    struct Exact {
        GiNaC::exmap pose;
        std::vector<GiNaC::symbol> before;
        std::vector<GiNaC::ex> after;
        std::vector<std::pair<GiNaC::symbol, GiNaC::ex>>
            reactions;  ///< by multiplier; empty where rows are redundant
    };
    std::optional<Exact> exact;
    std::optional<Phrase> energy_loss;  ///< T before − T after
    std::string silence;
};

/// Throws ModelError for a gap that is negative at the start, IntegrationError where there are no rates after (the
/// reason is that of `strike`), and what `assemble` throws for positions that break a constraint.
Impact impact(const Mechanism& mechanism);

/// The whole verb: a scene with what its impulses do.
struct Struck : Prepared {
    Impact hit = {};
};
Struck impact(Scene scene);

}  // namespace alembert
