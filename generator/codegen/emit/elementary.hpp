// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the templates of emitted files share: lists of lines, and the elementary functions that a file needs.
/// Functions that it does not use are not written.

#include <kainjow/mustache.hpp>
#include <set>
#include <string>
#include <vector>

#include "program/program.hpp"

namespace alembert {

kainjow::mustache::data list_of(const std::vector<std::string>& lines);

/// The elementary functions in the roots of a program.
std::set<Op> elementary_functions(const Program& program);

/// Keys of templates/elementary.cpp.mustache and templates/sines.cpp.mustache: one for each function,
/// `trigonometric` for sines and cosines, and `library` if there are others.
void set_elementary(kainjow::mustache::data& file, const std::set<Op>& functions);

/// Sets the text of these templates as `elementary` and `sines`; the second has an empty line before and after it.
void add_elementary(kainjow::mustache::data& file);

}  // namespace alembert
