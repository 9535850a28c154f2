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

/// --duration, --tolerance, --method, --step, -o, --max-step, --budget, --fast-math, --by.
void add_run_options(Verb& verb, RunVerb& options);

/// --code: whether the functions are machine code in memory or compiled.
void add_code_option(Verb& verb, RunOptions& wishes);

/// Only --duration; --max-step and --budget.
void add_duration_option(Verb& verb, RunOptions& wishes);
void add_limits(Verb& verb, RunOptions& wishes);

/// --show NAME,NAME…: the columns that a picture shows. It is refused without the option `picture`, which must
/// have been added before.
void add_show_option(Verb& verb, std::string& list, const std::string& picture);

/// "theta1, energy" as names; none if it is empty. Throws ModelError if a name between commas is missing.
std::vector<std::string> shown_names(const std::string& list);

}  // namespace alembert
