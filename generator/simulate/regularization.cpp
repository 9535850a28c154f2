// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/regularization.hpp"

#include <fmt/format.h>

#include "base/language/say.hpp"
#include "simulate/separable.hpp"

namespace alembert {

namespace {

std::optional<std::string> obstacle_to_regularization(const Mechanism& m, const Energy& energy) {
    if (!m.constraints.empty()) return say("there are constraints");
    if (!m.unilateral.empty() || !m.frictions.empty()) return say("there are contacts or dry friction");
    if (m.has_kicks() || m.has_counts()) return say("there are events that change the motion or are counted");
    if (!energy.conserved) return say("the energy T + V is not conserved");
    return std::nullopt;
}

}  // namespace

bool asks_regularization(const RunOptions& wishes, const Mechanism& m) {
    return wishes.regularize || m.run.regularize;
}

Regularization regularization_of(const RunOptions& wishes, const Derived& d, const Energy& energy,
                                 const MethodChoice& choice, const Start& start) {
    if (!asks_regularization(wishes, d.mechanism)) return Regularization::none;
    if (const auto why = obstacle_to_regularization(d.mechanism, energy))
        throw ModelError(say("this scene does not run regularized: {}", *why));
    const std::string method = choice.sundials.empty() ? std::string(name(choice.method)) : choice.sundials;
    if (!choice.sundials.empty() || needs_series(choice.method) || needs_canonical(choice.method) ||
        (needs_separable(choice.method) && !has_fixed_step(choice.method)))
        throw ModelError(
            say("method '{}' does not run regularized; take verner98, or kahanli8 or gauss with a step", method));
    if (longest_step(wishes, start) > 0)
        throw ModelError(
            say("a regularized run chooses its steps in a time of its own and takes no longest step; "
                "leave out one of the two"));
    return inseparable(d) ? Regularization::rescaled : Regularization::canonical;
}

void need_depth(const Rhs& rhs, double t, const std::vector<double>& initial) {
    if (rhs.energies == nullptr)
        throw ModelError(say("this scene does not run regularized: {}",
                             say("a sign, an absolute value, min or max in its loads is held constant piece by "
                                 "piece")));
    double energies[2];
    rhs.energies(rhs.context.get(), t, initial.data(), energies);
    if (!(energies[1] < 0))
        throw ModelError(
            say("a regularized run needs a negative potential energy, as that of bodies that attract "
                "each other, and it is {:g} at the start; leave out the regularization",
                energies[1]));
}

}  // namespace alembert
