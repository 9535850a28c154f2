// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A slip in words.
///
///     words_of({.kind = "sign", .term = "m*g"})       // "the sign of m*g"

#include "check/slip.hpp"

namespace alembert {

std::string words_of(const Slip& slip);

}  // namespace alembert
