// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/inverse.hpp"
#include "base/language/say.hpp"
#include "commands/show.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

struct InverseVerb : SceneOptions {
    std::vector<std::string> at;
};

int run(const InverseVerb& options) {
    Scene scene = scene_of(options.scene);
    const Overrides at = overrides_of(options.at, scene);
    const InverseLoads needed = inverse(std::move(scene), {.by = options.by, .at = at});
    warn(needed.warnings);
    if (options.json)
        show(as_json(needed));
    else
        show_page(as_text(needed), options.full);
    return 0;
}

}  // namespace

void add_inverse(CLI::App& app, Chosen& chosen) {
    add_scene_verb<InverseVerb>(
        app, chosen,
        {.name = "inverse",
         .about = say("calculates the loads that accelerations need"),
         .example = "alembert eval scenes/textbook/cart_pole.toml --inverse --at \"x''=2\""},
        run, [](Verb& verb, InverseVerb& options) {
            verb.take("--at", options.at);
            verb.take("--by", options.by);
            verb.take("--full", options.full);
        });
}

}  // namespace alembert
