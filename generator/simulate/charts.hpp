// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A run through gimbal lock: where three angles of a frame or joint fail to describe its turning, the run goes on
/// with a quaternion in their place, and comes back.
///
///     if (const auto angles = angles_of_frame(derived, method)) …  // nothing where no chart can replace them
///     ChartRun charts(derived, *angles, start, work, wishes);  // derives the other description
///     contact.system.by = charts.integrator();
///     charts.passes();                                          // where it went on with the quaternion
///
/// The smallness of the map from the rates of the angles a, b, c to the angular velocity is |sin b| where the
/// first axis is the third again (z-x-z), else |cos b|. Below `to_quaternion` the other description takes over,
/// above `to_angles` the angles do. What the run gives is always in the scene's coordinates, which continue
/// (angles_along.hpp): where the motion goes exactly through the lock, b passes through it smoothly; beside it b
/// turns back, and a and c turn by about π in a short time.
///
/// Not for scenes whose other parts name the angles (they are the only place where the frame's turning is said),
/// with contacts, dry friction, events or generalized speeds, nor for methods with a fixed step.

#include <memory>
#include <optional>

#include "alembert/ode/integrate.hpp"
#include "analysis/derive/derived.hpp"
#include "simulate/angles_of_frame.hpp"
#include "simulate/method.hpp"
#include "simulate/options.hpp"

namespace alembert {

inline constexpr double to_quaternion = 0.03, to_angles = 0.1;

/// The frame or joint whose angles may be replaced; nothing if there is none, or more than one.
std::optional<AnglesOfFrame> angles_of_frame(const Derived& derived, const MethodChoice& method);

/// From a time to another the run was described by a quaternion.
struct ChartPass {
    double begin, end;
};

class ChartRun {
public:
    /// Throws what the stages throw, also where other parts of the scene name the angles. Not movable, because the
    /// integrator refers to it.
    ChartRun(const Derived& derived, const AnglesOfFrame& angles, const std::vector<double>& parameters, Work work,
             const RunOptions& wishes);
    ~ChartRun();
    ChartRun(const ChartRun&) = delete;
    ChartRun& operator=(const ChartRun&) = delete;

    Integrator integrator();
    /// Those of the last run.
    const std::vector<ChartPass>& passes() const;

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace alembert
