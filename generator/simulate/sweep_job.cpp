// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sweep_job.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "alembert/base/argument.hpp"
#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "scene/lists.hpp"
#include "simulate/shared_sweep.hpp"

namespace alembert {

namespace {

std::vector<Statistic> asked_statistics(const std::string& list) {
    return list.empty() ? std::vector<Statistic>() : statistics_of(list);
}

std::vector<std::string> asked_along(const std::string& list) {
    std::vector<std::string> words = names_of(list);
    for (auto word = words.begin(); word != words.end(); ++word)
        if ((*word != "min" && *word != "max" && *word != "mean") || std::find(words.begin(), word, *word) != word)
            throw ModelError(
                say("--along {}: expected min, max or mean, each once, with commas between, as in --along "
                    "min,max",
                    list));
    return words;
}

std::unique_ptr<Sweeper> sweeper_of(SweepRequest& request) {
    return std::make_unique<Sweeper>(std::move(request.scene), std::move(request.grid), request.wishes,
                                     asked_along(request.along));
}

/// Processes that share a machine have one thread each, unless the launcher or the user gives them more.
int threads_of(const SweepRequest& request, const Ranks* ranks) {
    if (request.threads > 0 || ranks == nullptr) return request.threads;
    const char* const cores = std::getenv("SLURM_CPUS_PER_TASK");
    return cores == nullptr ? 1 : std::clamp(std::atoi(cores), 1, 1024);
}

auto packing(const Sweep& sweep, const std::vector<Statistic>& statistics) {
    return [&sweep, &statistics](SweepPart part, const std::vector<SweptMotion>& motions) {
        return packed_part(sweep, statistics, part, motions);
    };
}

}  // namespace

SweepJob::SweepJob(SweepRequest request, const Ranks* ranks)
    : request_(std::move(request)), ranks_(ranks), statistics_(asked_statistics(request_.reduce)) {
    argument::need_whole_nonnegative("threads", request_.threads);
    request_.threads = threads_of(request_, ranks_);
    sweeper_ = sweeper_of(request_);
    sweeper_->check();
}

SweepJob::~SweepJob() {
    if (store_ && store_->safe() == 0) drop_journal();
}

void SweepJob::prepare() {
    sweeper_->compile();
    if (!request_.journal.empty())
        journal_.emplace(request_.journal, sweeper_->key() + " " + request_.reduce,
                         request_.resume ? SweepJournal::Begin::resume : SweepJournal::Begin::anew);
    store_.emplace(sweep(), statistics_, journal_ ? &*journal_ : nullptr);
    resumed_ = store_->safe();
}

void SweepJob::give_at_once(const SweptStore::Rows& rows) {
    store_->give_at_once([this, rows](const std::vector<SweptMotion>& motions) {
        add_to_totals(motions);
        rows(motions);
    });
}

void SweepJob::add_to_totals(const std::vector<SweptMotion>& motions) {
    for (const SweptMotion& motion : motions) totals_.add(motion, sweep().grid.names());
}

SweepQueue SweepJob::queue() const {
    constexpr std::size_t lanes = 8, most_bytes = 1 << 25, most_reduced = 1 << 17;
    const Sweep& s = sweep();
    const auto takers = static_cast<std::size_t>(processes());
    const std::size_t width = 8 * (end_columns(s).size() + along_columns(s).size() + 4);
    return SweepQueue(
        parts_left(s.grid.size(), store_->parts()),
        {.takers = takers,
         .first = lanes * static_cast<std::size_t>(std::max(1, request_.threads)),
         .fixed = static_cast<std::size_t>(request_.chunk),
         .most = is_reduced() ? most_reduced : std::clamp<std::size_t>(most_bytes / width, 1, 65536),
         .seconds = std::max(0.5, (with_quantiles(statistics_) ? 0.03 : 0.001) * static_cast<double>(takers))});
}

void SweepJob::run() {
    SweepQueue parts = queue();
    const SweepShelf shelf{.pack = packing(sweep(), statistics_),
                           .keep = [this](SweepPart part, std::string bytes) {
                               store_->keep(part, std::move(bytes));
                               if (journal_ && tell_safe_) tell_safe_();
                           }};
    SharingOptions options{.threads = request_.threads};
    if (request_.wishes.progress)
        options.progress = [this](double part) { request_.wishes.progress(say("sweeping"), part); };
    if (ranks_ == nullptr)
        run_alone(*sweeper_, parts, shelf, options);
    else
        run_first(*sweeper_, parts, shelf, options, *ranks_);
    if (is_reduced()) totals_ = store_->reduction().totals();
}

void SweepJob::each(const SweptStore::Rows& rows) {
    const bool count = !std::exchange(is_counted_, true);
    store_->each([&](const std::vector<SweptMotion>& motions) {
        if (count) add_to_totals(motions);
        rows(motions);
    });
}

Sweep& SweepJob::collected() {
    Sweep& s = sweep();
    if (s.members.empty())
        each([&](const std::vector<SweptMotion>& motions) {
            s.members.insert(s.members.end(), motions.begin(), motions.end());
        });
    return s;
}

void SweepJob::drop_journal() {
    if (journal_ && !std::exchange(is_dropped_, true)) journal_->remove();
}

void SweepJob::finish() const {
    if (ranks_ != nullptr) dismiss(*ranks_);
}

void help_with_sweep(const std::function<SweepRequest()>& request, const Ranks& ranks) {
    SharingOptions options;
    std::vector<Statistic> statistics;
    run_other(
        [&] {
            SweepRequest own = request();
            options.threads = threads_of(own, &ranks);
            statistics = asked_statistics(own.reduce);
            return sweeper_of(own);
        },
        [&](const Sweeper& sweeper) {
            return SweepShelf{.pack = packing(sweeper.sweep(), statistics), .keep = {}};
        },
        options, ranks);
}

}  // namespace alembert
