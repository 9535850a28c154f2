// SPDX-License-Identifier: GPL-2.0-or-later
#include "report/bench.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/show.hpp"
#include "commands/verb.hpp"

namespace alembert {

namespace {

struct BenchVerb : SceneOptions {
    BenchOptions options;
    std::string csv, svg;
};

int run(const BenchVerb& verb) {
    for (const std::string& file : {verb.csv, verb.svg}) check_output(file, {verb.scene});
    BenchOptions options = verb.options;
    options.wishes.by = verb.by;
    Progress progress;
    options.wishes.progress = [&progress](std::string_view what, double part) { progress.at(what, part); };
    const Bench measured = bench(read_scene(verb.scene), options);
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
        app, chosen, "bench", "speed against error: every method over a range of tolerances, against a reference",
        run, [](CLI::App& verb, BenchVerb& bench) {
            RunOptions& wishes = bench.options.wishes;
            verb.add_flag("--peers", bench.options.peers,
                          "CVODE, IDA, odeint and GSL too, on the same right-hand side, where they are installed");
            verb.add_option("--csv", bench.csv, "CSV file");
            verb.add_option("--svg", bench.svg, "work-precision plot");
            verb.add_option("--duration", wishes.duration, "seconds from the start")->check(nonnegative_number());
            verb.add_option("--method", wishes.method, "this one alone");
            verb.add_option("--max-step", wishes.max_step,
                            "longest step, in seconds, for methods that choose their steps")
                ->check(positive_number());
            verb.add_option("--budget", wishes.budget, "right-hand sides of one run, at the most")
                ->check(positive_number());
            verb.add_option("--reference-seconds", bench.options.reference_seconds,
                            "processor time for each of the reference's methods")
                ->check(positive_number());
        });
}

}  // namespace alembert
