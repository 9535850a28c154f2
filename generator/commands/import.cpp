// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "commands/output.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "scene/text.hpp"
#include "urdf/robot_scene.hpp"

namespace alembert {

namespace {

struct ImportOptions {
    std::string robot, output;
    bool floating = false, quaternion = false, json = false;
};

int run(const ImportOptions& options) {
    const std::string file = std::filesystem::path(options.robot).filename().string();
    const Robot robot = read_robot(options.robot);
    const RobotScene scene =
        robot_scene(robot, {.source = file, .floating = options.floating, .quaternion = options.quaternion});
    parse_scene(scene.text, options.output);  // what it refuses is not written
    write_file(options.output, scene.text, {options.robot});
    for (const Diagnostic& remark : robot.remarks)
        std::cerr << fmt::format("{}:{}:{}: warning: {}\n", options.robot, remark.place.line, remark.place.column,
                                 escaped(remark.message, 300));
    for (const std::string& sentence : scene.notes)
        std::cerr << fmt::format("{}: note: {}\n", options.robot, escaped(sentence, 300));
    for (const Robot::Dropped& dropped : scene.dropped)
        std::cerr << fmt::format("{}: dropped: {}{}{}\n", options.robot, escaped(dropped.what),
                                 dropped.of.empty() ? "" : ": ",
                                 escaped(fmt::format("{}", fmt::join(dropped.of, ", ")), 100'000));
    if (options.json) {
        Json result;
        result["file"] = options.output;
        result["bodies"] = scene.bodies;
        result["coordinates"] = scene.coordinates;
        result["merged"] = scene.merged;
        result["dropped"] = Json::object();
        for (const Robot::Dropped& dropped : scene.dropped) result["dropped"][dropped.what] = dropped.of;
        result["warnings"] = Json::array();
        for (const Diagnostic& remark : robot.remarks)
            result["warnings"].push_back({{"line", remark.place.line}, {"message", remark.message}});
        show(result);
        return 0;
    }
    fmt::print("{}\n{} bodies, {} coordinates: {}\n", options.output, scene.bodies, scene.coordinates.size(),
               fmt::join(scene.coordinates, ", "));
    for (const std::string& sentence : scene.merged) fmt::print("{}\n", escaped(sentence, 300));
    return 0;
}

}  // namespace

void add_import(CLI::App& app, Chosen& chosen) {
    const auto options = std::make_shared<ImportOptions>();
    Verb verb = add_verb(app, {.name = "import",
                               .about = "writes the scene of a robot description (URDF)",
                               .example = "alembert import tests/robots/arm6.urdf -o arm6.toml"});
    verb.add_option("robot", options->robot, "the robot, an .urdf file").type_name(values::robot).required();
    verb.add_option("-o,--output", options->output, "the scene to be written").type_name(values::file).required();
    verb.add_flag("--floating", options->floating, "the root link moves freely; default: it is the ground");
    verb.add_flag("--quaternion", options->quaternion, "what floats turns by a quaternion");
    verb.add_flag("--json", options->json, "print one JSON object");
    verb.callback([options, &chosen] { chosen = {options->robot, [options] { return run(*options); }}; });
}

}  // namespace alembert
