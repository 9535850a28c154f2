// SPDX-License-Identifier: MIT
#pragma once

namespace alembert::test {

/// Whether this test, and the program with it, was compiled with the address sanitizer, which needs memory of its
/// own.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace alembert::test
