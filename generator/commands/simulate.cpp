// SPDX-License-Identifier: GPL-2.0-or-later
#include <unistd.h>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/run_verb.hpp"
#include "commands/show.hpp"
#include "commands/terminal.hpp"
#include "commands/values.hpp"
#include "present/report/motion_plot.hpp"
#include "present/report/proof.hpp"
#include "present/report/run.hpp"
#include "present/report/table_file.hpp"
#include "scene/lists.hpp"
#include "simulate/section.hpp"

namespace alembert {

namespace {

constexpr const char* in_text = "-";
constexpr int columns_of_a_file = 80;

struct SimulateVerb : RunVerb {
    std::string plot;     ///< an SVG file, or "-" for lines of text; empty for none, and for text on a terminal
    std::string section;  ///< of Poincaré; empty for none
    std::string sensitivity;  ///< names with commas; empty for none
    std::string wanted;       ///< of what the sensitivity is; empty for the state
    bool proof = false;       ///< boxes that contain the motion, in place of a run
    bool all_digits = false;  ///< the values at the end with 16 digits
    std::string show;         ///< the names of the columns that it shows, with commas; if empty, all
};

/// Boxes in place of a run. Status 4 where they do not reach the end.
int run_proof(const SimulateVerb& verb) {
    RunOptions wishes = verb.wishes;
    wishes.by = verb.by;
    Progress progress;
    wishes.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    const Proof proof = prove(scene_of(verb), wishes);
    progress.wipe();
    if (verb.json)
        show(as_json(proof));
    else
        show(as_text(proof));
    return proof.motion.complete ? 0 : 4;
}

int run(const SimulateVerb& verb) {
    if (verb.proof) return run_proof(verb);
    check_output(verb.output, FileForm::table, {verb.scene});
    const bool plots_in_text = verb.plot == in_text;
    if (!plots_in_text) check_output(verb.plot, FileForm::picture, {verb.scene});
    need_table_form(verb.output);
    RunOptions wishes = verb.wishes;
    wishes.by = verb.by;
    Progress progress;
    wishes.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    Scene scene = scene_of(verb);
    wishes.columns = shown_names(in_words_of(scene, verb.show));
    wishes.sensitivity = names_of(in_words_of(scene, verb.sensitivity));
    wishes.sensitivity_of = names_of(in_words_of(scene, verb.wanted));
    if (!verb.section.empty()) {
        Prepared begun = prepared(std::move(scene));
        scene = std::move(begun.scene);
        add_section(scene, begun.mechanism, in_words_of(scene, verb.section));
    }
    Run run = simulate(std::move(scene), wishes);
    const SectionOfRun section{verb.section, take_crossings(run)};
    progress.wipe();
    warn(run.warnings);
    if (!verb.output.empty()) write_file(verb.output, table_file(run, verb.output), {verb.scene});
    if (!verb.plot.empty() && !plots_in_text)
        write_file(verb.plot, motion_plot(run, wishes.columns), {verb.scene});
    if (verb.json) {
        Json all = as_json(run);
        if (!verb.section.empty()) all["poincare"] = as_json(section, run);
        show(all);
    } else {
        show_formulas(as_text(run, ink_for(STDOUT_FILENO), verb.all_digits ? 16 : 6));
        if (!verb.section.empty()) show_formulas(as_text(section, run));
        const std::optional<int> columns = columns_of(STDOUT_FILENO);
        if (plots_in_text || (columns && verb.plot.empty()))
            show(braille_plot(run, wishes.columns, columns.value_or(columns_of_a_file)));
        for (const std::string& file : {verb.output, plots_in_text ? std::string() : verb.plot})
            if (!file.empty()) show(say("wrote {}\n", file));
    }
    if (run.failure) throw IntegrationError(*run.failure, run.motion.failure->time, run.motion.failure->state);
    return 0;
}

}  // namespace

void add_simulate(CLI::App& app, Chosen& chosen) {
    add_scene_verb<SimulateVerb>(
        app, chosen,
        {.name = "simulate",
         .about = say("makes code, integrates, and estimates the error"),
         .example = "alembert simulate scenes/textbook/crane.toml --svg motion.svg"},
        run, [](Verb& verb, SimulateVerb& options) {
            add_run_options(verb, options);
            verb.take("--sample", options.wishes.sample);
            verb.add_flag("--digits", options.all_digits, say("the values at the end with all 16 digits"));
            verb.take("--svg", options.plot, say("SVG picture of the motion over time; - for text"));
            verb.take("--show", options.show);
            verb.take("--poincare", options.section);
            verb.add_option("--sensitivity", options.sensitivity,
                            say("derivatives of the end by initial values, parameters"))
                .type_name(values::names);
            verb.add_option("--sensitivity-of", options.wanted, say("of these components and outputs alone"))
                .type_name(values::names);
            verb.add_flag("--regularize", options.wishes.regularize, say("short steps near collisions"));
            verb.add_flag("!--no-estimate", options.wishes.estimate,
                          say("no second run to estimate the error: half the time"));
            verb.take("--reactions", options.wishes.reactions);
            verb.add_flag("--proof", options.proof, say("intervals that contain the true motion, proved"));
        });
}

}  // namespace alembert
