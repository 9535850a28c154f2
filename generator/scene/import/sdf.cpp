// SPDX-License-Identifier: GPL-2.0-or-later
// SDF, the format of Gazebo (sdformat.org). Links stand freely in the world; joints hold them together, in any
// order and in loops. A tree is grown from the world: each joint that reaches a new link places it, and what no
// joint reaches floats. The other joints close loops. A link's frame here has its own axes, and its origin at the
// joint that places it.
#include <fmt/format.h>

#include <cstring>
#include <map>
#include <set>

#include "alembert/base/inertia.hpp"
#include "base/language/say.hpp"
#include "scene/import/sdf_include.hpp"
#include "scene/import/sdf_left_out.hpp"
#include "scene/import/sdf_poses.hpp"
#include "scene/text.hpp"

namespace alembert {

namespace {

using Type = Robot::Type;
using Kind = SdfPoses::Entry::Kind;

constexpr double no_limit = 1e15;  // SDF writes 1e16 for a joint without limits

class SdfReader {
public:
    SdfReader(const std::string& text, const std::string& file, const OtherFiles& others)
        : file_(text, file), poses_(file_) {
        include_models(file_, file, others);
    }

    Robot read() {
        const XmlElement& root = file_.root();
        const auto version = file_.text(root, "version");
        old_axes_ = version && (*version == "1.4" || *version == "1.3" || *version == "1.2" || *version == "1.0");
        file_.ignore(root, "version");
        std::vector<const XmlElement*> models = file_.children(root, "model");
        for (const XmlElement* world : file_.children(root, "world")) {
            file_.ignore(*world, "name");
            const XmlElement* const g = file_.only(*world, "gravity");
            const std::vector<double> v = g != nullptr ? file_.numbers_in(*g, 3) : std::vector<double>{0, 0, -9.8};
            robot_.gravity = {v[0], v[1], v[2]};
            for (const XmlElement* model : file_.children(*world, "model")) models.push_back(model);
        }
        if (models.empty()) file_.refuse(root, say("no <model> is found; expected one, or some in a <world>"));
        for (const XmlElement* model : models) poses_.add_model(*model, file_.needed_text(*model, "name"), "");
        robot_.name = file_.needed_text(*models[0], "name");
        robot_.has_world = true;
        one_model_ = models.size() == 1 ? robot_.name + "::" : "";
        robot_.links.push_back({.name = "world", .place = {}});
        frames_["world"] = {0, {}};
        for (const XmlElement* model : models) hold_static(*model);
        grow();
        for (const std::string& path : poses_.order())
            if (poses_.entries().at(path).kind == Kind::frame) add_frame(path);
        follow_leaders();
        robot_.dropped = file_.left_out(effect_in_sdf);
        robot_.remarks = file_.remarks();
        return std::move(robot_);
    }

private:
    struct Frame {
        int link;
        RobotPlace place;  ///< in the world
    };
    struct Follower {
        int joint;
        std::string leader;
        double factor, offset;
        const XmlElement* element;
    };

    const SdfPoses::Entry& entry(const std::string& path) const { return poses_.entries().at(path); }
    std::string short_name(const std::string& path) const {
        return path.starts_with(one_model_) ? path.substr(one_model_.size()) : path;
    }

    void hold_static(const XmlElement& model) {
        if (!file_.flag_in(model, "static").value_or(false)) return;
        const std::string scope = file_.needed_text(model, "name") + "::";
        for (const std::string& path : poses_.order())
            if (path.starts_with(scope) && entry(path).kind == Kind::link) hold(path, Type::fixed);
    }

    /// Adds a link whose frame stands at `place`, on the link `parent`.
    Robot::Joint& add_link(const std::string& path, const RobotPlace& place, const std::string& parent,
                           const std::string& name, Type type) {
        const XmlElement& e = *entry(path).element;
        const Frame above = frames_.at(parent);
        const RobotPlace at = composed(inverted(above.place), place);
        const int link = static_cast<int>(robot_.links.size());
        robot_.links.push_back({.name = short_name(path),
                                .place = XmlFile::place_of(e),
                                .joint = static_cast<int>(robot_.joints.size())});
        frames_[path] = {link, place};
        if (entry(path).kind == Kind::link) read_inertial(e, path, robot_.links.back());
        robot_.joints.push_back({.name = name,
                                 .place = XmlFile::place_of(e),
                                 .type = type,
                                 .parent = above.link,
                                 .child = link,
                                 .at = at.pose(),
                                 .axis = Real3::UnitX()});
        return robot_.joints.back();
    }

    /// Adds a link that no joint holds: it floats, or is fixed to the ground.
    void hold(const std::string& path, Type type) {
        const RobotPlace place = poses_.place(path);
        Robot::Joint& joint = add_link(path, place, "world", short_name(path), type);
        if (type != Type::floating) return;
        joint.at = {};
        joint.start = place.pose();
    }

    void add_frame(const std::string& path) {
        const std::string on = poses_.link(path);
        if (on != "world" && !frames_.contains(path))
            add_link(path, poses_.place(path), on, short_name(path), Type::fixed);
    }

    void read_inertial(const XmlElement& e, const std::string& path, Robot::Link& link) {
        const XmlElement* const inertial = file_.only(e, "inertial");
        if (file_.flag_in(e, "kinematic") == true)
            file_.refuse(e, say("link {} is kinematic, which a scene does not know", in_quotes(path)));
        if (file_.flag_in(e, "gravity") == false) link.held = 1;
        double mass = 1, moments[] = {1, 1, 1}, products[] = {0, 0, 0};
        RobotPlace at;
        if (inertial == nullptr) {
            file_.remark(e,
                         say("link {} has no <inertial>: its mass is 1 and its moments of inertia are 1, as SDF "
                             "has it",
                             in_quotes(path)));
        } else {
            if (file_.flag(*inertial, "auto").value_or(false))
                file_.refuse(*inertial, say("the inertia of {} is to be computed from its shapes; expected <mass> "
                                            "and <inertia>",
                                            in_quotes(path)));
            if (const XmlElement* const pose = file_.only(*inertial, "pose")) at = poses_.written(*pose);
            mass = file_.number_in(*inertial, "mass").value_or(mass);
            if (const XmlElement* const I = file_.only(*inertial, "inertia")) {
                const char* const diagonal[] = {"ixx", "iyy", "izz"};
                const char* const others[] = {"ixy", "iyz", "ixz"};
                for (int k = 0; k < 3; ++k) {
                    moments[k] = file_.number_in(*I, diagonal[k]).value_or(moments[k]);
                    products[k] = file_.number_in(*I, others[k]).value_or(products[k]);
                }
            }
        }
        if (mass < 0)
            file_.refuse(e, say("the mass of link {} is {}; expected zero or more", in_quotes(path), mass));
        const RobotPlace inside = composed(inverted(frames_.at(path).place), poses_.place(path));
        at = composed(inside, at);
        link.mass = mass;
        link.centre = at.shift;
        link.inertia = turned<double>(
            inertia_matrix<double>({moments[0], moments[1], moments[2], products[0], products[1], products[2]}),
            at.R);
    }

    /// The two links of a joint, as paths.
    std::pair<std::string, std::string> sides(const std::string& path) {
        const XmlElement& e = *entry(path).element;
        const auto side = [&](const char* tag) {
            const auto name = file_.text_in(e, tag);
            if (!name || name->empty()) file_.refuse(e, say("joint {} has no <{}>", in_quotes(path), tag));
            return poses_.link(poses_.path(e, entry(path).scope, *name));
        };
        return {side("parent"), side("child")};
    }

    void grow() {
        std::vector<std::string> waiting;
        std::set<std::string> children;
        for (const std::string& path : poses_.order())
            if (entry(path).kind == Kind::joint && is_gearbox(path)) {
                gearboxes_.push_back(path);
            } else if (entry(path).kind == Kind::joint) {
                waiting.push_back(path);
                children.insert(sides(path).second);
            }
        const auto next_root = [&](bool any) {
            for (const std::string& path : poses_.order())
                if (entry(path).kind == Kind::link && !frames_.contains(path) && (any || !children.contains(path)))
                    return path;
            return std::string();
        };
        for (;;) {
            for (bool again = true; again;) {
                again = false;
                for (std::size_t k = 0; k < waiting.size() && !again; ++k) {
                    const auto [parent, child] = sides(waiting[k]);
                    const bool reaches_child = frames_.contains(parent) && !frames_.contains(child),
                               reaches_parent = frames_.contains(child) && !frames_.contains(parent);
                    if (!reaches_child && !reaches_parent) continue;
                    place_by(waiting[k], reaches_child ? parent : child, reaches_child ? child : parent,
                             reaches_parent);
                    waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(k));
                    again = true;
                }
            }
            std::string root = next_root(false);
            if (root.empty()) root = next_root(true);
            if (root.empty()) break;
            hold(root, Type::floating);
        }
        for (const std::string& path : waiting) close_by(path);
        for (const std::string& path : gearboxes_) gear(path);
    }

    bool is_gearbox(const std::string& path) {
        return file_.needed_text(*entry(path).element, "type") == "gearbox";
    }

    /// Couples the angles of two hinges on the reference body: θ₂ = −ratio·θ₁, where θ₁ is that of the gearbox's
    /// parent about <axis> and θ₂ that of its child about <axis2>.
    void gear(const std::string& path) {
        const XmlElement& e = *entry(path).element;
        const auto [parent, child] = sides(path);
        const std::string body = file_.text_in(e, "gearbox_reference_body").value_or("");
        if (body.empty()) file_.refuse(e, say("the gearbox {} has no <gearbox_reference_body>", in_quotes(path)));
        const std::string reference = poses_.link(poses_.path(e, entry(path).scope, body));
        const auto [one, along_one] = hinge_between(path, reference, parent, "axis");
        const auto [two, along_two] = hinge_between(path, reference, child, "axis2");
        const double ratio = file_.number_in(e, "gearbox_ratio").value_or(1);
        robot_.couplings.push_back({.name = short_name(path),
                                    .joint = two,
                                    .other = one,
                                    .polynomial = {0, -ratio * along_one * along_two}});
    }

    /// The joint that turns `link` against `reference`, and whether it counts along the axis (1) or against it
    /// (−1).
    std::pair<int, int> hinge_between(const std::string& path, const std::string& reference,
                                      const std::string& link, const char* tag) {
        const Real3 wanted = axis(path, tag).normalized();
        for (std::size_t k = 0; k < robot_.joints.size(); ++k) {
            const Robot::Joint& joint = robot_.joints[k];
            const bool forth = joint.parent == frames_.at(reference).link && joint.child == frames_.at(link).link,
                       back = joint.child == frames_.at(reference).link && joint.parent == frames_.at(link).link;
            if ((!forth && !back) || (joint.type != Type::revolute && joint.type != Type::continuous)) continue;
            const double along =
                wanted.dot(frames_.at(forth ? link : reference).place.R * joint.axis.normalized());
            if (std::abs(along) > 1 - 1e-9) return {static_cast<int>(k), (along > 0) == forth ? 1 : -1};
        }
        file_.refuse(*entry(path).element,
                     say("the gearbox {} needs a hinge between {} and {}, about its own axis", in_quotes(path),
                         in_quotes(reference), in_quotes(link)));
    }

    Type type_of(const std::string& path) {
        const XmlElement& e = *entry(path).element;
        const std::map<std::string, Type> types{{"revolute", Type::revolute},   {"continuous", Type::continuous},
                                                {"prismatic", Type::prismatic}, {"ball", Type::spherical},
                                                {"universal", Type::universal}, {"screw", Type::screw},
                                                {"fixed", Type::fixed},         {"revolute2", Type::universal}};
        const std::string name = file_.needed_text(e, "type");
        const auto found = types.find(name);
        if (found == types.end())
            file_.refuse(e,
                         say("joint {} is of type {}; expected revolute, continuous, prismatic, ball, universal, "
                             "screw or fixed",
                             in_quotes(path), in_quotes(name)));
        return found->second;
    }

    /// The direction of <axis> in the world.
    Real3 axis(const std::string& path, const char* tag) {
        const XmlElement& e = *entry(path).element;
        const XmlElement* const own = file_.only(e, tag);
        const XmlElement* const xyz = own == nullptr ? nullptr : file_.only(*own, "xyz");
        Real3 a = Real3::UnitZ();
        Real33 R = poses_.place(path).R;
        if (xyz != nullptr) {
            const std::vector<double> v = file_.numbers_in(*xyz, 3);
            a = {v[0], v[1], v[2]};
            const auto in = file_.text(*xyz, "expressed_in");
            const bool in_model =
                own != nullptr && file_.flag_in(*own, "use_parent_model_frame").value_or(old_axes_);
            if (in && !in->empty())
                R = poses_.place(poses_.path(e, entry(path).scope, *in)).R;
            else if (in_model)
                R = poses_.place(poses_.path(e, entry(path).scope, "__model__")).R;
        }
        if (a.norm() == 0)
            file_.refuse(e, say("the axis of joint {} is zero; expected a direction", in_quotes(path)));
        return R * a;
    }

    double pitch(const std::string& path) {
        const XmlElement& e = *entry(path).element;
        const auto a_turn = file_.number_in(e, "screw_thread_pitch"), radians = file_.number_in(e, "thread_pitch");
        if (!a_turn && radians && *radians != 0) return -1 / *radians;  // of old, in radians a metre to the left
        if (!a_turn)
            file_.refuse(e,
                         say("the screw {} has no <screw_thread_pitch>; expected metres a turn", in_quotes(path)));
        return *a_turn / (2 * M_PI);
    }

    /// Adds the link `to` by a joint from `from`; backwards if `to` is the joint's parent.
    void place_by(const std::string& path, const std::string& from, const std::string& to, bool backwards) {
        const XmlElement& e = *entry(path).element;
        const Type type = type_of(path);
        if (backwards && (type == Type::universal || type == Type::spherical))
            file_.remark(e,
                         say("the parent of joint {} hangs on its child: its coordinates count the motion of the "
                             "parent",
                             in_quotes(path)));
        const RobotPlace place{poses_.place(path).shift, poses_.place(to).R};
        Robot::Joint& joint = add_link(to, place, from, short_name(path), type);
        if (type == Type::fixed) ignore_axis(e);
        if (type == Type::fixed || type == Type::spherical) return;
        const Real33 into = place.R.transpose();
        joint.axis = into * axis(path, backwards && type == Type::universal ? "axis2" : "axis");
        if (type == Type::universal) {
            joint.second = into * axis(path, backwards ? "axis" : "axis2");
            if (std::abs(joint.axis.normalized().dot(joint.second.normalized())) > 1e-9)
                file_.refuse(e,
                             say("the axes of the universal joint {} are not at right angles", in_quotes(path)));
        }
        if (backwards) {
            joint.axis = -joint.axis;
            joint.second = -joint.second;
        }
        if (type == Type::screw) joint.pitch = pitch(path);
        if (const XmlElement* const own = file_.only(e, "axis"); own != nullptr && type != Type::universal)
            read_axis(*own, joint);
        const double rotor = file_.number_in(e, "drake:rotor_inertia").value_or(0),
                     ratio = file_.number_in(e, "drake:gear_ratio").value_or(1);
        if (type != Type::universal) joint.armature = ratio * ratio * rotor;
    }

    /// Of a fixed joint, which has no use for it.
    void ignore_axis(const XmlElement& e) {
        for (const char* tag : {"axis", "axis2"})
            if (const XmlElement* const axis = e.FirstChildElement(tag)) file_.ignore(*axis);
    }

    void read_axis(const XmlElement& e, Robot::Joint& joint) {
        if (const XmlElement* const dynamics = file_.only(e, "dynamics")) {
            joint.damping = file_.number_in(*dynamics, "damping").value_or(0);
            joint.friction = file_.number_in(*dynamics, "friction").value_or(0);
            joint.stiffness = file_.number_in(*dynamics, "spring_stiffness").value_or(0);
            joint.rest = file_.number_in(*dynamics, "spring_reference").value_or(0);
        }
        if (const XmlElement* const mimic = file_.only(e, "mimic")) {
            const double factor = file_.number_in(*mimic, "multiplier").value_or(1);
            followers_.push_back({static_cast<int>(robot_.joints.size()) - 1, file_.needed_text(*mimic, "joint"),
                                  factor,
                                  file_.number_in(*mimic, "offset").value_or(0) -
                                      factor * file_.number_in(*mimic, "reference").value_or(0),
                                  mimic});
            file_.ignore(*mimic);
        }
        const XmlElement* const limit = file_.only(e, "limit");
        if (limit == nullptr || joint.type == Type::continuous) return;
        const auto bound = [&](const char* tag, double none) {
            const std::string written = file_.text_in(*limit, tag).value_or("");
            if (written.empty() || written.ends_with("inf")) return none;
            return file_.numbers_in(*limit->FirstChildElement(tag), 1)[0];
        };
        const double low = bound("lower", -2 * no_limit), high = bound("upper", 2 * no_limit);
        if (low > -no_limit && high < no_limit) joint.limits = {low, high};
    }

    void follow_leaders() {
        for (const Follower& f : followers_) {
            int leader = -1;
            for (std::size_t k = 0; k < robot_.joints.size(); ++k)
                if (robot_.joints[k].name == f.leader && robot_.joints[k].type != Type::fixed)
                    leader = static_cast<int>(k);
            if (leader < 0 || robot_.joints[static_cast<std::size_t>(leader)].mimic || leader == f.joint)
                file_.refuse(*f.element,
                             say("<mimic> names {}, which is no independent joint", in_quotes(f.leader)));
            robot_.joints[static_cast<std::size_t>(f.joint)].mimic = Robot::Mimic{leader, f.factor, f.offset};
        }
    }

    void close_by(const std::string& path) {
        const auto [parent, child] = sides(path);
        const Type type = type_of(path);
        const RobotPlace place = poses_.place(path);
        Robot::Loop loop{.name = short_name(path),
                         .type = type,
                         .parent = frames_.at(parent).link,
                         .child = frames_.at(child).link,
                         .at_parent = composed(inverted(frames_.at(parent).place), place).pose(),
                         .at_child = composed(inverted(frames_.at(child).place), place).pose()};
        if (type == Type::fixed) ignore_axis(*entry(path).element);
        const Real33 into = place.R.transpose();
        if (type != Type::fixed && type != Type::spherical) loop.axis = into * axis(path, "axis");
        if (type == Type::universal) loop.second = into * axis(path, "axis2");
        if (type == Type::screw) loop.pitch = pitch(path);
        robot_.loops.push_back(std::move(loop));
    }

    XmlFile file_;
    SdfPoses poses_;
    bool old_axes_ = false;  // whether axes are given along the axes of the model
    std::string one_model_;  // the path that all names share
    std::map<std::string, Frame> frames_;
    std::vector<Follower> followers_;
    std::vector<std::string> gearboxes_;
    Robot robot_;
};

}  // namespace

Robot parse_sdf(const std::string& text, const std::string& file, const OtherFiles& others) {
    return SdfReader(text, file, others).read();
}

}  // namespace alembert
