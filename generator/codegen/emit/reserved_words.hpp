// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Words that emitted code must not use as the name of a value: keywords of C and C++, and macros of their
/// headers, of POSIX and of compilers; reserved words of JavaScript. A macro would replace the name before the
/// compiler sees it.
///
///     is_reserved("register");    // a keyword
///     may_be_macro("M_PI");       // by its shape
///     may_be_macro("errno");      // by a list
///
/// No keyword and no macro of these headers ends in a single `_`, so a `_` after the word makes a name of it.

#include <span>
#include <string_view>

#include "codegen/emit/statement.hpp"

namespace alembert {

/// Whether the name begins with a capital and a second character that is no small letter, and has two capitals, as
/// macros have by convention, or is one of the macros that do not.
bool may_be_macro(std::string_view name);

/// Whether it is a keyword, or may be a macro.
bool is_reserved(std::string_view name);

/// Whether a header of the libraries of C and POSIX may declare something of this name outside of any namespace,
/// which a scene may well be called after: time, link, clock, pause …
bool is_global_in_c(std::string_view name);

/// What a module of JavaScript must not use as a name beside these.
std::span<const std::string_view> javascript_words();
/// What a file in another language must not use beside these (dialect_words.cpp).
std::span<const std::string_view> reserved_in(CodeLanguage language);

}  // namespace alembert
