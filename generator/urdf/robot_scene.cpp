// SPDX-License-Identifier: GPL-2.0-or-later
#include "urdf/robot_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "language/say.hpp"
#include "scene/text.hpp"
#include "urdf/scene_words.hpp"
#include "urdf/welded.hpp"

namespace alembert {

namespace {

constexpr const char* base = "floating_base";  // the name of the joint of a floating root

/// A body, with its names in the scene.
struct Group : WeldedBody {
    std::string name = "N";
    std::string frame = "N";
};

class Writer {
public:
    Writer(const Robot& robot, const RobotSceneOptions& options) : robot_(robot), options_(options) {
        WeldedLinks links = welded(robot, options.floating);
        for (WeldedBody& body : links.bodies) groups_.push_back({std::move(body)});
        seats_ = std::move(links.seats);
        result_.merged = std::move(links.merged);
        result_.dropped = std::move(links.dropped);
    }

    RobotScene write() {
        name_all();
        head();
        if (options_.floating) free_joint(joints_taken_.given(base), base, groups_[0], "N", {}, Real3::Zero());
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
            throw ModelError(say(
                "no link of this robot has a mass, so that no joint moves a mass; expected <inertial> with <mass> "
                "and <inertia> in the links (meshes alone have none)"));
        if (result_.coordinates.empty())
            throw ModelError(say(
                "this robot has no joint that moves a mass; expected a revolute, continuous, prismatic, planar or "
                "floating one, or a root that floats"));
        result_.text += joints_ + dampers_ + frictions_ + stops_;
        for (const Group& group : groups_) mounted(group);
        if (!result_.drives.empty()) result_.text += fmt::format("\n[inputs]\n{}\n[forces]\n{}", inputs_, forces_);
        result_.dropped.insert(result_.dropped.begin(), robot_.dropped.begin(), robot_.dropped.end());
        std::vector<std::string> without_friction;
        for (const Robot::Joint& joint : robot_.joints)
            if (joint.friction != 0 && !with_friction_.contains(joint.name))
                without_friction.push_back(joint.name);
        if (!without_friction.empty())
            result_.dropped.push_back({say("Coulomb friction, <dynamics friction=…>"), without_friction});
        return std::move(result_);
    }

private:
    const Robot::Link& link(int i) const { return robot_.links[static_cast<std::size_t>(i)]; }
    const Seat& seat(int i) const { return seats_[static_cast<std::size_t>(i)]; }

    void name_all() {
        const auto named = [&](SceneNames& names, const std::string& wanted) {
            const std::string name = names.given(wanted);
            const std::string note = say("{} is called {} in the scene", in_quotes(wanted), name);
            if (name != wanted &&
                std::find(result_.notes.begin(), result_.notes.end(), note) == result_.notes.end())
                result_.notes.push_back(note);
            return name;
        };
        for (Group& group : groups_) {
            if (group.ground || !group.kept) continue;
            group.frame = group.name = named(places_, link(group.top).name);
            const int above = link(group.top).joint;
            if (above < 0) continue;
            joint_names_.resize(robot_.joints.size());
            values_of_.resize(robot_.joints.size());
            const Robot::Joint& joint = robot_.joints[static_cast<std::size_t>(above)];
            joint_names_[static_cast<std::size_t>(above)] = named(joints_taken_, joint.name);
            if (!joint.mimic && joint.type != Robot::Type::floating && joint.type != Robot::Type::planar)
                values_of_[static_cast<std::size_t>(above)] = values_.given(joint.name);
        }
        link_names_.resize(robot_.links.size());
        for (const Group& group : groups_)
            for (const int i : group.links)
                if (!group.ground && group.kept && i != group.top)
                    link_names_[static_cast<std::size_t>(i)] = named(places_, link(i).name);
    }

    void head() {
        result_.text = fmt::format("title = {}\nsource = {}\ngravity = [0, 0, -9.81]\n", scene_text(robot_.name),
                                   scene_text("imported from " + options_.source));
    }

    void body(const Group& g, const std::string& placing = "") {
        const Real33& I = g.inertia;
        std::string held;
        for (const int i : g.links)
            if (i != g.top) held += (held.empty() ? "\n# with " : ", ") + escaped(link(i).name, 200);
        result_.text += fmt::format(
            "{}\n[[body]]\nname = \"{}\"\nmass = {}\n{}inertia = {{ xx = {}, yy = {}, zz = {}, xy = {}, yz = {}, "
            "zx = {} }}\n",
            held, g.name, scene_number(g.mass), placing, scene_number(I(0, 0)), scene_number(I(1, 1)),
            scene_number(I(2, 2)), scene_number(I(0, 1)), scene_number(I(1, 2)), scene_number(I(2, 0)));
        ++result_.bodies;
    }

    /// Adds a frame and a point of the same name for each link that is fixed to the body's own.
    void mounted(const Group& group) {
        if (group.ground || !group.kept) return;
        for (const int i : group.links) {
            if (i == group.top) continue;
            const std::string& name = link_names_[static_cast<std::size_t>(i)];
            std::vector<std::string> rotate = turns_of(seat(i));
            if (rotate.empty()) rotate.emplace_back("[\"z\", 0]");
            result_.text += fmt::format(
                "\n[[frame]]\nname = \"{0}\"\nparent = \"{1}\"\nrotate = {2}\n\n[[point]]\nname = \"{0}\"\nfrom = "
                "\"{3}\"\noffset = {4}\naxes = \"{1}\"\n",
                name, group.frame, rotations(rotate), group.name, scene_vector(seat(i).shift - group.centre));
            result_.frames.push_back(name);
        }
    }
    /// The rotations of the fixed joints that lead to a link.
    static std::vector<std::string> turns_of(const Seat& at) {
        std::vector<std::string> result;
        for (const Real3& rpy : at.turns) add_turns(result, rpy);
        return result;
    }
    static void add_turns(std::vector<std::string>& list, const Real3& rpy) {
        for (int k = 2; k >= 0; --k)
            if (rpy[k] != 0) list.push_back(fmt::format("[\"{}\", {}]", "xyz"[k], scene_angle(rpy[k])));
    }

    /// The pose of the joint in the group of its parent, relative to the mass centre of that group.
    struct Stand {
        const Group* parent;
        Real3 point;
        std::vector<std::string> rotate;
    };
    Stand stand(const Robot::Joint& joint) const {
        const Seat& at = seat(joint.parent);
        Stand result{.parent = &groups_[static_cast<std::size_t>(at.group)],
                     .point = at.shift + at.R * joint.at.shift,
                     .rotate = turns_of(at)};
        if (!result.parent->ground) result.point -= result.parent->centre;
        add_turns(result.rotate, joint.at.rpy);
        return result;
    }
    static std::string rotations(const std::vector<std::string>& list) {
        return fmt::format("[{}]", fmt::join(list, ", "));
    }

    std::string coordinate(const std::string& name, const std::string& unit, const std::string& about = "",
                           double initial = 0) {
        result_.coordinates.push_back(name);
        const std::string rest = about.empty() ? "" : fmt::format(", about = \"{}\"", about);
        return fmt::format("{} = {{ initial = {}, rate = 0{}{} }}", scene_key(name), scene_number(initial),
                           unit.empty() ? "" : fmt::format(", unit = \"{}\"", unit), rest);
    }
    void joint_table(const std::string& name, const char* type, const std::string& parent, const Group& child,
                     const Real3& point, const std::string& rest) {
        joints_ += fmt::format("\n[[joint]]\nname = \"{}\"\ntype = \"{}\"\nparent = \"{}\"\nchild = \"{}\"\n",
                               name, type, parent, child.name);
        if (!point.isZero(0)) joints_ += fmt::format("parent_point = {}\n", scene_vector(point));
        if (!child.centre.isZero(0)) joints_ += fmt::format("child_point = {}\n", scene_vector(-child.centre));
        joints_ += rest;
    }

    void free_joint(const std::string& own, const std::string& name, const Group& child, const std::string& parent,
                    const std::vector<std::string>& rotate, const Real3& point) {
        std::vector<std::string> list;
        for (const char* k : {"x", "y", "z"})
            list.push_back(coordinate(values_.given(fmt::format("{}_{}", name, k)), "m"));
        if (options_.quaternion)
            for (int k = 0; k < 4; ++k)
                list.push_back(coordinate(values_.given(fmt::format("{}_e{}", name, k)), "", "", k == 0 ? 1 : 0));
        else
            for (const char* k : {"yaw", "pitch", "roll"})
                list.push_back(coordinate(values_.given(fmt::format("{}_{}", name, k)), "rad"));
        joint_table(own, "free", parent, child, point,
                    fmt::format("{}{}coordinates = {{ {} }}\n",
                                rotate.empty() ? "" : fmt::format("parent_rotate = {}\n", rotations(rotate)),
                                options_.quaternion ? "" : "angles = \"zyx\"\n", fmt::join(list, ", ")));
    }

    void mover(const Robot::Joint& joint, const Group& child) {
        Stand at = stand(joint);
        const std::string& name = joint_names_[index(joint)];
        body(child);
        if (joint.type == Robot::Type::floating)
            return free_joint(name, joint.name, child, at.parent->name, at.rotate, at.point);
        if (joint.type == Robot::Type::planar) return planar(joint, child, std::move(at));
        const bool slides = joint.type == Robot::Type::prismatic;
        const std::string& q = values_of_[index(joint)];
        std::string about;
        if (joint.limits)
            about =
                fmt::format("limits {} to {}", scene_number((*joint.limits)[0]), scene_number((*joint.limits)[1]));
        const bool has_limits = joint.limits && (*joint.limits)[0] <= (*joint.limits)[1];
        double initial = 0;
        if (has_limits && ((*joint.limits)[0] > 0 || (*joint.limits)[1] < 0)) {
            if (options_.stops) initial = ((*joint.limits)[0] + (*joint.limits)[1]) / 2;
            result_.notes.push_back(options_.stops
                                        ? say("{} starts at {}, between its stops", q, scene_number(initial))
                                        : say("{} starts at 0, outside its limits", q));
        }
        const std::string rotate =
            at.rotate.empty() ? "" : fmt::format("parent_rotate = {}\n", rotations(at.rotate));
        joint_table(name, slides ? "prismatic" : "revolute", at.parent->name, child, at.point,
                    fmt::format("{}axis = {}\ncoordinates = {{ {} }}\n", rotate, scene_axis(joint.axis),
                                coordinate(q, slides ? "m" : "rad", about, initial)));
        damper(joint, q);
        friction(joint, q);
        if (has_limits) stops(joint, q);
        if (options_.stops && joint.limits && !has_limits)
            result_.notes.push_back(say("{} has no stops, because its lower limit is above the upper one", q));
        if (options_.drives) drive(joint, q, slides);
    }

    /// Adds an input along the joint's coordinate, which is zero until it is given a value.
    void drive(const Robot::Joint& joint, const std::string& q, bool slides) {
        const std::string name = values_.given("drive_" + joint.name);
        inputs_ += fmt::format("{} = {{ value = 0, unit = \"{}\" }}\n", scene_key(name), slides ? "N" : "N*m");
        forces_ += fmt::format("{} = \"{}\"\n", scene_key(q), name);
        result_.drives.push_back(name);
    }

    /// Adds a planar joint, with axes turned so that z is the normal.
    void planar(const Robot::Joint& joint, const Group& child, Stand at) {
        const Real3 a = joint.axis.normalized();
        std::string child_rotate;
        if (a[2] != 1) {
            const double across = std::hypot(a[0], a[1]);
            const std::string turn = across == 0 ? "[\"x\", \"pi\"]"
                                                 : fmt::format("[{}, {}]", scene_axis({-a[1], a[0], 0}),
                                                               scene_angle(std::atan2(across, a[2])));
            at.rotate.push_back(turn);
            child_rotate = fmt::format("child_rotate = [{}]\n", turn);
        }
        std::vector<std::string> list;
        for (const char* k : {"x", "y"})
            list.push_back(coordinate(values_.given(fmt::format("{}_{}", joint.name, k)), "m"));
        list.push_back(coordinate(values_.given(joint.name + "_turn"), "rad"));
        joint_table(joint_names_[index(joint)], "planar", at.parent->name, child, at.point,
                    fmt::format("{}{}coordinates = {{ {} }}\n",
                                at.rotate.empty() ? "" : fmt::format("parent_rotate = {}\n", rotations(at.rotate)),
                                child_rotate, fmt::join(list, ", ")));
    }

    /// Adds a frame and a point in place of a joint, without a coordinate and without a constraint.
    void follower(const Robot::Joint& joint, Group& child) {
        Stand at = stand(joint);
        const Robot::Mimic& mimic = *joint.mimic;
        const std::string& leader = values_of_[static_cast<std::size_t>(mimic.joint)];
        const bool moves = !leader.empty() && mimic.factor != 0;  // a fixed leader stays at 0
        std::string position = scene_number(mimic.offset);
        if (moves) {
            position = mimic.factor == 1    ? leader
                       : mimic.factor == -1 ? "-" + leader
                                            : fmt::format("{}*{}", scene_number(mimic.factor), leader);
            if (mimic.offset != 0)
                position +=
                    fmt::format(" {} {}", mimic.offset < 0 ? '-' : '+', scene_number(std::abs(mimic.offset)));
        }
        const bool slides = joint.type == Robot::Type::prismatic;
        const std::string& parent = at.parent->frame;
        if (!slides) at.rotate.push_back(fmt::format("[{}, \"{}\"]", scene_axis(joint.axis), position));
        child.frame = places_.given(child.name + "_frame");
        const std::string from = at.parent->ground ? "O" : at.parent->name;
        std::string pivot = places_.given(joint.name);
        result_.text += fmt::format("\n# {}\n[[frame]]\nname = \"{}\"\nparent = \"{}\"\n",
                                    moves ? fmt::format("{} moves with {}", escaped(joint.name), leader)
                                          : fmt::format("{} stands still", escaped(joint.name)),
                                    child.frame, parent);
        result_.text += fmt::format(
            "rotate = {}\n", rotations(at.rotate.empty() ? std::vector<std::string>{"[\"z\", 0]"} : at.rotate));
        result_.text += fmt::format("\n[[point]]\nname = \"{}\"\nfrom = \"{}\"\noffset = {}\naxes = \"{}\"\n",
                                    pivot, from, scene_vector(at.point), parent);
        if (slides) {
            const Real3 a = joint.axis.normalized();
            std::array<std::string, 3> shift;
            for (int k = 0; k < 3; ++k)
                shift[static_cast<std::size_t>(k)] =
                    a[k] == 0   ? "0"
                    : a[k] == 1 ? scene_text(position)
                                : scene_text(fmt::format("{}*({})", scene_number(a[k]), position));
            const std::string moved = places_.given(joint.name + "_shifted");
            result_.text +=
                fmt::format("\n[[point]]\nname = \"{}\"\nfrom = \"{}\"\noffset = [{}]\naxes = \"{}\"\n", moved,
                            pivot, fmt::join(shift, ", "), child.frame);
            pivot = moved;
        }
        body(child, fmt::format("frame = \"{}\"\nfrom = \"{}\"\nposition = {}\naxes = \"{}\"\n", child.frame,
                                pivot, scene_vector(child.centre), child.frame));
        if (moves) damper(joint, position);
    }

    void damper(const Robot::Joint& joint, const std::string& along) {
        if (joint.damping != 0)
            dampers_ +=
                fmt::format("\n[[damper]]\nalong = \"{}\"\ndamping = {}\n", along, scene_number(joint.damping));
    }

    /// Adds a torque or force of constant size against the motion along q.
    void friction(const Robot::Joint& joint, const std::string& q) {
        if (!options_.friction || joint.friction == 0) return;
        if (joint.friction < 0)
            throw ModelError(say("the friction of joint {} is {}; expected zero or more", in_quotes(joint.name),
                                 scene_number(joint.friction)));
        with_friction_.insert(joint.name);
        frictions_ += fmt::format("\n[[friction]]\nname = \"{}\"\ncoefficient = {}\nslip = \"{}'\"\nnormal = 1\n",
                                  values_.given(joint.name + "_friction"), scene_number(joint.friction), q);
    }

    /// Adds a contact at each end of the range of q, without rebound.
    void stops(const Robot::Joint& joint, const std::string& q) {
        if (!options_.stops) return;
        const auto [low, high] = *joint.limits;
        const auto stop = [&](const char* end, const std::string& gap) {
            stops_ += fmt::format("\n[[unilateral]]\nname = \"{}\"\ngap = \"{}\"\n",
                                  values_.given(fmt::format("{}_{}", joint.name, end)), gap);
        };
        stop("low", fmt::format("{} {} {}", q, low < 0 ? '+' : '-', scene_number(std::abs(low))));
        stop("high", fmt::format("{} - {}", scene_number(high), q));
    }

    std::size_t index(const Robot::Joint& joint) const {
        return static_cast<std::size_t>(&joint - robot_.joints.data());
    }

    const Robot& robot_;
    RobotSceneOptions options_;
    std::vector<Group> groups_;
    std::vector<Seat> seats_;
    SceneNames places_, values_, joints_taken_;
    std::vector<std::string> joint_names_, values_of_;  // for each joint of the robot
    std::vector<std::string> link_names_;               // of links that are fixed to others
    std::string joints_, dampers_, frictions_, stops_, inputs_, forces_;
    std::set<std::string> with_friction_;  // joints
    RobotScene result_;
};

}  // namespace

RobotScene robot_scene(const Robot& robot, const RobotSceneOptions& options) {
    return Writer(robot, options).write();
}

}  // namespace alembert
