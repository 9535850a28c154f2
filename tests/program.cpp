// SPDX-License-Identifier: MIT
#include "shell.hpp"

#include <fcntl.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "files.hpp"

namespace alembert::test {

namespace {

/// Lives as long as the test process.
struct Folder {
    std::filesystem::path path;
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "alembert-test-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path = name;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
};

const std::filesystem::path& folder() {
    static const Folder one;
    return one.path;
}

double seconds_of(const rusage& usage) {
    return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

void set_environment() {
    setenv("XDG_CACHE_HOME", (folder() / "cache").c_str(), 1);
    setenv("ALEMBERT", ALEMBERT_PROGRAM, 1);
}

[[noreturn]] void become(const char* program, const std::vector<std::string>& args) {
    std::vector<char*> argv{const_cast<char*>(program)};
    for (const std::string& arg : args) argv.push_back(const_cast<char*>(arg.c_str()));
    argv.push_back(nullptr);
    execv(program, argv.data());
    _exit(127);
}

std::vector<std::string> shell_words(const std::string& script, const std::vector<std::string>& args) {
    std::vector<std::string> words{"-c", script, "sh"};
    words.insert(words.end(), args.begin(), args.end());
    return words;
}

Run execute(const char* program, const std::vector<std::string>& args) {
    const std::filesystem::path out = folder() / "out", err = folder() / "err";
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) {
        const auto redirect = [](const std::filesystem::path& file, int to) {
            const int fd = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
            if (fd < 0 || dup2(fd, to) < 0) _exit(126);
        };
        redirect(out, STDOUT_FILENO);
        redirect(err, STDERR_FILENO);
        set_environment();
        become(program, args);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    return {.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            .out = contents(out),
            .err = contents(err),
            .seconds = seconds_of(usage),
            .megabytes = usage.ru_maxrss / 1024};
}

}  // namespace

Run run(const std::vector<std::string>& args) {
    return execute(ALEMBERT_PROGRAM, args);
}

Run run_shell(const std::string& script, const std::vector<std::string>& args) {
    return execute("/bin/sh", shell_words(script, args));
}

std::string on_terminal(const std::string& script, const std::vector<std::string>& args, int columns) {
    winsize size{};
    size.ws_row = 24;
    size.ws_col = static_cast<unsigned short>(columns);
    int master = -1;
    const pid_t child = forkpty(&master, nullptr, nullptr, &size);
    if (child < 0) throw std::runtime_error("forkpty failed");
    if (child == 0) {
        set_environment();
        become("/bin/sh", shell_words(script, args));
    }
    std::string shown;
    char bytes[4096];
    for (ssize_t count = 0; (count = read(master, bytes, sizeof bytes)) > 0;)
        shown.append(bytes, static_cast<std::size_t>(count));
    close(master);
    int status = 0;
    waitpid(child, &status, 0);
    return shown;
}

std::string temporary(const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
}

std::string temporary_folder(const std::string& name) {
    const std::filesystem::path path = folder() / name;
    std::filesystem::remove_all(path);
    std::filesystem::create_directory(path);
    return path.string();
}

}  // namespace alembert::test
