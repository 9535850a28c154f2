// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/language/say.hpp"
#include "commands/show.hpp"
#include "commands/verb.hpp"
#include "present/report/identification.hpp"

namespace alembert {

namespace {

int run_identify(const SceneOptions& options) {
    const Identification found = identify(scene_of(options));
    warn(found.warnings);
    if (options.json)
        show(as_json(found));
    else
        show(as_text(found));
    return 0;
}

}  // namespace

void add_identify(CLI::App& app, Chosen& chosen) {
    add_scene_verb<SceneOptions>(app, chosen,
                                 {.name = "identify",
                                  .about = say("tells which sums of masses and inertias motion shows"),
                                  .example = "alembert eval scenes/gallery/six_joint_arm.toml --identify"},
                                 run_identify,
                                 [](Verb& verb, SceneOptions& options) { add_given_state(verb, options.given); });
}

}  // namespace alembert
