// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/first_accelerations.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "analysis/state/diagnose.hpp"
#include "base/language/say.hpp"
#include "simulate/consistent_mode.hpp"

namespace alembert {

namespace {

/// Whether the mass matrix determines the accelerations in a pose beside this one, to which the rates lead.
bool is_regular_beside(const Program& program, State<double> state) {
    constexpr double distance = 1e-3;  // of the coordinate that moves fastest
    if (program.nodes_of(Group::row).empty()) return false;
    std::vector<double> rates = state.qdot;
    if (!program.speeds.empty()) {
        const std::vector<double> value = interpret(program, state);
        rates.clear();
        for (const int node : program.nodes_of(Group::rate))
            rates.push_back(value[static_cast<std::size_t>(node)]);
    }
    double fastest = 0;
    for (const double rate : rates) fastest = std::max(fastest, std::abs(rate));
    if (!(fastest > 0)) return false;
    for (std::size_t i = 0; i < rates.size(); ++i) state.q[i] += distance * rates[i] / fastest;
    return !massless_combination(program, state);
}

}  // namespace

void need_accelerations(const Derived& derived, const Program& program, State<double> first, FirstPose pose) {
    first.parameters = with_held_parameters(std::move(first.parameters), program);
    const auto has_none = [&] {
        if (program.singular) return true;
        if (!massless_combination(program, first)) return false;
        return pose == FirstPose::must_be_regular || !is_regular_beside(program, first);
    };
    if (has_none()) throw IntegrationError(no_accelerations_at(derived, first), first.t, first.q);
}

}  // namespace alembert
