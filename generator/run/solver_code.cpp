// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/solver_code.hpp"

#include <cstdlib>

#include "alembert/error.hpp"
#include "emit/emit.hpp"
#include "language/say.hpp"

namespace alembert {

namespace {

enum class CodeWish { automatic, memory, compiled };

/// What `--code` says, or the variable of the environment.
CodeWish code_wish(const RunOptions& wishes) {
    const char* const variable = std::getenv("ALEMBERT_CODE");
    const std::string word = !wishes.code.empty() ? wishes.code : variable != nullptr ? variable : "";
    if (word.empty() || word == "auto") return wishes.fast_math ? CodeWish::compiled : CodeWish::automatic;
    if (word == "compiled") return CodeWish::compiled;
    if (word != "memory") throw ModelError(say("unknown code '{}'; expected auto, memory or compiled", word));
    if (wishes.fast_math)
        throw ModelError(say("only a compiler reorders sums: leave --fast-math out, or take --code compiled"));
    return CodeWish::memory;
}

/// Seconds, fitted to g++ 12 on systems of 2 to 38 coordinates.
double compiling(const Program& program) {
    return 0.07 + 0.27e-3 * program.size();
}

}  // namespace

const char* name_of(CodeKind kind) {
    constexpr const char* names[] = {"memory", "compiled", "both"};
    return names[static_cast<int>(kind)];
}

CompileOptions compile_options(const RunOptions& wishes) {
    return {.compiler = {}, .extra_flags = {}, .fast_math = wishes.fast_math, .cache = {}};
}

SolverCode solver_code(const Program& program, const std::string& name, const RunOptions& wishes) {
    const CodeWish wish = code_wish(wishes);
    if (wish == CodeWish::compiled) return compiled_code(program, name, wishes);
    if (auto solver = memory_solver(program))
        return {.module = std::move(solver->module), .go_over = std::move(solver->go_over)};
    if (wish == CodeWish::memory)
        throw CompileError(say(
            "machine code in memory needs a processor x86-64 with AVX2 and FMA, and a system that lets memory be "
            "executed; take --code compiled"));
    return compiled_code(program, name, wishes);
}

SolverCode compiled_code(const Program& program, const std::string& name, const RunOptions& wishes) {
    const Compiled compiled = compile(emit(program).text, name, compile_options(wishes));
    return {.module = load(compiled.object), .from_cache = compiled.from_cache};
}

SolverCode batch_code(const Program& program, const std::string& text, const RunOptions& wishes) {
    if (code_wish(wishes) != CodeWish::compiled)
        if (auto solver = memory_solver(program, true)) return {.module = std::move(solver->module)};
    const Compiled compiled = compile(text, program.name, compile_options(wishes));
    return {.module = load(compiled.object), .from_cache = compiled.from_cache};
}

bool pays_to_compile(const Program& program, double effort) {
    constexpr double gain = 0.1, nanosecond = 1e-9;
    return gain * nanosecond * effort > compiling(program);
}

bool may_go_over(const RunOptions& wishes) {
    return code_wish(wishes) == CodeWish::automatic;
}

}  // namespace alembert
