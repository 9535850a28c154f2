// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// One function of an emitted file: from the values that it computes to the text for the template.
///
///     const std::vector<EmittedFunction> list = written(program, words, {.name = "energy", …}, options);
///     list.back();      // the function; its parts before it, where it is long

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "codegen/emit/emit.hpp"
#include "codegen/emit/statement.hpp"
#include "codegen/emit/vocabulary.hpp"

namespace alembert {

struct FunctionArgument {
    std::string type, name;  ///< "const Real*", "state"
};

/// The value of a node is written to these places in the array.
struct FunctionResult {
    std::string array;
    std::vector<std::size_t> places;
    int node;
};

/// rate[to] = state[from]: a rate that is a speed.
struct RateCopy {
    int from, to;
};

struct FunctionTask {
    std::string name, about;
    std::vector<FunctionArgument> arguments;
    std::vector<Goal> goals;
    std::vector<FunctionResult> results;
    std::vector<RateCopy> copies = {};  ///< written before the results
    std::size_t size = 0;               ///< of `out`, where it has places behind those of the results
    /// The unknowns that do not stand in the array of unknowns, by their number: in which array, and where. For
    /// machine code alone.
    std::map<int, std::pair<std::string, int>> elsewhere = {};
};

/// An array of results.
struct GivenArray {
    std::string name;
    std::size_t size;
    bool is_filled;  ///< whether each of its places gets a value
};

struct EmittedFunction {
    std::string name, about, arguments;
    std::vector<std::string> unpacked = {};  ///< "&theta = state[0], &omega = state[1]": declared as const Real
    std::vector<std::string> ignored = {};   ///< arguments that C must name although the function may not use them
    std::vector<Passage> passages = {};
    bool is_part = false;
    // For languages whose functions have outputs, or declare their values beforehand.
    std::vector<FunctionArgument> takes = {};
    std::vector<GivenArray> gives = {};
    std::vector<std::string> names = {};
};

/// "const Real* state": numbers are passed by reference in C++, where Real may be a pack of eight; Rust has types
/// of its own, and the other languages name none. `real` is what stands for Real.
std::string typed(CodeLanguage language, const FunctionArgument& argument, const std::string& real = "Real");

/// The functions; none if there is nothing to compute.
std::vector<EmittedFunction> written(const Program& program, const Vocabulary& words, const FunctionTask& task,
                                     const EmitOptions& options);

/// The function that computes the constants from the parameters; none if there are no constants.
std::vector<EmittedFunction> prepare(const Program& program, const Vocabulary& words, CodeLanguage language);

}  // namespace alembert
