// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/kinematics.hpp"
#include "base/language/say.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "scene/lists.hpp"

namespace alembert {

namespace {

struct KinematicsVerb : SceneOptions {
    std::string of, format = "text";
    std::vector<std::string> at;
    bool steps = false, jacobian = false;
};

int run(const KinematicsVerb& verb) {
    Scene scene = scene_of(verb.scene);
    const Overrides at = overrides_of(verb.at, scene);
    const std::vector<std::string> of = names_of(in_words_of(scene, verb.of));
    const SceneKinematics found =
        kinematics(std::move(scene), {.of = of, .at = at, .steps = verb.steps, .jacobian = verb.jacobian});
    warn(found.warnings);
    if (verb.json)
        show(as_json(found, verb.steps));
    else if (verb.format == "text")
        show_page(as_page(found, verb.format, verb.steps) + jacobian_page(found), verb.full);
    else
        show(as_page(found, verb.format, verb.steps));
    return 0;
}

}  // namespace

void add_kinematics(CLI::App& app, Chosen& chosen) {
    add_scene_verb<KinematicsVerb>(
        app, chosen,
        {.name = "kinematics",
         .about = say("describes how frames and points move: omega, alpha, v, a"),
         .example = "alembert eval scenes/textbook/heavy_top.toml --kinematics --steps"},
        run, [](Verb& verb, KinematicsVerb& options) {
            verb.take("--of", options.of);
            verb.take("--at", options.at);
            verb.take("--format", options.format);
            verb.take("--full", options.full);
            verb.add_flag("--jacobian", options.jacobian,
                          say("also the Jacobians of points and of the mass centre, as numbers"));
            verb.add_flag("--steps", options.steps, say("also how velocities and accelerations are composed"));
        });
}

}  // namespace alembert
