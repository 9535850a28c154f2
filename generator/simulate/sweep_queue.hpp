// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The one queue from which processes and threads take the parts of a sweep.
///
///     SweepQueue queue(parts_left(grid.size(), done), {.takers = 8});
///     while (const auto part = queue.next()) { …; queue.done(*part); }
///
/// A part is as long as one taker needs a wished time for, measured on what is done, and near the end of the queue
/// it is shorter, so that all takers end at about the same time (guided self-scheduling; Polychronopoulos & Kuck,
/// IEEE Trans. Comput. C-36 (1987) 1425). All functions may be called by several threads.

#include <chrono>
#include <mutex>
#include <optional>
#include <vector>

#include "simulate/sweep.hpp"

namespace alembert {

/// What is left of so many motions when these parts are done; in order.
std::vector<SweepPart> parts_left(std::size_t size, std::vector<SweepPart> done);

struct QueueOptions {
    std::size_t takers = 1;    ///< processes
    std::size_t first = 8;     ///< motions of a part, until times are known
    std::size_t fixed = 0;     ///< motions of each part; 0 means by time
    std::size_t most = 65536;  ///< motions of a part
    double seconds = 0.5;      ///< of a part, on one taker
};

class SweepQueue {
public:
    SweepQueue(std::vector<SweepPart> left, const QueueOptions& options);

    std::optional<SweepPart> next();
    void done(const SweepPart& part);
    /// Nothing is given any more.
    void close();
    /// Is everything that was given done?
    bool is_done() const;
    /// The part that is done of all motions, those that were done before included.
    double fraction(std::size_t all) const;

private:
    using Clock = std::chrono::steady_clock;
    std::size_t length() const;

    mutable std::mutex mutex_;
    std::vector<SweepPart> left_;  ///< the next one last
    QueueOptions options_;
    std::size_t waiting_ = 0, given_ = 0, ended_ = 0;  ///< motions
    std::optional<Clock::time_point> begin_;
};

}  // namespace alembert
