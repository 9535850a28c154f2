// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "present/report/ink.hpp"
#include "present/report/json.hpp"

namespace alembert {

Json as_json(const CheckedScene& checked);
std::string as_text(const CheckedScene& checked, const Ink& ink = {});

/// Whether the right claims determine the motion, as a sentence.
std::string words_of_completeness(const Checked& checked);
/// Whether the difference from the correct equation is just the term that the slip names.
bool is_missing_term(const CheckedClaim& claim);
/// The verdict as a word: "proved" …
const char* name_of(Verdict verdict);

}  // namespace alembert
