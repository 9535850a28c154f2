// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The processes of one job that an MPI launcher has started (mpirun, srun), and messages between them.
///
///     const std::unique_ptr<Ranks> ranks = ranks_of_launcher();      // null: this process is alone
///     ranks->send(0, "done");
///     std::string message;
///     for (int from; ranks->receive(from, message);) …
///     ranks->finish();
///
/// MPI is in alembert-mpi.so, which stands beside the program and is loaded only if the environment shows that a
/// launcher started more than one process; the program itself neither has nor needs MPI. All calls must come from
/// the thread that called ranks_of_launcher. A process that exits without `finish` ends all others.

#include <functional>
#include <memory>
#include <string>

namespace alembert {

struct Ranks {
    int rank = 0, size = 1;
    std::function<void(int to, const std::string& message)> send;
    /// False if no message has arrived. Messages from one process arrive in their order.
    std::function<bool(int& from, std::string& message)> receive;
    std::function<void()> finish;  ///< waits until all processes are there
};

/// Throws CompileError if a launcher started several processes and MPI is missing.
std::unique_ptr<Ranks> ranks_of_launcher();

/// Waits a little, and longer the more often nothing has happened in between.
class Nap {
public:
    void take();
    void wake() { microseconds_ = least; }

private:
    static constexpr unsigned least = 20, most = 2000;
    unsigned microseconds_ = least;
};

}  // namespace alembert

/// What alembert-mpi.so exports; false if MPI does not begin.
extern "C" bool alembert_mpi(alembert::Ranks& ranks);
