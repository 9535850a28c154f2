// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The comment at the head of an emitted file: what it computes, the size, order, units and defaults of all
/// arrays, and a program that calls it. A test takes the program out of the comment, compiles it and runs it.
///
///     head_of(program, words, {.state = {0.5, 0}, .language = CodeLanguage::c});

#include <string>
#include <vector>

#include "codegen/emit/emit.hpp"
#include "codegen/emit/vocabulary.hpp"

namespace alembert {

/// The lines of the comment, without the signs of the comment itself.
std::vector<std::string> head_of(const Program& program, const Vocabulary& words, const EmitOptions& options);
/// Of the header of a C++ file.
std::vector<std::string> header_head_of(const Program& program, const Vocabulary& words,
                                        const EmitOptions& options);

}  // namespace alembert
