// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/gimbal.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "alembert/base/dense.hpp"
#include "alembert/base/tolerances.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

/// The smallest singular value divided by the largest of a matrix with three rows, given row by row by `nodes`.
double evenness(const Program& program, const std::vector<int>& nodes, const State<double>& state) {
    const std::vector<double> value = interpret(program, state);
    Eigen::MatrixXd J(3, static_cast<Eigen::Index>(nodes.size() / 3));
    for (Eigen::Index r = 0, next = 0; r < 3; ++r)
        for (Eigen::Index c = 0; c < J.cols(); ++c) J(r, c) = value[nodes[next++]];
    if (!J.allFinite()) return 0;
    const Eigen::Vector3d sigma = singular_values(J).values;
    return sigma[0] > 0 ? sigma[2] / sigma[0] : 0;
}

std::string way_out(const Scene& scene, const Body& body) {
    if (!body.joint)
        return say(
            "give the frame a quaternion, quaternion = [\"e0\", \"e1\", \"e2\", \"e3\"], in place of 'rotate'");
    const Joint& joint = scene.joints[*body.joint];
    if (!joint.angles.empty())
        return say(
            "give joint '{}' a quaternion: four coordinates, {{ e0 = 1, e1 = 0, e2 = 0, e3 = 0 }}, in place of "
            "its three angles, and no 'angles'",
            joint.name.text);
    return say(
        "let one spherical joint turn the body, by a quaternion: four coordinates, scalar first, and no "
        "'angles'");
}

}  // namespace

std::optional<std::string> gimbal_lock(const Scene& scene, const Mechanism& m, const State<double>& state) {
    State<double> here = state;
    std::fill_n(here.qdot.begin(), m.q.size(), 0);
    Program program = lower_constraints(m);
    for (const MassElement& element : m.masses) {
        if (element.origin.kind != Origin::Kind::body || !element.rotation) continue;
        const Body& body = scene.bodies[static_cast<std::size_t>(element.origin.index)];
        std::vector<GiNaC::ex> entries;
        for (const GiNaC::ex& w : element.rotation->w_NB_B) {
            const std::vector<GiNaC::ex> row = m.z->pull_back({{w, 1}}, m.qdot);
            entries.insert(entries.end(), row.begin(), row.end());
        }
        std::string angles;
        int count = 0;
        for (int i = 0; i < m.size(); ++i)
            if (!entries[i].is_zero() || !entries[m.size() + i].is_zero() ||
                !entries[2 * m.size() + i].is_zero()) {
                angles += (angles.empty() ? "" : ", ") + m.q[i].get_name();
                ++count;
            }
        if (count < 3) continue;
        const std::vector<int> nodes = lower_expressions(program, m, entries);
        if (evenness(program, nodes, here) > tolerance::gimbal_lock) continue;
        State<double> beside = here;
        for (std::size_t i = 0; i < beside.q.size(); ++i) beside.q[i] += 0.3 + 0.1 * static_cast<double>(i);
        if (evenness(program, nodes, beside) < tolerance::gimbal_lock) continue;
        return say(
            "the angles {} of frame '{}' are in gimbal lock: two of them turn body '{}' about the same line, and "
            "the third cannot turn it about all others; {}",
            angles, body.frame.text, body.name.text, way_out(scene, body));
    }
    return std::nullopt;
}

}  // namespace alembert
