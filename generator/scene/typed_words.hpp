// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What people type for names, functions and derivatives, in the words of the expression language, where its
/// meaning is certain.
///
///     // in a scene with the coordinates theta and x
///     "θdot^2*arcsin(x(t))"          →  "theta'^2*asin(x)"
///     "\dot{\theta} + ln(Derivative(x, t))"  →  "theta' + log(x')"
///     "e^(-x)"                       →  "exp(-x)"
///
/// A name of the scene always keeps its own meaning: nothing is changed for a scene with a parameter `e` or `ln`.
/// What is not certain stays as it is, and its message says what to write (scene/advice.hpp).

#include <string>
#include <vector>

#include "alembert/base/error.hpp"
#include "scene/known_names.hpp"

namespace alembert {

/// `places` are as in Expression, and may be empty: each byte keeps its place in the file. Signs are written
/// plainly first (scene/typed.hpp).
void write_in_words(std::string& text, std::vector<Place>& places, const KnownNames& names);

/// One name, with its primes: "theta'" for "θ′" or "thetadot".
std::string written_name(std::string name, const KnownNames& names);

}  // namespace alembert
