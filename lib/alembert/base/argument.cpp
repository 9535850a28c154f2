// SPDX-License-Identifier: MIT
#include "alembert/base/argument.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace alembert::argument {

namespace {

void need(bool good, std::string_view name, double value, const char* expected) {
    if (!std::isfinite(value) && expected != whole_positive && expected != whole_nonnegative) expected = finite;
    if (!std::isfinite(value) || !good) throw std::invalid_argument(mistake(name, value, expected));
}

}  // namespace

std::string mistake(std::string_view name, double value, const char* expected) {
    // The sign of what is not a number means nothing, and programs in C print it or not.
    return fmt::format("{}={:.15g}{}", name, std::isnan(value) ? std::abs(value) : value, expected);
}

void need_finite(std::string_view name, double value) {
    need(true, name, value, finite);
}

void need_positive(std::string_view name, double value) {
    need(value > 0, name, value, positive);
}

void need_nonnegative(std::string_view name, double value) {
    need(value >= 0, name, value, nonnegative);
}

void need_positive_if_given(std::string_view name, double value) {
    need(value >= 0, name, value, positive);
}

void need_whole_positive(std::string_view name, double value) {
    need(value > 0 && value == std::floor(value), name, value, whole_positive);
}

void need_whole_nonnegative(std::string_view name, double value) {
    need(value >= 0 && value == std::floor(value), name, value, whole_nonnegative);
}

}  // namespace alembert::argument
