// SPDX-License-Identifier: MIT
#include "alembert/native/compilation.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "alembert/base/error.hpp"
#include "alembert/native/abi.hpp"
#include "alembert/native/fingerprint.hpp"
#include "alembert/native/process.hpp"
#include "alembert/native/temporary_file.hpp"

namespace alembert {
namespace {

namespace fs = std::filesystem;

/// Straight-line code of the second size takes g++ 12 about 1.6 s at -O2 and 1.0 s at -O1, and both grow faster
/// than the size; straight-line code has no loops that -O2 would transform. From the first size on, some passes
/// are left out that take a third of the time if a function has thousands of statements, and that do not change
/// the code.
constexpr std::size_t long_source = 60'000, large_source = 200'000;
constexpr std::array quick_flags{"-fno-tree-dse", "-fno-dse", "-fno-gcse",
                                 "--param=lra-max-considered-reload-pseudos=10"};

constexpr std::size_t digits = 32;  ///< digits of the fingerprint at the end of every object in the cache

std::string joined(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

/// The compiler as words for argv, the first an absolute path.
std::vector<std::string> find_compiler(const std::string& wanted) {
    const char* const variable = std::getenv("CXX");
    std::vector<std::string> candidates;
    if (!wanted.empty())
        candidates = {wanted};
    else if (variable != nullptr && *variable != '\0')
        candidates = {variable};
    else
        candidates = {"g++", "clang++"};

    for (const std::string& candidate : candidates) {
        std::vector<std::string> words;
        std::istringstream stream(candidate);
        for (std::string word; stream >> word;) words.push_back(word);
        if (!find_program(candidate).empty()) words = {candidate};  // a path with spaces
        if (words.empty()) continue;
        const fs::path program = find_program(words.front());
        if (program.empty()) continue;
        words.front() = fs::absolute(program).string();
        return words;
    }
    throw CompileError(
        fmt::format("no C++ compiler: looked for {}{} in $PATH; install one (on Debian: apt install g++) or name "
                    "one with $CXX",
                    joined(candidates, " and "), wanted.empty() && candidates.size() == 1 ? " (from $CXX)" : ""));
}

/// Path, size and date of every program among the words: `ccache g++` is two.
std::string identity(const std::vector<std::string>& compiler) {
    std::string text;
    for (const std::string& word : compiler) {
        text += word + '\n';
        const fs::path program = word.starts_with('-') ? fs::path() : find_program(word);
        std::error_code none;
        const fs::path real = program.empty() ? program : fs::canonical(program, none);
        struct stat info {};
        if (!real.empty() && stat(real.c_str(), &info) == 0)
            text += fmt::format("{} {} {}.{}\n", real.string(), info.st_size, info.st_mtim.tv_sec,
                                info.st_mtim.tv_nsec);
    }
    return text;
}

/// The lines of /proc/cpuinfo about the first processor that determine what -march=native means.
std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    std::string text;
    for (std::string line; std::getline(file, line) && !line.empty();)
        for (const char* key :
             {"vendor_id", "cpu family", "model", "stepping", "flags", "Features", "CPU ", "isa"})
            if (line.starts_with(key)) text += line + '\n';
    return text;
}

bool is_clang(const std::vector<std::string>& command) {
    return std::any_of(command.begin(), command.end(),
                       [](const std::string& word) { return word.find("clang") != std::string::npos; });
}

std::vector<std::string> compiler_flags(std::size_t source_size, bool by_clang, const CompileOptions& options) {
    std::vector<std::string> flags = {"-std=c++20",      "-shared",
                                      "-fPIC",           source_size > large_source ? "-O1" : "-O2",
                                      "-march=native",   "-ffp-contract=fast",
                                      "-fno-math-errno", "-fno-trapping-math",
                                      "-nostdlib",       "-pipe"};
    // g++ 12 permutes lanes wrongly where it vectorizes copies between arrays with AVX-512; straight-line code
    // gains nothing by it.
    flags.emplace_back("-fno-tree-slp-vectorize");
    // At -O1 g++ leaves out vzeroupper: the host's own SSE code would then run many times slower after a call.
    if (source_size > large_source) flags.emplace_back("-fexpensive-optimizations");
    if (source_size > long_source && !by_clang) flags.insert(flags.end(), quick_flags.begin(), quick_flags.end());
    if (options.fast_math)
        for (const char* flag :
             {"-fassociative-math", "-fno-signed-zeros", "-freciprocal-math", "-DALEMBERT_REASSOCIATES"})
            flags.emplace_back(flag);
    flags.insert(flags.end(), options.extra_flags.begin(), options.extra_flags.end());
    return flags;
}

/// A folder in which nobody else can write; it is removed with its contents when the process ends.
fs::path new_private_folder() {
    std::error_code none;
    std::string pattern = (fs::temp_directory_path(none) / "alembert-XXXXXX").string();
    if (none || mkdtemp(pattern.data()) == nullptr)
        throw CompileError(
            fmt::format("cannot write to the cache, nor make a temporary folder {}: {}; "
                        "name a writable folder with $XDG_CACHE_HOME or $TMPDIR",
                        pattern, std::strerror(errno)));
    return pattern;
}

const fs::path& private_folder() {
    static const TemporaryFile folder(new_private_folder());
    return folder.path();
}

/// May a file or folder with these properties be trusted? Code that somebody else can replace must not be run.
bool is_ours(const struct stat& info) {
    return info.st_uid == geteuid() && (info.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

/// Makes the folder and the missing ones above it, each accessible to its owner only. False if that fails.
bool make_folders(const fs::path& folder) {
    if (mkdir(folder.c_str(), 0700) == 0 || errno == EEXIST) return true;
    const fs::path above = folder.parent_path();
    return errno == ENOENT && above != folder && make_folders(above) && mkdir(folder.c_str(), 0700) == 0;
}

/// Throws CompileError for a folder of somebody else, and for one in which others can write.
bool is_usable(const fs::path& folder) {
    struct stat info {};
    if (!make_folders(folder) || stat(folder.c_str(), &info) != 0) return false;
    if (S_ISDIR(info.st_mode) && !is_ours(info))
        throw CompileError(
            fmt::format("the cache of compiled solvers, {}, belongs to user {} and has mode {:04o}; expected user "
                        "{} and no right for others to "
                        "write, because what is in it is run: chmod go-w it if it is yours, or name another "
                        "folder with $XDG_CACHE_HOME",
                        folder.string(), info.st_uid, info.st_mode & 07777, geteuid()));
    return S_ISDIR(info.st_mode) && access(folder.c_str(), W_OK | X_OK) == 0;
}

/// The folder named by the user or the environment, if it can be written to; else an empty path.
fs::path lasting_folder(const fs::path& wanted) {
    fs::path folder = wanted;
    const char* const xdg = std::getenv("XDG_CACHE_HOME");
    const char* const home = std::getenv("HOME");
    if (folder.empty() && xdg != nullptr && fs::path(xdg).is_absolute()) folder = fs::path(xdg) / "alembert";
    if (folder.empty() && home != nullptr && *home != '\0') folder = fs::path(home) / ".cache" / "alembert";
    return !folder.empty() && is_usable(folder) ? folder : fs::path();
}

fs::path cache_folder(const fs::path& wanted) {
    const fs::path folder = lasting_folder(wanted);
    return folder.empty() ? private_folder() : folder;
}

/// The bytes of a regular file that belongs to the user; nothing for anything else, including a link to such a
/// file.
std::optional<std::string> read_own_file(const fs::path& path) {
    const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return std::nullopt;
    std::optional<std::string> text;
    struct stat info {};
    if (fstat(file, &info) == 0 && S_ISREG(info.st_mode) && is_ours(info)) {
        text.emplace(static_cast<std::size_t>(info.st_size), '\0');
        std::size_t done = 0;
        for (ssize_t count = 0; done < text->size(); done += static_cast<std::size_t>(count)) {
            count = read(file, text->data() + done, text->size() - done);
            if (count < 0 && errno == EINTR)
                count = 0;
            else if (count <= 0)
                break;
        }
        text->resize(done);
    }
    close(file);
    return text;
}

void write_file(const fs::path& path, std::string_view text, std::ios::openmode mode) {
    std::ofstream file(path, std::ios::binary | mode);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    file.close();
    if (!file)
        throw CompileError(
            fmt::format("cannot write {}: {}; is the disk full?", path.string(), std::strerror(errno)));
}

std::string fingerprint(std::string_view bytes) {
    Fingerprint print;
    print.add_bytes(bytes);
    return print.hex();
}

/// Does the object end in the fingerprint of what comes before? (The loader does not mind bytes after the last
/// section.)
bool is_intact(const fs::path& object) {
    const std::optional<std::string> bytes = read_own_file(object);
    if (!bytes || bytes->size() <= digits) return false;
    const std::string_view view = *bytes;
    return view.substr(view.size() - digits) == fingerprint(view.substr(0, view.size() - digits));
}

void seal(const fs::path& object) {
    const std::optional<std::string> bytes = read_own_file(object);
    if (!bytes) throw CompileError("the compiler succeeded but left no " + object.string());
    write_file(object, fingerprint(*bytes), std::ios::app);
}

void move_into_place(const fs::path& from, const fs::path& to) {
    std::error_code failure;
    fs::rename(from, to, failure);
    if (failure)
        throw CompileError(
            fmt::format("cannot rename {} to {}: {}", from.string(), to.string(), failure.message()));
}

void build(std::vector<std::string> command, const std::string& source_text, const fs::path& object) {
    static std::atomic<int> counter = 0;
    const fs::path stem =
        object.parent_path() / fmt::format(".{}-{}-{}", object.stem().string(), getpid(), counter++);
    const TemporaryFile source(fs::path(stem) += ".cpp");
    const TemporaryFile result(fs::path(stem) += ".so");
    write_file(source.path(), source_text, std::ios::trunc);
    command.insert(command.end(), {source.path().string(), "-o", result.path().string(), "-lm", "-lc"});
    const Process compiler = run(command);
    if (compiler.status != 0)
        throw CompileError(fmt::format("the compiler failed with status {}:\n  {}\n{}", compiler.status,
                                       joined(command, " "), compiler.output.substr(0, 8000)));
    for (const fs::path& file : {source.path(), result.path()})
        chmod(file.c_str(), S_IRWXU);  // otherwise the user's umask would decide
    seal(result.path());
    move_into_place(source.path(), fs::path(object).replace_extension(".cpp"));
    move_into_place(result.path(), object);
}

/// Held while one process compiles, so that others wait for its object. Where a file system has no locks, nothing
/// is held, and each compiles for itself.
class CompileLock {
public:
    explicit CompileLock(const fs::path& file)
        : temporary_(file),
          file_(open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR)) {
        while (file_ >= 0 && flock(file_, LOCK_EX) != 0 && errno == EINTR) {
        }
    }
    CompileLock(const CompileLock&) = delete;
    CompileLock& operator=(const CompileLock&) = delete;
    ~CompileLock() {
        if (file_ >= 0) close(file_);
    }

private:
    TemporaryFile temporary_;
    int file_;
};

std::string file_stem(const std::string& name, const std::string& key) {
    std::string stem = name.substr(0, 64);
    for (char& letter : stem)
        if (!std::isalnum(static_cast<unsigned char>(letter)) && letter != '-' && letter != '_') letter = '_';
    return stem + '-' + key;
}

}  // namespace

Compilation compile(const std::string& source_text, const std::string& name, const CompileOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::string> command = find_compiler(options.compiler);
    Fingerprint key;
    key.add(source_text);
    key.add(identity(command));
    const std::vector<std::string> flags = compiler_flags(source_text.size(), is_clang(command), options);
    for (const std::string& flag : flags) key.add(flag);
    key.add(std::to_string(abi_version));
    key.add(processor());

    const fs::path object = cache_folder(options.cache) / (file_stem(name, key.hex()) + ".so");
    bool from_cache = is_intact(object);
    if (!from_cache) {
        const CompileLock lock(fs::path(object).replace_extension(".lock"));
        from_cache = is_intact(object);  // another process has compiled it meanwhile
        if (from_cache) return {.object = object, .from_cache = true, .seconds = 0};
        command.insert(command.end(), flags.begin(), flags.end());
        build(std::move(command), source_text, object);
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return {.object = object, .from_cache = from_cache, .seconds = elapsed.count()};
}

namespace {

/// Empty without a lasting cache.
fs::path file_about_processor(const std::string& name) {
    const fs::path folder = lasting_folder({});
    return folder.empty() ? folder : folder / (file_stem(name, fingerprint(processor())) + ".txt");
}

}  // namespace

std::optional<std::string> kept_about_processor(const std::string& name) try {
    const fs::path file = file_about_processor(name);
    if (file.empty() || !is_intact(file)) return std::nullopt;
    const std::optional<std::string> text = read_own_file(file);
    return text && text->size() > digits ? std::optional(text->substr(0, text->size() - digits)) : std::nullopt;
} catch (const std::exception&) {
    return std::nullopt;
}

void keep_about_processor(const std::string& name, const std::string& text) try {
    const fs::path file = file_about_processor(name);
    if (file.empty()) return;
    const TemporaryFile part(fs::path(file) += fmt::format(".{}", getpid()));
    write_file(part.path(), text + fingerprint(text), std::ios::trunc);
    chmod(part.path().c_str(), S_IRUSR | S_IWUSR);
    // Of several processes the first one's text is kept, so that all of them read the same.
    std::error_code failure;
    fs::create_hard_link(part.path(), file, failure);
    if (failure && !is_intact(file)) move_into_place(part.path(), file);
} catch (const std::exception&) {
    // It is measured anew next time.
}

std::string shared_object(const std::vector<CSource>& files, const CompileOptions& options) {
    std::vector<std::string> command = find_compiler(options.compiler);
    const TemporaryFile folder(new_private_folder());
    const std::string there = folder.path().string(), object = (folder.path() / "unit.so").string();
    std::size_t size = 0;
    for (const CSource& file : files) size += file.text.size();
    for (const char* flag : {"-std=c99", "-shared", "-fPIC", size > large_source ? "-O1" : "-O2",
                             "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math", "-fvisibility=hidden",
                             "-nostdlib", "-s", "-Wl,--build-id=none", "-pipe"})
        command.emplace_back(flag);
    if (size > long_source && !is_clang(command))
        command.insert(command.end(), quick_flags.begin(), quick_flags.end());
    command.push_back("-ffile-prefix-map=" + there + "=.");
    for (const CSource& file : files) {
        const fs::path path = folder.path() / file.name;
        write_file(path, file.text, std::ios::trunc);
        // g++ takes the option for the next file alone.
        if (path.extension() == ".c") command.insert(command.end(), {"-x", "c", path.string()});
    }
    command.insert(command.end(), {"-o", object, "-lm", "-lc"});
    const Process compiler = run(command);
    if (compiler.status != 0)
        throw CompileError(fmt::format("the compiler failed with status {}:\n  {}\n{}", compiler.status,
                                       joined(command, " "), compiler.output.substr(0, 8000)));
    std::optional<std::string> bytes = read_own_file(object);
    if (!bytes) throw CompileError("the compiler succeeded but left no " + object);
    return *std::move(bytes);
}

}  // namespace alembert
