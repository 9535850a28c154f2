// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Short words that mean different things in different languages. The sentences are in lower case.

#include <string>

namespace alembert {

/// Whether "no" in the sentence is the Portuguese "in the", and denies nothing.
bool is_portuguese(const std::string& sentence);

/// "Si la barra está fija", "si la barre est fixe": "si" is "if" there, and not the Italian "si ha".
bool is_si_for_if(const std::string& sentence);

}  // namespace alembert
