// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/robot_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/language/say.hpp"
#include "scene/import/scene_writer.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

/// a − b; 0 where only the rounding of sums is left, such as 0.1 + 0.2 − 0.3.
Real3 difference(const Real3& a, const Real3& b) {
    constexpr double rounded = 4 * std::numeric_limits<double>::epsilon();
    Real3 result = a - b;
    for (int k = 0; k < 3; ++k)
        if (std::abs(result[k]) <= rounded * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()))
            result[k] = 0;
    return result;
}

constexpr const char* base = "floating_base";  // the name of the joint of a floating root

bool has_one_coordinate(Robot::Type type) {
    return type == Robot::Type::revolute || type == Robot::Type::continuous || type == Robot::Type::prismatic ||
           type == Robot::Type::screw;
}

}  // namespace

SceneWriter::SceneWriter(const Robot& robot, const RobotSceneOptions& options) : robot_(robot), options_(options) {
    if (options_.floating && robot.has_world) {
        options_.floating = false;
        result_.notes.push_back(
            say("--floating is for URDF, in which nothing says what floats; here the file says it"));
    }
    WeldedLinks links = welded(robot, options_.floating, options_.mend_inertia);
    for (std::string& one : links.mended) result_.notes.push_back(std::move(one));
    for (WeldedBody& body : links.bodies) groups_.push_back({std::move(body)});
    seats_ = std::move(links.seats);
    result_.merged = std::move(links.merged);
    result_.dropped = std::move(links.dropped);
}

RobotScene SceneWriter::write() {
    name_all();
    choose_starts();
    head();
    if (options_.floating) {
        const Group ground{};
        free_joint(nullptr, joints_taken_.given(base), base, groups_[0], {&ground, Real3::Zero(), {}}, {});
    }
    for (Group& group : groups_) {
        if (group.ground || !group.kept) continue;
        const int above = link(group.top).joint;
        if (above < 0) {
            body(group);
            continue;
        }
        const Robot::Joint& joint = robot_.joints[static_cast<std::size_t>(above)];
        if (joint.mimic)
            follower(joint, group);
        else
            mover(joint, group);
    }
    if (std::none_of(robot_.links.begin(), robot_.links.end(),
                     [](const Robot::Link& l) { return l.mass != 0 || !l.inertia.isZero(0); }))
        throw ModelError(
            say("no link of this robot has a mass, so that no joint moves a mass; expected <inertial> with <mass> "
                "and <inertia> in the links (meshes alone have none)"));
    if (result_.coordinates.empty())
        throw ModelError(
            say("this robot has no joint that moves a mass; expected a revolute, continuous, prismatic, planar or "
                "floating one, or a root that floats"));
    for (const Group& group : groups_) held(group);
    lengths_.resize(robot_.tendons.size());
    for (std::size_t k = 0; k < robot_.tendons.size(); ++k) tendon(robot_.tendons[k], lengths_[k]);
    for (const Robot::Loop& one : robot_.loops) loop(one);
    for (const Robot::Coupling& one : robot_.couplings) coupling(one);
    if (options_.drives && robot_.actuators) actuators();
    result_.text += joints_ + points_ + dampers_ + springs_ + frictions_ + stops_ + conditions_;
    energies();
    for (const Group& group : groups_) mounted(group);
    if (!result_.drives.empty()) {
        result_.text += fmt::format("\n[inputs]\n{}\n[forces]\n", inputs_);
        for (const auto& [q, sum] : forces_) result_.text += fmt::format("{} = \"{}\"\n", scene_key(q), sum);
    }
    drop_the_rest();
    map_names();
    return std::move(result_);
}

void SceneWriter::name_all() {
    const auto named = [&](SceneNames& names, const std::string& wanted) {
        const std::string name = names.given(wanted);
        const std::string note = say("{} is called {} in the scene", in_quotes(wanted), name);
        if (name != wanted && std::find(result_.notes.begin(), result_.notes.end(), note) == result_.notes.end())
            result_.notes.push_back(note);
        return name;
    };
    joint_names_.resize(robot_.joints.size());
    values_of_.resize(robot_.joints.size());
    for (Group& group : groups_) {
        if (group.ground || !group.kept) continue;
        group.frame = group.name = named(places_, link(group.top).name);
        const int above = link(group.top).joint;
        if (above < 0) continue;
        const Robot::Joint& joint = robot_.joints[static_cast<std::size_t>(above)];
        joint_names_[index(joint)] = named(joints_taken_, joint.name);
        if (!joint.mimic && has_one_coordinate(joint.type)) values_of_[index(joint)] = values_.given(joint.name);
    }
    link_names_.resize(robot_.links.size());
    for (const Group& group : groups_)
        for (const int i : group.links)
            if (!group.ground && group.kept && i != group.top)
                link_names_[static_cast<std::size_t>(i)] = named(places_, link(i).name);
    for (Group& group : groups_)
        if (!group.ground && group.kept)
            group.centre_name = group.centre.isZero(0) ? group.name : places_.given(group.name + "_centre");
}

void SceneWriter::head() {
    result_.text =
        fmt::format("title = {}\nsource = {}\ngravity = {}\nallow = [\"unused\"]\n", scene_text(robot_.name),
                    scene_text("imported from " + options_.source), scene_vector(robot_.gravity));
}

void SceneWriter::body(const Group& g, const std::string& placing) {
    const Real33& I = g.inertia;
    std::string held;
    for (const int i : g.links)
        if (i != g.top) held += (held.empty() ? "\n# with " : ", ") + escaped(link(i).name, 200);
    result_.text += fmt::format(
        "{}\n[[body]]\nname = \"{}\"\n{}mass = {}\n{}inertia = {{ xx = {}, yy = {}, zz = {}, xy = {}, yz = {}, "
        "zx = {} }}\n",
        held, g.name, g.centre_name == g.name ? "" : fmt::format("centre = \"{}\"\n", g.centre_name),
        scene_number(g.mass), placing, scene_number(I(0, 0)), scene_number(I(1, 1)), scene_number(I(2, 2)),
        scene_number(I(0, 1)), scene_number(I(1, 2)), scene_number(I(2, 0)));
    ++result_.bodies;
}

/// Adds a frame and a point of the same name for each link that is fixed to the body's own, and for that one the
/// point alone, its origin, if the mass centre is elsewhere.
void SceneWriter::mounted(const Group& group) {
    if (group.ground || !group.kept) return;
    if (group.centre_name != group.name)
        result_.text += fmt::format("\n[[point]]\nname = \"{}\"\nfrom = \"{}\"\noffset = {}\naxes = \"{}\"\n",
                                    group.name, group.centre_name, scene_vector(-group.centre), group.frame);
    for (const int i : group.links) {
        if (i == group.top) continue;
        const std::string& name = link_names_[static_cast<std::size_t>(i)];
        std::vector<std::string> rotate = turns_of(seat(i));
        if (rotate.empty()) rotate.emplace_back("[\"z\", 0]");
        result_.text += fmt::format(
            "\n[[frame]]\nname = \"{0}\"\nparent = \"{1}\"\nrotate = {2}\n\n[[point]]\nname = \"{0}\"\nfrom = "
            "\"{3}\"\noffset = {4}\naxes = \"{1}\"\n",
            name, group.frame, scene_list(rotate), group.centre_name,
            scene_vector(difference(seat(i).shift, group.centre)));
        result_.frames.push_back(name);
    }
}

void SceneWriter::drop(const std::string& what, std::vector<std::string> of, Robot::Effect effect) {
    if (!of.empty()) result_.dropped.push_back({what, std::move(of), effect});
}

/// Friction, limits and motors that the options leave out; and what of the rest changes the motion now.
void SceneWriter::drop_the_rest() {
    using Effect = Robot::Effect;
    result_.dropped.insert(result_.dropped.begin(), robot_.dropped.begin(), robot_.dropped.end());
    const auto without = [](const auto& list, auto is_left_out) {
        std::vector<std::string> names;
        for (const auto& one : list)
            if (is_left_out(one)) names.push_back(one.name);
        return names;
    };
    const auto rubs = [&](const auto& one) { return one.friction != 0 && !with_friction_.contains(one.name); };
    const auto stops = [&](const auto& one) { return one.limits && !with_stops_.contains(one.name); };
    drop(say("Coulomb friction of joints, without --friction"), without(robot_.joints, rubs), Effect::motion);
    drop(say("Coulomb friction of tendons, without --friction"), without(robot_.tendons, rubs), Effect::motion);
    drop(say("limits of joints, without --stops"), without(robot_.joints, stops), Effect::motion);
    drop(say("limits of tendons, without --stops"), without(robot_.tendons, stops), Effect::motion);
    if (robot_.actuators && !options_.drives) {
        const auto alone = [](const Robot::Actuator& motor) { return motor.acts_alone(); };
        drop(say("motors, without --drives"), without(*robot_.actuators, std::not_fn(alone)));
        drop(say("motors that act without a control too, without --drives"), without(*robot_.actuators, alone),
             Effect::motion);
    }
    for (Robot::Dropped& one : result_.dropped)
        if (one.effect == Effect::driven) one.effect = options_.drives ? Effect::motion : Effect::none;
}

/// What links and joints are called in the scene.
void SceneWriter::map_names() {
    for (std::size_t i = 0; i < robot_.links.size(); ++i) {
        const Group& group = groups_[static_cast<std::size_t>(seats_[i].group)];
        if (!group.kept) continue;
        const bool is_top = group.ground || group.top == static_cast<int>(i);
        result_.links.emplace_back(robot_.links[i].name, is_top ? group.name : link_names_[i]);
    }
    for (std::size_t k = 0; k < robot_.joints.size(); ++k)
        if (!joint_names_[k].empty()) result_.joints.emplace_back(robot_.joints[k].name, joint_names_[k]);
}

/// The rotations of the fixed joints that lead to a link.
std::vector<std::string> SceneWriter::turns_of(const Seat& at) {
    std::vector<std::string> result;
    for (const Real3& rpy : at.turns) add_turns(result, rpy);
    return result;
}

void SceneWriter::add_turns(std::vector<std::string>& list, const Real3& rpy) {
    for (int k = 2; k >= 0; --k)
        if (rpy[k] != 0) list.push_back(fmt::format("[\"{}\", {}]", "xyz"[k], scene_angle(rpy[k])));
}

SceneWriter::Stand SceneWriter::stand(int of, const RobotPose& at) const {
    const Seat& own = seat(of);
    Stand result{.parent = &groups_[static_cast<std::size_t>(own.group)],
                 .point = own.shift + own.R * at.shift,
                 .rotate = turns_of(own)};
    if (!result.parent->ground) result.point = difference(result.point, result.parent->centre);
    add_turns(result.rotate, at.rpy);
    return result;
}

RobotScene robot_scene(const Robot& robot, const RobotSceneOptions& options) {
    return SceneWriter(robot, options).write();
}

}  // namespace alembert
