// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// From equations to a derivation that a reader can follow.
///
///     const Derivation shown = derivation_of(mechanism, equations);
///     text(shown.equations[0].lhs);

#include <optional>
#include <string>
#include <vector>

#include "formalism/formalisms.hpp"
#include "notation/readable.hpp"

namespace alembert {

/// What a derivation shows to a reader, as phrases that any notation can print: the four steps of Zhang & Qin,
/// §1.5:
/// 1. degrees of freedom and coordinates, 2. T, 3. virtual work and generalized forces, 4. the equations.
/// Beyond the readable size the steps are left out and `definitions` carries intermediate symbols.
struct Derivation {
    std::string formalism;
    std::string title;              ///< "Kane's equations"
    std::vector<Section> sections;  ///< partial velocities, virtual works, H, R …
    int degrees_of_freedom = 0;
    std::vector<Phrase> coordinates;
    std::vector<std::pair<Phrase, Phrase>> definitions;  ///< intermediate symbols; empty at readable size
    std::vector<Statement> angular;   ///< angular velocities along the axes of bodies that turn in space
    std::vector<Statement> energies;  ///< T and V of each body and spring
    Phrase kinetic, potential;
    std::optional<Phrase> lagrangian;    ///< where the scene gives it
    std::vector<Statement> forces;       ///< generalized forces of each part of V and each load, then in all
    std::vector<Statement> derivatives;  ///< ∂T/∂q', ∂T/∂q, or those of L
    std::vector<ReadableEquation> equations;
    std::vector<std::pair<Phrase, Phrase>> abbreviations;  ///< definitions of the scene that stay names in these
    std::vector<Phrase> rows;                              ///< whose equation each is: coordinates, or speeds
    std::vector<std::pair<Phrase, Phrase>> kinematics;     ///< q' = h(q,u,t); empty where u = q'
    std::vector<Phrase> poles;  ///< where one of these vanishes the rates do not follow from the speeds
    std::vector<std::pair<Phrase, Phrase>> speeds;  ///< chosen by the program: u = N(q,t) q'
    std::string choice;                             ///< in words, where the speeds were chosen by the program
    std::vector<Statement> reactions;  ///< of each constraint along each coordinate, where they are asked for
    std::vector<std::pair<std::string, Phrase>> constraints;  ///< by name: what is zero
    std::vector<Phrase> positive;                             ///< on the sheet of roots on which all this holds
    std::vector<ReadableEquation> shares;              ///< of multipliers whose constraints depend on each other
    std::vector<std::pair<std::string, Phrase>> gaps;  ///< by name: what is not negative
    /// Dry friction: it slides with the velocity `slip` against the force `sliding`, or sticks with a force of at
    /// most `sticking`.
    struct Rubs {
        std::string name;
        Phrase slip, sliding, sticking;
    };
    std::vector<Rubs> frictions;
    bool has_unit_quaternions = false;  ///< e·e = 1 of each quaternion has been used in all terms
};

/// λ ∂f/∂q of each constraint (λ a for nonholonomic ones), as far as readable.
void show_reactions(Derivation& shown, const Mechanism& mechanism);

/// With the steps that every formalism shares.
Derivation derivation_of(const Mechanism& mechanism, const Equations& equations);

/// With the formalism's own steps too, and its own first-order equations where it ends in these.
Derivation derivation_of(const Mechanism& mechanism, const Equations& equations, const Formalism& by);

}  // namespace alembert
