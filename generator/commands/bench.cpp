// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/bench.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/run_verb.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

struct BenchVerb : SceneOptions {
    BenchOptions options;
    std::string csv, svg;
};

int run(const BenchVerb& verb) {
    check_output(verb.csv, FileForm::csv, {verb.scene});
    check_output(verb.svg, FileForm::picture, {verb.scene});
    BenchOptions options = verb.options;
    options.wishes.by = verb.by;
    Progress progress;
    options.wishes.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    const Bench measured = bench(scene_of(verb.scene), options);
    progress.wipe();
    warn(measured.warnings);
    if (!verb.csv.empty()) write_file(verb.csv, as_csv(measured), {verb.scene});
    if (!verb.svg.empty()) write_file(verb.svg, as_svg(measured), {verb.scene});
    if (verb.json)
        show(as_json(measured));
    else
        show(as_text(measured));
    return 0;
}

}  // namespace

void add_bench(CLI::App& app, Chosen& chosen) {
    add_scene_verb<BenchVerb>(
        app, chosen,
        {.name = "bench",
         .about = say("measures speed against error, of every method"),
         .example = "alembert bench scenes/textbook/crane.toml --duration 1 --method dop853"},
        run, [](Verb& verb, BenchVerb& bench) {
            RunOptions& wishes = bench.options.wishes;
            verb.add_flag("--peers", bench.options.peers,
                          say("also CVODE, IDA, odeint, GSL, where they are installed"));
            verb.add_option("--csv", bench.csv, say("table as CSV")).type_name(values::file);
            verb.add_option("--svg", bench.svg, say("SVG picture of time against error")).type_name(values::file);
            add_duration_option(verb, wishes);
            verb.add_option("--method", wishes.method, say("this one alone")).type_name(values::method);
            add_limits(verb, wishes);
            verb.add_option("--run-seconds", bench.options.most_seconds,
                            say("processor time of the slowest runs that are of interest"))
                .type_name(values::seconds)
                .positive();
            add_code_option(verb, wishes);
            verb.add_option("--reference-seconds", bench.options.reference_seconds,
                            say("processor time for each of the reference's methods"))
                .type_name(values::seconds)
                .positive();
            add_by_option(verb, bench.by);
        });
}

}  // namespace alembert
