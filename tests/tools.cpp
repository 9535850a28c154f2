// SPDX-License-Identifier: MIT
#include "tools.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

#include "alembert/native/process.hpp"

namespace alembert::test {

bool has_program(const std::string& name) {
    return is_provided(!find_program(name).empty(), name);
}

bool has_part(const std::string& name) {
    return is_provided(std::filesystem::exists(std::filesystem::path(ALEMBERT_PROGRAM).parent_path() / name),
                       name);
}

bool is_provided(bool there, const std::string& what) {
    if (!there && std::getenv("ALEMBERT_NO_SKIP") != nullptr) FAIL_CHECK(what << " is missing");
    return there;
}

}  // namespace alembert::test
