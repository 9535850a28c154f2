// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// toml++ as the reader uses it: compiled into this layer (toml.cpp), with line ends in inline tables and bare keys
/// of any letters (`θ = 0.1`), which the system's shared library lacks.

#undef TOML_HEADER_ONLY
#undef TOML_SHARED_LIB
#define TOML_HEADER_ONLY 0
#define TOML_ENABLE_UNRELEASED_FEATURES 1
#define TOML_ENABLE_FORMATTERS 0
#define TOML_ENABLE_WINDOWS_COMPAT 0
#include <toml++/toml.h>
