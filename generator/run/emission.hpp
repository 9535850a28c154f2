// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `emit`: a scene's specialized C++.
///
///     const Emission e = emission(read_scene("scenes/textbook/double_pendulum.toml"), {.batch = true});
///     e.source.text;

#include <optional>

#include "derive/derived.hpp"
#include "emit/emit.hpp"
#include "program/differentiate.hpp"

namespace alembert {

struct EmissionOptions {
    std::string by = {};    ///< a formalism; empty: the program chooses
    bool fold = false;      ///< parameters become constants
    bool jacobian = false;  ///< with the derivatives of the right-hand side by state and parameters
    bool batch = false;     ///< the same functions for eight systems at once too
    CodeLanguage language = CodeLanguage::cpp;
    bool standalone = false;  ///< a main program too, which integrates and prints
};

struct Emission : Derived {
    Choice choice = {};
    std::optional<Differentiated> derivatives = {};
    Source source = {};
    std::optional<SourceFile> main = {};  ///< where it was asked for
};

/// Throws what `derived` throws; ModelError for a main program of a scene with contacts, dry friction or events
/// that change the motion, which it would pass over; for a singular system, and for derivatives that are too long
/// to be written out.
Emission emission(Scene scene, const EmissionOptions& options = {});

}  // namespace alembert
