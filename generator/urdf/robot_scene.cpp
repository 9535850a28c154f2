// SPDX-License-Identifier: GPL-2.0-or-later
// For bodies that are fixed to each other, with m, c, and I about each one's own mass centre, along common axes:
//   m = Σ m_i,   m c = Σ m_i c_i,   I = Σ I_i + m_i (d·d E − d dᵀ),   d = c_i − c.
#include "urdf/robot_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "alembert/inertia.hpp"
#include "scene/functions.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

constexpr const char* base = "floating_base";  // the name of the joint of a floating root

/// The shortest text that gives the same number.
std::string number(double value) {
    return value == 0 ? "0" : fmt::format("{}", value);
}
std::string vector(const Real3& v) {
    return fmt::format("[{}, {}, {}]", number(v[0]), number(v[1]), number(v[2]));
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (std::size_t i = 0; i < text.size();) {
        const char32_t c = decode(text, i);
        if (c == U'"' || c == U'\\') result += '\\';
        result += c == invalid_character || is_disturbing(c) ? "?" : encode(c);
    }
    return result + "\"";
}

/// Makes names that are legal in scenes, each of them once.
class Names {
public:
    std::string given(const std::string& wanted) {
        std::string name;
        for (std::size_t i = 0; i < wanted.size();) {
            const char32_t c = decode(wanted, i);
            const bool fits = c != invalid_character && (is_letter(c) || (is_digit(c) && !name.empty()));
            if (!fits && name.empty() && is_digit(c)) name = "_";
            name += fits || is_digit(c) ? encode(c) : "_";
        }
        if (name.empty()) name = "unnamed";
        while (!taken_.insert(name).second || is_reserved_function(name)) name += "_";
        return name;
    }

private:
    std::set<std::string> taken_{"N", "O", "t", "pi"};
};

/// Links that do not move relative to each other.
struct Group {
    int top;  ///< a link
    std::vector<int> links;
    double mass = 0;
    Real3 centre = Real3::Zero();
    Real33 inertia = Real33::Zero();
    bool ground = false, kept = true;
    std::string name = "N";
    std::string frame = "N";  ///< the name of its frame
};

/// The pose of a link in its group.
struct Seat {
    int group = -1;
    Real3 shift = Real3::Zero();
    Real33 R = Real33::Identity();
    std::vector<Real3> turns = {};  ///< roll, pitch, yaw of each fixed joint on the path to it
};

class Writer {
public:
    Writer(const Robot& robot, const RobotSceneOptions& options) : robot_(robot), options_(options) {}

    RobotScene write() {
        gather();
        leave_out_massless();
        name_all();
        head();
        if (options_.floating) free_joint(joints_taken_.given(base), base, groups_[0], "N", {}, Real3::Zero());
        for (const std::size_t g : order_) {
            Group& group = groups_[g];
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
                "no link of this robot has a mass, so that no joint moves a mass; expected <inertial> with <mass> "
                "and <inertia> in the links (meshes alone have none)");
        if (result_.coordinates.empty())
            throw ModelError(
                "this robot has no joint that moves a mass; expected a revolute, continuous, prismatic, planar or "
                "floating one, or a root that floats");
        result_.text += joints_ + dampers_;
        if (!result_.drives.empty()) result_.text += fmt::format("\n[inputs]\n{}\n[forces]\n{}", inputs_, forces_);
        result_.dropped.insert(result_.dropped.begin(), robot_.dropped.begin(), robot_.dropped.end());
        return std::move(result_);
    }

private:
    const Robot::Link& link(int i) const { return robot_.links[static_cast<std::size_t>(i)]; }
    const Seat& seat(int i) const { return seats_[static_cast<std::size_t>(i)]; }

    void gather() {
        seats_.resize(robot_.links.size());
        place(robot_.root);
        groups_[0].ground = !options_.floating;
        for (std::size_t g = 0; g < groups_.size(); ++g) sum_up(groups_[g]);
        if (groups_[0].ground && groups_[0].mass != 0) {
            std::vector<std::string> names;
            for (const int i : groups_[0].links)
                if (link(i).mass != 0) names.push_back(link(i).name);
            drop("mass that is fixed to the ground", names);
        }
    }
    int new_group(int top) {
        groups_.push_back({.top = top, .links = {}});
        order_.push_back(order_.size());
        return static_cast<int>(groups_.size()) - 1;
    }
    /// Down the tree without recursion, in the order of the file.
    void place(int root) {
        std::vector<std::vector<const Robot::Joint*>> below(robot_.links.size());
        for (const Robot::Joint& joint : robot_.joints)
            below[static_cast<std::size_t>(joint.parent)].push_back(&joint);
        std::vector<int> waiting{root};
        while (!waiting.empty()) {
            const int i = waiting.back();
            waiting.pop_back();
            Seat& own = seats_[static_cast<std::size_t>(i)];
            if (own.group < 0) own.group = new_group(i);
            groups_[static_cast<std::size_t>(own.group)].links.push_back(i);
            const auto& list = below[static_cast<std::size_t>(i)];
            for (auto joint = list.rbegin(); joint != list.rend(); ++joint) {
                const int child = (*joint)->child;
                waiting.push_back(child);
                if ((*joint)->type == Robot::Type::fixed)
                    seats_[static_cast<std::size_t>(child)] = fixed(own, **joint);
            }
            const int above = link(i).joint;
            if (above >= 0 && robot_.joints[static_cast<std::size_t>(above)].type == Robot::Type::fixed)
                result_.merged.push_back(
                    fmt::format("{} is fixed to {}", link(i).name,
                                link(robot_.joints[static_cast<std::size_t>(above)].parent).name));
        }
    }
    static Seat fixed(const Seat& parent, const Robot::Joint& joint) {
        Seat next{.group = parent.group,
                  .shift = parent.shift + parent.R * joint.at.shift,
                  .R = parent.R * joint.at.rotation(),
                  .turns = parent.turns};
        next.turns.push_back(joint.at.rpy);
        return next;
    }

    void sum_up(Group& group) const {
        std::vector<int> heavy;
        for (const int i : group.links)
            if (link(i).mass != 0 || !link(i).inertia.isZero(0)) heavy.push_back(i);
        const auto centre = [&](int i) -> Real3 { return seat(i).shift + seat(i).R * link(i).centre; };
        for (const int i : heavy) group.mass += link(i).mass;
        if (heavy.size() == 1)
            group.centre = centre(heavy[0]);
        else if (group.mass != 0)
            for (const int i : heavy) group.centre += link(i).mass / group.mass * centre(i);
        for (const int i : heavy)
            group.inertia += moved_from_centre<double>(turned<double>(link(i).inertia, seat(i).R), link(i).mass,
                                                       centre(i) - group.centre);
        if (const PrincipalAxes<> own = principal_axes<double>(group.inertia);
            !group.ground && has_negative_moment(own))
            throw ModelError(fmt::format(
                "link {}{} has the principal moments of inertia {:.6g}, {:.6g} and {:.6g}, which are not all zero "
                "or "
                "more; no body has them",
                in_quotes(link(group.top).name), group.links.size() > 1 ? ", with all that is fixed to it," : "",
                own.moments[0], own.moments[1], own.moments[2]));
    }

    void leave_out_massless() {
        std::vector<std::string> names;
        const auto of = [&](const Group& group) { return link(group.top).joint; };
        for (bool again = true; again;) {
            again = false;
            for (Group& group : groups_) {
                if (group.ground || !group.kept || group.mass != 0 || !group.inertia.isZero(0) || of(group) < 0)
                    continue;
                const int own = of(group);
                const bool needed = std::any_of(groups_.begin(), groups_.end(), [&](const Group& other) {
                    if (!other.kept || of(other) < 0 || &other == &group) return false;
                    const Robot::Joint& joint = robot_.joints[static_cast<std::size_t>(of(other))];
                    return &groups_[static_cast<std::size_t>(seat(joint.parent).group)] == &group ||
                           (joint.mimic && joint.mimic->joint == own);
                });
                if (needed) continue;
                group.kept = false;
                again = true;
                names.push_back(robot_.joints[static_cast<std::size_t>(own)].name);
            }
        }
        drop("joints that move no mass", names);
    }

    void name_all() {
        const auto named = [&](Names& names, const std::string& wanted) {
            const std::string name = names.given(wanted);
            const std::string note = fmt::format("{} is called {} in the scene", in_quotes(wanted), name);
            if (name != wanted &&
                std::find(result_.notes.begin(), result_.notes.end(), note) == result_.notes.end())
                result_.notes.push_back(note);
            return name;
        };
        for (const std::size_t g : order_) {
            Group& group = groups_[g];
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
    }

    void head() {
        result_.text = fmt::format("title = {}\nsource = {}\ngravity = [0, 0, -9.81]\n", quoted(robot_.name),
                                   quoted("imported from " + options_.source));
    }

    void body(const Group& g, const std::string& placing = "") {
        const Real33& I = g.inertia;
        std::string held;
        for (const int i : g.links)
            if (i != g.top) held += (held.empty() ? "\n# with " : ", ") + escaped(link(i).name, 200);
        result_.text += fmt::format(
            "{}\n[[body]]\nname = \"{}\"\nmass = {}\n{}inertia = {{ xx = {}, yy = {}, zz = {}, xy = {}, yz = {}, "
            "zx = {} }}\n",
            held, g.name, number(g.mass), placing, number(I(0, 0)), number(I(1, 1)), number(I(2, 2)),
            number(I(0, 1)), number(I(1, 2)), number(I(2, 0)));
        ++result_.bodies;
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
                     .rotate = {}};
        if (!result.parent->ground) result.point -= result.parent->centre;
        const auto add = [&](const Real3& rpy) {
            for (int k = 2; k >= 0; --k)
                if (rpy[k] != 0) result.rotate.push_back(fmt::format("[\"{}\", {}]", "xyz"[k], angle(rpy[k])));
        };
        for (const Real3& rpy : at.turns) add(rpy);
        add(joint.at.rpy);
        return result;
    }
    static std::string angle(double value) {
        const std::optional<int> k = twelfths_of_pi(value);
        if (!k) return number(value);
        const int by = std::gcd(*k, 12), over = 12 / by, times = *k / by;
        return fmt::format("\"{}pi{}\"",
                           times == 1    ? ""
                           : times == -1 ? "-"
                                         : fmt::format("{}*", times),
                           over == 1 ? "" : fmt::format("/{}", over));
    }
    /// An axis as a letter or a vector.
    static std::string axis(const Real3& a) {
        for (int k = 0; k < 3; ++k)
            if (a[k] > 0 && a[(k + 1) % 3] == 0 && a[(k + 2) % 3] == 0) return fmt::format("\"{}\"", "xyz"[k]);
        return vector(a);
    }
    static std::string rotations(const std::vector<std::string>& list) {
        return fmt::format("[{}]", fmt::join(list, ", "));
    }

    std::string coordinate(const std::string& name, const std::string& unit, const std::string& about = "",
                           double initial = 0) {
        result_.coordinates.push_back(name);
        const std::string rest = about.empty() ? "" : fmt::format(", about = \"{}\"", about);
        return fmt::format("{} = {{ initial = {}, rate = 0{}{} }}", key(name), number(initial),
                           unit.empty() ? "" : fmt::format(", unit = \"{}\"", unit), rest);
    }
    static std::string key(const std::string& name) {
        return std::all_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; })
                   ? name
                   : "\"" + name + "\"";
    }

    void joint_table(const std::string& name, const char* type, const std::string& parent, const Group& child,
                     const Real3& point, const std::string& rest) {
        joints_ += fmt::format("\n[[joint]]\nname = \"{}\"\ntype = \"{}\"\nparent = \"{}\"\nchild = \"{}\"\n",
                               name, type, parent, child.name);
        if (!point.isZero(0)) joints_ += fmt::format("parent_point = {}\n", vector(point));
        if (!child.centre.isZero(0)) joints_ += fmt::format("child_point = {}\n", vector(-child.centre));
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
            about = fmt::format("limits {} to {}", number((*joint.limits)[0]), number((*joint.limits)[1]));
        if (joint.limits && (*joint.limits)[0] <= (*joint.limits)[1] &&
            ((*joint.limits)[0] > 0 || (*joint.limits)[1] < 0))
            result_.notes.push_back(fmt::format("{} starts at 0, outside its limits", q));
        const std::string rotate =
            at.rotate.empty() ? "" : fmt::format("parent_rotate = {}\n", rotations(at.rotate));
        joint_table(name, slides ? "prismatic" : "revolute", at.parent->name, child, at.point,
                    fmt::format("{}axis = {}\ncoordinates = {{ {} }}\n", rotate, axis(joint.axis),
                                coordinate(q, slides ? "m" : "rad", about)));
        damper(joint, q);
        if (options_.drives) drive(joint, q, slides);
    }

    /// Adds an input along the joint's coordinate, which is zero until it is given a value.
    void drive(const Robot::Joint& joint, const std::string& q, bool slides) {
        const std::string name = values_.given("drive_" + joint.name);
        inputs_ += fmt::format("{} = {{ value = 0, unit = \"{}\" }}\n", key(name), slides ? "N" : "N*m");
        forces_ += fmt::format("{} = \"{}\"\n", key(q), name);
        result_.drives.push_back(name);
    }

    /// Adds a planar joint, with axes turned so that z is the normal.
    void planar(const Robot::Joint& joint, const Group& child, Stand at) {
        const Real3 a = joint.axis.normalized();
        std::string child_rotate;
        if (a[2] != 1) {
            const double across = std::hypot(a[0], a[1]);
            const std::string turn =
                across == 0 ? "[\"x\", \"pi\"]"
                            : fmt::format("[{}, {}]", axis({-a[1], a[0], 0}), angle(std::atan2(across, a[2])));
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
        std::string position = number(mimic.offset);
        if (moves) {
            position = mimic.factor == 1    ? leader
                       : mimic.factor == -1 ? "-" + leader
                                            : fmt::format("{}*{}", number(mimic.factor), leader);
            if (mimic.offset != 0)
                position += fmt::format(" {} {}", mimic.offset < 0 ? '-' : '+', number(std::abs(mimic.offset)));
        }
        const bool slides = joint.type == Robot::Type::prismatic;
        const std::string& parent = at.parent->frame;
        if (!slides) at.rotate.push_back(fmt::format("[{}, \"{}\"]", axis(joint.axis), position));
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
                                    pivot, from, vector(at.point), parent);
        if (slides) {
            const Real3 a = joint.axis.normalized();
            std::array<std::string, 3> shift;
            for (int k = 0; k < 3; ++k)
                shift[static_cast<std::size_t>(k)] = a[k] == 0 ? "0"
                                                     : a[k] == 1
                                                         ? quoted(position)
                                                         : quoted(fmt::format("{}*({})", number(a[k]), position));
            const std::string moved = places_.given(joint.name + "_shifted");
            result_.text +=
                fmt::format("\n[[point]]\nname = \"{}\"\nfrom = \"{}\"\noffset = [{}]\naxes = \"{}\"\n", moved,
                            pivot, fmt::join(shift, ", "), child.frame);
            pivot = moved;
        }
        body(child, fmt::format("frame = \"{}\"\nfrom = \"{}\"\nposition = {}\naxes = \"{}\"\n", child.frame,
                                pivot, vector(child.centre), child.frame));
        if (moves) damper(joint, position);
    }

    void damper(const Robot::Joint& joint, const std::string& along) {
        if (joint.damping != 0)
            dampers_ += fmt::format("\n[[damper]]\nalong = \"{}\"\ndamping = {}\n", along, number(joint.damping));
    }

    std::size_t index(const Robot::Joint& joint) const {
        return static_cast<std::size_t>(&joint - robot_.joints.data());
    }
    void drop(const std::string& what, std::vector<std::string> of) {
        if (!of.empty()) result_.dropped.push_back({what, std::move(of)});
    }

    const Robot& robot_;
    RobotSceneOptions options_;
    std::vector<Group> groups_;
    std::vector<std::size_t> order_;
    std::vector<Seat> seats_;
    Names places_, values_, joints_taken_;
    std::vector<std::string> joint_names_, values_of_;  // for each joint of the robot
    std::string joints_, dampers_, inputs_, forces_;
    RobotScene result_;
};

}  // namespace

RobotScene robot_scene(const Robot& robot, const RobotSceneOptions& options) {
    return Writer(robot, options).write();
}

}  // namespace alembert
