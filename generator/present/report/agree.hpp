// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "analysis/agree/agree.hpp"
#include "present/report/ink.hpp"
#include "present/report/json.hpp"

namespace alembert {

Json as_json(const Agreed& agreed);
std::string as_text(const Agreed& agreed, const Ink& ink = {});

/// The method of the proof, in a sentence.
std::string how_it_was_proved(const Agreement& agreement);
/// The verdict as a word: "proved" …
const char* name_of(Agreement::Verdict verdict);

}  // namespace alembert
