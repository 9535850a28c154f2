// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "check/check.hpp"
#include "report/ink.hpp"
#include "report/json.hpp"

namespace alembert {

Json as_json(const CheckedScene& checked);
std::string as_text(const CheckedScene& checked, const Ink& ink = {});

/// A mistake in words: "a sign: of the term -m*g".
std::string words_of(const Slip& slip);
/// The verdict as a word: "proved" …
const char* name_of(Verdict verdict);

}  // namespace alembert
