// SPDX-License-Identifier: GPL-2.0-or-later
#include <iostream>
#include <stdexcept>
#include <utility>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/run_verb.hpp"
#include "commands/show.hpp"
#include "commands/streams.hpp"
#include "commands/sweep_table.hpp"
#include "commands/values.hpp"
#include "commands/vary.hpp"
#include "commands/vary_from.hpp"
#include "present/report/sweep.hpp"
#include "present/report/sweep_plot.hpp"
#include "simulate/samples.hpp"
#include "simulate/sweep_job.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_in_memory = 1'000'000;  // motions, for pictures and rows of JSON

struct SweepVerb : RunVerb {
    std::vector<std::string> vary;
    std::string vary_from;  ///< a table of points; empty for none
    long samples = 0;       ///< how many points in the ranges; 0 for a grid
    std::string sampling = "sobol";
    long seed = 0;
    int threads = 0;
    std::string along;    ///< of min, max, mean, with commas
    std::string reduce;   ///< statistics, with commas; empty for rows
    bool resume = false;  ///< whether to go on with what an interrupted sweep has left
    long chunk = 0;       ///< motions that a process takes at once; 0 for by their time
    std::string svg;      ///< an SVG picture; empty for none
    std::string show;     ///< the names of the columns that it shows, with commas; if empty, the coordinates
};

Grid points_of(const SweepVerb& verb, const Scene& scene) {
    if (!verb.vary_from.empty()) {
        if (!verb.vary.empty() || verb.samples > 0)
            throw ModelError(say("--vary-from has all points; leave --vary and --samples out"));
        return grid_from_file(verb.vary_from, scene);
    }
    if (verb.samples == 0) return grid_of(verb.vary, scene);
    return sampled(ranges_of(verb.vary, scene), static_cast<std::size_t>(verb.samples), sampling_of(verb.sampling),
                   static_cast<std::uint64_t>(verb.seed));
}

Json points_as_json(const SweepVerb& verb) {
    Json points = Json::object();
    if (!verb.vary_from.empty()) points["vary_from"] = verb.vary_from;
    if (verb.samples > 0)
        points.update({{"samples", verb.samples}, {"sampling", verb.sampling}, {"seed", verb.seed}});
    return points;
}

SweepRequest request_of(const SweepVerb& verb, Scene scene, const std::string& journal = {}) {
    RunOptions wishes = verb.wishes;
    wishes.by = verb.by;
    wishes.columns = shown_names(in_words_of(scene, verb.show));
    Grid points = points_of(verb, scene);
    for (const Axis& axis : points.axes)
        for (const auto& [name, value] : overrides_of(verb.given.at, scene))
            if (axis.name == name)
                throw ModelError(say("'{}' is varied, and --at gives it one value; leave one out", name));
    return {.scene = std::move(scene),
            .grid = std::move(points),
            .wishes = std::move(wishes),
            .along = verb.along,
            .reduce = verb.reduce,
            .journal = journal,
            .resume = verb.resume,
            .chunk = verb.chunk,
            .threads = verb.threads};
}

/// What a process other than the first does. It says nothing: the first one speaks for all.
int help_first(const SweepVerb& verb, const Ranks& ranks) {
    help_with_sweep(
        [&] {
            Scene scene = read_scene(verb.scene);
            scene.on_warning = [](const Warning&) {};
            return request_of(verb, std::move(scene));
        },
        ranks);
    return 0;
}

/// Before the work begins: what could only fail at its end.
void check_options(const SweepVerb& verb) {
    check_output(verb.svg, FileForm::picture, {verb.scene, verb.vary_from});
    check_sweep_table(verb.output, verb.resume, {verb.scene, verb.vary_from});
    if (!verb.reduce.empty()) statistics_of(verb.reduce);
    if (!verb.reduce.empty() && !verb.svg.empty())
        throw ModelError(say("--svg draws the ends of motions, which --reduce does not keep; leave one out"));
}

void check_size(const SweepVerb& verb, const Grid& grid) {
    if (!verb.svg.empty()) need_pictured(grid);
    if (grid.size() <= most_in_memory || !verb.reduce.empty()) return;
    if (verb.json && verb.output.empty())
        throw ModelError(
            say("--json has the rows of at most {} motions, and these are {}; add -o FILE, or --reduce",
                most_in_memory, grid.size()));
    if (!verb.svg.empty())
        throw ModelError(say("--svg draws at most {} motions, and these are {}; leave it out, or take fewer",
                             most_in_memory, grid.size()));
}

/// The sweep as the first, or only, process shows it.
class ShownSweep {
public:
    ShownSweep(const SweepVerb& verb, const Ranks* ranks)
        : verb_(verb), progress_(ranks != nullptr), job_(request(), ranks) {
        check_size(verb, grid());
        job_.prepare();
        tell_what_is_safe();
        job_.on_safe([this] { tell_what_is_safe(); });
        if (verb.output.empty() && !verb.json && verb.svg.empty() && verb.reduce.empty()) show_at_once();
    }

    int go() {
        try {
            job_.run();
            progress_.wipe();
            warn(job_.sweep().warnings);
            write_files();
        } catch (...) {
            progress_.wipe();
            if (job_.safe() > 0 && !job_.journal().empty()) warn({what_is_safe()});
            tell_at_signal("");
            throw;
        }
        job_.drop_journal();
        tell_at_signal("");
        if (verb_.json)
            show(json());
        else
            show_text();
        job_.finish();
        return end();
    }

private:
    const Grid& grid() const { return job_.sweep().grid; }

    SweepRequest request() {
        SweepRequest asked = request_of(verb_, scene_of(verb_), journal_beside(verb_.output));
        asked.wishes.progress = [this](std::string_view what, double part) { progress_.at(what, part); };
        return asked;
    }

    std::string what_is_safe() const {
        return say(
            "{}: interrupted; {} of {} motions are kept in {}, and the same command with --resume goes on\n",
            verb_.scene, job_.safe(), grid().size(), job_.journal());
    }
    void tell_what_is_safe() {
        if (!job_.journal().empty()) tell_at_signal(what_is_safe());
    }

    void show_at_once() {
        show(csv_header(job_.sweep()));
        job_.give_at_once([this](const std::vector<SweptMotion>& motions) {
            progress_.wipe();
            show(csv_rows(motions));
            if (output_failed()) throw std::runtime_error("no output");  // told at the end
        });
    }

    void write_files() {
        const std::vector<std::string> inputs{verb_.scene, verb_.vary_from};
        if (!verb_.svg.empty() || (verb_.json && verb_.output.empty() && verb_.reduce.empty())) job_.collected();
        if (!verb_.output.empty()) write_sweep_table(job_, verb_.output, inputs);
        if (verb_.svg.empty()) return;
        const Sweep& s = job_.sweep();
        write_file(verb_.svg, sweep_plot(s, shown_names(verb_.show)), inputs);
        if (verb_.output.empty() && !verb_.json) show(csv_header(s) + csv_rows(s.members));
    }

    Json json() const {
        Json result = as_json(job_, points_as_json(verb_), verb_.output);
        if (verb_.output.empty() && verb_.reduce.empty())
            result["rows"] = rows_as_json(job_.sweep(), job_.sweep().members);
        return result;
    }

    void show_text() const {
        if (!verb_.output.empty())
            show(as_text(job_, verb_.output));
        else if (job_.is_reduced())
            show(as_csv(job_.reduction()));
    }

    int end() const {
        const SweepTotals& totals = job_.totals();
        if (totals.failed == 0) return 0;
        std::cout.flush();
        if (verb_.reduce.empty())
            warn({say("{}: {} of {} motions failed; the table's column 'status' says why, the first at {}\n",
                      verb_.scene, totals.failed, grid().size(), totals.first_failure)});
        else
            warn({say("{}: {} of {} motions failed and are left out of the statistics, the first at {}\n",
                      verb_.scene, totals.failed, grid().size(), totals.first_failure)});
        return 4;
    }

    const SweepVerb& verb_;
    Progress progress_;
    SweepJob job_;
};

int run(const SweepVerb& verb) {
    const std::unique_ptr<Ranks> ranks = ranks_of_launcher();
    if (ranks && ranks->rank > 0) return help_first(verb, *ranks);
    check_options(verb);
    return ShownSweep(verb, ranks.get()).go();
}

}  // namespace

void add_sweep(CLI::App& app, Chosen& chosen) {
    add_scene_verb<SweepVerb>(
        app, chosen,
        {.name = "sweep",
         .about = say("integrates from many initial states or with many parameters"),
         .example = "alembert sweep scenes/textbook/crane.toml --vary l=1:9:100"},
        run, [](Verb& verb, SweepVerb& options) {
            verb.take("--vary", options.vary, say("NAME=FROM:TO:COUNT; several make a grid"));
            verb.add_option("--vary-from", options.vary_from, say("CSV: names, then a point in each line"))
                .type_name(values::file);
            verb.add_option("--samples", options.samples, say("N points in the ranges NAME=FROM:TO"))
                .type_name(values::count)
                .between(1, 2147483647);
            verb.add_option("--sampling", options.sampling, say("how they lie: sobol (default), latin, uniform"))
                .type_name(values::sampling);
            verb.add_option("--seed", options.seed, say("of the samples; default: 0"))
                .type_name(values::count)
                .between(0, 2147483647);
            add_run_options(verb, options);
            verb.add_option("--threads", options.threads, say("default: as many as there are cores"))
                .type_name(values::count)
                .between(1, 1024);
            verb.add_option("--along", options.along, say("also of whole motions: min,max,mean of coordinates"))
                .type_name(values::statistics);
            verb.add_option("--reduce", options.reduce,
                            say("statistics instead of rows: min,max,mean,median,0.95"))
                .type_name(values::statistics);
            verb.add_flag("--resume", options.resume, say("go on with a sweep to -o that was interrupted"));
            verb.add_option("--chunk", options.chunk, say("motions that a process takes at once"))
                .type_name(values::count)
                .between(1, 1'000'000'000);
            verb.take("--svg", options.svg, say("SVG picture: lines over one quantity, maps over two"));
            verb.take("--show", options.show);
        });
}

}  // namespace alembert
