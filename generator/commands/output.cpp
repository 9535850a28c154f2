// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>
#include <tuple>

#include "alembert/base/error.hpp"
#include "alembert/native/temporary_file.hpp"
#include "base/language/say.hpp"
#include "commands/streams.hpp"

namespace alembert {

namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // the kernel follows as many

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw CompileError(say("cannot write '{}': {}", path, reason));
}

/// An open file that is closed at the end of the block.
struct Descriptor {
    explicit Descriptor(int opened) : number(opened) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (number >= 0) close(number);
    }
    int number;
};

/// The target of a path after links: a file that exists or is to be made, or a descriptor of this process
/// (/dev/stdout).
struct Target {
    fs::path file;
    std::optional<int> descriptor = {};
};

std::optional<int> own_descriptor(const fs::path& file) {
    std::error_code none;
    if (fs::canonical(file.parent_path(), none) != fmt::format("/proc/{}/fd", getpid())) return {};
    const std::string name = file.filename().string();
    int number = -1;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    return error == std::errc() && end == name.data() + name.size() ? std::optional(number) : std::nullopt;
}

Target target_of(const std::string& path) {
    if (path.empty()) throw ModelError(say("the name of the file to be written is empty"));
    fs::path file = fs::absolute(path);
    for (int k = 0; k < most_links; ++k) {
        if (const std::optional<int> number = own_descriptor(file)) return {file, number};
        std::error_code none;
        const fs::path next = fs::read_symlink(file, none);
        if (none) return {file};
        file = file.parent_path() / next;
    }
    fail(path, std::strerror(ELOOP));
}

/// The status of the existing file.
std::optional<struct stat> status_of(const Target& target) {
    struct stat info {};
    const bool there =
        target.descriptor ? fstat(*target.descriptor, &info) == 0 : stat(target.file.c_str(), &info) == 0;
    return there ? std::optional(info) : std::nullopt;
}

void check(const std::string& path, const Target& target, const std::vector<std::string>& inputs) {
    const std::optional<struct stat> here = status_of(target);
    if (!here) {
        if (target.descriptor) fail(path, std::strerror(EBADF));
        std::error_code none;
        const fs::path folder = target.file.parent_path();
        if (!fs::is_directory(folder, none)) fail(path, say("there is no folder '{}'", folder.string()));
        if (!target.file.has_filename()) fail(path, say("expected the name of a file"));
        return;
    }
    if (S_ISDIR(here->st_mode)) fail(path, say("it is a folder; expected the name of a file"));
    if (S_ISBLK(here->st_mode)) fail(path, say("it is a block device; expected the name of a file"));
    if (!S_ISREG(here->st_mode)) return;
    for (const std::string& input : inputs) {
        struct stat read {};
        if (!input.empty() && stat(input.c_str(), &read) == 0 && read.st_dev == here->st_dev &&
            read.st_ino == here->st_ino)
            throw ModelError(
                say("'{}' is the same file as the input '{}', which would be overwritten; name another "
                    "file for the output",
                    path, input));
    }
    if (target.descriptor) return;
    // The mode also counts for the superuser, who could write anyway, because it shows what the owner wants.
    if ((here->st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0)
        fail(path, say("it is read-only (mode {:04o}); chmod +w it, or name another file", here->st_mode & 07777));
    if (access(target.file.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
}

/// The errno of the write that failed; 0 if everything was written. A pipe without a reader gives an error, not a
/// signal.
int write_all(int descriptor, std::string_view text) {
    struct sigaction ignored {
    }, before{};
    ignored.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &ignored, &before);
    const int error = write_bytes(descriptor, text);
    sigaction(SIGPIPE, &before, nullptr);
    return error;
}

using Producer = std::function<void(const PieceTaker&)>;

PieceTaker to_descriptor(const std::string& path, int descriptor) {
    return [&path, descriptor](std::string_view piece) {
        if (const int error = write_all(descriptor, piece); error != 0) fail(path, std::strerror(error));
    };
}

void write_to_device(const std::string& path, const fs::path& file, const Producer& produce) {
    Descriptor opened(open(file.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
    if (opened.number < 0) fail(path, std::strerror(errno));
    produce(to_descriptor(path, opened.number));
}

/// `before` is the status of the file that is replaced.
void write_beside(const std::string& path, const fs::path& file, const Producer& produce,
                  const std::optional<struct stat>& before) {
    fs::path part;
    int made = -1;
    for (int k = 0; k < 100 && made < 0; ++k) {  // names left by processes that were killed are skipped
        part = file.parent_path() / fmt::format(".alembert-{}-{}.part", getpid(), k);
        made = open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (made < 0 && errno != EEXIST) break;
    }
    if (made < 0) fail(path, std::strerror(errno));
    const TemporaryFile beside(part);
    Descriptor opened(made);
    if (before) {
        // Only the superuser can do this, and needs to.
        std::ignore = fchown(made, before->st_uid, before->st_gid);
        if (fchmod(made, before->st_mode & 0777) != 0) fail(path, std::strerror(errno));
    }
    produce(to_descriptor(path, made));
    opened.number = -1;
    // Some file systems notice only now that they are full.
    if (close(made) != 0) fail(path, std::strerror(errno));
    if (rename(part.c_str(), file.c_str()) != 0) fail(path, std::strerror(errno));
}

void write_to_descriptor(const std::string& path, int descriptor, const Producer& produce) {
    std::FILE* const stream = descriptor == STDOUT_FILENO   ? stdout
                              : descriptor == STDERR_FILENO ? stderr
                                                            : nullptr;
    if (stream == nullptr) return produce(to_descriptor(path, descriptor));
    produce([&](std::string_view piece) {
        if (std::fwrite(piece.data(), 1, piece.size(), stream) != piece.size()) fail(path, std::strerror(errno));
    });
}

}  // namespace

void check_output(const std::string& path, const std::vector<std::string>& inputs) {
    if (!path.empty()) check(path, target_of(path), inputs);
}

void check_output(const std::string& path, FileForm form, const std::vector<std::string>& inputs) {
    check_output(path, inputs);
    need_form(path, form);
}

void write_file(const std::string& path, const std::string& text, const std::vector<std::string>& inputs) {
    write_file(
        path, [&](const PieceTaker& put) { put(text); }, inputs);
}

void write_file(const std::string& path, const Producer& produce, const std::vector<std::string>& inputs) {
    const Target target = target_of(path);
    check(path, target, inputs);
    const std::optional<struct stat> before = status_of(target);
    if (target.descriptor)
        write_to_descriptor(path, *target.descriptor, produce);
    else if (before && !S_ISREG(before->st_mode))
        write_to_device(path, target.file, produce);
    else
        write_beside(path, target.file, produce, before);
}

bool is_ordinary_file(const std::string& path) {
    const Target target = target_of(path);
    const std::optional<struct stat> here = status_of(target);
    return !target.descriptor && (!here || S_ISREG(here->st_mode));
}

}  // namespace alembert
