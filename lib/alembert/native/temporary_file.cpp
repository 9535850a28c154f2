// SPDX-License-Identifier: MIT
// Two lists of fixed size, which a signal handler can read at any moment, because no memory is allocated and no
// lock is taken.
#include "alembert/native/temporary_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <utility>

namespace alembert {
namespace {

struct Slot {
    std::atomic<int> state = free_;
    std::array<char, 1024> path = {};
    static constexpr int free_ = 0, being_filled = 1, full = 2;
};

std::array<Slot, 64> files;
std::array<std::atomic<pid_t>, 64> groups;

int enter(const std::filesystem::path& path) {
    if (path.native().size() >= files[0].path.size()) return -1;
    for (std::size_t i = 0; i < files.size(); ++i) {
        int expected = Slot::free_;
        if (!files[i].state.compare_exchange_strong(expected, Slot::being_filled)) continue;
        std::memcpy(files[i].path.data(), path.c_str(), path.native().size() + 1);
        files[i].state = Slot::full;
        return static_cast<int>(i);
    }
    return -1;
}

/// Removes a file, or a folder and the files in it.
void remove_now(const char* path) noexcept {
    if (unlink(path) == 0) return;
    const int folder = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0) return;
    alignas(dirent64) std::array<char, 4096> block;
    auto* const entries = reinterpret_cast<dirent64*>(block.data());
    for (ssize_t size = 0; (size = getdents64(folder, entries, block.size())) > 0;)
        for (ssize_t at = 0; at < size;) {
            const auto* const entry = reinterpret_cast<const dirent64*>(block.data() + at);
            unlinkat(folder, entry->d_name, 0);
            at += entry->d_reclen;
        }
    close(folder);
    rmdir(path);
}

}  // namespace

TemporaryFile::TemporaryFile(std::filesystem::path path)
    : path_(std::filesystem::absolute(path)), owner_(getpid()), slot_(enter(path_)) {}

TemporaryFile::~TemporaryFile() {
    if (owner_ != getpid()) return;
    std::error_code none;
    std::filesystem::remove_all(path_, none);
    if (slot_ >= 0) files[static_cast<std::size_t>(slot_)].state = Slot::free_;
}

RunningGroup::RunningGroup(pid_t leader) : slot_(-1) {
    for (std::size_t i = 0; i < groups.size() && slot_ < 0; ++i) {
        pid_t expected = 0;
        if (groups[i].compare_exchange_strong(expected, leader)) slot_ = static_cast<int>(i);
    }
}

RunningGroup::~RunningGroup() {
    if (slot_ >= 0) groups[static_cast<std::size_t>(slot_)] = 0;
}

void remove_leftovers() noexcept {
    for (const std::atomic<pid_t>& group : groups) {
        const pid_t leader = group;
        if (leader <= 0) continue;
        kill(-leader, SIGTERM);  // compilers then remove their own temporary files
        waitpid(leader, nullptr, 0);
    }
    for (const Slot& file : files)
        if (file.state == Slot::full) remove_now(file.path.data());
}

}  // namespace alembert
