// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A whole sweep, from a scene and points to rows or statistics: by one process or by all of a cluster's, in
/// memory or with a journal on disk, from which it goes on after an interruption. The command and Python run this.
///
///     SweepJob job({.scene = read_scene("crane.toml"), .grid = {{{"l", 1, 9, 100}}}, .reduce = "min,max,0.95"});
///     job.prepare();
///     job.run();
///     job.reduction().rows();                                         // or, without `reduce`,
///     job.each([&](const std::vector<SweptMotion>& motions) { … });   // in the order of the points
///     job.totals().failed;
///     job.drop_journal();                                             // when the results are stored elsewhere
///
/// The rows and statistics do not depend on the number of processes and threads, nor on interruptions.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulate/ranks.hpp"
#include "simulate/sweep_queue.hpp"
#include "simulate/sweeper.hpp"
#include "simulate/swept_store.hpp"

namespace alembert {

struct SweepRequest {
    Scene scene;
    Grid grid;
    RunOptions wishes = {};    ///< `progress` is called while motions are integrated
    std::string along = {};    ///< of min, max, mean, with commas between: what is known along each motion
    std::string reduce = {};   ///< statistics (sweep_reduction.hpp); if empty, all rows are kept
    std::string journal = {};  ///< the file for what is done; empty for memory
    bool resume = false;       ///< whether to begin with what the journal has from before
    long chunk = 0;            ///< motions that a process takes at once; 0 for by their time
    int threads = 0;  ///< 0 for as many as there are cores, or with other processes as the launcher gives each
};

class SweepJob {
public:
    /// Derives and makes the checks that need no compiler. `ranks`, for the first of several processes, must
    /// outlive it. Throws what Sweeper and Sweeper::check throw; ModelError for a word that `along` and `reduce`
    /// cannot have; std::invalid_argument for a negative number of threads.
    explicit SweepJob(SweepRequest request, const Ranks* ranks = nullptr);
    SweepJob(const SweepJob&) = delete;
    SweepJob& operator=(const SweepJob&) = delete;
    /// Removes the journal if nothing is in it.
    ~SweepJob();

    /// Compiles and opens the journal. Throws what Sweeper::compile and SweepJournal throw.
    void prepare();
    /// Rows are given away as soon as all before them were, instead of being kept: without statistics and journal.
    void give_at_once(const SweptStore::Rows& rows);
    /// `tell` is called after each part that is on disk, by one thread at a time.
    void on_safe(std::function<void()> tell) { tell_safe_ = std::move(tell); }
    /// Integrates. What the journal has stays there if this throws.
    void run();

    /// All rows in the order of the points.
    void each(const SweptStore::Rows& rows);
    /// The sweep with all its rows in memory.
    Sweep& collected();
    bool is_reduced() const { return !statistics_.empty(); }
    const SweepReduction& reduction() const { return store_->reduction(); }
    /// Known after `each`, or with statistics.
    const SweepTotals& totals() const { return totals_; }
    Sweep& sweep() { return sweeper_->sweep(); }
    const Sweep& sweep() const { return sweeper_->sweep(); }

    int processes() const { return ranks_ == nullptr ? 1 : ranks_->size; }
    bool is_shared() const { return ranks_ != nullptr; }
    bool resumes() const { return request_.resume; }
    /// How many motions were there from before, and how many would not have to be repeated after an interruption.
    std::size_t resumed() const { return resumed_; }
    std::size_t safe() const { return store_ ? store_->safe() : 0; }
    /// The file in which they are; empty for none.
    const std::string& journal() const { return request_.journal; }
    void drop_journal();
    /// Lets the other processes end.
    void finish() const;

private:
    void add_to_totals(const std::vector<SweptMotion>& motions);
    SweepQueue queue() const;

    SweepRequest request_;  ///< without scene and grid, which the sweeper has
    const Ranks* ranks_;
    std::vector<Statistic> statistics_;
    std::unique_ptr<Sweeper> sweeper_;
    std::optional<SweepJournal> journal_;
    std::optional<SweptStore> store_;
    std::function<void()> tell_safe_;
    SweepTotals totals_;
    std::size_t resumed_ = 0;
    bool is_counted_ = false, is_dropped_ = false;
};

/// What a process other than the first does: it says nothing, and integrates what the first one gives it. What is
/// thrown, by `request` too, is sent to the first.
void help_with_sweep(const std::function<SweepRequest()>& request, const Ranks& ranks);

}  // namespace alembert
