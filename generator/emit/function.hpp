// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One function of an emitted file, from what it is to compute to what the template prints.
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

/// A goal's value goes to `place` in the array `array`.
struct FunctionResult {
    std::string array, place;  ///< "mass", "mass[1] = mass[2]"
    int node;
};

struct FunctionTask {
    std::string name, about;
    std::vector<FunctionArgument> arguments;
    std::vector<Goal> goals;
    std::vector<FunctionResult> results;
    std::vector<CodeStatement> copies = {};  ///< before the results: the rates that are speeds
};

struct EmittedFunction {
    std::string name, about, arguments;
    std::vector<std::string> unpacked = {};  ///< "&theta = state[0], &omega = state[1]": declared as const Real
    std::vector<std::string> ignored = {};   ///< arguments that C names and the function may not use
    std::vector<Passage> passages = {};
    bool is_part = false;
};

/// None where nothing is to be computed.
std::vector<EmittedFunction> written(const Program& program, const Vocabulary& words, const FunctionTask& task,
                                     const EmitOptions& options);

/// The function that makes the constants from the parameters; none where there are no constants.
std::vector<EmittedFunction> prepare(const Program& program, const Vocabulary& words, CodeLanguage language);

}  // namespace alembert
