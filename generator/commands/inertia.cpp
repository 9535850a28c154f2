// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/inertia.hpp"
#include "base/language/say.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "scene/lists.hpp"

namespace alembert {

namespace {

struct InertiaVerb : SceneOptions {
    std::string of, about;
    std::vector<std::string> at;
};

int run(const InertiaVerb& verb) {
    Scene scene = scene_of(verb.scene);
    const Overrides at = overrides_of(verb.at, scene);
    const std::vector<std::string> of = names_of(in_words_of(scene, verb.of));
    const SceneInertia found = inertia(std::move(scene), {.of = of, .about = verb.about, .at = at});
    warn(found.warnings);
    if (verb.json)
        show(as_json(found));
    else
        show_page(as_text(found), verb.full);
    return 0;
}

}  // namespace

void add_inertia(CLI::App& app, Chosen& chosen) {
    add_scene_verb<InertiaVerb>(
        app, chosen,
        {.name = "inertia",
         .about = say("gives mass, mass centre, tensor and principal moments"),
         .example = "alembert eval scenes/textbook/gyrocompass.toml --inertia"},
        run, [](Verb& verb, InertiaVerb& options) {
            verb.take("--of", options.of, say("bodies and particles, as in B1,B2; default: all together"));
            verb.add_option("--about", options.about, say("a point, particle or body; default: the mass centre"))
                .type_name(values::point);
            verb.take("--at", options.at);
            verb.take("--full", options.full);
        });
}

}  // namespace alembert
