// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a motion passes: events that change it, impacts, and zeros of functions whose sign stands in its
/// equations.
///
///     for (const JumpInstant& one : run.instants.list) …      // in the order of time

#include <string>
#include <vector>

#include "alembert/hybrid/hybrid_motion.hpp"
#include "model/mechanism.hpp"

namespace alembert {

struct JumpInstant {
    enum class Kind {
        event,    ///< that sets states or rates, or gives an impulse
        impact,   ///< of a contact that is open before and after
        side,     ///< the zero of a function whose sign is held between its zeros (program/switches.hpp)
        closing,  ///< a contact stays closed from now on, or opens
        holding   ///< such a function stays at its zero from now on, or leaves it
    };
    Kind kind = Kind::event;
    int index = 0;  ///< of the event, contact or function
    double time = 0;
    std::string name = {};
};

struct JumpInstants {
    std::vector<JumpInstant> list = {};
    /// The sign of each function where the motion begins, 0 where it stays at its zero or was not told.
    std::vector<int> sides = {};
};

/// Adds what a motion has passed of events and contacts, and puts all in the order of time.
void add_instants(JumpInstants& instants, const Mechanism& mechanism, const HybridMotion& motion,
                  const std::vector<std::string>& contacts);

}  // namespace alembert
