// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/derive/start_check.hpp"

#include "alembert/base/tolerances.hpp"
#include "analysis/contact/contacts.hpp"
#include "analysis/state/assemble.hpp"
#include "model/sample_functions.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

constexpr const char* kind = "initial_values";

}  // namespace

std::vector<Diagnostic> warnings_of_start(const Mechanism& mechanism, const Overrides& at) {
    if (mechanism.constraints.empty() && mechanism.unilateral.empty()) return {};
    const Mechanism m = with_sample_functions(mechanism);
    Start start = start_of(m, at);
    try {
        assemble(start, m, lower_constraints(m), {}, m.impulses.empty());
    } catch (const BrokenConstraint& broken) {
        return {{broken.place, broken.what(), Severity::warning, kind}};
    } catch (const std::runtime_error& other) {  // guesses that do not converge, speeds that cannot be had
        return {{{}, other.what(), Severity::warning, kind}};
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
