// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/impact.hpp"

#include "base/language/say.hpp"
#include "commands/show.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

int run_impact(const SceneOptions& options) {
    const Struck struck = impact(scene_of(options));
    warn(struck.warnings);
    if (options.json)
        show(as_json(struck));
    else
        show_page(as_text(struck), options.full);
    return 0;
}

}  // namespace

void add_impact(CLI::App& app, Chosen& chosen) {
    add_scene_verb<SceneOptions>(app, chosen,
                                 {.name = "impact",
                                  .about = say("calculates rates after impulses, sudden constraints"),
                                  .example = "alembert eval scenes/textbook/struck_rods.toml --impact"},
                                 run_impact, [](Verb& verb, SceneOptions& options) {
                                     add_given_state(verb, options.given);
                                     verb.take("--full", options.full);
                                 });
}

}  // namespace alembert
