// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "commands/output.hpp"
#include "commands/pipeline.hpp"
#include "scene/text.hpp"
#include "urdf/robot_scene.hpp"

namespace alembert {

int import_robot(const Request& request) {
    const std::string file = std::filesystem::path(request.scene).filename().string();
    const RobotScene scene = robot_scene(read_robot(request.scene), {.source = file, .floating = request.floating, .quaternion = request.quaternion});
    parse_scene(scene.text, request.output);  // what it refuses is not written
    write_file(request.output, scene.text, request);
    for (const std::string& sentence : scene.notes) std::cerr << fmt::format("{}: note: {}\n", request.scene, escaped(sentence, 300));
    for (const Robot::Dropped& dropped : scene.dropped)
        std::cerr << fmt::format("{}: dropped: {}{}{}\n", request.scene, escaped(dropped.what), dropped.of.empty() ? "" : ": ",
                                 escaped(fmt::format("{}", fmt::join(dropped.of, ", ")), 100'000));
    if (request.json) {
        Json result;
        result["file"] = request.output;
        result["bodies"] = scene.bodies;
        result["coordinates"] = scene.coordinates;
        result["merged"] = scene.merged;
        result["dropped"] = Json::object();
        for (const Robot::Dropped& dropped : scene.dropped) result["dropped"][dropped.what] = dropped.of;
        std::cout << as_text(result);
        return 0;
    }
    fmt::print("{}\n{} bodies, {} coordinates: {}\n", request.output, scene.bodies, scene.coordinates.size(), fmt::join(scene.coordinates, ", "));
    for (const std::string& sentence : scene.merged) fmt::print("{}\n", escaped(sentence, 300));
    return 0;
}

}  // namespace alembert
