// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A mechanism while it is built from its scene, table by table; mistakes are gathered and reported together. Of
/// build.cpp alone.

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

    /// Runs `step`; what it finds wrong is kept, and the building goes on.
    template <typename Step>
    void attempt(const Step& step) {
        try {
            step();
        } catch (const SceneMistake& mistake) {
            mistakes.push_back(mistake.diagnostic);
        }
    }

    /// At the scene's own parameters; not finite at a pole.
    double number_at(const Expression& e);

    const Scene& scene;
    Mechanism m;
    Translator translator;
    Places places;
    std::optional<ParameterValues> values;  ///< once the parameters are known
    std::vector<Diagnostic> mistakes;
    bool on_sheets = false;              ///< roots of squares are taken on the sheet of the initial state
    std::shared_ptr<RootSheets> sheets;  ///< then: once parameters and coordinates are known
};

/// Parameters, inputs, coordinates, speeds' names, definitions; their values are finite numbers. Throws InputError
/// where not.
void declare(Building& here);
/// Masses, the system graph of joints, springs, dampers, forces, torques, impulses, given energies: T, V and the
/// loads.
void add_loads(Building& here);
/// [[constraint]], quaternions' norms, [[rolling]], joints that close loops, [[unilateral]].
void add_conditions(Building& here);
/// [[friction]]: once the conditions are known.
void add_frictions(Building& here);

}  // namespace alembert
