// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/show.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "alembert/error.hpp"

namespace alembert {

void show(const Json& result) { std::cout << result.dump(2, ' ', false, Json::error_handler_t::replace) << "\n"; }

void show(const std::string& text) { std::cout << text; }

void warn(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) std::cerr << warning;
}

void write_file(const std::string& path, const std::string& text) {
    const std::string beside = fmt::format("{}.{}.part", path, getpid());
    {
        std::ofstream out(beside, std::ios::binary);
        out << text;
        out.flush();
        if (!out) {
            const std::string reason = std::strerror(errno);
            std::error_code ignored;
            std::filesystem::remove(beside, ignored);
            throw CompileError(fmt::format("cannot write '{}': {}", path, reason));
        }
    }
    std::error_code failed;
    std::filesystem::rename(beside, path, failed);
    if (failed) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw CompileError(fmt::format("cannot write '{}': {}", path, failed.message()));
    }
}

}  // namespace alembert
