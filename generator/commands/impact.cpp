// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/impact.hpp"

#include "commands/show.hpp"
#include "commands/verb.hpp"
#include "formalism/formalisms.hpp"

namespace alembert {

namespace {

int run(const SceneOptions& options) {
    if (!options.by.empty()) formalism(options.by);  // any will do: the momenta are the same in all
    const Struck struck = impact(read_scene(options.scene));
    warn(struck.warnings);
    if (options.json)
        show(as_json(struck));
    else
        show(as_text(struck));
    return 0;
}

}  // namespace

void add_impact(CLI::App& app, Chosen& chosen) {
    add_scene_verb<SceneOptions>(app, chosen, "impact",
                                 "the rates after the scene's impulses, sudden constraints and closed contacts",
                                 run);
}

}  // namespace alembert
