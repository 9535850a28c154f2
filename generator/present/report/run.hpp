// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/ink.hpp"
#include "present/report/json.hpp"
#include "simulate/simulate.hpp"

namespace alembert {

/// "impact", "release" or "rest", as in the JSON; `translated` gives it in the user's language.
const char* name_of(ContactEvent::Kind kind);

Json as_json(const Run& run);
/// `digits`: of the values at the end, 16 for all that there are.
std::string as_text(const Run& run, const Ink& ink = {}, int digits = 6);

/// A section of Poincaré: its equation, and the states at which the motion crossed it.
struct SectionOfRun {
    std::string equation;
    std::vector<EventRecord> crossings;
};
Json as_json(const SectionOfRun& section, const Run& run);
std::string as_text(const SectionOfRun& section, const Run& run);

/// The rows, with 17 significant digits.
std::string as_csv(const MotionTable& table);

}  // namespace alembert
