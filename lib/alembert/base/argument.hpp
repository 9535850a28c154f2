// SPDX-License-Identifier: MIT
#pragma once

/// Checks of numbers that are handed in: options, initial values, counts. The same wrong number gives the same
/// message in C++, in Python, in emitted programs and in functional mock-up units, whose C takes its words from
/// here.
///
///     argument::need_positive("tolerance", tolerance);        // tolerance=0: expected a number above zero
///     argument::need_finite("theta", state[0]);               // theta=nan: expected a finite number
///
/// std::invalid_argument is thrown for a wrong number. A number that is not finite is told as such, whatever else
/// is expected of it.

#include <string>
#include <string_view>

namespace alembert::argument {

/// The ends of messages, after "NAME=NUMBER".
inline constexpr const char *finite = ": expected a finite number", *positive = ": expected a number above zero",
                            *nonnegative = ": expected a number of zero or more",
                            *whole_positive = ": expected a whole number above zero",
                            *whole_nonnegative = ": expected a whole number of zero or more";

/// "tolerance=0: expected a number above zero": the number with at most 15 digits; what is not a number is "nan".
std::string mistake(std::string_view name, double value, const char* expected);

void need_finite(std::string_view name, double value);
void need_positive(std::string_view name, double value);
void need_nonnegative(std::string_view name, double value);
/// For numbers of which 0 stands for "not given".
void need_positive_if_given(std::string_view name, double value);
void need_whole_positive(std::string_view name, double value);
void need_whole_nonnegative(std::string_view name, double value);

}  // namespace alembert::argument
