// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Functions of a coordinate that the author calls by the letter of a parameter: the reduced mass m(φ) of a scene
/// with a mass m.
///
///     written = with_own_functions(std::move(written), letters);   // m(φ), m'(φ), dm/dφ are letters of their own

#include "check/derivation/letters.hpp"
#include "check/written/read.hpp"

namespace alembert {

/// Where a line defines such a function. Elsewhere m(φ) may be a product without a sign. `remarks` get which.
Written with_own_functions(Written written, const Letters& letters, std::vector<std::string>& remarks);

}  // namespace alembert
