// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/derive/start_check.hpp"

#include <algorithm>

#include "alembert/base/tolerances.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/state/assemble.hpp"
#include "model/sample_functions.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

constexpr const char* kind = "initial_values";

/// The place of the constraint that the message names.
Place place_in(const std::string& message, const Mechanism& m) {
    const auto named = std::find_if(m.constraints.begin(), m.constraints.end(), [&](const auto& c) {
        return message.find("'" + c.name + "'") != std::string::npos;
    });
    return named == m.constraints.end() ? Place{} : named->place;
}

}  // namespace

std::vector<Diagnostic> warnings_of_start(const Mechanism& mechanism, const Overrides& at) {
    if (mechanism.constraints.empty() && mechanism.unilateral.empty()) return {};
    const Mechanism m = with_sample_functions(mechanism);
    Start start = start_of(m, at);
    try {
        assemble(start, m, lower_constraints(m), {}, m.impulses.empty());
    } catch (const std::runtime_error& broken) {
        const std::string message = broken.what();
        return {{place_in(message, m), message, Severity::warning, kind}};
    }
    if (m.unilateral.empty()) return {};
    std::vector<Diagnostic> found = negative_gaps(m, ContactView(m), start.state(), tolerance::closed_gap);
    for (Diagnostic& gap : found) {
        gap.severity = Severity::warning;
        gap.kind = kind;
    }
    return found;
}

}  // namespace alembert
