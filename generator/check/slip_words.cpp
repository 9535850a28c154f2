// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/verdict.hpp"

#include "base/language/say.hpp"

namespace alembert {

namespace {

/// l^2 for l, l^2 for l^3.
bool is_wrong_power(const Slip& slip) {
    const auto base = [](const std::string& power) { return power.substr(0, power.rfind('^')); };
    return base(slip.written) == base(slip.meant);
}

}  // namespace

std::string words_of(const Slip& slip) {
    if (slip.kind == "sign")
        return slip.also.empty() ? say("the sign of {}", slip.term)
                                 : say("the signs of {} and {}", slip.term, slip.also);
    if (slip.kind == "missing_term")
        return slip.written.empty() ? say("a missing term {}", slip.term)
                                    : say("a missing term {} in {}", slip.term, slip.written);
    if (slip.kind == "extra_term") return say("a term too many: {}", slip.term);
    if (slip.kind == "wrong_row") return say("a force that belongs to another equation: {}", slip.term);
    if (slip.kind == "wrong_unit") return say("a term of another dimension than the others: {}", slip.term);
    if (!slip.written.empty() && !slip.meant.empty())
        return is_wrong_power(slip) ? say("a wrong power in {}: {} for {}", slip.term, slip.written, slip.meant)
                                    : say("{} for {} in {}", slip.written, slip.meant, slip.term);
    if (!slip.written.empty()) return say("a factor {} on {}", slip.written, slip.term);
    if (!slip.meant.empty()) return say("a missing factor {} on {}", slip.meant, slip.term);
    if (!slip.should_be.empty()) return say("{}, which should be {}", slip.term, slip.should_be);
    return say("unknown");
}

}  // namespace alembert
