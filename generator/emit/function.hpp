// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One function of an emitted file: from the values that it computes to the text for the template.
///
///     const std::vector<EmittedFunction> list = written(program, words, {.name = "energy", …}, options);
///     list.back();      // the function; its parts before it, where it is long

#include <string>
#include <vector>

#include "emit/emit.hpp"
#include "emit/statement.hpp"
#include "emit/vocabulary.hpp"

namespace alembert {

struct FunctionArgument {
    std::string type, name;  ///< "const Real*", "state"
};

/// The value of a goal is written to `place` in the array `array`.
struct FunctionResult {
    std::string array, place;  ///< "mass", "mass[1] = mass[2]"
    int node;
};

struct FunctionTask {
    std::string name, about;
    std::vector<FunctionArgument> arguments;
    std::vector<Goal> goals;
    std::vector<FunctionResult> results;
    std::vector<CodeStatement> copies = {};  ///< written before the results: the rates that are speeds
};

struct EmittedFunction {
    std::string name, about, arguments;
    std::vector<std::string> unpacked = {};  ///< "&theta = state[0], &omega = state[1]": declared as const Real
    std::vector<std::string> ignored = {};   ///< arguments that C must name although the function may not use them
    std::vector<Passage> passages = {};
    bool is_part = false;
};

/// The functions; none if there is nothing to compute.
std::vector<EmittedFunction> written(const Program& program, const Vocabulary& words, const FunctionTask& task,
                                     const EmitOptions& options);

/// The function that computes the constants from the parameters; none if there are no constants.
std::vector<EmittedFunction> prepare(const Program& program, const Vocabulary& words, CodeLanguage language);

}  // namespace alembert
