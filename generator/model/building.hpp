// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A mechanism while it is built from its scene, table by table. Mistakes are collected and reported together.
/// Only the files that build the mechanism use this header.

#include <optional>
#include <vector>

#include "model/parameter_values.hpp"
#include "model/places.hpp"
#include "model/translate.hpp"

namespace alembert {

struct Building {
    explicit Building(const Scene& of);
    Building(const Building&) = delete;
    Building& operator=(const Building&) = delete;

    /// Runs `step`. The mistakes that it finds are kept, and building goes on.
    template <typename Step>
    void attempt(const Step& step) {
        try {
            step();
        } catch (const SceneMistake& mistake) {
            mistakes.push_back(mistake.diagnostic);
        }
    }

    /// The value at the scene's own parameters; not finite at a pole.
    double number_at(const Expression& e);

    const Scene& scene;
    Mechanism m;
    Translator translator;
    Places places;
    std::optional<ParameterValues> values;  ///< set as soon as the parameters are known
    std::vector<Diagnostic> mistakes;
    std::vector<std::string> left_out;   ///< multipliers of rows that hold in every position
    bool on_sheets = false;              ///< whether roots of squares are taken on the sheet of the initial state
    std::shared_ptr<RootSheets> sheets;  ///< set in that case, as soon as parameters and coordinates are known
};

/// Adds parameters, inputs, coordinates, the names of speeds, and definitions. Throws InputError if a value is not
/// a finite number.
void declare(Building& here);
/// Adds T, V and the loads: masses, the system graph of joints, springs, dampers, forces, torques, impulses, given
/// energies.
void add_loads(Building& here);
/// Adds the constraints: [[constraint]], norms of quaternions, [[rolling]], joints that close loops,
/// [[unilateral]].
void add_conditions(Building& here);
/// The rates of the states, which the masses, constraints and gaps that are there must allow.
void add_states(Building& here);
/// Adds [[friction]], after the constraints.
void add_frictions(Building& here);

}  // namespace alembert
