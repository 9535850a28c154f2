// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/run_verb.hpp"

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "scene/lists.hpp"

namespace alembert {

void add_run_options(Verb& verb, RunVerb& options) {
    RunOptions& w = options.wishes;
    add_given_values(verb, options.given);
    verb.take("--duration", w.duration);
    verb.take("--tolerance", w.tolerance);
    verb.take("--method", w.method);
    verb.take("--step", w.step);
    verb.take("--output", options.output);
    verb.take("--max-step", w.max_step);
    verb.take("--budget", w.budget);
    verb.take("--code", w.code);
    verb.take("--fast-math", w.fast_math);
    verb.take("--no-tuning", w.tuning);
    verb.take("--by", options.by);
}

std::vector<std::string> shown_names(const std::string& list) {
    if (list.empty()) return {};
    std::vector<std::string> names = at_commas(list);
    for (std::string& name : names) {
        name.erase(0, name.find_first_not_of(' '));
        name.erase(name.find_last_not_of(' ') + 1);
        if (name.empty())
            throw ModelError(say("--show {}: expected names with commas between, as in --show x,y", list));
    }
    return names;
}

}  // namespace alembert
