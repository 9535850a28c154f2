// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What an error of the arithmetic says of the claim that met it: a claim that divides by zero is undecided, and
/// the other claims of its file are judged.
///
///     try {
///         …                                            // judge one claim
///     } catch (const std::exception&) {
///         verdict.reason = words_of_arithmetic_error();  // "it divides by something that is always zero, …"
///     }

#include <string>

namespace alembert {

/// The words for the exception that is being handled. Throws it on if it is about the scene, the model, the
/// compiler, a run or memory.
std::string words_of_arithmetic_error();

}  // namespace alembert
