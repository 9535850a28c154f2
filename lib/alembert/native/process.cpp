// SPDX-License-Identifier: MIT
#include "alembert/native/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>

#include "alembert/base/error.hpp"
#include "alembert/base/interrupt.hpp"
#include "alembert/native/program_path.hpp"
#include "alembert/native/temporary_file.hpp"

namespace alembert {
namespace {

std::vector<char*> pointers(const std::vector<std::string>& texts) {
    std::vector<char*> list;
    for (const std::string& text : texts) list.push_back(const_cast<char*>(text.c_str()));
    list.push_back(nullptr);
    return list;
}

std::vector<std::string> english_environment() {
    std::vector<std::string> list;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry;
        if (!text.starts_with("LC_ALL=") && !text.starts_with("LANGUAGE=")) list.emplace_back(text);
    }
    list.emplace_back("LC_ALL=C");
    return list;
}

/// Reads until the last process that writes has closed its end. Whoever waits may end that.
std::string read_all(int descriptor) {
    constexpr int moment = 50;  // ms
    std::string text;
    std::array<char, 4096> block;
    for (;;) {
        ask_whether_wanted();
        pollfd ready{.fd = descriptor, .events = POLLIN, .revents = 0};
        if (on_long_work != nullptr && poll(&ready, 1, moment) <= 0) continue;
        const ssize_t count = read(descriptor, block.data(), block.size());
        if (count > 0) text.append(block.data(), static_cast<std::size_t>(count));
        if (count == 0 || (count < 0 && errno != EINTR)) return text;
    }
}

int wait_for(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return 127;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// Holds signals back between the start of a child and its entry into the list of children.
class SignalsHeld {
public:
    SignalsHeld() {
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before);
    }
    SignalsHeld(const SignalsHeld&) = delete;
    SignalsHeld& operator=(const SignalsHeld&) = delete;
    ~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before, nullptr); }
    sigset_t before;
};

/// Starts a program as the leader of a group of its own, so that what it starts can be ended with it.
int spawn(pid_t& child, const std::vector<std::string>& argv, int output, const sigset_t& mask) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setsigmask(&attributes, &mask);
    const std::vector<std::string> environment = english_environment();
    const int failure = posix_spawn(&child, argv[0].c_str(), &actions, &attributes, pointers(argv).data(),
                                    pointers(environment).data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return failure;
}

bool is_program(const std::filesystem::path& path) {
    struct stat info {};
    return stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode) && access(path.c_str(), X_OK) == 0;
}

}  // namespace

Process run(const std::vector<std::string>& argv) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw CompileError(std::string("cannot make a pipe to a child process: ") + std::strerror(errno));

    pid_t child = 0;
    int failure = 0;
    std::optional<RunningGroup> group;
    {
        const SignalsHeld held;
        failure = spawn(child, argv, ends[1], held.before);
        if (failure == 0) group.emplace(child);
    }
    close(ends[1]);
    if (failure != 0) {
        close(ends[0]);
        throw CompileError("cannot start " + argv[0] + ": " + std::strerror(failure));
    }
    std::string output;
    try {
        output = read_all(ends[0]);
    } catch (...) {
        kill(-child, SIGKILL);
        close(ends[0]);
        wait_for(child);
        throw;
    }
    close(ends[0]);
    return {.status = wait_for(child), .output = std::move(output)};
}

std::filesystem::path find_program(const std::string& program) {
    if (program.empty()) return {};
    if (program.find('/') != std::string::npos) return is_program(program) ? program : std::string();
    const char* const path = std::getenv("PATH");
    std::string_view rest = path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
    while (!rest.empty()) {
        const std::string_view folder = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(folder.size() + 1, rest.size()));
        if (folder.empty()) continue;
        if (auto file = std::filesystem::path(folder) / program; is_program(file)) return file;
    }
    return {};
}

std::filesystem::path beside_this_program(const std::string& name) {
    std::error_code failed;
    const std::filesystem::path homes[] = {std::filesystem::read_symlink("/proc/self/exe", failed), own_file()};
    for (const std::filesystem::path& home : homes) {
        const std::filesystem::path beside = home.parent_path() / name;
        if (!home.empty() && std::filesystem::exists(beside, failed))
            return std::filesystem::absolute(beside, failed);
    }
    return {};
}

}  // namespace alembert
