// SPDX-License-Identifier: MIT
// The reader of URDF files. The scene that comes of an accepted one is read without a mistake.
#include <fmt/format.h>

#include "alembert/base/error.hpp"
#include "scene/import/robot_scene.hpp"
#include "scene/scene.hpp"
#include "target.hpp"

using namespace alembert;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string scene;
    try {
        const Robot robot = parse_robot(fuzz::text(data, size), "robot.urdf");
        scene = robot_scene(robot, {.drives = true, .friction = true, .stops = true}).text;
    } catch (const SceneError&) {
        return 0;
    } catch (const ModelError&) {
        return 0;
    }
    try {
        parse_scene(scene, "robot.toml");
    } catch (const SceneError& mistake) {
        fmt::print(stderr, "{}\n{}\n", scene, mistake.what());
        __builtin_trap();
    }
    return 0;
}
