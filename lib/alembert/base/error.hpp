// SPDX-License-Identifier: MIT
#pragma once

/// The four types of errors. Each message says where the error is, what was found, what was expected and what to
/// do. The library throws and never prints or exits; the commands map the type to an exit code: SceneError,
/// ModelError 3; IntegrationError 4; CompileError 5.

#include <stdexcept>
#include <string>
#include <vector>

namespace alembert {

/// A place in a text file. Line and column count from 1, the column in characters (not bytes). Line 0 means no
/// place.
struct Place {
    int line = 0;
    int column = 0;
    friend bool operator==(const Place&, const Place&) = default;
    friend auto operator<=>(const Place&, const Place&) = default;
};

enum class Severity { error, warning };

struct Diagnostic {
    Place place;
    std::string message;  ///< one sentence without file, line or "error:"
    Severity severity = Severity::error;
    std::string kind = {};  ///< of a warning, for programs: "unused", "unit_mismatch" …
    std::string name = {};  ///< of what it is about, where it has one
};

/// The scene (or a claim file, or an option that is part of the input) is wrong. `what()` is the full text: for
/// each diagnostic `file:line:column: message`, the line itself and a caret.
struct SceneError : std::runtime_error {
    SceneError(const std::string& text, std::vector<Diagnostic> list)
        : std::runtime_error(text), diagnostics(std::move(list)) {}
    std::vector<Diagnostic> diagnostics;
};

/// The scene was read without errors, but it describes no system that the requested formalism can treat.
struct ModelError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The environment failed: there is no compiler, the compiler reported errors, the disk is full or an object does
/// not load.
struct CompileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The computation failed: a singular system, underflow of the step size, a value that is not a number, or a
/// budget that is used up.
struct IntegrationError : std::runtime_error {
    IntegrationError(const std::string& text, double at, std::vector<double> where)
        : std::runtime_error(text), time(at), state(std::move(where)) {}
    double time;                ///< where it happened
    std::vector<double> state;  ///< the last state that was good
};

}  // namespace alembert
