// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/audit.hpp"

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/show.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

int run_audit(const SceneOptions& options) {
    const Audited audited = audit(scene_of(options));
    warn(audited.warnings);
    if (options.json)
        show(as_json(audited));
    else
        show_page(as_text(audited), options.full);
    const Audit& result = audited.audit;
    if (result.problem.empty()) return 0;
    if (result.wrong) throw ModelError(result.problem);
    throw IntegrationError(result.problem, result.start.t, result.start.q);
}

}  // namespace

void add_audit(CLI::App& app, Chosen& chosen) {
    add_scene_verb<SceneOptions>(app, chosen,
                                 {.name = "audit",
                                  .about = say("examines the constraints: kinds, rank, redundancy"),
                                  .example = "alembert audit scenes/textbook/sled.toml"},
                                 run_audit, [](Verb& verb, SceneOptions& options) {
                                     add_given_state(verb, options.given);
                                     verb.take("--full", options.full);
                                 });
}

}  // namespace alembert
