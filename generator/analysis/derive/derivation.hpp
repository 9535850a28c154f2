// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Makes a derivation that a reader can follow from equations.
///
///     const Derivation shown = derivation_of(mechanism, equations);
///     text(shown.equations[0].lhs);

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "algebra/notation/readable.hpp"
#include "model/formalism/formalisms.hpp"

namespace alembert {

/// The contents of a derivation, as phrases that any notation can print. It has the four steps of Zhang & Qin,
/// §1.5: 1. degrees of freedom and coordinates, 2. T, 3. virtual work and generalized forces, 4. the equations. If
/// the equations exceed the readable size, the steps are left out and `definitions` has intermediate symbols.
struct Derivation {
    std::string formalism;
    std::string title;              ///< "Kane's equations"
    std::vector<Section> sections;  ///< the formalism's own steps: partial velocities, virtual works, H, R …
    int degrees_of_freedom = 0;
    std::vector<Phrase> coordinates;
    std::vector<std::pair<Phrase, Phrase>>
        definitions;                  ///< intermediate symbols; empty for equations of readable size
    std::vector<Statement> motion;    ///< positions of masses along the axes of N, velocities, squares of speeds
    std::vector<Statement> angular;   ///< angular velocities along the axes of bodies that turn in space
    std::vector<Statement> energies;  ///< T and V of each body and spring
    Phrase kinetic, potential;
    std::optional<Phrase> lagrangian;  ///< the Lagrangian, if the scene gives it
    std::vector<Statement> forces;     ///< generalized forces of each part of V and of each load, then their sums
    std::vector<Statement> derivatives;  ///< ∂T/∂q', its rate and ∂T/∂q, or those of L
    std::vector<ReadableEquation> equations;
    std::vector<std::pair<Phrase, Phrase>> abbreviations;  ///< definitions of the scene that stay names in these
    std::vector<Phrase> rows;                           ///< the coordinate or speed to which each equation belongs
    std::vector<std::pair<Phrase, Phrase>> states;      ///< z' of the scene's first-order states
    std::vector<std::pair<Phrase, Phrase>> kinematics;  ///< q' = h(q,u,t); empty if u = q'
    std::vector<Phrase> poles;  ///< where one of these vanishes, the speeds do not determine the rates
    std::vector<std::pair<Phrase, Phrase>> speeds;  ///< speeds chosen by the program: u = N(q,t) q'
    std::string choice;                             ///< a sentence about the speeds, if the program chose them
    std::vector<Statement> reactions;  ///< reactions of each constraint along each coordinate, on request
    std::vector<std::pair<std::string, Phrase>> constraints;  ///< by name: the expression that is zero
    std::vector<ReadableSign> signs;                   ///< on the sheet of roots on which the derivation holds
    std::vector<ReadableEquation> shares;              ///< relations between multipliers of dependent constraints
    std::vector<std::pair<std::string, Phrase>> gaps;  ///< by name: the expression that is not negative
    /// Dry friction: the contact slides with the velocity `slip` against the force `sliding`, or sticks with a
    /// force of at most `sticking`.
    struct Rubs {
        std::string name;
        Phrase sliding_velocity, sliding, sticking;
        std::optional<Phrase> across = {};  ///< the second component of the sliding velocity, if it has two
        /// The equations while it sticks and all others slide, with its force as a multiplier
        /// (scene/sticking.hpp), if they are readable; set by `derive`.
        std::vector<ReadableEquation> held = {};
        std::vector<std::string> forces = {};  ///< the names of these multipliers
        std::size_t operations = 0;            ///< of these equations, if they are too long to be shown
    };
    std::vector<Rubs> frictions;
    /// Of a program for the equations, where these are too long to be made for a reader; they are missing then. 0
    /// otherwise.
    int program_operations = 0;
    bool has_unit_quaternions = false;  ///< whether e·e = 1 of quaternions has been used in all terms
};

/// Adds λ ∂f/∂q of each constraint (λ a for nonholonomic ones), as far as readable.
void show_reactions(Derivation& shown, const Mechanism& mechanism);

/// Whether equations are written out in full only as far as a page holds them, or whatever the length of their
/// terms is.
enum class Length { readable, any };

/// Is told now and then which part is done, from 0 to 1; may be empty.
using PartDone = std::function<void(double)>;

/// The derivation with the steps that every formalism shares.
Derivation derivation_of(const Mechanism& mechanism, const Equations& equations, Length length = Length::readable,
                         const PartDone& done = {});

/// The derivation that also has the formalism's own steps, and its first-order equations if it ends in these.
Derivation derivation_of(const Mechanism& mechanism, const Equations& equations, const Formalism& by,
                         const PartDone& done = {});

}  // namespace alembert
