// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/run_verb.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "alembert/error.hpp"
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

void add_show_option(CLI::App& verb, std::string& list, const std::string& picture) {
    verb.add_option("--show", list, "with " + picture + ": what to draw, as in theta1,theta1',energy")
        ->needs(picture);
}

std::vector<std::string> shown_names(const std::string& list) {
    std::vector<std::string> names;
    for (std::size_t begin = 0; !list.empty() && begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        std::string name = list.substr(begin, end - begin);
        name.erase(0, name.find_first_not_of(' '));
        name.erase(name.find_last_not_of(' ') + 1);
        if (name.empty())
            throw ModelError(fmt::format("--show {}: expected names with commas between, as in --show x,y", list));
        names.push_back(name);
        begin = end + 1;
    }
    return names;
}

}  // namespace alembert
