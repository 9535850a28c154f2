// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/options.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "base/language/say.hpp"
#include "commands/values.hpp"

namespace alembert {

namespace {

std::vector<SharedOption> all_options() {
    using enum SharedOption::Number;
    return {
        {"scene", values::scene, say("the scene, a TOML file")},
        {"--json", nullptr, say("print one JSON object")},
        {"--strict", nullptr, say("warnings end the run, with exit code 3")},
        {"--by", values::formalism, say("the formalism; default: the program chooses")},
        {"--at", values::assignment,
         say("sets a coordinate, a rate (\"theta1'=1\"), a parameter, an input, t; pi/2 is read")},
        {"--input", values::assignment, say("u=FILE.csv or u=EXPRESSION, for an input from outside")},
        {"--vary,--over,--follow", values::interval, {}},
        {"--of", values::names, say("frames, bodies and points, as in A,P; default: all")},
        {"--format", values::format, say("text (default), latex or mathml")},
        {"--full", nullptr, say("also what exceeds two screens")},
        {"--modes", nullptr, say("eigenvectors too")},
        {"--reactions", nullptr, say("what constraints exert along coordinates, and joints")},
        {"-o,--output,--csv", values::file, say("table as CSV, or NAME.npz (NumPy), NAME.h5 (HDF5)")},
        {"--svg,--plot,--draw", values::file, {}},
        {"--show", values::names, say("with {}: what to draw, as in theta1,theta1',energy", "--svg")},
        {"--poincare", values::formula, say("section of Poincare, as in \"theta1 = 0\"")},
        {"--duration", values::seconds, say("seconds from the start"), nonnegative},
        {"--tolerance", values::number, say("local error of a component, relative to max(1, |y|)"), positive},
        {"--method", values::method, say("the integrator; default: auto, which chooses")},
        {"--step", values::seconds, say("fixed step, for methods without step control"), positive},
        {"--sample", values::seconds, say("time between rows of the table"), positive},
        {"--max-step", values::seconds, say("longest step, for methods that choose it"), positive},
        {"--budget", values::count, say("evaluations of one motion, at most"), positive},
        {"--code", values::code, say("auto (default); memory: no compiler; compiled")},
        {"--fast-math", nullptr, say("let the compiler reorder sums")},
        {"!--no-tuning", nullptr, say("choose the method by counts alone")},
        {"!--no-motion", nullptr, say("leaves the motion out")},
    };
}

bool has_name(const SharedOption& option, std::string_view name) {
    std::string_view rest = option.names;
    if (rest.starts_with('!')) rest.remove_prefix(1);
    for (;;) {
        const std::size_t comma = rest.find(',');
        if (rest.substr(0, comma) == name) return true;
        if (comma == rest.npos) return false;
        rest.remove_prefix(comma + 1);
    }
}

}  // namespace

const SharedOption& shared_option(std::string_view name) {
    static const std::vector<SharedOption> all = all_options();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const SharedOption& option) { return has_name(option, name); });
    if (found == all.end()) throw std::logic_error("there is no shared option " + std::string(name));
    return *found;
}

}  // namespace alembert
