// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `import`: the scene of a robot description.
///
///     const ImportedRobot arm = imported_robot("arm6.urdf", {.drives = true}, false);
///     arm.scene.text;                       // the scene

#include "report/json.hpp"
#include "urdf/robot_scene.hpp"

namespace alembert {

struct ImportedRobot {
    RobotScene scene;
    std::vector<Diagnostic> remarks;  ///< what was completed or is unusual in the description, with its place
    int rounded = 0;                  ///< right angles that are written with few digits
    bool made_exact = false;          ///< whether these became right angles
    bool has_drives = false;
};

/// `source` of the options is set to the name of the file. With `right_angles`, 1.5708 and the like become right
/// angles. `loops` is a file of joints that close loops (urdf/loops.hpp), or empty. Throws what `read_robot`,
/// `close_loops` and `robot_scene` throw.
ImportedRobot imported_robot(const std::string& file, RobotSceneOptions options, bool right_angles,
                             const std::string& loops = {});

/// What `import --json` prints; `file` is the name of the scene.
Json as_json(const ImportedRobot& imported, const std::string& file);

}  // namespace alembert
