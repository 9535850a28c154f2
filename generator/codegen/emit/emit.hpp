// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Writes straight-line code as a C++ file or a C99 file, each with its header, or as a file in another language
/// (dialect.hpp).
///
///     const Source source = emit(program);
///     source.file;   // "double_pendulum.cpp"
///     source.header->name;              // "double_pendulum.hpp"
///     emit(program, {.batch = true});   // with the same functions over eight systems at once
///
/// The functions of the file are rhs, mass_forcing, energy, outputs_at, events_at, and prepare(par) for values
/// that depend on parameters only; the tables at its end are those of lib/alembert/native/abi.hpp. The template is
/// templates/solver.cpp.mustache, and templates/solver.js.mustache for JavaScript. A program that has been
/// differentiated (program/differentiate.hpp) also gets `jacobian` and a table of derivatives.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "codegen/emit/statement.hpp"
#include "program/named_function.hpp"
#include "program/processor.hpp"
#include "program/program.hpp"

namespace alembert {

struct SourceFile {
    std::string name, text;
};

struct Source {
    std::string file, text;
    Operations operations;  ///< of one right-hand side
    std::string formulation;
    std::optional<SourceFile> header = {};  ///< the header of a C or C++ file
};

/// What a scene says of a parameter or of a coordinate.
struct SceneNote {
    std::string given;  ///< its value, where that is in another unit than that of the file: "31 deg"
    std::string about;
};

struct EmitOptions {
    bool batch = false;  ///< whether to write alembert_pack too; in C++ alone
    CodeLanguage language = CodeLanguage::cpp;
    std::vector<NamedFunction> functions = {};  ///< functions of their own, whose nodes are in the program
    /// The derivatives of the Jacobian's entries, then of those by parameters, along a direction (tangent.hpp),
    /// for CasADi; none if empty.
    std::vector<int> jacobian_tangent = {};
    std::size_t longest_function =
        processor::longest_function;  ///< in statements; a longer function is written in parts (parts.hpp)
    /// Whether long statements that rates and multipliers need are written once, for both, which a compiler reads
    /// in half the time; rates then come with the multipliers.
    bool shares_multipliers = false;
    double t = 0;                    ///< of the calling example at the head of the file, in s
    std::vector<double> state = {};  ///< likewise: (q, q') or (q, u); zeros if empty
    /// The state that the C++ header has as data, with all its digits; `state` if empty. It has none if that is
    /// empty too.
    std::vector<double> initial = {};
    std::map<std::string, SceneNote> notes = {};  ///< by name, for the C++ header
    std::string command = {};                     ///< that makes the file, for its head; none if empty
    /// What moves the scene and is not in the equations, for the head: "the contact floor".
    std::vector<std::string> left_out = {};
};

/// Throws ModelError if the program has no accelerations (a singular system), for packs in C or JavaScript, and
/// for shared multipliers in another language than C.
Source emit(const Program& program, const EmitOptions& options = {});

}  // namespace alembert
