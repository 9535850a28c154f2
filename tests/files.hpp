// SPDX-License-Identifier: MIT
#pragma once

/// Files of the repository and of the tests.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace alembert::test {

/// The path of a file of the repository, given from its root.
inline std::string source_path(const std::string& relative) {
    return std::string(ALEMBERT_SOURCE_DIR "/") + relative;
}

/// A file of the repository or of a test, whole; empty where there is none.
inline std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

}  // namespace alembert::test
