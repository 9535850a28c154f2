// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the templates of emitted files share: lists of lines, and which elementary functions a file needs; those
/// that it does not use are not written into it.

#include <kainjow/mustache.hpp>
#include <set>
#include <string>
#include <vector>

#include "program/program.hpp"

namespace alembert {

kainjow::mustache::data list_of(const std::vector<std::string>& lines);

/// Those that the roots of a program are made of.
std::set<Op> elementary_functions(const Program& program);

/// Keys of templates/elementary.cpp.mustache and templates/sines.cpp.mustache: one for each function;
/// `trigonometric` for sines and cosines, `library` where there are others.
void set_elementary(kainjow::mustache::data& file, const std::set<Op>& functions);

/// The text of these templates under `elementary` and `sines`; of the second with an empty line before and after.
void add_elementary(kainjow::mustache::data& file);

}  // namespace alembert
