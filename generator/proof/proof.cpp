// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/proof.hpp"

#include "alembert/base/error.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

/// What the motion of a mechanism may do that the proof does not follow.
std::optional<std::string> obstacle_in(const Mechanism& m) {
    if (!m.unilateral.empty()) return say("contacts");
    if (!m.frictions.empty()) return say("dry friction");
    if (!m.events.empty()) return say("events");
    if (!m.impulses.empty()) return say("impulses");
    if (!m.constraints.empty()) return say("constraints");
    return std::nullopt;
}

}  // namespace

Proof prove(Scene scene, const RunOptions& wishes) {
    check_numbers(wishes);
    Proof result{derived(std::move(scene), {.by = wishes.by, .use = Use::run, .reactions = false})};
    const Mechanism& m = result.mechanism;
    if (const auto what = obstacle_in(m))
        throw ModelError(
            say("--proof: motions with {} are not proved; those in independent coordinates without "
                "jumps are",
                *what));
    const Program program = lowered(result).program;
    Start start = start_of(m);
    assemble(start, m, lower_constraints(m), {});
    const IntervalStart exact = interval_start(m, result.equations, start, wishes.duration);
    for (const Quantity& q : program.coordinates) result.names.push_back(q.name);
    if (program.speeds.empty())
        for (const Quantity& q : program.coordinates) result.names.push_back(q.name + "'");
    for (const Quantity& u : program.speeds) result.names.push_back(u.name);
    ProofOptions options{.sample = wishes.sample.value_or(start.sample)};
    if (wishes.progress) options.progress = [&](double part) { wishes.progress(say("proving the motion"), part); };
    result.motion = proved_motion(program, exact, options);
    return result;
}

}  // namespace alembert
