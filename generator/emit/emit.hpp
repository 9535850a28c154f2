// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// From straight-line code to a C++ file, or a C99 file with its header.
///
///     const Source source = emit(program);
///     source.file;   // "double_pendulum.cpp"
///     emit(program, {.batch = true});   // with the same functions over eight systems at once
///
/// Functions of the file: rhs, mass_forcing, energy, outputs_at, events_at, and prepare(par) for what depends on
/// parameters alone; the tables at its end are those of lib/alembert/abi.hpp. Shape in
/// templates/solver.cpp.mustache. A program that has been differentiated (program/differentiate.hpp) gets
/// `jacobian` and a table of derivatives besides.

#include <optional>

#include "emit/statement.hpp"
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
    std::optional<SourceFile> header = {};  ///< of a C file
};

struct EmitOptions {
    bool batch = false;  ///< alembert_pack too; not in C
    CodeLanguage language = CodeLanguage::cpp;
    std::size_t longest_function =
        processor::longest_function;  ///< statements; a longer one is written in parts (parts.hpp)
};

/// Throws ModelError if the program has no accelerations (a singular system), and for packs in C.
Source emit(const Program& program, const EmitOptions& options = {});

}  // namespace alembert
