// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/number_mistake.hpp"

#include <cln/exception.h>
#include <cln/float.h>

#include <stdexcept>

#include "base/language/say.hpp"

namespace alembert {

namespace {

/// 0, as the processor has it: an exception in the middle of a linkage would tell nobody anything.
[[maybe_unused]] const bool small_numbers_are_zero = cln::cl_inhibit_floating_point_underflow = true;

}  // namespace

std::optional<std::string> number_mistake(const std::exception& thrown) {
    const bool is_pole = dynamic_cast<const cln::division_by_0_exception*>(&thrown) != nullptr ||
                         dynamic_cast<const std::domain_error*>(&thrown) != nullptr;  // GiNaC's pole_error too
    if (is_pole) return say("a division by zero, or a function where it has no value");
    if (dynamic_cast<const cln::runtime_exception*>(&thrown) != nullptr ||
        dynamic_cast<const std::overflow_error*>(&thrown) != nullptr ||
        dynamic_cast<const std::range_error*>(&thrown) != nullptr)
        return say("a number beyond the range of double precision, or one that is no real number");
    return {};
}

}  // namespace alembert
