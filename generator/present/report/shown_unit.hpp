// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Values in the unit in which the scene gives them, for people. Programs get SI units.
///
///     const ShownUnit angle(mechanism.shown_units[k]);        // of `theta = { initial = 30, unit = "deg" }`
///     fmt::format("{} = {:.6g}", angle.label("theta"), angle.value(q));        // "theta [deg] = 30"

#include <string>

#include "model/mechanism.hpp"
#include "present/report/json.hpp"
#include "scene/unit_text.hpp"

namespace alembert {

class ShownUnit {
public:
    explicit ShownUnit(const Shown& shown) : shown_(shown) {}

    double value(double in_si) const { return shown_.unit.empty() ? in_si : in_si / shown_.size; }

    /// The name with the unit, where it is not of the SI; with the times that it is differentiated by time.
    std::string label(const std::string& name, int times = 0) const {
        return shown_.unit.empty() ? name : name + " [" + text({}, times) + "]";
    }

    /// The unit, or that of the SI, over s.
    std::string text(const std::string& si, int times = 0) const {
        const std::string& unit = shown_.unit.empty() ? si : shown_.unit;
        return times == 0 ? unit : per_second(unit, times);
    }

private:
    Shown shown_;
};

/// The SI units of coordinates and speeds, whose rates are in these over s: {"theta": "rad"}. Those that have none
/// are left out.
Json si_units(const Mechanism& mechanism);

}  // namespace alembert
