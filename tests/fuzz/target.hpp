// SPDX-License-Identifier: MIT
#pragma once

/// What each fuzz target defines, in the form that libFuzzer (clang) expects. A target returns for every input
/// that the program refuses in its own way; any other exception, a signal or a sanitizer's report is a finding.

#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace alembert::fuzz {

inline std::string text(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

}  // namespace alembert::fuzz
