// SPDX-License-Identifier: MIT
#pragma once

/// Zip archives, read from their directory.

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <string>

namespace alembert::test {

/// The files of an archive that stores them as they are.
inline std::map<std::string, std::string> unzipped(const std::string& bytes) {
    const auto number = [&](std::size_t at, int size) {
        std::uint64_t value = 0;
        for (int k = size - 1; k >= 0; --k)
            value = value << 8U | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(k)));
        return value;
    };
    std::map<std::string, std::string> files;
    const std::size_t end = bytes.rfind("PK\5\6");
    REQUIRE(end != std::string::npos);
    std::size_t at = number(end + 16, 4);
    for (std::size_t count = number(end + 10, 2); count > 0; --count) {
        REQUIRE(bytes.substr(at, 4) == "PK\1\2");
        CHECK(number(at + 10, 2) == 0);   // stored
        CHECK(number(at + 14, 2) == 33);  // on the first day
        const std::size_t size = number(at + 24, 4), name = number(at + 28, 2), extra = number(at + 30, 2),
                          there = number(at + 42, 4);
        files[bytes.substr(at + 46, name)] =
            bytes.substr(there + 30 + number(there + 26, 2) + number(there + 28, 2), size);
        at += 46 + name + extra;
    }
    return files;
}

}  // namespace alembert::test
