// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the functions of a solver are made: as machine code in memory, which takes milliseconds, or by the
/// compiler.
///
///     const SolverCode code = solver_code(program, program.name, wishes);
///     code.module.table().rhs(…);
///     if (pays_to_compile(program, effort)) code.go_over(compiled_code(program, program.name, wishes).module);
///
/// A right-hand side of a compiler takes from 0.8 to 1.2 of the time of that in memory, and is waited for a tenth
/// of a second for a pendulum and many seconds for a long chain. So a run begins in memory, and compiles after
/// steps that are predicted, from counts, to have taken ten times as long as compiling. Power series of a compiler
/// take from 0.5 to 1.6 of the time of those in memory, and are compiled after three times as long. Which of the
/// two is faster depends on the processor too: it is measured then (faster_code.hpp), and the run goes over if it
/// is the compiled one. Momenta (`rattle`) and what runs after a motion was found stiff do not go over.

#include "alembert/native/compilation.hpp"
#include "codegen/machine/memory_series.hpp"
#include "codegen/machine/memory_series_packs.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "simulate/options.hpp"

namespace alembert {

struct SolverCode {
    Module module;
    std::function<void(const Module& compiled)> go_over = {};  ///< set if the code is in memory
    bool from_cache = false;
    std::string object = {};  ///< the file of compiled code
};

/// Where the scene's functions are, for people who ask.
enum class CodeKind { memory, compiled, both };
const char* name_of(CodeKind kind);

CompileOptions compile_options(const RunOptions& wishes);

/// The functions of `program` as RunOptions::code wants them; `name` is that of the compiled file. Throws
/// ModelError for wishes that contradict each other, CompileError if the wished code cannot be made here.
SolverCode solver_code(const Program& program, const std::string& name, const RunOptions& wishes);
SolverCode compiled_code(const Program& program, const std::string& name, const RunOptions& wishes);
/// Likewise, if the program has been emitted as `text` already.
SolverCode compiled_text(const Program& program, const std::string& text, const std::string& name,
                         const RunOptions& wishes);

struct CodeOfSeries {
    SeriesModule module;
    std::function<void(const SeriesModule& compiled)> go_over = {};  ///< set if the code is in memory
};

/// The power series of the motion, likewise. With `with_work` the power of loads is integrated too.
CodeOfSeries series_code(const Program& program, bool with_work, const RunOptions& wishes);
SeriesModule compiled_series(const Program& program, bool with_work, const RunOptions& wishes);
/// The predicted time in which series_code makes a series in memory, ns.
double effort_of_making_series(const Program& program);
/// Whether series_code compiles, which takes 0.1 to 1 s.
bool needs_compiler_for_series(const RunOptions& wishes);

/// The functions for one system and for eight at once, which a sweep takes; for one alone where eight need a
/// compiler and there is none. `text` is the emitted file.
SolverCode batch_code(const Program& program, const std::string& text, const RunOptions& wishes);

struct BatchSeries {
    SeriesModule module;
    std::shared_ptr<const PackSeries> packs;  ///< null without code in memory for eight systems
};

/// The power series of a sweep, likewise. Compiled series are for one system alone.
BatchSeries batch_series(const Program& program, bool with_work, const RunOptions& wishes);

/// "auto", "memory" or "compiled": what is wished for, whatever comes of it here.
std::string wished_code(const RunOptions& wishes);

/// Whether compiling pays for a run that has taken `effort` (in predicted ns, as in alembert/ode/cost_model.hpp)
/// in memory; of the functions, or of the power series.
bool pays_to_compile(const Program& program, double effort);
bool pays_to_compile(const alembert_series_table& series, double effort);

/// Whether code that begins in memory may be replaced.
bool may_go_over(const RunOptions& wishes);

}  // namespace alembert
