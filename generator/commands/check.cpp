// SPDX-License-Identifier: GPL-2.0-or-later
#include <unistd.h>

#include "present/report/check.hpp"

#include "base/language/say.hpp"
#include "commands/show.hpp"
#include "commands/terminal.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "scene/claims_file.hpp"

namespace alembert {

namespace {

struct CheckOptions : SceneOptions {
    std::string claims;     ///< a file; if empty, the claims of the scene
    bool complete = false;  ///< whether the right claims must determine the motion
};

int exit_code(const Checked& checked, bool must_be_complete) {
    bool open = must_be_complete && !checked.complete;
    for (const CheckedClaim& c : checked.claims) {
        if (c.verdict == Verdict::refuted) return 1;
        open = open || c.verdict == Verdict::undecided || c.verdict == Verdict::vacuous;
    }
    return open ? 2 : 0;
}

int run(const CheckOptions& options) {
    Scene scene = scene_of(options.scene);
    if (!options.claims.empty()) scene = with_claims(std::move(scene), options.claims);
    const CheckedScene checked = check(std::move(scene), options.by);
    warn(checked.warnings);
    if (options.json)
        show(as_json(checked));
    else
        show_formulas(as_text(checked, ink_for(STDOUT_FILENO)));
    return exit_code(checked.checked, options.complete);
}

}  // namespace

void add_check(CLI::App& app, Chosen& chosen) {
    add_scene_verb<CheckOptions>(app, chosen,
                                 {.name = "check",
                                  .about = say("holds a hand derivation against the derived equations"),
                                  .example = "alembert check scenes/textbook/double_pendulum.toml"},
                                 run, [](Verb& verb, CheckOptions& options) {
                                     verb.add_option(
                                             "claims", options.claims,
                                             say("a file, one equation a line; default: the scene's [[claim]]s"))
                                         .type_name(values::claims);
                                     verb.add_flag("--complete", options.complete,
                                                   say("the exit code is 2 also if the claims that hold do not "
                                                       "determine the motion"));
                                     add_by_option(verb, options.by);
                                 });
}

}  // namespace alembert
