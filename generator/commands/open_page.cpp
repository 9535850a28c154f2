// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/open_page.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "alembert/native/process.hpp"

namespace alembert {

namespace {

bool is_set(const char* variable) {
    const char* const value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

/// The program goes on after this one, and says nothing between its lines.
void start(std::string program, std::string argument) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    char* const argv[] = {program.data(), argument.data(), nullptr};
    pid_t child = 0;
    posix_spawn(&child, program.c_str(), &actions, &attributes, argv, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
}

}  // namespace

void open_page(const std::string& file) {
    if (isatty(STDOUT_FILENO) == 0 || (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))) return;
    const std::filesystem::path program = find_program("xdg-open");
    if (!program.empty()) start(program.string(), std::filesystem::absolute(file).string());
}

}  // namespace alembert
