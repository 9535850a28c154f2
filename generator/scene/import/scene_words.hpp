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

#include "scene/import/robot.hpp"

namespace alembert {

/// The shortest text that gives the same number.
std::string scene_number(double value);
std::string scene_vector(const Real3& v);

/// The text in quotation marks; characters that disturb a terminal or a reader become "?".
std::string scene_text(const std::string& text);

/// A multiple of π/12 as a formula in quotation marks, any other angle as a number.
std::string scene_angle(double value);

/// The letter of a coordinate axis in quotation marks, any other axis as a vector.
std::string scene_axis(const Real3& a);

/// "[a, b]" of texts that are values already.
std::string scene_list(const std::vector<std::string>& list);

/// The name as a key: in quotation marks if TOML requires them.
std::string scene_key(const std::string& name);

/// The type of a joint in a scene: "revolute" also for a continuous joint, "free" for a floating one.
const char* joint_word(Robot::Type type);

/// Adds factor·what to the text of a sum, or factor alone if `what` is empty; nothing if the factor is 0.
void add_term(std::string& sum, double factor, const std::string& what);

/// Makes names that are legal in scenes, and never the same name twice.
class SceneNames {
public:
    std::string given(const std::string& wanted);

private:
    std::set<std::string> taken_{"N", "O", "t", "pi"};
};

}  // namespace alembert
