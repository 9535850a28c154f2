// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/import.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "base/language/say.hpp"
#include "commands/output.hpp"
#include "commands/show.hpp"
#include "commands/values.hpp"
#include "commands/verb.hpp"
#include "scene/import/loops.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

struct ImportVerb {
    std::string robot, output, loops;
    RobotSceneOptions scene;
    OtherFiles others;
    bool right_angles = false, strict = false, json = false;
};

/// What is dropped, that which changes the motion first and then once more by its kinds.
void tell_dropped(const std::string& robot, const std::vector<Robot::Dropped>& all) {
    std::vector<std::string> changes;
    for (const bool moves : {true, false})
        for (const Robot::Dropped& dropped : all) {
            if ((dropped.effect == Robot::Effect::motion) != moves) continue;
            std::cerr << say("{}: dropped: {}{}{}\n", robot, escaped(dropped.what), dropped.of.empty() ? "" : ": ",
                             escaped(fmt::format("{}", fmt::join(dropped.of, ", ")), 100'000));
            if (moves) changes.push_back(escaped(dropped.what));
        }
    if (!changes.empty())
        std::cerr << say("{}: the motion is changed by what is dropped: {}\n", robot, fmt::join(changes, "; "));
}

void refuse_changes(const std::string& robot, const std::vector<Robot::Dropped>& all) {
    std::vector<std::string> changes;
    for (const Robot::Dropped& dropped : all)
        if (dropped.effect == Robot::Effect::motion)
            changes.push_back(dropped.what +
                              (dropped.of.empty() ? "" : fmt::format(" ({})", fmt::join(dropped.of, ", "))));
    if (!changes.empty())
        throw ModelError(
            say("{}: the scene would leave out what changes the motion: {}; nothing is written with --strict",
                robot, escaped(fmt::format("{}", fmt::join(changes, "; ")), 2000)));
}

/// What versions of MuJoCo take otherwise, where it is in the scene: motors are with --drives.
void refuse_versions(const std::string& robot, const std::vector<Diagnostic>& remarks, bool is_driven) {
    for (const Diagnostic& remark : remarks)
        if (remark.kind == "version" && is_driven)
            throw ModelError(say("{}:{}:{}: {}; nothing is written with --strict", robot, remark.place.line,
                                 remark.place.column, remark.message));
}

int run(const ImportVerb& verb) {
    check_output(verb.output, FileForm::scene, {verb.robot, verb.loops});
    const ImportedRobot imported = imported_robot(verb.robot, {.scene = verb.scene,
                                                               .others = verb.others,
                                                               .right_angles = verb.right_angles,
                                                               .strict = verb.strict,
                                                               .loops = verb.loops});
    const RobotScene& scene = imported.scene;
    parse_scene(scene.text, verb.output);  // a scene that is refused is not written
    write_file(verb.output, scene.text, {verb.robot, verb.loops});
    for (const Diagnostic& remark : imported.remarks)
        std::cerr << say("{}:{}:{}: warning: {}\n", verb.robot, remark.place.line, remark.place.column,
                         escaped(remark.message, 300));
    for (const std::string& sentence : scene.notes)
        std::cerr << say("{}: note: {}\n", verb.robot, escaped(sentence, 300));
    tell_dropped(verb.robot, scene.dropped);
    if (verb.json) {
        show(as_json(imported, verb.output));
        return 0;
    }
    std::cout << say("{}\n{} bodies, {} coordinates: {}\n", verb.output, scene.bodies, scene.coordinates.size(),
                     fmt::join(scene.coordinates, ", "));
    if (!scene.loops.empty()) std::cout << say("loops closed by {}\n", fmt::join(scene.loops, ", "));
    for (const std::string& sentence : scene.merged) std::cout << escaped(sentence, 300) << "\n";
    return 0;
}

}  // namespace

ImportedRobot imported_robot(const std::string& file, ImportOptions options) {
    Robot robot = read_robot(file, options.others);
    if (!options.loops.empty()) {
        close_loops(robot, options.loops);
        options.scene.guesses = true;
    }
    options.scene.source = std::filesystem::path(file).filename().string();
    const int rounded = rounded_right_angles(robot, options.right_angles);
    ImportedRobot result{.scene = robot_scene(robot, options.scene),
                         .remarks = robot.remarks,
                         .rounded = rounded,
                         .made_exact = options.right_angles,
                         .has_drives = options.scene.drives};
    if (options.strict) {
        refuse_changes(file, result.scene.dropped);
        refuse_versions(file, robot.remarks, options.scene.drives);
    }
    if (rounded > 0 && !options.right_angles)
        result.scene.notes.push_back(
            say("{} angle{} a right angle written with few digits, as 1.5708; with --right-angles {} exact, "
                "which leaves terms out of the equations",
                rounded, rounded == 1 ? " is" : say("s are each"),
                rounded == 1 ? say("it becomes") : say("they become")));
    return result;
}

Json as_json(const ImportedRobot& imported, const std::string& file) {
    const RobotScene& scene = imported.scene;
    Json result;
    result["file"] = file;
    result["bodies"] = scene.bodies;
    result["coordinates"] = scene.coordinates;
    if (imported.has_drives) result["drives"] = scene.drives;
    result["right_angles"] = {{"rounded", imported.rounded}, {"made_exact", imported.made_exact}};
    if (!scene.loops.empty()) result["loops"] = scene.loops;
    if (!scene.couplings.empty()) result["couplings"] = scene.couplings;
    result["merged"] = scene.merged;
    result["frames"] = scene.frames;
    Json links = Json::object(), joints = Json::object();
    for (const auto& [own, name] : scene.links) links[own] = name;
    for (const auto& [own, name] : scene.joints) joints[own] = name;
    result["names"] = {{"links", links}, {"joints", joints}, {"coordinates", scene.coordinates_of}};
    result["dropped"] = result["changes_motion"] = Json::object();
    const auto list = [&](const char* field, const Robot::Dropped& dropped) {
        Json& names = result[field][dropped.what];
        if (names.is_null()) names = Json::array();
        for (const std::string& name : dropped.of) names.push_back(name);
    };
    for (const Robot::Dropped& dropped : scene.dropped) {
        list("dropped", dropped);
        if (dropped.effect == Robot::Effect::motion) list("changes_motion", dropped);
    }
    result["warnings"] = Json::array();
    for (const Diagnostic& remark : imported.remarks)
        result["warnings"].push_back({{"line", remark.place.line}, {"message", remark.message}});
    return result;
}

void add_import(CLI::App& app, Chosen& chosen) {
    const auto options = std::make_shared<ImportVerb>();
    Verb verb = add_verb(app, {.name = "import",
                               .about = say("writes the scene of a robot description (URDF, MJCF, SDF)"),
                               .example = "alembert import tests/robots/arm6.urdf -o arm6.toml"});
    verb.add_option("robot", options->robot, say("the robot: a file in URDF, MJCF (MuJoCo) or SDF (Gazebo)"))
        .type_name(values::robot)
        .required();
    verb.add_option("-o,--output", options->output, say("the scene to be written"))
        .type_name(values::file)
        .required();
    verb.add_flag("--floating", options->scene.floating,
                  say("the root link moves freely; default: it is the ground"));
    verb.add_flag("--quaternion", options->scene.quaternion, say("what floats turns by a quaternion"));
    verb.add_flag("--friction", options->scene.friction, say("the Coulomb friction of the joints"));
    verb.add_flag("--stops", options->scene.stops, say("contacts at the limits of the joints"));
    verb.add_flag("--drives", options->scene.drives,
                  say("an input for the torque or force of each joint, or for each motor of the file"));
    verb.add_option("--keyframe", options->scene.keyframe,
                    say("the state of an MJCF file in which the scene starts"))
        .type_name(values::name);
    verb.add_flag("--mend-inertia", options->scene.mend_inertia,
                  say("an inertia that no body has becomes the nearest possible"));
    verb.add_option("--loops", options->loops, say("a file of [[joint]]s between links, which close loops"))
        .type_name(values::file);
    verb.add_flag("--strict", options->strict,
                  say("refuses a robot if the scene leaves out what changes its motion"));
    verb.add_option("--package", options->others.packages,
                    say("a folder in which models that an SDF file includes are looked up; may be given often"))
        .type_name(values::folder);
    verb.add_flag("--allow-outside", options->others.outside,
                  say("also reads files outside the folder of the robot, if it includes them"));
    verb.add_flag("--right-angles", options->right_angles, say("1.5708 and the like become right angles"));
    verb.take("--json", options->json);
    verb.callback([options, &chosen] { chosen = {options->robot, [options] { return run(*options); }}; });
}

}  // namespace alembert
