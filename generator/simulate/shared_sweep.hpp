// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A sweep by one process, or by several that share one queue. The first process (rank 0) has the queue and keeps
/// the results; it integrates too, on threads of its own beside the one that serves. The others ask for a part
/// before they need it, so that they do not wait. One message takes a part's results to the first process, one
/// asks for the next part, and one answers.
///
///     SweepShelf shelf{.pack = …, .keep = …};
///     if (ranks == nullptr) run_alone(sweeper, queue, shelf, {.threads = 4});
///     else if (ranks->rank == 0) run_first(sweeper, queue, shelf, {}, *ranks);
///     else run_other(sweeper, shelf, {}, *ranks);

#include "simulate/ranks.hpp"
#include "simulate/sweep_queue.hpp"
#include "simulate/sweeper.hpp"

namespace alembert {

/// What becomes of results.
struct SweepShelf {
    /// In the process that integrated, by several threads at once.
    std::function<std::string(SweepPart, const std::vector<SweptMotion>&)> pack;
    std::function<void(SweepPart, std::string bytes)> keep;  ///< in the first process, by one thread at a time
};

struct SharingOptions {
    int threads = 0;  ///< of this process; 0 for as many as there are cores
    std::function<void(double part)> progress = {};
};

/// Throws what the sweeper and the shelf throw.
void run_alone(Sweeper& sweeper, SweepQueue& queue, const SweepShelf& shelf, const SharingOptions& options);

/// The same with the other processes. Throws CompileError for an error in one of them. The sweep's time is that of
/// all.
void run_first(Sweeper& sweeper, SweepQueue& queue, const SweepShelf& shelf, const SharingOptions& options,
               const Ranks& ranks);

/// Lets the others go, when the results are kept.
void dismiss(const Ranks& ranks);

/// `make` derives; the sweeper is compiled when the first process has done so, which leaves the object in the
/// cache. Ends when the first process dismisses it. What is thrown in between is sent to the first process.
void run_other(const std::function<std::unique_ptr<Sweeper>()>& make,
               const std::function<SweepShelf(const Sweeper&)>& shelf_of, const SharingOptions& options,
               const Ranks& ranks);

}  // namespace alembert
