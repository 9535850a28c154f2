// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Says what is wrong with a file that is not valid TOML, in words that the author of a scene understands.

#include "scene/layout.hpp"
#include "scene/toml.hpp"

namespace alembert {

Diagnostic syntax_mistake(const toml::parse_error& error, const Layout& layout, const SourceText& source);

}  // namespace alembert
