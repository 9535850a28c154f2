// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/run_verb.hpp"

#include <fmt/format.h>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/values.hpp"
#include "scene/lists.hpp"

namespace alembert {

void add_run_options(Verb& verb, RunVerb& options) {
    RunOptions& w = options.wishes;
    add_duration_option(verb, w);
    verb.add_option("--tolerance", w.tolerance, say("local error of a component, relative to max(1, |y|)"))
        .type_name(values::number)
        .positive();
    verb.add_option("--method", w.method, say("the integrator; default: auto, which chooses"))
        .type_name(values::method)
        .in_words(value_kind(values::method)->words);
    verb.add_option("--step", w.step, say("fixed step, for methods without step control"))
        .type_name(values::seconds)
        .positive();
    verb.add_option("-o,--output", options.output, say("table as CSV, or NAME.npz (NumPy), NAME.h5 (HDF5)"))
        .type_name(values::file);
    add_limits(verb, w);
    verb.add_flag("--fast-math", w.fast_math, say("let the compiler reorder sums"));
    add_by_option(verb, options.by);
}

void add_duration_option(Verb& verb, RunOptions& wishes) {
    verb.add_option("--duration", wishes.duration, say("seconds from the start"))
        .type_name(values::seconds)
        .nonnegative();
}

void add_limits(Verb& verb, RunOptions& wishes) {
    verb.add_option("--max-step", wishes.max_step, say("longest step, for methods that choose it"))
        .type_name(values::seconds)
        .positive();
    verb.add_option("--budget", wishes.budget, say("evaluations of one motion, at most"))
        .type_name(values::count)
        .positive();
}

void add_show_option(Verb& verb, std::string& list, const std::string& picture) {
    verb.add_option("--show", list, say("with {}: what to draw, as in theta1,theta1',energy", picture))
        .type_name(values::names)
        .needs(picture);
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

void add_code_option(Verb& verb, RunOptions& wishes) {
    verb.add_option("--code", wishes.code, say("auto (default); memory: no compiler; compiled"))
        .type_name(values::code)
        .one_of({"auto", "memory", "compiled"});
}

}  // namespace alembert
