// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `fmu`: a functional mock-up unit (FMI 2.0 or 3.0) for model exchange and co-simulation.
///
///     const FunctionalUnit unit = functional_unit(read_scene("scenes/textbook/cart_pole.toml"));
///     unit.archive;                        // the bytes of cart_pole.fmu
///
/// The archive holds the description, the equations in C with their derivatives, the functions of FMI in C, and
/// what the compiler makes of these for this machine. The same scene, program and compiler give the same bytes.

#include "simulate/fmu/unit_variables.hpp"

namespace alembert {

struct FunctionalUnitOptions {
    std::string by = {};               ///< a formalism; if empty, the program chooses
    int version = 2;                   ///< of FMI: 2 or 3
    std::vector<std::string> at = {};  ///< what was given in words, for the heads of the sources
};

struct FunctionalUnit : UnitModel {
    int version = 2;
    std::string name = {};      ///< the model identifier
    std::string token = {};     ///< the guid, or instantiation token: a fingerprint of the contents
    std::string platform = {};  ///< the folder of the binary: "linux64"
    std::vector<UnitVariable> variables = {};
    std::string archive = {};
};

/// Throws what `unit_model` throws, CompileError if there is no compiler, and std::invalid_argument for
/// another version.
FunctionalUnit functional_unit(Scene scene, const FunctionalUnitOptions& options = {});

}  // namespace alembert
