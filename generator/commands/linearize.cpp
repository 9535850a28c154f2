// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/show.hpp"
#include "commands/verb.hpp"
#include "present/report/linearization.hpp"

namespace alembert {

namespace {

struct LinearizeVerb : SceneOptions {
    std::vector<std::string> at;
    bool modes = false, affine = false, along = false;
    AlongOptions motion;
    std::string output;  ///< a CSV file of the matrices along a motion; empty for none
};

int run(const LinearizeVerb& verb) {
    check_output(verb.output, FileForm::csv, {verb.scene});
    Scene scene = scene_of(verb.scene);
    LinearizeOptions options{
        .by = verb.by, .at = overrides_of(verb.at, scene), .exact_at = exact_overrides_of(verb.at, scene)};
    if (verb.affine) options.about = About::any;
    Progress progress;
    if (verb.along) options.along = verb.motion;
    if (verb.along)
        options.along->progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    const LinearizedScene near = linearize(std::move(scene), options);
    progress.wipe();
    warn(near.warnings);
    if (!verb.output.empty()) write_file(verb.output, as_csv(near), {verb.scene});
    if (verb.json)
        show(as_json(near));
    else
        show_page(as_text(near, verb.modes), verb.full);
    return 0;
}

}  // namespace

void add_linearize(CLI::App& app, Chosen& chosen) {
    add_scene_verb<LinearizeVerb>(
        app, chosen,
        {.name = "linearize",
         .about = say("gives matrices and eigenvalues near an equilibrium"),
         .example = "alembert stability scenes/stability/ziegler.toml --matrices"},
        run, [](Verb& verb, LinearizeVerb& options) {
            verb.take("--at", options.at);
            verb.take("--by", options.by);
            verb.take("--modes", options.modes);
            verb.take("--full", options.full);
            verb.add_flag("--affine", options.affine, say("about any state: x' = A dx + B du + c"));
            verb.add_flag("--along", options.along, say("the same along the motion from the state"));
            verb.take("--duration", options.motion.duration);
            verb.take("--tolerance", options.motion.tolerance);
            verb.take("--sample", options.motion.sample);
            verb.take("--output", options.output, say("CSV file of A, B and c along the motion"));
        });
}

}  // namespace alembert
