// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What people type, in the signs of the expression language, where its meaning is certain.
///
///     Expression e{.text = "½·m·v² − θ′**2", …};
///     write_plainly(e);                              // "(1/2)*m*v^2 - θ'^2"
///
/// Signs of multiplication and division, dashes, primes and dots put over letters, raised and lowered digits,
/// fractions, roots, and the full-width signs of Chinese keyboards. Each byte keeps its place in the file.

#include "scene/expression.hpp"

namespace alembert {

/// Text and places stay as they are where there is nothing of this kind.
void write_plainly(std::string& text, std::vector<Place>& places);

/// A name in plain signs, "m1" for "m₁"; text that is no name then stays as it is.
std::string plain_name(const std::string& name);

}  // namespace alembert
