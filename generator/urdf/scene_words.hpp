// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How numbers, names and axes of a robot are written in the text of a scene.
///
///     scene_number(0.1)              // 0.1, the shortest that reads back the same
///     scene_angle(M_PI / 4)          // "pi/4", with its quotation marks
///     scene_axis({0, 0, 1})          // "z"
///     SceneNames names;
///     names.given("left-arm")        // left_arm

#include <set>
#include <string>

#include "urdf/robot.hpp"

namespace alembert {

/// The shortest that reads back the same.
std::string scene_number(double value);
std::string scene_vector(const Real3& v);

/// In quotation marks; characters that disturb a terminal or a reader become "?".
std::string scene_text(const std::string& text);

/// Twelfths of π as such, in quotation marks; else the number.
std::string scene_angle(double value);

/// The letter of an axis of coordinates, in quotation marks, or a vector.
std::string scene_axis(const Real3& a);

/// The name as a key: in quotation marks where TOML wants them.
std::string scene_key(const std::string& name);

/// Names as scenes may have them, each given once.
class SceneNames {
public:
    std::string given(const std::string& wanted);

private:
    std::set<std::string> taken_{"N", "O", "t", "pi"};
};

}  // namespace alembert
