// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/solver_code.hpp"

#include <cstdlib>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/taylor.hpp"
#include "codegen/machine/can_run.hpp"

namespace alembert {

namespace {

enum class CodeWish { automatic, memory, compiled };

/// What `--code` says, or the variable of the environment.
CodeWish code_wish(const RunOptions& wishes) {
    const char* const variable = wishes.code.empty() ? std::getenv("ALEMBERT_CODE") : nullptr;
    const std::string word = variable != nullptr ? variable : wishes.code;
    if (word.empty() || word == "auto") return wishes.fast_math ? CodeWish::compiled : CodeWish::automatic;
    if (word == "compiled") return CodeWish::compiled;
    if (word != "memory") throw ModelError(say("unknown code '{}'; expected auto, memory or compiled", word));
    if (wishes.fast_math)
        throw ModelError(say("only a compiler reorders sums: leave --fast-math out, or take --code compiled"));
    return CodeWish::memory;
}

constexpr double nanosecond = 1e-9;

/// Seconds, fitted to g++ 12 on systems of 2 to 38 coordinates.
double compiling(const Program& program) {
    return 0.07 + 0.27e-3 * program.size();
}

/// Of the file of a series, from the cost of that in memory: nine scenes took 0.13 to 0.6 s, those with packs of
/// equal products a quarter of this, the others a half to twice.
double compiling(const alembert_series_table& series) {
    return 0.1 + 0.4 * series.order_cost;
}

}  // namespace

const char* name_of(CodeKind kind) {
    constexpr const char* names[] = {"memory", "compiled", "both"};
    return names[static_cast<int>(kind)];
}

CompileOptions compile_options(const RunOptions& wishes) {
    return {.compiler = {}, .extra_flags = {}, .fast_math = wishes.fast_math, .cache = {}};
}

namespace {

std::optional<SolverCode> code_in_memory(const Program& program, bool with_packs) {
    auto solver = memory_solver(program, with_packs);
    if (!solver) return std::nullopt;
    solver->module.tell_needed_state(program.needed_state());
    return SolverCode{.module = std::move(solver->module), .go_over = std::move(solver->go_over)};
}

/// The code in memory, or, where there is none or it is not wanted, the compiled one.
template <typename Code>
Code code_as_wished(const RunOptions& wishes, const std::function<std::optional<Code>()>& in_memory,
                    const std::function<Code()>& compiled) {
    const CodeWish wish = code_wish(wishes);
    if (wish == CodeWish::compiled) return compiled();
    if (auto code = in_memory()) return *std::move(code);
    if (wish == CodeWish::memory)
        throw CompileError(say(
            "machine code in memory needs a processor x86-64 with AVX2 and FMA, and a system that lets memory be "
            "executed; take --code compiled"));
    return compiled();
}

}  // namespace

SolverCode solver_code(const Program& program, const std::string& name, const RunOptions& wishes) {
    return code_as_wished<SolverCode>(
        wishes, [&] { return code_in_memory(program, false); },
        [&] { return compiled_code(program, name, wishes); });
}

CodeOfSeries series_code(const Program& program, bool with_work, const RunOptions& wishes) {
    return code_as_wished<CodeOfSeries>(
        wishes,
        [&]() -> std::optional<CodeOfSeries> {
            auto series = memory_series(program, with_work);
            if (!series) return std::nullopt;
            return CodeOfSeries{.module = std::move(series->module), .go_over = std::move(series->go_over)};
        },
        [&] { return CodeOfSeries{.module = compiled_series(program, with_work, wishes)}; });
}

double effort_of_making_series(const Program& program) {
    constexpr double least = 0.4e6, for_each = 9e3;  // fitted to nine systems of 10 to 1026 operations
    return least + for_each * program.count(program.right_hand_side()).total();
}

bool needs_compiler_for_series(const RunOptions& wishes) {
    return code_wish(wishes) == CodeWish::compiled || !machine::can_run();
}

SeriesModule compiled_series(const Program& program, bool with_work, const RunOptions& wishes) {
    return load_series(
        compile(emit_taylor(program, with_work).text, program.name + "_taylor", compile_options(wishes)).object);
}

SolverCode compiled_text(const Program& program, const std::string& text, const std::string& name,
                         const RunOptions& wishes) {
    const Compilation compiled = compile(text, name, compile_options(wishes));
    SolverCode code{.module = load(compiled.object), .from_cache = compiled.from_cache, .object = compiled.object};
    code.module.tell_needed_state(program.needed_state());
    return code;
}

SolverCode compiled_code(const Program& program, const std::string& name, const RunOptions& wishes) {
    return compiled_text(program, emit(program).text, name, wishes);
}

SolverCode batch_code(const Program& program, const std::string& text, const RunOptions& wishes) {
    const CodeWish wish = code_wish(wishes);
    if (wish == CodeWish::compiled) return compiled_text(program, text, program.name, wishes);
    if (auto code = code_in_memory(program, true)) return *std::move(code);
    if (wish == CodeWish::memory) return solver_code(program, program.name, wishes);
    try {
        return compiled_text(program, text, program.name, wishes);
    } catch (const CompileError&) {  // without a compiler, one system after the other
        if (auto code = code_in_memory(program, false)) return *std::move(code);
        throw;
    }
}

BatchSeries batch_series(const Program& program, bool with_work, const RunOptions& wishes) {
    return {.module = series_code(program, with_work, wishes).module,
            .packs = code_wish(wishes) == CodeWish::compiled ? nullptr : memory_series_packs(program, with_work)};
}

std::string wished_code(const RunOptions& wishes) {
    constexpr const char* names[] = {"auto", "memory", "compiled"};
    return names[static_cast<int>(code_wish(wishes))];
}

bool pays_to_compile(const Program& program, double effort) {
    constexpr double gain = 0.1;
    return gain * nanosecond * effort > compiling(program);
}

bool pays_to_compile(const alembert_series_table& series, double effort) {
    constexpr double gain = 0.3;
    return gain * nanosecond * effort > compiling(series);
}

bool may_go_over(const RunOptions& wishes) {
    return code_wish(wishes) == CodeWish::automatic;
}

}  // namespace alembert
