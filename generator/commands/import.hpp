// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `import`: the scene of a robot description.
///
///     const ImportedRobot arm = imported_robot("arm6.urdf", {.scene = {.drives = true}});
///     arm.scene.text;                       // the scene

#include "present/report/json.hpp"
#include "scene/import/robot_scene.hpp"

namespace alembert {

struct ImportedRobot {
    RobotScene scene;
    std::vector<Diagnostic> remarks;  ///< what was completed or is unusual in the description, with its place
    int rounded = 0;                  ///< right angles that are written with few digits
    bool made_exact = false;          ///< whether these became right angles
    bool has_drives = false;
};

struct ImportOptions {
    RobotSceneOptions scene = {};  ///< `source` is set to the name of the file
    OtherFiles others = {};
    bool right_angles = false;  ///< 1.5708 and the like become right angles
    bool strict = false;        ///< refuses, with ModelError, a scene that leaves out what changes the motion
    std::string loops = {};     ///< a file of joints that close loops (scene/import/loops.hpp), or empty
};

/// Throws what `read_robot`, `close_loops` and `robot_scene` throw.
ImportedRobot imported_robot(const std::string& file, ImportOptions options);

/// What `import --json` prints; `file` is the name of the scene.
Json as_json(const ImportedRobot& imported, const std::string& file);

}  // namespace alembert
