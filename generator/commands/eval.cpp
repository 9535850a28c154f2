// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/language/say.hpp"
#include "commands/show.hpp"
#include "commands/verb.hpp"
#include "present/report/evaluation.hpp"

namespace alembert {

namespace {

struct EvalOptions : SceneOptions {
    std::vector<std::string> at;
    bool reactions = false, matrices = false;
};

int run(const EvalOptions& options) {
    Scene scene = scene_of(options.scene);
    const Overrides at = overrides_of(options.at, scene);
    const Evaluation e =
        evaluate(std::move(scene),
                 {.by = options.by, .at = at, .reactions = options.reactions, .matrices = options.matrices});
    warn(e.warnings);
    if (options.json)
        show(as_json(e, options.reactions));
    else
        show_page(as_text(e), options.full);
    return 0;
}

}  // namespace

void add_eval(CLI::App& app, Chosen& chosen) {
    add_scene_verb<EvalOptions>(app, chosen,
                                {.name = "eval",
                                 .about = say("evaluates the equations once: accelerations, energies, reactions"),
                                 .example = "alembert eval scenes/textbook/double_pendulum.toml --at theta1=0.3"},
                                run, [](Verb& verb, EvalOptions& options) {
                                    verb.take("--at", options.at);
                                    verb.take("--by", options.by);
                                    verb.take("--reactions", options.reactions);
                                    verb.take("--full", options.full);
                                    verb.add_flag("--matrices", options.matrices,
                                                  say("M(q) and C(q, q') of M q'' + C q' + g = Q"));
                                });
}

}  // namespace alembert
