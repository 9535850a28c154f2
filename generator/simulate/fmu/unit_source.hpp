// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The C file of a functional mock-up unit that stands beside the emitted equations: values, events, co-simulation
/// and the functions of FMI.
///
///     unit_source(model, variables, {2, "alembert emit cart_pole.toml", "{…}"}).name;     // "cart_pole_fmu.c"

#include "codegen/emit/emit.hpp"
#include "simulate/fmu/unit_variables.hpp"

namespace alembert {

struct UnitHead {
    int version;          ///< of FMI: 2 or 3
    std::string command;  ///< that makes the unit
    std::string token;    ///< what an importer must know to make an instance
};

SourceFile unit_source(const UnitModel& model, const std::vector<UnitVariable>& variables, const UnitHead& head);

}  // namespace alembert
