// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What GiNaC and CLN say where numbers have no value.
///
///     catch (const std::exception& e) { if (const auto why = number_mistake(e)) … }    // "a division by zero"

#include <exception>
#include <optional>
#include <string>

namespace alembert {

/// Nothing if the exception is of another kind. A number that is too small for CLN is 0, and no mistake.
std::optional<std::string> number_mistake(const std::exception& thrown);

}  // namespace alembert
