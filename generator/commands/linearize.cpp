// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/show.hpp"
#include "commands/verb.hpp"
#include "language/say.hpp"
#include "report/linearization.hpp"

namespace alembert {

namespace {

struct LinearizeVerb : SceneOptions {
    std::vector<std::string> at;
    bool modes = false;
};

int run(const LinearizeVerb& verb) {
    LinearizeOptions options{.by = verb.by, .at = overrides_of(verb.at)};
    for (const std::string& item : verb.at)
        options.exact_at.emplace_back(item.substr(0, item.find('=')), item.substr(item.find('=') + 1));
    const LinearizedScene near = linearize(scene_of(verb.scene), options);
    warn(near.warnings);
    if (verb.json)
        show(as_json(near));
    else
        show(as_text(near, verb.modes));
    return 0;
}

}  // namespace

void add_linearize(CLI::App& app, Chosen& chosen) {
    add_scene_verb<LinearizeVerb>(
        app, chosen,
        {.name = "linearize",
         .about = say("gives matrices and eigenvalues near an equilibrium"),
         .example = "alembert linearize scenes/textbook/watt_governor.toml --at alpha=0"},
        run, [](Verb& verb, LinearizeVerb& options) {
            add_at_option(verb, options.at);
            add_by_option(verb, options.by);
            verb.add_flag("--modes", options.modes, say("eigenvectors too"));
        });
}

}  // namespace alembert
