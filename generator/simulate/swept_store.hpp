// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The results of a sweep as they come, in any order: the ends of all motions, or their statistics. With a journal
/// they are on disk, and the store begins with what is there already.
///
///     SweepJournal journal("table.csv.unfinished", sweeper.key(), SweepJournal::Begin::resume);
///     SweptStore store(sweeper.sweep(), {}, &journal);
///     store.keep({0, 8}, packed_part(sweeper.sweep(), {}, {0, 8}, motions));
///     store.each([&](const std::vector<SweptMotion>& motions) { … });          // in the order of the points
///
/// Statistics are written to the journal as a whole: every half second, or less often if that takes long.

#include <chrono>
#include <functional>
#include <map>
#include <optional>

#include "simulate/sweep_journal.hpp"
#include "simulate/sweep_reduction.hpp"
#include "simulate/sweep_rows.hpp"

namespace alembert {

/// What one process sends for its part.
std::string packed_part(const Sweep& sweep, const std::vector<Statistic>& statistics, SweepPart part,
                        const std::vector<SweptMotion>& motions);

class SweptStore {
public:
    using Rows = std::function<void(const std::vector<SweptMotion>&)>;

    /// Without statistics it keeps all ends; without a journal it does so in memory. Both must outlive it.
    SweptStore(const Sweep& sweep, std::vector<Statistic> statistics, SweepJournal* journal);

    /// Rows are given to `rows` as soon as all before them were, and not kept. Only without journal and
    /// statistics.
    void give_at_once(Rows rows) { rows_ = std::move(rows); }
    /// One thread at a time.
    void keep(SweepPart part, std::string bytes);

    std::vector<SweepPart> parts() const;
    /// How many motions would not have to be repeated after an interruption now.
    std::size_t safe() const { return safe_; }
    void each(const Rows& rows) const;
    const SweepReduction& reduction() const { return *reduction_; }

private:
    void read_journal();
    void reduce(SweepPart part, std::string_view bytes);
    void write_reduction();

    const Sweep& s_;
    SweepJournal* journal_;
    Rows rows_;
    std::map<std::size_t, std::size_t> parts_;  ///< counts by first motions; neighbours are one
    std::map<std::size_t, std::pair<SweepPart, std::string>> memory_;  ///< by first motions
    std::optional<SweepReduction> reduction_;
    std::size_t safe_ = 0, given_ = 0, kept_ = 0;
    std::chrono::steady_clock::time_point next_writing_;
};

}  // namespace alembert
