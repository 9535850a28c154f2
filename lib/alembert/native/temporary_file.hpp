// SPDX-License-Identifier: MIT
#pragma once

/// Removes what a process must not leave behind, however it ends: temporary files, temporary folders, child
/// processes.
///
///     const TemporaryFile part(folder / ".result.part");  // from now on it is removed when the block ends,
///     ... write it, rename it ...                        // (nothing is left under that name after the rename)
///
///     extern "C" void on_signal(int) { remove_leftovers(); ... }   // and when the program ends by a signal
///
/// The library installs no signal handlers; a program that wants this after signals calls remove_leftovers() in
/// its own.

#include <sys/types.h>

#include <filesystem>

namespace alembert {

/// A file, or a folder with the files in it, that is removed when this object goes out of scope in the process
/// that made it. It need not exist.
class TemporaryFile {
public:
    explicit TemporaryFile(std::filesystem::path path);
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile();

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    pid_t owner_;
    int slot_;  ///< the place in the list for signals; negative if the list is full
};

/// A process group that is ended too if a signal ends this process.
class RunningGroup {
public:
    explicit RunningGroup(pid_t leader);
    RunningGroup(const RunningGroup&) = delete;
    RunningGroup& operator=(const RunningGroup&) = delete;
    ~RunningGroup();

private:
    int slot_;
};

/// Ends all running groups and removes all leftovers of this process. Async-signal-safe.
void remove_leftovers() noexcept;

}  // namespace alembert
