// SPDX-License-Identifier: MIT
#pragma once

/// Runs the program as a user does, in a process of its own.

#include <string>
#include <vector>

namespace alembert::test {

/// Whether this test, and the program with it, was compiled with the address sanitizer, which needs memory of its
/// own.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

struct Run {
    int exit = -1;
    std::string out, err;
    double seconds = 0;  ///< processor time, children included
    long megabytes = 0;  ///< largest resident size
};

/// `alembert ARGS…`, with a cache of its own folder for this test process.
Run run(const std::vector<std::string>& args);

/// Writes `text` to a new file in a temporary folder of this test process and gives its path.
std::string temporary(const std::string& name, const std::string& text);

}  // namespace alembert::test
