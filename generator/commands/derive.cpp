// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "present/report/derivation.hpp"
#include "present/report/figure.hpp"

namespace alembert {

namespace {

struct DeriveVerb : SceneOptions {
    PageOptions page;
    bool reactions = false;
    std::string draw;  ///< an SVG file; empty for none
};

int run(const DeriveVerb& options) {
    PageOptions page = options.page;
    page.full = options.full;
    check_output(options.draw, FileForm::picture, {options.scene});
    Progress progress;
    const DerivedScene d =
        derive(scene_of(options), {.by = options.by,
                                   .reactions = options.reactions,
                                   .full = options.full || options.json,
                                   .done = [&progress](double part) { progress.at(say("deriving"), part); }});
    progress.wipe();
    warn(d.warnings);
    if (!options.draw.empty()) write_file(options.draw, figure_of(d.scene), {options.scene});
    if (options.json)
        show(as_json(d, page.dimensions));
    else
        page.format == "text" ? show_formulas(as_page(d, page)) : show(as_page(d, page));
    return 0;
}

}  // namespace

void add_derive(CLI::App& app, Chosen& chosen) {
    add_scene_verb<DeriveVerb>(app, chosen,
                               {.name = "derive",
                                .about = say("prints the equations of motion in the form of a textbook"),
                                .example = "alembert derive scenes/textbook/double_pendulum.toml --steps"},
                               run, [](Verb& verb, DeriveVerb& options) {
                                   add_given_state(verb, options.given);
                                   verb.take("--by", options.by);
                                   verb.take("--format", options.page.format);
                                   verb.add_flag("--steps", options.page.steps,
                                                 say("also coordinates, T, V, generalized forces, own steps"));
                                   verb.take("--full", options.full);
                                   verb.add_flag("--dimensions", options.page.dimensions,
                                                 say("also the dimension of each coordinate and multiplier"));
                                   verb.take("--svg", options.draw, say("SVG figure of the system"));
                                   verb.take("--reactions", options.reactions);
                               });
}

}  // namespace alembert
