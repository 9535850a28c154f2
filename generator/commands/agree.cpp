// SPDX-License-Identifier: GPL-2.0-or-later
#include <unistd.h>

#include "present/report/agree.hpp"

#include "base/language/say.hpp"
#include "commands/show.hpp"
#include "commands/terminal.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

int run_agree(const SceneOptions& options) {
    const Agreed agreed = agree(scene_of(options));
    warn(agreed.warnings);
    if (options.json)
        show(as_json(agreed));
    else
        show_formulas(as_text(agreed, ink_for(STDOUT_FILENO)));
    return static_cast<int>(agreed.agreement.verdict);
}

}  // namespace

void add_agree(CLI::App& app, Chosen& chosen) {
    add_scene_verb<SceneOptions>(app, chosen,
                                 {.name = "agree",
                                  .about = say("derives by every formalism that applies, and proves them equal"),
                                  .example = "alembert check scenes/textbook/sled.toml --formalisms"},
                                 run_agree,
                                 [](Verb& verb, SceneOptions& options) { add_given_state(verb, options.given); });
}

}  // namespace alembert
