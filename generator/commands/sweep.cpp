// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <iostream>

#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/run_verb.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/vary.hpp"
#include "language/say.hpp"
#include "report/sweep.hpp"
#include "report/sweep_plot.hpp"
#include "report/table_file.hpp"

namespace alembert {

namespace {

struct SweepVerb : RunVerb {
    std::vector<std::string> vary;
    int threads = 0;
    std::string svg;   ///< an SVG picture; empty for none
    std::string show;  ///< the names of the columns that it shows, with commas; if empty, the coordinates
};

int run(const SweepVerb& verb) {
    for (const std::string& file : {verb.output, verb.svg}) check_output(file, {verb.scene});
    need_table_form(verb.output);
    RunOptions wishes = verb.wishes;
    wishes.by = verb.by;
    wishes.columns = shown_names(verb.show);
    Progress progress;
    wishes.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    const Grid grid = grid_of(verb.vary);
    if (!verb.svg.empty()) need_pictured(grid);
    const Sweep swept = sweep(scene_of(verb.scene), grid, wishes, verb.threads);
    progress.wipe();
    warn(swept.warnings);
    if (!verb.output.empty()) write_file(verb.output, table_file(swept, verb.output), {verb.scene});
    if (!verb.svg.empty()) write_file(verb.svg, sweep_plot(swept, wishes.columns), {verb.scene});
    if (verb.json) {
        Json result = as_json(swept);
        if (!verb.output.empty())
            result["file"] = verb.output;
        else
            result["rows"] = rows_as_json(swept);
        show(result);
    } else if (verb.output.empty()) {
        show(as_csv(swept));
    } else {
        show(as_text(swept) + say("wrote {}\n", verb.output));
    }
    const SweepTotals sum = totals_of(swept);
    if (sum.failed == 0) return 0;
    std::cout.flush();
    warn({say("{}: {} of {} motions failed; the table's column 'status' says why, the first at {}\n", verb.scene,
              sum.failed, grid.size(), sum.first_failure)});
    return 4;
}

}  // namespace

void add_sweep(CLI::App& app, Chosen& chosen) {
    add_scene_verb<SweepVerb>(
        app, chosen,
        {.name = "sweep",
         .about = say("integrates from many initial states or with many parameters"),
         .example = "alembert sweep scenes/textbook/crane.toml --vary l=1:9:100"},
        run, [](Verb& verb, SweepVerb& options) {
            verb.add_option("--vary", options.vary, say("NAME=FROM:TO:COUNT; several make a grid"))
                .type_name(values::range)
                .required();
            add_run_options(verb, options);
            verb.add_option("--threads", options.threads, say("default: as many as there are cores"))
                .type_name(values::count)
                .between(1, 1024);
            verb.add_option("--svg", options.svg,
                            say("SVG picture: lines over one varied quantity, maps over two"))
                .type_name(values::file);
            add_show_option(verb, options.show, "--svg");
        });
}

}  // namespace alembert
