// SPDX-License-Identifier: MIT
#pragma once

/// Runs the program as a user does, in a process of its own.

#include <string>
#include <vector>

#include "sanitized.hpp"

namespace alembert::test {

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
