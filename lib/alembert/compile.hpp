// SPDX-License-Identifier: MIT
#pragma once

/// From the text of an emitted solver to a shared object, by the system's compiler and through a cache.
///
///     const Compiled pendulum = compile(text, "pendulum", {});
///     const Module module = load(pendulum.object);
///
/// An entry of the cache is one file, `<name>-<key>.so`, beside the source it came from. The key is a fingerprint
/// of the source, the flags, the compiler (path, size, date of the executable: running it to ask for its version
/// would cost more than a warm start may), the ABI version and the processor, since the code is for this
/// processor alone. A file is written under a name of its own and renamed when complete, so that processes which
/// compile the same thing at once do not disturb each other; it ends in its own fingerprint, and one that was cut
/// short or altered is compiled again rather than loaded. If the cache cannot be written, a private folder takes
/// its place and is removed when the process ends.
///
/// What is in the cache is run, so it must be of the user whom this process acts for: a folder of somebody else,
/// or one in which others can write, is refused with CompileError; folders are made with mode 0700; an entry that
/// is a link, no regular file, or that somebody else can write is not loaded but compiled again.
///
/// Flags: no -ffast-math, ever: at link time it would switch the whole process to flush-to-zero when the object is
/// loaded. `fast_math` adds single flags to the same command, and these leave the link alone: the result then
/// depends on how the compiler orders sums. The start files and libstdc++ are left out (-nostdlib): emitted code
/// needs libm only, and linking takes a third of the time without them.
///
/// Throws CompileError: no compiler (with what was looked for and what to install), the compiler's own errors,
/// disk full. Nothing goes through a shell.

#include <filesystem>
#include <string>
#include <vector>

namespace alembert {

struct CompileOptions {
    std::string compiler = {};  ///< program, perhaps with arguments; empty: $CXX if set, else g++, else clang++
    std::vector<std::string> extra_flags = {};  ///< after ours, so that they win
    bool fast_math = false;
    std::filesystem::path cache =
        {};  ///< empty: $XDG_CACHE_HOME/alembert, else $HOME/.cache/alembert, else a private folder
};

struct Compiled {
    std::filesystem::path object;
    bool from_cache = false;
    double seconds = 0;  ///< wall time of the whole call
};

/// `name` only makes files in the cache recognizable; what is not a letter, digit, `-` or `_` in it becomes `_`.
Compiled compile(const std::string& source_text, const std::string& name, const CompileOptions& options);

}  // namespace alembert
