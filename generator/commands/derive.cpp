// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/show.hpp"
#include "commands/verb.hpp"
#include "report/derivation.hpp"

namespace alembert {

namespace {

struct DeriveVerb : SceneOptions {
    PageOptions page;
    bool reactions = false;
};

int run(const DeriveVerb& options) {
    const DerivedScene d = derive(read_scene(options.scene), {.by = options.by, .reactions = options.reactions});
    warn(d.warnings);
    if (options.json)
        show(as_json(d));
    else
        show(as_page(d, options.page));
    return 0;
}

}  // namespace

void add_derive(CLI::App& app, Chosen& chosen) {
    add_scene_verb<DeriveVerb>(app, chosen, "derive", "print the equations of motion in textbook form", run,
                               [](CLI::App& verb, DeriveVerb& options) {
                                   verb.add_option("--format", options.page.format, "text, latex or mathml")
                                       ->check(CLI::IsMember({"text", "latex", "mathml"}));
                                   verb.add_flag("--steps", options.page.steps,
                                                 "show coordinates, T, V, generalized forces, then the equations");
                                   add_reactions_option(verb, options.reactions);
                               });
}

}  // namespace alembert
