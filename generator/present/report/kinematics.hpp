// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "present/report/json.hpp"
#include "simulate/kinematics/kinematics.hpp"

namespace alembert {

/// `steps`: with the parts that velocities and accelerations are composed of.
Json as_json(const SceneKinematics& found, bool steps);
/// `format`: text, latex or mathml; values stand in text alone.
std::string as_page(const SceneKinematics& found, const std::string& format, bool steps);

/// The Jacobians at the state, row by row; empty where there are none.
std::string jacobian_page(const SceneKinematics& found);

}  // namespace alembert
