// SPDX-License-Identifier: MIT
#include "robot_model.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "files.hpp"

namespace alembert::test {

namespace {

using V3 = Eigen::Vector3d;
using M3 = Eigen::Matrix3d;

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

}  // namespace

RobotModel::RobotModel(const std::string& file) {
    const std::string text = std::regex_replace(contents(file), std::regex("<!--[^]*?-->"), "");
    const std::regex tag("<(/?)(\\w+)([^>]*?)(/?)>"), attribute("(\\w+)=\"([^\"]*)\"");
    std::vector<RobotHinge> list;
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
        for (std::sregex_iterator k(inside.begin(), inside.end(), attribute); k != end; ++k) a[(*k)[1]] = (*k)[2];
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
            RobotHinge& joint = list.back();
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
        if (std::none_of(list.begin(), list.end(), [&, n = name](const RobotHinge& h) { return h.child == n; }))
            placed[name] = true;
    REQUIRE(placed.size() == 1);
    while (!list.empty()) {
        const auto next = std::find_if(list.begin(), list.end(),
                                       [&](const RobotHinge& h) { return placed.count(h.parent) > 0; });
        REQUIRE(next != list.end());
        placed[next->child] = true;
        if (next->type == "floating")
            add_floating(*next);
        else
            hinges.push_back(*next);
        list.erase(next);
    }
}

void RobotModel::add_floating(const RobotHinge& joint) {
    const std::vector<std::string> suffix{"x", "y", "z", "yaw", "pitch", "roll"};
    const std::vector<V3> axis{V3::UnitX(), V3::UnitY(), V3::UnitZ(), V3::UnitZ(), V3::UnitY(), V3::UnitX()};
    for (std::size_t k = 0; k < 6; ++k) {
        RobotHinge one;
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

const RobotHinge& RobotModel::named(const std::string& name) const {
    return *std::find_if(hinges.begin(), hinges.end(), [&](const RobotHinge& h) { return h.name == name; });
}

double RobotModel::value(const RobotHinge& h, const Values& of, bool with_offset) const {
    if (h.leader.empty()) return of.count(h.name) ? of.at(h.name) : 0;
    return h.factor * value(named(h.leader), of, with_offset) + (with_offset ? h.offset : 0);
}

RobotModel::Values RobotModel::loads(const Values& q, const Values& u, const Values& a, double g,
                                     bool damped) const {
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
    for (const RobotHinge& h : hinges) {
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
        const RobotLink& b = bodies.at(h.child);
        const V3 c = m.R * b.centre;
        const M3 turn = m.R * of_rpy(b.centre_rpy), I = turn * b.inertia * turn.transpose();
        const V3 ac = m.acc + m.e.cross(c) + m.w.cross(m.w.cross(c));
        needed[h.child] = {I * m.e + m.w.cross(I * m.w), b.mass * (ac + V3(0, 0, g)), m.p + c};
    }
    Values result;
    for (const RobotHinge& h : hinges) {
        if (h.type == "fixed") continue;
        double load = damped ? h.damping * value(h, u, false) : 0;
        for (const RobotHinge& other : hinges) {
            const RobotHinge* below = &other;
            while (below->name != h.name) {
                const auto up = std::find_if(hinges.begin(), hinges.end(),
                                             [&](const RobotHinge& k) { return k.child == below->parent; });
                if (up == hinges.end()) break;
                below = &*up;
            }
            if (below->name != h.name) continue;
            const Wrench& w = needed[other.child];
            load += h.type == "prismatic" ? axis[h.name].dot(w.f)
                                          : axis[h.name].dot(w.n + (w.c - pivot[h.name]).cross(w.f));
        }
        double factor = 1;
        const RobotHinge* leader = &h;
        for (; !leader->leader.empty(); leader = &named(leader->leader)) factor *= leader->factor;
        if (leader->type != "fixed") result[leader->name] += factor * load;
    }
    return result;
}

}  // namespace alembert::test
