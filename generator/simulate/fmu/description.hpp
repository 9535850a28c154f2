// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The file modelDescription.xml of a functional mock-up unit, of FMI 2.0 or 3.0.
///
///     const std::string xml = model_description(model, variables, {.version = 2, .token = "{…}"});

#include "simulate/fmu/unit_variables.hpp"

namespace alembert {

struct DescriptionOptions {
    int version = 2;    ///< 2 or 3
    std::string token;  ///< the guid of FMI 2.0, the instantiation token of FMI 3.0
};

/// `name` is the model identifier, and the names of the C files follow from it.
std::string model_description(const UnitModel& model, const std::string& name,
                              const std::vector<UnitVariable>& variables, const DescriptionOptions& options);

/// The file sources/buildDescription.xml of FMI 3.0.
std::string build_description(const std::string& name);

}  // namespace alembert
