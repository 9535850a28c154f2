// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The options that the verbs that integrate have in common.

#include "commands/verb.hpp"
#include "simulate/options.hpp"

namespace alembert {

struct RunVerb : SceneOptions {
    RunOptions wishes;
    std::string output;  ///< a CSV file; empty for none
};

/// --at, --input, --duration, --tolerance, --method, --step, -o, --max-step, --budget, --code, --fast-math,
/// --no-tuning, --by.
void add_run_options(Verb& verb, RunVerb& options);

/// "theta1, energy" as names; none if it is empty. Throws ModelError if a name between commas is missing.
std::vector<std::string> shown_names(const std::string& list);

}  // namespace alembert
