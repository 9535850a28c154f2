// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <utility>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/progress.hpp"
#include "commands/run_verb.hpp"
#include "commands/show.hpp"
#include "commands/streams.hpp"
#include "commands/values.hpp"
#include "commands/vary.hpp"
#include "commands/vary_from.hpp"
#include "present/report/sweep.hpp"
#include "present/report/sweep_plot.hpp"
#include "present/report/table_file.hpp"
#include "scene/lists.hpp"
#include "simulate/samples.hpp"
#include "simulate/shared_sweep.hpp"
#include "simulate/swept_store.hpp"

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
    const Sampling sampling = verb.sampling == "latin"     ? Sampling::latin
                              : verb.sampling == "uniform" ? Sampling::uniform
                                                           : Sampling::sobol;
    return sampled(ranges_of(verb.vary, scene), static_cast<std::size_t>(verb.samples), sampling,
                   static_cast<std::uint64_t>(verb.seed));
}

std::vector<Statistic> asked_statistics(const SweepVerb& verb) {
    return verb.reduce.empty() ? std::vector<Statistic>() : statistics_of(verb.reduce);
}

std::vector<std::string> asked_along(const SweepVerb& verb) {
    std::vector<std::string> words = names_of(verb.along);
    for (auto word = words.begin(); word != words.end(); ++word)
        if ((*word != "min" && *word != "max" && *word != "mean") || std::find(words.begin(), word, *word) != word)
            throw ModelError(
                say("--along {}: expected min, max or mean, each once, with commas between, as in --along "
                    "min,max",
                    verb.along));
    return words;
}

std::unique_ptr<Sweeper> sweeper_of(const SweepVerb& verb, Scene scene) {
    RunOptions wishes = verb.wishes;
    wishes.by = verb.by;
    wishes.columns = shown_names(in_words_of(scene, verb.show));
    Grid points = points_of(verb, scene);
    return std::make_unique<Sweeper>(std::move(scene), std::move(points), wishes, asked_along(verb));
}

/// Processes that share a machine have one thread each, unless the launcher or the user gives them more.
int threads_of(const SweepVerb& verb, const Ranks* ranks) {
    if (verb.threads > 0 || ranks == nullptr) return verb.threads;
    const char* const cores = std::getenv("SLURM_CPUS_PER_TASK");
    return cores == nullptr ? 1 : std::clamp(std::atoi(cores), 1, 1024);
}

/// What a process other than the first does. It says nothing: the first one speaks for all.
int help_first(const SweepVerb& verb, const Ranks& ranks) {
    run_other(
        [&] {
            Scene scene = read_scene(verb.scene);
            scene.on_warning = [](const Warning&) {};
            return sweeper_of(verb, std::move(scene));
        },
        [&](const Sweeper& sweeper) {
            return SweepShelf{.pack =
                                  [&sweeper, statistics = asked_statistics(verb)](
                                      SweepPart part, const std::vector<SweptMotion>& motions) {
                                      return packed_part(sweeper.sweep(), statistics, part, motions);
                                  },
                              .keep = {}};
        },
        {.threads = threads_of(verb, &ranks)}, ranks);
    return 0;
}

/// Before the work begins: what could only fail at its end.
void check_options(const SweepVerb& verb) {
    check_output(verb.output, FileForm::table, {verb.scene, verb.vary_from});
    check_output(verb.svg, FileForm::picture, {verb.scene, verb.vary_from});
    need_table_form(verb.output);
    asked_statistics(verb);
    if (!verb.reduce.empty() && !verb.svg.empty())
        throw ModelError(say("--svg draws the ends of motions, which --reduce does not keep; leave one out"));
    if (verb.resume && verb.output.empty())
        throw ModelError(say("--resume needs -o FILE: what is done is kept beside it, in FILE.unfinished"));
    if (verb.resume && !is_ordinary_file(verb.output))
        throw ModelError(
            say("--resume: '{}' is no ordinary file, beside which the results could be kept", verb.output));
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

/// The sweep as the first, or only, process does it.
class FirstProcess {
public:
    FirstProcess(const SweepVerb& verb, const Ranks* ranks)
        : verb_(verb),
          ranks_(ranks),
          progress_(ranks != nullptr),
          sweeper_(sweeper_of(verb, scene_of(verb.scene))) {
        sweeper_->check();
        check_size(verb, grid());
        sweeper_->compile();
        if (!verb.output.empty() && is_ordinary_file(verb.output))
            journal_.emplace(verb.output + ".unfinished", sweeper_->key() + " " + verb.reduce,
                             verb.resume ? SweepJournal::Begin::resume : SweepJournal::Begin::anew);
        store_.emplace(sweeper_->sweep(), asked_statistics(verb), journal_ ? &*journal_ : nullptr);
        resumed_ = store_->safe();
        tell_what_is_safe();
        if (verb.output.empty() && !verb.json && verb.svg.empty() && verb.reduce.empty()) show_at_once();
    }

    int go() {
        try {
            integrate();
            progress_.wipe();
            warn(sweeper_->sweep().warnings);
            write_files();
        } catch (...) {
            leave_journal();
            throw;
        }
        if (journal_) journal_->remove();
        tell_at_signal("");
        if (verb_.json)
            show(json());
        else
            show_text();
        if (ranks_ != nullptr) dismiss(*ranks_);
        return end();
    }

private:
    const Grid& grid() const { return sweeper_->sweep().grid; }

    std::string what_is_safe() const {
        return say(
            "{}: interrupted; {} of {} motions are kept in {}, and the same command with --resume goes on\n",
            verb_.scene, store_->safe(), grid().size(), journal_->path());
    }
    void tell_what_is_safe() {
        if (journal_) tell_at_signal(what_is_safe());
    }
    /// After an error.
    void leave_journal() {
        progress_.wipe();
        if (!journal_) return;
        if (store_->safe() > 0)
            warn({what_is_safe()});
        else
            journal_->remove();
        tell_at_signal("");
    }

    void show_at_once() {
        show(csv_header(sweeper_->sweep()));
        store_->give_at_once([this](const std::vector<SweptMotion>& motions) {
            for (const SweptMotion& motion : motions) totals_.add(motion, grid().names());
            progress_.wipe();
            show(csv_rows(motions));
            if (output_failed()) throw std::runtime_error("no output");  // told at the end
        });
    }

    void integrate() {
        Sweep& s = sweeper_->sweep();
        const auto takers = static_cast<std::size_t>(ranks_ == nullptr ? 1 : ranks_->size);
        const int threads = threads_of(verb_, ranks_);
        constexpr std::size_t lanes = 8, most_bytes = 1 << 25, most_reduced = 1 << 17;
        const std::vector<Statistic> statistics = asked_statistics(verb_);
        const bool reduces = !statistics.empty(), has_quantiles = with_quantiles(statistics);
        const std::size_t width = 8 * (end_columns(s).size() + along_columns(s).size() + 4);
        SweepQueue queue(parts_left(grid().size(), store_->parts()),
                         {.takers = takers,
                          .first = lanes * static_cast<std::size_t>(std::max(1, threads)),
                          .fixed = static_cast<std::size_t>(verb_.chunk),
                          .most = reduces ? most_reduced : std::clamp<std::size_t>(most_bytes / width, 1, 65536),
                          .seconds = std::max(0.5, (has_quantiles ? 0.03 : 0.001) * static_cast<double>(takers))});
        const SweepShelf shelf{.pack =
                                   [&s, &statistics](SweepPart part, const std::vector<SweptMotion>& motions) {
                                       return packed_part(s, statistics, part, motions);
                                   },
                               .keep =
                                   [this](SweepPart part, std::string bytes) {
                                       store_->keep(part, std::move(bytes));
                                       tell_what_is_safe();
                                   }};
        const SharingOptions options{.threads = threads,
                                     .progress = [&](double part) { progress_.at(say("sweeping"), part); }};
        if (ranks_ == nullptr)
            run_alone(*sweeper_, queue, shelf, options);
        else
            run_first(*sweeper_, queue, shelf, options, *ranks_);
        if (!verb_.reduce.empty()) totals_ = store_->reduction().totals();
    }

    /// All rows, which are counted the first time.
    void each(const SweptStore::Rows& take) {
        const bool count = !std::exchange(counted_, true);
        store_->each([&](const std::vector<SweptMotion>& motions) {
            if (count)
                for (const SweptMotion& motion : motions) totals_.add(motion, grid().names());
            take(motions);
        });
    }

    void write_files() {
        Sweep& s = sweeper_->sweep();
        const std::vector<std::string> inputs{verb_.scene, verb_.vary_from};
        if (!verb_.svg.empty() || (verb_.json && verb_.output.empty() && verb_.reduce.empty()))
            each([&](const std::vector<SweptMotion>& motions) {
                s.members.insert(s.members.end(), motions.begin(), motions.end());
            });
        if (!verb_.output.empty()) write_table(inputs);
        if (!verb_.svg.empty()) write_file(verb_.svg, sweep_plot(s, shown_names(verb_.show)), inputs);
        if (verb_.output.empty() && !verb_.svg.empty() && !verb_.json) show(csv_header(s) + csv_rows(s.members));
    }

    void write_table(const std::vector<std::string>& inputs) {
        const Sweep& s = sweeper_->sweep();
        const std::string& file = verb_.output;
        const auto rows = [this](const SweptStore::Rows& take) { each(take); };
        if (!verb_.reduce.empty())
            write_file(file, table_file(s, store_->reduction(), file), inputs);
        else if (!is_csv(file))
            write_file(file, table_file(s, rows, file), inputs);
        else
            write_file(
                file,
                [&](const PieceTaker& put) {
                    put(csv_header(s));
                    each([&](const std::vector<SweptMotion>& motions) { put(csv_rows(motions)); });
                },
                inputs);
    }

    Json json() const {
        const Sweep& s = sweeper_->sweep();
        Json result = as_json(s, totals_);
        if (ranks_ != nullptr) result["ranks"] = ranks_->size;
        if (verb_.resume) result["resumed"] = resumed_;
        if (!verb_.vary_from.empty()) result["vary_from"] = verb_.vary_from;
        if (verb_.samples > 0)
            result.update({{"samples", verb_.samples}, {"sampling", verb_.sampling}, {"seed", verb_.seed}});
        if (!verb_.reduce.empty()) result["reduced"] = as_json(store_->reduction());
        if (!verb_.output.empty())
            result["file"] = verb_.output;
        else if (verb_.reduce.empty())
            result["rows"] = rows_as_json(s, s.members);
        return result;
    }

    void show_text() const {
        const bool reduces = !verb_.reduce.empty();
        if (verb_.output.empty()) {
            if (reduces) show(as_csv(store_->reduction()));
            return;
        }
        std::string text = as_text(sweeper_->sweep(), totals_);
        if (ranks_ != nullptr) text += say("shared by {} processes\n", ranks_->size);
        if (resumed_ > 0) text += say("{} motions were there from before\n", resumed_);
        if (reduces) text += quantile_error_as_text(store_->reduction());
        show(text + say("wrote {}\n", verb_.output));
    }

    int end() const {
        if (totals_.failed == 0) return 0;
        std::cout.flush();
        if (verb_.reduce.empty())
            warn({say("{}: {} of {} motions failed; the table's column 'status' says why, the first at {}\n",
                      verb_.scene, totals_.failed, grid().size(), totals_.first_failure)});
        else
            warn({say("{}: {} of {} motions failed and are left out of the statistics, the first at {}\n",
                      verb_.scene, totals_.failed, grid().size(), totals_.first_failure)});
        return 4;
    }

    const SweepVerb& verb_;
    const Ranks* ranks_;
    Progress progress_;
    std::unique_ptr<Sweeper> sweeper_;
    std::optional<SweepJournal> journal_;
    std::optional<SweptStore> store_;
    SweepTotals totals_;
    std::size_t resumed_ = 0;
    bool counted_ = false;
};

int run(const SweepVerb& verb) {
    const std::unique_ptr<Ranks> ranks = ranks_of_launcher();
    if (ranks && ranks->rank > 0) return help_first(verb, *ranks);
    check_options(verb);
    return FirstProcess(verb, ranks.get()).go();
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
                .type_name(values::range);
            verb.add_option("--vary-from", options.vary_from, say("CSV: names, then a point in each line"))
                .type_name(values::file);
            verb.add_option("--samples", options.samples, say("N points in the ranges NAME=FROM:TO"))
                .type_name(values::count)
                .between(1, 2147483647);
            verb.add_option("--sampling", options.sampling, say("how they lie: sobol (default), latin, uniform"))
                .type_name(values::sampling)
                .one_of({"sobol", "latin", "uniform"})
                .needs("--samples");
            verb.add_option("--seed", options.seed, say("of the samples; default: 0"))
                .type_name(values::count)
                .between(0, 2147483647)
                .needs("--samples");
            add_run_options(verb, options);
            add_code_option(verb, options.wishes);
            verb.add_option("--threads", options.threads, say("default: as many as there are cores"))
                .type_name(values::count)
                .between(1, 1024);
            verb.add_option("--along", options.along,
                            say("also of each whole motion: min,max,mean of its coordinates"))
                .type_name(values::statistics);
            verb.add_option("--reduce", options.reduce,
                            say("statistics instead of rows: min,max,mean,median,0.95"))
                .type_name(values::statistics);
            verb.add_flag("--resume", options.resume, say("go on with a sweep to -o that was interrupted"));
            verb.add_option("--chunk", options.chunk,
                            say("motions that a process takes at once; default: by time"))
                .type_name(values::count)
                .between(1, 1'000'000'000);
            verb.add_option("--svg", options.svg, say("SVG picture: lines over one quantity, maps over two"))
                .type_name(values::file);
            add_show_option(verb, options.show, "--svg");
        });
}

}  // namespace alembert
