// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/output.hpp"
#include "commands/show.hpp"
#include "commands/verb.hpp"
#include "report/derivation.hpp"
#include "report/figure.hpp"

namespace alembert {

namespace {

struct DeriveVerb : SceneOptions {
    PageOptions page;
    bool reactions = false;
    std::string draw;  ///< an SVG file; empty: none
};

int run(const DeriveVerb& options) {
    check_output(options.draw, {options.scene});
    const DerivedScene d = derive(read_scene(options.scene), {.by = options.by, .reactions = options.reactions});
    warn(d.warnings);
    if (!options.draw.empty()) write_file(options.draw, figure_of(d.scene), {options.scene});
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
                                   verb.add_option("--draw", options.draw, "SVG file for a figure of the system");
                                   add_reactions_option(verb, options.reactions);
                               });
}

}  // namespace alembert
