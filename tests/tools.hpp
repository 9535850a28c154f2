// SPDX-License-Identifier: MIT
#pragma once

/// Programs of others, and parts of ours that are built only where their library is there. A test that misses one
/// ends:
///
///     if (!has_program("mandoc")) return;
///
/// Where test.sh has installed all of them (it sets ALEMBERT_NO_SKIP), such a test fails.

#include <string>

namespace alembert::test {

bool has_program(const std::string& name);
/// A file beside the program, such as alembert-sundials.so.
bool has_part(const std::string& name);
/// For what is found out in another way: `there`, which is a failure if it is false and should not be.
bool is_provided(bool there, const std::string& what);

}  // namespace alembert::test
