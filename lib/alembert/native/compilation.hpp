// SPDX-License-Identifier: MIT
#pragma once

/// Compiles the text of an emitted solver into a shared object, with the system's compiler and a cache.
///
///     const Compilation pendulum = compile(text, "pendulum", {});
///     const Module module = load(pendulum.object);
///
/// An entry of the cache is one file, `<name>-<key>.so`, beside the source it came from. The key is a fingerprint
/// of the source, the flags, the compiler (path, size, date of the executable: running it to ask for its version
/// would cost more than a warm start may), the ABI version and the processor, since the code is for this
/// processor alone. A file is written under a name of its own and renamed when complete, so that processes which
/// compile the same thing at once do not disturb each other; the first of them locks `<name>-<key>.lock`, and the
/// others wait for its object where the file system has locks. It ends in its own fingerprint, and one that was
/// cut short or altered is compiled again rather than loaded. If the cache cannot be written, a private folder
/// takes its place and is removed when the process ends.
///
/// The code in the cache is executed, so it must belong to the user for whom this process acts. A folder that
/// belongs to somebody else, or in which others can write, is refused with CompileError. Folders are made with
/// mode 0700. An entry that is a link, that is not a regular file or that somebody else can write is not loaded
/// but compiled again.
///
/// The flag -ffast-math is never used: at link time it would switch the whole process to flush-to-zero when the
/// object is loaded. `fast_math` adds single flags that do not change the link; the result then depends on how the
/// compiler orders sums. The start files and libstdc++ are left out (-nostdlib): emitted code needs libm only, and
/// linking takes a third of the time without them.
///
/// Throws CompileError if there is no compiler (the message says what was looked for and what to install), if the
/// compiler reports errors or if the disk is full. No command goes through a shell.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace alembert {

struct CompileOptions {
    /// A program, perhaps with arguments; if empty, $CXX if it is set, else g++, else clang++.
    std::string compiler = {};
    std::vector<std::string> extra_flags = {};  ///< placed after our flags, so that they override these
    bool fast_math = false;
    std::filesystem::path cache =
        {};  ///< if empty, $XDG_CACHE_HOME/alembert, else $HOME/.cache/alembert, else a private folder
};

struct Compilation {
    std::filesystem::path object;
    bool from_cache = false;
    double seconds = 0;  ///< wall time of the whole call
};

/// `name` only makes files in the cache recognizable; each of its characters that is not a letter, digit, `-` or
/// `_` becomes `_`.
Compilation compile(const std::string& source_text, const std::string& name, const CompileOptions& options);

/// What is known about this processor, kept as a text beside compiled solvers: that which was kept under this name
/// on a processor like this, if it is still there and whole. What is kept first stays. Both throw nothing; where
/// there is no lasting cache, or another user's, nothing is kept.
std::optional<std::string> kept_about_processor(const std::string& name);
void keep_about_processor(const std::string& name, const std::string& text);

struct CSource {
    std::string name, text;  ///< of a .c file, or of a header that these include
};

/// The bytes of a shared object made of C99 files by the same compiler: for every processor of this family,
/// without paths of this machine and without the cache, so that the same files and compiler give the same bytes.
/// Of `options` only the compiler counts.
std::string shared_object(const std::vector<CSource>& files, const CompileOptions& options = {});

}  // namespace alembert
