// SPDX-License-Identifier: GPL-2.0-or-later
#include "alembert/error.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/run_verb.hpp"
#include "commands/show.hpp"
#include "report/run.hpp"

namespace alembert {

namespace {

int run(const RunVerb& verb) {
    check_output(verb.output, {verb.scene});
    RunOptions wishes = verb.wishes;
    wishes.by = verb.by;
    Progress progress;
    wishes.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    const Run run = simulate(read_scene(verb.scene), wishes);
    progress.wipe();
    warn(run.warnings);
    if (!verb.output.empty()) write_file(verb.output, as_csv(run.rows), {verb.scene});
    if (verb.json) {
        show(as_json(run));
    } else {
        show(as_text(run));
        if (!verb.output.empty()) show("wrote " + verb.output + "\n");
    }
    if (run.failure) throw IntegrationError(*run.failure, run.motion.failure->time, run.motion.failure->state);
    return 0;
}

}  // namespace

void add_simulate(CLI::App& app, Chosen& chosen) {
    add_scene_verb<RunVerb>(
        app, chosen, "simulate", "emit, compile and integrate", run, [](CLI::App& verb, RunVerb& options) {
            add_run_options(verb, options);
            verb.add_option("--sample", options.wishes.sample, "seconds between rows")->check(positive_number());
            verb.add_flag("!--no-estimate", options.wishes.estimate,
                          "no second run to estimate the error: half the time");
            add_reactions_option(verb, options.wishes.reactions);
        });
}

}  // namespace alembert
