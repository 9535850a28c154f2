// SPDX-License-Identifier: MIT
// Robots as scenes: accelerations by the recursion on the imported tree are compared with a Newton-Euler recursion
// in this file, which reads the numbers of the URDF itself, goes link by link (fixed ones too) along the axes of
// the world, and uses neither merged bodies nor scenes.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Dense>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <sstream>

#include "program.hpp"
#include "scenes.hpp"
#include "solved.hpp"

namespace commands_import {

using alembert::test::contents;
using alembert::test::run;
using alembert::test::source_path;
using alembert::test::temporary;
using Json = nlohmann::json;
using V3 = Eigen::Vector3d;
using M3 = Eigen::Matrix3d;

namespace {

V3 three(const std::string& text) {
    std::istringstream in(text);
    V3 v = V3::Zero();
    in >> v[0] >> v[1] >> v[2];
    return v;
}

M3 about(const V3& axis, double angle) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}
M3 of_rpy(const V3& a) {
    return about(V3::UnitZ(), a[2]) * about(V3::UnitY(), a[1]) * about(V3::UnitX(), a[0]);
}

struct Body {
    double mass = 0;
    V3 centre = V3::Zero(), centre_rpy = V3::Zero();
    M3 inertia = M3::Zero();
};
/// A simple joint with its child; a floating joint is six of them.
struct Hinge {
    std::string name, type, parent, child, leader;
    V3 xyz = V3::Zero(), rpy = V3::Zero(), axis = V3::UnitX();
    double damping = 0, factor = 1, offset = 0;
};

struct Model {
    std::map<std::string, Body> bodies;
    std::vector<Hinge> hinges;  ///< parents first

    explicit Model(const std::string& file) {
        const std::string text = std::regex_replace(contents(file), std::regex("<!--[^]*?-->"), "");
        const std::regex tag("<(/?)(\\w+)([^>]*?)(/?)>"), attribute("(\\w+)=\"([^\"]*)\"");
        std::vector<Hinge> list;
        std::string link;
        bool in_joint = false, in_inertial = false;
        int depth = 0;
        for (std::sregex_iterator it(text.begin(), text.end(), tag), end; it != end; ++it) {
            const std::string name = (*it)[2], inside = (*it)[3];
            const bool closes = (*it)[1].length() > 0, alone = (*it)[4].length() > 0;
            if (closes) --depth;
            if (closes && name == "inertial") in_inertial = false;
            if (closes && depth == 1) link.clear(), in_joint = false;
            if (closes) continue;
            std::map<std::string, std::string> a;
            for (std::sregex_iterator k(inside.begin(), inside.end(), attribute); k != end; ++k)
                a[(*k)[1]] = (*k)[2];
            const auto number = [&](const char* key, double otherwise) {
                return a.count(key) ? std::stod(a[key]) : otherwise;
            };
            if (depth == 1 && name == "link") bodies[link = a["name"]];
            if (depth == 1 && name == "joint") {
                in_joint = !alone;
                list.push_back({});
                list.back().name = a["name"];
                list.back().type = a["type"];
            }
            if (!link.empty() && name == "inertial") in_inertial = true;
            if (in_inertial && name == "origin")
                bodies[link].centre = three(a["xyz"]), bodies[link].centre_rpy = three(a["rpy"]);
            if (in_inertial && name == "mass") bodies[link].mass = number("value", 0);
            if (in_inertial && name == "inertia")
                bodies[link].inertia << number("ixx", 0), number("ixy", 0), number("ixz", 0), number("ixy", 0),
                    number("iyy", 0), number("iyz", 0), number("ixz", 0), number("iyz", 0), number("izz", 0);
            if (in_joint && depth == 2) {
                Hinge& joint = list.back();
                if (name == "parent") joint.parent = a["link"];
                if (name == "child") joint.child = a["link"];
                if (name == "origin") joint.xyz = three(a["xyz"]), joint.rpy = three(a["rpy"]);
                if (name == "axis") joint.axis = three(a["xyz"]).normalized();
                if (name == "dynamics") joint.damping = number("damping", 0);
                if (name == "mimic")
                    joint.leader = a["joint"], joint.factor = number("multiplier", 1),
                    joint.offset = number("offset", 0);
            }
            if (!alone) ++depth;
            if (alone && depth == 1) link.clear();
        }
        std::map<std::string, bool> placed;
        for (const auto& [name, body] : bodies)
            if (std::none_of(list.begin(), list.end(), [&, n = name](const Hinge& h) { return h.child == n; }))
                placed[name] = true;
        REQUIRE(placed.size() == 1);
        while (!list.empty()) {
            const auto next =
                std::find_if(list.begin(), list.end(), [&](const Hinge& h) { return placed.count(h.parent) > 0; });
            REQUIRE(next != list.end());
            placed[next->child] = true;
            if (next->type == "floating")
                add_floating(*next);
            else
                hinges.push_back(*next);
            list.erase(next);
        }
    }

    void add_floating(const Hinge& joint) {
        const std::vector<std::string> suffix{"x", "y", "z", "yaw", "pitch", "roll"};
        const std::vector<V3> axis{V3::UnitX(), V3::UnitY(), V3::UnitZ(), V3::UnitZ(), V3::UnitY(), V3::UnitX()};
        for (std::size_t k = 0; k < 6; ++k) {
            Hinge one;
            one.name = joint.name + "_" + suffix[k];
            one.type = k < 3 ? "prismatic" : "revolute";
            one.parent = k == 0 ? joint.parent : joint.child + "/" + suffix[k - 1];
            one.child = k == 5 ? joint.child : joint.child + "/" + suffix[k];
            if (k == 0) one.xyz = joint.xyz, one.rpy = joint.rpy;
            one.axis = axis[k];
            bodies[one.child];
            hinges.push_back(one);
        }
    }

    const Hinge& named(const std::string& name) const {
        return *std::find_if(hinges.begin(), hinges.end(), [&](const Hinge& h) { return h.name == name; });
    }

    using Values = std::map<std::string, double>;
    /// Position (or rate, with no offsets) of a joint that may follow another.
    double value(const Hinge& h, const Values& of, bool with_offset) const {
        if (h.leader.empty()) return of.count(h.name) ? of.at(h.name) : 0;
        return h.factor * value(named(h.leader), of, with_offset) + (with_offset ? h.offset : 0);
    }

    /// Σ over all joints that follow it, of the loads that these accelerations need.
    Values loads(const Values& q, const Values& u, const Values& a, double g, bool damped) const {
        struct Motion {
            M3 R = M3::Identity();
            V3 p = V3::Zero(), w = V3::Zero(), e = V3::Zero(), acc = V3::Zero();
        };
        std::map<std::string, Motion> at;
        struct Wrench {
            V3 n, f, c;
        };
        std::map<std::string, Wrench> needed;
        std::map<std::string, V3> axis, pivot;
        for (const Hinge& h : hinges) {
            const Motion up = at[h.parent];
            Motion m;
            const M3 R0 = up.R * of_rpy(h.rpy);
            const V3 z = R0 * h.axis;
            const double s = value(h, q, true), sd = value(h, u, false), sdd = value(h, a, false);
            m.R = R0;
            m.p = up.p + up.R * h.xyz;
            m.w = up.w;
            m.e = up.e;
            if (h.type == "prismatic") m.p += s * z;
            const V3 r = m.p - up.p;
            m.acc = up.acc + up.e.cross(r) + up.w.cross(up.w.cross(r));
            if (h.type == "prismatic") {
                m.acc += 2 * up.w.cross(V3(sd * z)) + sdd * z;
            } else if (h.type != "fixed") {
                m.R = R0 * about(h.axis, s);
                m.w += sd * z;
                m.e += sdd * z + up.w.cross(V3(sd * z));
            }
            at[h.child] = m;
            axis[h.name] = z;
            pivot[h.name] = m.p;
            const Body& b = bodies.at(h.child);
            const V3 c = m.R * b.centre;
            const M3 turn = m.R * of_rpy(b.centre_rpy), I = turn * b.inertia * turn.transpose();
            const V3 ac = m.acc + m.e.cross(c) + m.w.cross(m.w.cross(c));
            needed[h.child] = {I * m.e + m.w.cross(I * m.w), b.mass * (ac + V3(0, 0, g)), m.p + c};
        }
        Values result;
        for (const Hinge& h : hinges) {
            if (h.type == "fixed") continue;
            double load = damped ? h.damping * value(h, u, false) : 0;
            for (const Hinge& other : hinges) {
                const Hinge* below = &other;
                while (below->name != h.name) {
                    const auto up = std::find_if(hinges.begin(), hinges.end(),
                                                 [&](const Hinge& k) { return k.child == below->parent; });
                    if (up == hinges.end()) break;
                    below = &*up;
                }
                if (below->name != h.name) continue;
                const Wrench& w = needed[other.child];
                load += h.type == "prismatic" ? axis[h.name].dot(w.f)
                                              : axis[h.name].dot(w.n + (w.c - pivot[h.name]).cross(w.f));
            }
            double factor = 1;
            const Hinge* leader = &h;
            for (; !leader->leader.empty(); leader = &named(leader->leader)) factor *= leader->factor;
            if (leader->type != "fixed") result[leader->name] += factor * load;
        }
        return result;
    }
};

std::string plain(std::string name) {
    for (char& c : name)
        if (c == ' ' || c == '-') c = '_';
    return name;
}

struct Random {
    std::mt19937_64 engine{20261121};
    double operator()(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); }
};

/// The largest difference of accelerations, over the largest of them.
void compare(const std::string& robot, const std::vector<std::string>& still, std::size_t freedom,
             const std::vector<std::string>& options = {}) {
    const std::string file = source_path("tests/robots/" + robot + ".urdf"),
                      scene = temporary(robot + ".toml", "");
    std::vector<std::string> args{"import", file, "-o", scene, "--json"};
    args.insert(args.end(), options.begin(), options.end());
    const auto imported = run(args);
    CAPTURE(imported.err);
    REQUIRE(imported.exit == 0);
    const Model model(file);
    Random random;
    for (int trial = 0; trial < 4; ++trial) {
        Model::Values q, u, none;
        for (const Hinge& h : model.hinges) {
            if (!h.leader.empty() || h.type == "fixed" ||
                std::find(still.begin(), still.end(), h.name) != still.end())
                continue;
            q[h.name] = random(-1.2, 1.2);
            u[h.name] = random(-1, 1);
        }
        REQUIRE(q.size() == freedom);
        const auto n = static_cast<Eigen::Index>(q.size());
        Eigen::MatrixXd M(n, n);
        Eigen::VectorXd f(n);
        const auto column = [&](const Model::Values& loads) {
            Eigen::VectorXd v(n);
            Eigen::Index k = 0;
            for (const auto& [name, value] : q) v[k++] = loads.at(name);
            return v;
        };
        f = -column(model.loads(q, u, none, 9.81, true));
        Eigen::Index k = 0;
        for (const auto& [name, value] : q) M.col(k++) = column(model.loads(q, none, {{name, 1.0}}, 0, false));
        const Eigen::VectorXd expected = alembert::test::solved(M, f).value();
        std::vector<std::string> eval{"eval", scene, "--json", "--by", "recursive"};
        for (const auto& [values, prime] : {std::pair(&q, ""), std::pair(&u, "'")})
            for (const auto& [name, value] : *values) {
                eval.emplace_back("--at");
                eval.push_back(fmt::format("{}{}={}", plain(name), prime, value));
            }
        const auto result = run(eval);
        CAPTURE(result.err);
        REQUIRE(result.exit == 0);
        const Json accelerations = Json::parse(result.out)["accelerations"];
        CHECK(accelerations.size() == q.size());
        k = 0;
        for (const auto& coordinate : q) {
            const std::string& name = coordinate.first;
            CAPTURE(name);
            const double difference = accelerations[plain(name)].get<double>() - expected[k++];
            CHECK(std::abs(difference) < 1e-12 * expected.cwiseAbs().maxCoeff());
        }
    }
}

std::string link_of(const std::string& name, const std::string& inside = "") {
    return "<link name=\"" + name + "\">" + inside + "</link>";
}
const std::string heavy =
    "<inertial><mass value=\"2\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" "
    "iyz=\"0\"/></inertial>";
std::string hinge_of(const std::string& name, const std::string& type, const std::string& parent,
                     const std::string& child, const std::string& inside = "") {
    return fmt::format("<joint name=\"{}\" type=\"{}\"><parent link=\"{}\"/><child link=\"{}\"/>{}</joint>", name,
                       type, parent, child, inside);
}
std::string robot_of(const std::string& inside) {
    return "<robot name=\"r\">" + inside + "</robot>";
}

}  // namespace

TEST_CASE(
    "import: a six-joint arm with oblique axes, turned inertias and a fixed tool accelerates as link by link") {
    compare("arm6", {}, 6);
}

TEST_CASE(
    "import: a torso of branches, with joints that mimic others and others again, accelerates as link by link") {
    compare("torso", {"antenna"}, 10);
}

TEST_CASE("import: a quadruped on a floating base accelerates as link by link") {
    compare("quadruped", {}, 18);
}

// M (q''(τ) − q''(0)) = τ, with M from the loads that the description itself needs for unit accelerations.
TEST_CASE("import: each joint gets a drive, whose torque accelerates all as the description's own inertia says") {
    const std::string file = source_path("tests/robots/arm6.urdf"), scene = temporary("driven.toml", "");
    const auto imported = run({"import", file, "-o", scene, "--drives", "--json"});
    REQUIRE(imported.exit == 0);
    CHECK(Json::parse(imported.out)["drives"].size() == 6);
    const Model model(file);
    Model::Values q, none;
    for (const Hinge& h : model.hinges)
        if (h.type != "fixed") q[h.name] = 0.3 + 0.1 * static_cast<double>(q.size());
    const auto accelerations = [&](const std::string& text) {
        std::vector<std::string> eval{"eval", temporary("one.toml", text), "--json"};
        for (const auto& [name, value] : q) {
            eval.emplace_back("--at");
            eval.push_back(fmt::format("{}={}", name, value));
        }
        const auto result = run(eval);
        CAPTURE(result.err);
        REQUIRE(result.exit == 0);
        return Json::parse(result.out)["accelerations"];
    };
    std::string driven = contents(scene);
    const Json free = accelerations(driven);
    Eigen::VectorXd torque(6);
    Eigen::Index k = 0;
    for (const auto& [name, value] : q) {
        torque[k] = 2.0 - static_cast<double>(k);
        const std::string unset = "drive_" + name + " = { value = 0,";
        const std::size_t place = driven.find(unset);
        REQUIRE(place != std::string::npos);
        driven.replace(place, unset.size(), fmt::format("drive_{} = {{ value = {},", name, torque[k++]));
    }
    const Json pushed = accelerations(driven);
    Eigen::MatrixXd M(6, 6);
    Eigen::VectorXd change(6);
    k = 0;
    for (const auto& [name, value] : q) {
        const Model::Values loads = model.loads(q, none, {{name, 1.0}}, 0, false);
        Eigen::Index row = 0;
        for (const auto& [other, ignored] : q) M(row++, k) = loads.at(other);
        change[k++] = pushed[name].get<double>() - free[name].get<double>();
    }
    CHECK((M * change - torque).norm() < 1e-11 * torque.norm());
}

TEST_CASE("import: right angles written with few digits are counted, and made exact on request") {
    const auto robot = [](const std::string& rpy) {
        return robot_of(link_of("base") + link_of("arm", heavy) +
                        hinge_of("j", "continuous", "base", "arm",
                                 "<origin xyz=\"0 0 1\" rpy=\"" + rpy + "\"/><axis xyz=\"0 0 1\"/>"));
    };
    const std::string scene = temporary("right.toml", "");
    const auto imported = [&](const std::string& rpy, const std::vector<std::string>& more) {
        std::vector<std::string> args{"import", temporary("r.urdf", robot(rpy)), "-o", scene, "--json"};
        args.insert(args.end(), more.begin(), more.end());
        const auto result = run(args);
        REQUIRE(result.exit == 0);
        return std::pair(Json::parse(result.out)["right_angles"]["rounded"].get<int>(), contents(scene));
    };
    for (const char* angle : {"1.5708", "-1.5707", "3.14", "1.570796", "-4.712", "6.283185"}) {
        CAPTURE(angle);
        const auto [found, text] = imported(std::string(angle) + " 0 0", {});
        CHECK(found == 1);
        CHECK(text.find("pi") == std::string::npos);
        const auto [again, mended] = imported(std::string(angle) + " 0 0", {"--right-angles"});
        CHECK(again == 1);
        CHECK(mended.find("pi") != std::string::npos);
    }
    for (const char* angle : {"1.58", "1.5", "0.7854", "1.5709", "1.5707963267948966", "0", "1.6"}) {
        CAPTURE(angle);
        CHECK(imported(std::string(angle) + " 0 0", {"--right-angles"}).first == 0);
    }
    CHECK(imported("1.5708 -1.57 3.1416", {}).first == 3);
}

TEST_CASE("import: omitted and merged parts are reported, and the scene has limits as comments") {
    const std::string scene = temporary("told.toml", "");
    const auto result = run({"import", source_path("tests/robots/arm6.urdf"), "-o", scene});
    REQUIRE(result.exit == 0);
    for (const char* line :
         {"dropped: <visual>: base_link, shoulder-1, forearm\n", "dropped: <collision>: base_link\n",
          "dropped: <transmission>: t1, t2\n", "dropped: <gazebo>: flange\n",
          "dropped: Coulomb friction of joints, without --friction: j1, j4\n",
          "dropped: limits of joints, without --stops: j1, j2, j3, j5, j6\n",
          "dropped: <limit effort=…>: j1, j2, j3, j5, j6\n", "dropped: <limit velocity=…>: j1, j2, j3, j5, j6\n",
          "dropped: <safety_controller>: j5\n", "dropped: mass that is fixed to the ground: base_link\n",
          "note: 'shoulder-1' is called shoulder_1", "note: j3 starts at 0, outside its limits"})
        CHECK(result.err.find(line) != std::string::npos);
    CHECK(result.out.find("welding_torch is fixed to tool0") != std::string::npos);
    CHECK(contents(scene).find("about = \"limits 0.2 to 2.6\"") != std::string::npos);
    // The torch stands at (0, 0, 0.04) turned by roll 0.1, pitch 0.2, yaw 0.3, then at (0.01, 0, 0.02) from the
    // flange.
    const auto motion = [&](const std::vector<std::string>& args) {
        std::vector<std::string> all{"kinematics", scene, "--of", "flange,tool0,welding_torch", "--json"};
        all.insert(all.end(), args.begin(), args.end());
        return Json::parse(run(all).out);
    };
    const Json k = motion({"--at", "j1=0.3", "--at", "j4=0.7"});
    const auto axes = [&](const char* name) { return k["frames"][name]["values"]["direction_cosines"]; };
    const auto at = [&](const char* name) { return k["points"][name]["values"]["position"]; };
    double tool_to_torch = 0;
    for (int i = 0; i < 3; ++i) {
        const double along_tool =
            0.01 * axes("tool0")[i][0].get<double>() + 0.02 * axes("tool0")[i][2].get<double>();
        CHECK(std::abs(at("welding_torch")[i].get<double>() - at("tool0")[i].get<double>() - along_tool) < 1e-12);
        tool_to_torch += axes("tool0")[i][0].get<double>() * axes("welding_torch")[i][0].get<double>();
    }
    CHECK(std::abs(tool_to_torch - std::cos(M_PI / 4)) < 1e-12);
    const auto torso = run({"import", source_path("tests/robots/torso.urdf"), "-o", scene});
    CHECK(torso.err.find("dropped: joints that move no mass: antenna\n") != std::string::npos);
}

// A hinge without gravity's moment, at rest 0.25 from its stop: friction 0.3 against a torque M gives q'' = (M -
// 0.3)/I.
TEST_CASE("import: friction slows a joint as its file says, and a stop ends its range") {
    const std::string file = temporary(
        "stopped.urdf", robot_of(link_of("a") + link_of("b", heavy) +
                                 hinge_of("j", "revolute", "a", "b",
                                          "<axis xyz=\"0 0 1\"/><limit lower=\"0.25\" upper=\"0.75\" effort=\"1\" "
                                          "velocity=\"1\"/><dynamics friction=\"0.3\"/>")));
    const std::string scene = temporary("stopped.toml", "");
    const auto plain = run({"import", file, "-o", scene});
    CHECK(plain.err.find("dropped: Coulomb friction of joints, without --friction: j\n") != std::string::npos);
    const auto whole = run({"import", file, "-o", scene, "--friction", "--stops", "--drives"});
    REQUIRE(whole.exit == 0);
    CHECK(whole.err.find("Coulomb") == std::string::npos);
    CHECK(whole.err.find("note: j starts at 0.5, between its stops") != std::string::npos);
    std::string text = contents(scene);
    const std::string zero = "drive_j = { value = 0,";
    REQUIRE(text.find(zero) != std::string::npos);
    text.replace(text.find(zero), zero.size(), "drive_j = { value = 1.3,");
    const Json moving = Json::parse(
        run({"simulate", temporary("driven.toml", text), "--duration", "0.3", "--json", "--no-estimate"}).out);
    CHECK(std::abs(moving["final"]["coordinates"]["j"].get<double>() - (0.5 + 0.5 * 1 * 0.09)) < 1e-8);
    const Json stopped = Json::parse(
        run({"simulate", temporary("driven.toml", text), "--duration", "2", "--json", "--no-estimate"}).out);
    CHECK(std::abs(stopped["final"]["coordinates"]["j"].get<double>() - 0.75) < 1e-8);
    const std::string reversed = temporary(
        "reversed.urdf", robot_of(link_of("a") + link_of("b", heavy) +
                                  hinge_of("j", "revolute", "a", "b", "<limit lower=\"1\" upper=\"-1\"/>")));
    CHECK(run({"import", reversed, "-o", scene, "--stops"})
              .err.find("note: j has no stops, because its lower limit is above the upper one") !=
          std::string::npos);
}

// Free, a body of two masses 2 and 1 at 0 and 0.3 falls with g and keeps its rotation, however that is described;
// and a body on a planar joint normal to x does not fall along x.
TEST_CASE("import: a root that floats falls, by angles and by a quaternion; a planar joint keeps its plane") {
    const std::string two =
        temporary("two.urdf", robot_of(link_of("a", heavy) +
                                       link_of("b",
                                               "<inertial><mass value=\"1\"/><inertia ixx=\"0.1\" iyy=\"0.1\" "
                                               "izz=\"0.1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>") +
                                       hinge_of("weld", "fixed", "a", "b", "<origin xyz=\"0.3 0 0\"/>")));
    const std::string scene = temporary("two.toml", "");
    REQUIRE(run({"import", two, "-o", scene, "--floating"}).exit == 0);
    const Json by_angles = Json::parse(run({"eval", scene, "--json"}).out);
    CHECK(std::abs(by_angles["accelerations"]["floating_base_z"].get<double>() + 9.81) < 1e-13);
    // About the mass centre at 0.1: izz = 1 + 0.1 + 2·0.1² + 1·0.2²; the origin of a turns about it.
    const Json turning = Json::parse(run({"eval", scene, "--json", "--at", "floating_base_yaw'=2"}).out);
    CHECK(std::abs(turning["kinetic"].get<double>() - (0.5 * 1.16 * 4 + 0.5 * 3 * 0.2 * 0.2)) < 1e-13);
    CHECK(std::abs(turning["accelerations"]["floating_base_x"].get<double>() - 0.4) < 1e-13);
    REQUIRE(run({"import", two, "-o", scene, "--floating", "--quaternion"}).exit == 0);
    const Json by_quaternion = Json::parse(run({"eval", scene, "--json", "--at", "floating_base_e3'=1"}).out);
    CHECK(std::abs(by_quaternion["accelerations"]["floating_base_x"].get<double>() - 0.4) < 1e-13);
    const std::string flat = temporary(
        "flat.urdf",
        robot_of(link_of("a") + link_of("b", heavy) +
                 hinge_of("table", "planar", "a", "b", "<axis xyz=\"0 1 0\"/><origin rpy=\"0 0 0.5\"/>")));
    REQUIRE(run({"import", flat, "-o", scene}).exit == 0);
    const Json planar = Json::parse(
        run({"eval", scene, "--json", "--at", "table_x=0.7", "--at", "table_y=-0.4"}).out)["accelerations"];
    CHECK(std::abs(std::hypot(planar["table_x"].get<double>(), planar["table_y"].get<double>()) - 9.81) < 1e-13);
    CHECK(std::abs(planar["table_turn"].get<double>()) < 1e-13);
}

TEST_CASE("import: a file that is no robot gives one message, and nothing is written") {
    const std::string limit = "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
    std::string nested = "<robot name=\"r\">";
    for (int k = 0; k < 50000; ++k) nested += "<a>";
    const std::string out = temporary("wrong.toml", "untouched");
    const auto refused = [&](const std::string& text, const std::string& told) {
        CAPTURE(told);
        const auto result = run({"import", temporary("wrong.urdf", text), "-o", out});
        CAPTURE(result.err);
        CHECK(result.exit == 3);
        CHECK(result.err.find("wrong.urdf") != std::string::npos);
        CHECK(result.err.find(told) != std::string::npos);
        CHECK(result.err.find("internal") == std::string::npos);
        CHECK(contents(out) == "untouched");
    };
    refused("", "this is no XML");
    refused("title = \"a scene\"\n", "this is no XML");
    refused("<robot name=\"r\"><link name=\"a\"></robot>", "this is no XML");
    refused("<sdf version=\"1.6\"/>", "no <model> is found; expected one, or some in a <world>");
    refused(nested, "elements stand inside each other");
    refused(robot_of("<xacro:leg name=\"a\"/>"), "is a macro of xacro");
    refused(robot_of(""), "urdfdom refuses it");
    refused(robot_of(link_of("a", heavy) + link_of("a", heavy)), "urdfdom refuses it: link 'a' is not unique");
    refused(robot_of(link_of("a", heavy)), "no joint that moves a mass");
    refused(robot_of(link_of("a") + link_of("b") + hinge_of("j", "continuous", "a", "b")),
            "no link of this robot has a mass");
    refused(robot_of(link_of("a") + link_of("b", heavy) + hinge_of("j", "hinge", "a", "b")), "urdfdom refuses it");
    refused(robot_of(link_of("a") + link_of("b", heavy) + hinge_of("j", "revolute", "a", "c", limit)),
            "urdfdom refuses it: Failed to build tree: child link [c] of joint [j] not found");
    refused(robot_of(link_of("a") + link_of("b", heavy) +
                     hinge_of("j", "continuous", "a", "b", "<axis xyz=\"0 0 0\"/>")),
            "the axis of joint 'j' is zero");
    refused(robot_of(link_of("a") + link_of("b", heavy) +
                     hinge_of("j", "continuous", "a", "b", "<origin xyz=\"0 one 0\"/>")),
            "xyz=\"0 one 0\" of <origin>: 'one' is no number; expected 3 numbers");
    refused(robot_of(link_of("a") + link_of("b", "<inertial><origin rpy=\"0 0\"/>" + heavy.substr(10)) +
                     hinge_of("j", "continuous", "a", "b")),
            "rpy=\"0 0\" of <origin>: these are 2 numbers; expected 3 numbers");
    refused(robot_of(link_of("a") + link_of("b", heavy) +
                     hinge_of("j", "continuous", "a", "b", "<mimic joint=\"k\"/>")),
            "joint 'j' mimics 'k', which is no joint");
    refused(robot_of(link_of("a") + link_of("b", heavy) + link_of("c", heavy) +
                     hinge_of("j", "continuous", "a", "b", "<mimic joint=\"k\"/>") +
                     hinge_of("k", "continuous", "b", "c", "<mimic joint=\"j\"/>")),
            "mimics itself in a circle");
    refused(robot_of(link_of("a") + link_of("b", heavy) + link_of("c", heavy) +
                     hinge_of("j", "continuous", "b", "c") + hinge_of("k", "continuous", "c", "b")),
            "in a circle of joints");
    refused(
        robot_of(link_of("a") + link_of("b", heavy) + link_of("c", heavy) + hinge_of("j", "continuous", "a", "b") +
                 hinge_of("k", "continuous", "a", "c") + hinge_of("l", "continuous", "b", "c")),
        "joint 'l' holds link 'c', which joint 'k' holds already");
    refused(robot_of(link_of("a") + link_of("b", std::regex_replace(heavy, std::regex("\"2\""), "\"-2\"")) +
                     hinge_of("j", "continuous", "a", "b")),
            "the mass of link 'b' is -2");
    refused(robot_of(link_of("a") + link_of("b", std::regex_replace(heavy, std::regex("ixy=\"0\""), "ixy=\"3\"")) +
                     hinge_of("j", "continuous", "a", "b")),
            "link 'b' has the principal moments of inertia -2, 1 and 4, which are not all zero or more");
    CHECK(run({"import", source_path("tests/robots/none.urdf"), "-o", out}).exit == 3);
    CHECK(run({"import", source_path("tests/robots/arm6.urdf"), "-o", "/no/such/folder/x.toml"}).exit == 5);
    CHECK(run({"import", source_path("tests/robots/arm6.urdf")}).exit == 3);
}

}  // namespace commands_import
