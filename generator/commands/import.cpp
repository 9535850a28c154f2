// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "commands/output.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "language/say.hpp"
#include "scene/text.hpp"
#include "urdf/loops.hpp"
#include "urdf/robot_scene.hpp"

namespace alembert {

namespace {

struct ImportOptions {
    std::string robot, output, loops;
    bool floating = false, quaternion = false, drives = false, friction = false, stops = false,
         right_angles = false, json = false;
};

int run(const ImportOptions& options) {
    const std::string file = std::filesystem::path(options.robot).filename().string();
    Robot robot = read_robot(options.robot);
    if (!options.loops.empty()) close_loops(robot, options.loops);
    const int rounded = rounded_right_angles(robot, options.right_angles);
    RobotScene scene = robot_scene(robot, {.source = file,
                                           .floating = options.floating,
                                           .quaternion = options.quaternion,
                                           .drives = options.drives,
                                           .friction = options.friction,
                                           .stops = options.stops});
    if (rounded > 0 && !options.right_angles)
        scene.notes.push_back(
            say("{} angle{} a right angle written with few digits, as 1.5708; with --right-angles {} exact, "
                "which leaves terms out of the equations",
                rounded, rounded == 1 ? " is" : say("s are each"),
                rounded == 1 ? say("it becomes") : say("they become")));
    parse_scene(scene.text, options.output);  // a scene that is refused is not written
    write_file(options.output, scene.text, {options.robot});
    for (const Diagnostic& remark : robot.remarks)
        std::cerr << say("{}:{}:{}: warning: {}\n", options.robot, remark.place.line, remark.place.column,
                         escaped(remark.message, 300));
    for (const std::string& sentence : scene.notes)
        std::cerr << say("{}: note: {}\n", options.robot, escaped(sentence, 300));
    for (const Robot::Dropped& dropped : scene.dropped)
        std::cerr << say("{}: dropped: {}{}{}\n", options.robot, escaped(dropped.what),
                         dropped.of.empty() ? "" : ": ",
                         escaped(fmt::format("{}", fmt::join(dropped.of, ", ")), 100'000));
    if (options.json) {
        Json result;
        result["file"] = options.output;
        result["bodies"] = scene.bodies;
        result["coordinates"] = scene.coordinates;
        if (options.drives) result["drives"] = scene.drives;
        result["right_angles"] = {{"rounded", rounded}, {"made_exact", options.right_angles}};
        if (!scene.loops.empty()) result["loops"] = scene.loops;
        if (!scene.couplings.empty()) result["couplings"] = scene.couplings;
        result["merged"] = scene.merged;
        result["frames"] = scene.frames;
        Json links = Json::object(), joints = Json::object();
        for (const auto& [own, name] : scene.links) links[own] = name;
        for (const auto& [own, name] : scene.joints) joints[own] = name;
        result["names"] = {{"links", links}, {"joints", joints}, {"coordinates", scene.coordinates_of}};
        result["dropped"] = Json::object();
        for (const Robot::Dropped& dropped : scene.dropped) result["dropped"][dropped.what] = dropped.of;
        result["warnings"] = Json::array();
        for (const Diagnostic& remark : robot.remarks)
            result["warnings"].push_back({{"line", remark.place.line}, {"message", remark.message}});
        show(result);
        return 0;
    }
    std::cout << say("{}\n{} bodies, {} coordinates: {}\n", options.output, scene.bodies, scene.coordinates.size(),
                     fmt::join(scene.coordinates, ", "));
    if (!scene.loops.empty()) std::cout << say("loops closed by {}\n", fmt::join(scene.loops, ", "));
    for (const std::string& sentence : scene.merged) fmt::print("{}\n", escaped(sentence, 300));
    return 0;
}

}  // namespace

void add_import(CLI::App& app, Chosen& chosen) {
    const auto options = std::make_shared<ImportOptions>();
    Verb verb = add_verb(app, {.name = "import",
                               .about = say("writes the scene of a robot description (URDF, MJCF, SDF)"),
                               .example = "alembert import tests/robots/arm6.urdf -o arm6.toml"});
    verb.add_option("robot", options->robot, say("the robot: a file in URDF, MJCF (MuJoCo) or SDF (Gazebo)"))
        .type_name(values::robot)
        .required();
    verb.add_option("-o,--output", options->output, say("the scene to be written"))
        .type_name(values::file)
        .required();
    verb.add_flag("--floating", options->floating, say("the root link moves freely; default: it is the ground"));
    verb.add_flag("--quaternion", options->quaternion, say("what floats turns by a quaternion"));
    verb.add_flag("--friction", options->friction, say("the Coulomb friction of the joints"));
    verb.add_flag("--stops", options->stops, say("contacts at the limits of the joints"));
    verb.add_flag("--drives", options->drives,
                  say("an input for the torque or force of each joint, or for each motor of the file"));
    verb.add_option("--loops", options->loops, say("a file of [[joint]]s between links, which close loops"))
        .type_name(values::file);
    verb.add_flag("--right-angles", options->right_angles, say("1.5708 and the like become right angles"));
    verb.add_flag("--json", options->json, say("print one JSON object"));
    verb.callback([options, &chosen] { chosen = {options->robot, [options] { return run(*options); }}; });
}

}  // namespace alembert
