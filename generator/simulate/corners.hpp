// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// States at which velocities would jump, because a place or a constraint has a corner there: a road given by
/// points with lines between, y = |x|.
///
///     if (const auto corners = Corners::of(mechanism))       // null where there is none
///         corners->obstacle(state);                          // "at t = 1.3 the motion passes a corner …"
///
/// With σ for the side of a corner, v(q, q', σ) are the velocities and angular velocities of what has mass, the
/// momenta of kinetic energies that the scene gives, and the rates of constraints. Where a motion passes the zero
/// of the side's function g with v(σ = 1) ≠ v(σ = −1), it is an impact, and what it leaves of the velocities is a
/// law that equations of motion do not have. The jump is proportional to g', so that a motion that touches a
/// corner along its tangent goes on.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/state/prepared.hpp"
#include "model/mechanism.hpp"
#include "program/interpret.hpp"
#include "program/switches.hpp"

namespace alembert {

class Corners {
public:
    /// Null if no velocity jumps anywhere. Lowers expressions, for one thread at a time; all else may be called by
    /// many.
    static std::shared_ptr<const Corners> of(const Mechanism& mechanism);

    /// The names of the tables and functions that have corners: "h(x)", "sign(x)".
    std::vector<std::string> names() const;

    /// Why a motion cannot go through this state; nothing where no corner is passed. `qdot` of the state has the
    /// rates of the coordinates and then the scene's states.
    std::optional<std::string> obstacle(const State<double>& at) const;

    /// The same of two states of a motion that a step connects, where a corner lies between them.
    std::optional<std::string> obstacle_between(const State<double>& before, const State<double>& after) const;

private:
    Corners(Program program, Switched held, std::vector<std::size_t> ends);
    State<double> on_sides(const State<double>& at, std::vector<double>* values = nullptr) const;
    std::optional<std::string> jump(const State<double>& at, std::size_t side) const;

    Program program_;  ///< of which `held_` was made
    Switched held_;
    std::vector<int> velocities_, functions_;  ///< nodes of `held_.program`
    std::vector<std::size_t> ends_;            ///< of the velocities that jump together
    std::vector<int> masses_;                  ///< for each of these
    std::vector<bool> matters_;                ///< whether a velocity depends on the side
    std::vector<std::string> names_;
};

/// What is written of a scene with corners does not see them.
void warn_of_corners(Prepared& prepared);

}  // namespace alembert
