// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/stability.hpp"

#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

struct StabilityVerb : SceneOptions {
    std::vector<std::string> at;
    double period = 0;
    std::string lyapunov;
};

int run(const StabilityVerb& verb) {
    StabilityOptions options{
        .by = verb.by, .at = overrides_of(verb.at), .period = verb.period, .lyapunov = verb.lyapunov};
    for (const std::string& item : verb.at)
        options.exact_at.emplace_back(item.substr(0, item.find('=')), item.substr(item.find('=') + 1));
    const Stability result = stability(scene_of(verb.scene), options);
    warn(result.warnings);
    if (verb.json)
        show(as_json(result));
    else
        show(as_text(result));
    switch (result.verdict) {
        case StabilityVerdict::asymptotically_stable:
        case StabilityVerdict::stable:
            return 0;
        case StabilityVerdict::unstable:
            return 1;
        case StabilityVerdict::undecided:
            return 2;
    }
    return 2;
}

}  // namespace

void add_stability(CLI::App& app, Chosen& chosen) {
    add_scene_verb<StabilityVerb>(
        app, chosen,
        {.name = "stability",
         .about = "says whether an equilibrium, a steady motion or a polynomial is stable, and why",
         .example = "alembert stability scenes/textbook/watt_governor.toml --at alpha=0"},
        run, [](Verb& verb, StabilityVerb& options) {
            add_by_option(verb, options.by);
            add_at_option(verb, options.at);
            verb.add_option("--period", options.period, "of a periodic system or motion: Floquet multipliers")
                .type_name(values::seconds)
                .positive();
            verb.add_option("--lyapunov", options.lyapunov, "a function V of the state: judges what it proves")
                .type_name(values::formula);
        });
}

}  // namespace alembert
