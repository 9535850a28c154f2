// SPDX-License-Identifier: MIT
#pragma once

/// The guards of a phase: the scene's events, of which those that kick end it, then gaps and reactions of
/// contacts.
///
///     const Events guards = phase_guards(contacts, mode, {.t = t, .state = y, .closed = {0}, .tolerance = 1e-9});
///
/// Where a guard is zero as the phase begins, rounding must not end the phase at once: it is held on the side to
/// which it goes (held_guard.hpp).

#include "alembert/hybrid/hybrid_motion.hpp"

namespace alembert {

/// The instant at which a phase begins.
struct PhaseStart {
    double t = 0;
    const std::vector<double>& state;
    const std::vector<int>&closed, &resting;
    const std::vector<PassedZero>& passed;  ///< for the scene's events: their zeros that are behind
    double tolerance = 1e-9;
    bool is_first = false;  ///< whether the run begins here
};

Events phase_guards(const Contacts& contacts, const ContactMode& mode, const PhaseStart& start);

}  // namespace alembert
