// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A marked derivation as text and as JSON.

#include "check/derivation/marked.hpp"
#include "present/report/ink.hpp"
#include "present/report/json.hpp"

namespace alembert {

Json as_json(const Marked& marked);

/// `width`: the columns of the terminal, to which the author's lines are shortened; 0 for as long as they are.
std::string as_text(const Marked& marked, const Ink& ink = {}, int width = 0);

/// "follows from line 12": the status of a line as people read it.
std::string words_of_status(const Marked& marked, const MarkedLine& line);

/// "First mistake: line 12, the sign of m*g. 5 lines are right, 1 is wrong, 2 follow from it."
std::string summary_of(const Marked& marked);

/// "The equation of motion of theta2 is missing."; empty if the document holds them all.
std::string words_of_missing(const Marked& marked);

/// How often a status occurs; all that count as right together are `count_right`.
std::size_t count_of(const Marked& marked, LineStatus status);
/// The lines with a verdict: all but those that were not understood, decided, or about the scene.
std::size_t count_judged(const Marked& marked);
std::size_t count_right(const Marked& marked);

/// The kind of the slip: "sign"; "unknown" if there is no better word.
std::string kind_of_slip(const MarkedLine& line);

/// What its author wrote, in one line.
std::string one_line(const std::string& source);

}  // namespace alembert
