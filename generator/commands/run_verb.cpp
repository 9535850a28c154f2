// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/run_verb.hpp"

#include "alembert/integrate.hpp"

namespace alembert {

void add_run_options(CLI::App& verb, RunVerb& options) {
    RunOptions& w = options.wishes;
    verb.add_option("--duration", w.duration, "seconds from the start")->check(nonnegative_number());
    verb.add_option("--tolerance", w.tolerance, "local error of each component, relative to max(1, |y|)")
        ->check(positive_number());
    verb.add_option("--method", w.method, "auto, " + method_names() + "; cvode, ida with SUNDIALS");
    verb.add_option("--step", w.step, "fixed step, for methods without step control")->check(positive_number());
    verb.add_option("--max-step", w.max_step, "longest step, in seconds, for methods that choose their steps")
        ->check(positive_number());
    verb.add_option("-o,--output", options.output, "CSV file");
    verb.add_option("--budget", w.budget, "right-hand sides at the most")->check(positive_number());
    verb.add_flag("--fast-math", w.fast_math, "let the compiler reorder sums");
}

}  // namespace alembert
