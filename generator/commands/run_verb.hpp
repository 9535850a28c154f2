// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the verbs that integrate have in common.

#include "commands/verb.hpp"
#include "run/options.hpp"

namespace alembert {

struct RunVerb : SceneOptions {
    RunOptions wishes;
    std::string output;  ///< a CSV file; empty: none
};

/// --duration, --tolerance, --method, --step, --max-step, -o, --budget, --fast-math.
void add_run_options(CLI::App& verb, RunVerb& options);

}  // namespace alembert
