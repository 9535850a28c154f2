// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/bench.hpp"

#include <algorithm>
#include <iostream>

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
    const Bench measured = bench(scene_of(verb), options);
    progress.wipe();
    warn(measured.warnings);
    if (!verb.csv.empty()) write_file(verb.csv, as_csv(measured), {verb.scene});
    if (!verb.svg.empty()) write_file(verb.svg, as_svg(measured), {verb.scene});
    if (verb.json)
        show(as_json(measured));
    else
        show(as_text(measured));
    const auto failed = [](const Measured& one) { return !one.failure.empty(); };
    if (!measured.runs.empty() && std::all_of(measured.runs.begin(), measured.runs.end(), failed)) {
        std::cout.flush();
        warn({say("{}: no run has reached the end: {}\n", verb.scene, measured.runs.front().failure)});
        return 4;
    }
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
            add_given_values(verb, bench.given);
            verb.add_flag("--peers", bench.options.peers,
                          say("also CVODE, IDA, odeint, GSL, where they are installed"));
            verb.take("--output", bench.csv, say("table as CSV"));
            verb.take("--svg", bench.svg, say("SVG picture of time against error"));
            verb.take("--duration", wishes.duration);
            verb.take("--method", wishes.method, say("this one alone"));
            verb.take("--max-step", wishes.max_step);
            verb.take("--budget", wishes.budget);
            verb.add_option("--run-seconds", bench.options.most_seconds,
                            say("processor time of the slowest runs that are of interest"))
                .type_name(values::seconds)
                .positive();
            verb.take("--code", wishes.code);
            verb.take("--no-tuning", wishes.tuning);
            verb.add_option("--reference-seconds", bench.options.reference_seconds,
                            say("processor time for each of the reference's methods"))
                .type_name(values::seconds)
                .positive();
            verb.take("--by", bench.by);
        });
}

}  // namespace alembert
