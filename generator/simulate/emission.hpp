// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `emit`: a scene's specialized C++, or its code in another language.
///
///     const Emission e = emission(read_scene("scenes/textbook/double_pendulum.toml"), {.batch = true});
///     e.source.text;

#include <optional>

#include "analysis/derive/derived.hpp"
#include "codegen/emit/emit.hpp"
#include "program/differentiate.hpp"

namespace alembert {

struct EmissionOptions {
    std::string name = {};  ///< of the files, the namespace and what they export; that of the scene if empty
    std::string by = {};    ///< a formalism; if empty, the program chooses
    bool fold = false;      ///< whether parameters become constants
    /// Whether to add the derivatives of the right-hand side with respect to state and parameters.
    bool jacobian = false;
    bool batch = false;  ///< whether to add the same functions for eight systems at once
    CodeLanguage language = CodeLanguage::cpp;
    /// Names of functions of their own (robot_functions.hpp, frame_functions.hpp), each written once.
    std::vector<std::string> functions = {};
    /// Points, bodies, or points with the axes of a frame, "P@F": their functions of frame_functions.hpp.
    std::vector<std::string> frames = {};
    /// Points or bodies with external wrenches as parameters (wrenches.hpp), "P" or "P@F".
    std::vector<std::string> wrenches = {};
    bool standalone = false;           ///< whether to add a main program that integrates and prints
    std::vector<std::string> at = {};  ///< the values in place of the scene's, which it has already: for the head
    bool casadi = false;  ///< in C: whether to add functions for CasADi, and derivatives if they are not too long
};

struct Emission : Derived {
    Choice choice = {};
    std::optional<Differentiated> derivatives = {};
    std::vector<NamedFunction> functions = {};
    Source source = {};
    std::optional<SourceFile> main = {};    ///< set if it was requested
    std::optional<SourceFile> casadi = {};  ///< likewise
};

/// All files, the equations first.
std::vector<SourceFile> files_of(const Emission& emission);

/// "cpp", "c", "js", "rust" … as the verb and the Python package take them (dialect.hpp); C++ for any other.
CodeLanguage language_of(std::string_view name);

/// The names of all functions that EmissionOptions::functions may have.
const std::vector<std::string>& all_functions();

/// Throws what `derived` throws; ModelError for a main program of a scene with contacts, dry friction or events
/// that change the motion, which it would ignore; for a singular system; for derivatives that are too long to be
/// written out; for functions whose name is unknown or that of another function, for functions where the state is
/// not (q, q'); for functions for CasADi in C++ and JavaScript, for a main program in JavaScript, and for a name
/// that is no identifier.
Emission emission(Scene scene, const EmissionOptions& options = {});

}  // namespace alembert
