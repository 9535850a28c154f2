// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `linearize`: a scene's equations near an equilibrium or a steady motion, in numbers and, if they are
/// short, in symbols.
///
///     const LinearizedScene near = linearize(read_scene("scenes/gallery/bicycle.toml"), {.at = {{"x'", 4.6}}});
///     near.matrices.A, near.matrices.eigenvalues;

#include "analysis/derive/derived.hpp"
#include "stability/linear/along.hpp"
#include "stability/linear/linearize.hpp"

namespace alembert {

struct LinearizeOptions {
    std::string by = {};  ///< a formalism; if empty, the program chooses
    Overrides at = {};
    std::vector<std::pair<std::string, std::string>> exact_at =
        {};  ///< the same as typed; for symbols, decimals are exact
    About about = About::steady;
    std::optional<AlongOptions> along =
        {};  ///< if given, about each row of the motion from the state, `about` any
};

struct LinearizedScene : Derived {
    Start start = {};  ///< the state, which obeys the constraints
    About about = About::steady;
    /// The equilibrium or steady motion that Newton's method reached from a start that is none, as typed; empty if
    /// the start is one, or a state was asked for.
    std::vector<std::pair<std::string, std::string>> reached = {};
    Linearization matrices = {};
    std::vector<double> times = {};         ///< of the rows of the motion, if that was asked for
    std::vector<Linearization> along = {};  ///< about each; the first is `matrices`
    /// M, C, G, K, N in the parameters, by name, row by row in the order of the numbers; empty if they are not
    /// short.
    std::vector<std::pair<std::string, std::vector<std::vector<std::string>>>> symbols = {};
};

/// Where no state is asked for and the start is no equilibrium or steady motion, it is about the one near it.
/// Contacts that are closed at the state and stay closed count as constraints. Throws like the function of
/// linearize.hpp and those of along.hpp, and ModelError for a contact that touches without a force.
LinearizedScene linearize(Scene scene, const LinearizeOptions& options = {});

}  // namespace alembert
