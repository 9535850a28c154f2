// SPDX-License-Identifier: MIT
#pragma once

/// Runs another program without a shell, so that no character of an argument has a special meaning.
///
///     const Process gcc = run({"/usr/bin/g++", "--version"});
///     if (gcc.status != 0) … gcc.output …
///
/// The child reads from /dev/null, speaks untranslated English (LC_ALL=C), and what it writes to either stream
/// comes back as one text. `run` throws CompileError if the program cannot be started.

#include <filesystem>
#include <string>
#include <vector>

namespace alembert {

struct Process {
    int status = 0;      ///< exit status; 128 + signal if a signal ended it
    std::string output;  ///< standard output and error in the order in which they were written
};

/// Runs argv[0], an absolute path, and waits for its end.
Process run(const std::vector<std::string>& argv);

/// The executable file that a shell would start for `program`: itself if it contains a slash, else the first in
/// $PATH. Empty if there is none.
std::filesystem::path find_program(const std::string& program);

/// A file of that name in the folder of this program, or of the library that has this function (the module of
/// Python); empty if there is none.
std::filesystem::path beside_this_program(const std::string& name);

}  // namespace alembert
