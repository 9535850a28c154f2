// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// toml++ as the reader uses it: compiled into this layer (toml.cpp), with line ends in inline tables and bare keys
/// of any letters (`θ = 0.1`), which the system's shared library lacks. Its assertions are off in every build: `[=]`
/// fails one of them and is then refused in good order, and with NDEBUG clang would take them for granted.

#undef TOML_HEADER_ONLY
#undef TOML_SHARED_LIB
#define TOML_HEADER_ONLY 0
#define TOML_ENABLE_UNRELEASED_FEATURES 1
#define TOML_ENABLE_FORMATTERS 0
#define TOML_ENABLE_WINDOWS_COMPAT 0
#define TOML_ASSERT(expr) static_assert(true)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
