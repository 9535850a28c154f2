// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The units of a scene's own.
///
///     [units]
///     furlong = "201.168 m"      # a number and a unit; of the table or of this one
///     AU = "base"                # no multiple of others

#include <functional>
#include <string>
#include <vector>

#include "scene/unit_text.hpp"

namespace alembert {

struct UnitDefinition {
    std::string name;
    std::string value;  ///< in plain signs
};

/// Tells of each that has no meaning: which, at which byte of its value, and why.
using UnitComplaint = std::function<void(std::size_t which, std::size_t offset, const std::string& why)>;

/// Those that have a meaning, in any order of definition.
OwnUnits own_units(const std::vector<UnitDefinition>& definitions, const UnitComplaint& complain);

}  // namespace alembert
