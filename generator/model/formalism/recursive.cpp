// SPDX-License-Identifier: GPL-2.0-or-later
// With w = S q' + w₀: M = Sᵀ M_w S, f = Q − Sᵀ n, where n are the loads that the joints must apply at q'' = 0. For
// the three rates of a ball joint, S is J of its quaternion (ball_joint.hpp).
#include "model/formalism/recursive.hpp"

#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "model/formalism/joint_tree.hpp"
#include "model/formalism/tree_recursions.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

/// The forces of all potentials except gravity, which enters as an acceleration of the ground.
std::vector<ex> potential_forces(const Mechanism& m) {
    std::vector<std::pair<ex, ex>> targets;
    for (const Part& part : m.potential)
        if (part.origin.kind != Origin::Kind::gravity) targets.emplace_back(part.value, -1);
    return m.z->pull_back(targets, m.q);
}

Possible<JointTree> tree_with_masses(const Mechanism& m) {
    if (const auto unknown = masses_unknown(m, say("The recursive equations"))) return Obstacle{*unknown};
    return joint_tree(m);
}

/// S by rows, without its zeros.
using SparseRows = std::vector<std::vector<std::pair<int, ex>>>;

SparseRows entries_of_S(const JointTree& joints, const Mechanism& m) {
    SparseRows S(joints.joints.size());
    for (std::size_t j = 0; j < S.size(); ++j)
        for (int a = 0; a < m.size(); ++a)
            if (const ex s = joints.joints[j].row[a]; !s.is_zero()) S[j].emplace_back(a, s);
    for (const BallJoint& ball : joints.balls) {
        const auto G = rows_of_turn(ball.e);
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 4; ++i)
                S[static_cast<std::size_t>(ball.first) + k].emplace_back(
                    ball.coordinate[i], m.z->name(2 * ball.sign[i] * G[k][i] * ball.inverse));
    }
    return S;
}

/// The terms of −Sᵀ n, with the loads n of gravity and of the motion at q'' = 0.
std::vector<GiNaC::exvector> forces_of_motion(const BodyTree<Named>& tree, const SparseRows& S, int n) {
    const std::vector<Named> loads = joint_loads(tree, Bias<Named>(tree).wrenches);
    std::vector<GiNaC::exvector> forces(static_cast<std::size_t>(n));
    for (std::size_t j = 0; j < S.size(); ++j)
        for (const auto& [a, s] : S[j]) forces[static_cast<std::size_t>(a)].push_back(-s * loads[j].e);
    return forces;
}

BodyTree<Named> tree_of_names(const JointTree& joints, Intermediates& z) {
    return dressed<Named>(joints, LinkAxes::own, z, [&](const ex& e) { return Named(e, z); });
}

}  // namespace

std::optional<std::string> obstacle_to_recursive(const Mechanism& m) {
    return tree_with_masses(with_own_intermediates(m)).obstacle();
}

std::vector<ex> forces_besides_gravity(const Mechanism& m) {
    const std::vector<ex> springs = potential_forces(m), dampers = m.generalized_forces(true),
                          others = m.generalized_forces(false);
    std::vector<ex> forces;
    for (int a = 0; a < m.size(); ++a) forces.push_back(m.z->name(springs[a] + dampers[a] + others[a]));
    return forces;
}

Possible<JointTree> loaded_tree(const Mechanism& m) {
    Possible<JointTree> found = tree_with_masses(m);
    if (!found.exists()) return found;
    JointTree joints = std::move(found).value();
    joints.forces = forces_besides_gravity(m);
    return joints;
}

Equations recursive_without_matrix(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    Equations equations = equations_without_terms("recursive", m);
    equations.M = GiNaC::matrix(0, 0);
    equations.tree = std::make_shared<const JointTree>(loaded_tree(m).value());
    attach_constraints(m, equations);
    return equations;
}

std::vector<ex> forcing_of_tree(const Equations& e, const Mechanism& m) {
    std::vector<GiNaC::exvector> terms =
        forces_of_motion(tree_of_names(*e.tree, *m.z), entries_of_S(*e.tree, m), m.size());
    std::vector<ex> forcing;
    for (std::size_t a = 0; a < terms.size(); ++a)
        forcing.push_back(m.z->name(GiNaC::add(std::move(terms[a])) + e.tree->forces[a]));
    return forcing;
}

Equations recursive(const Mechanism& mechanism) {
    const Mechanism m = with_own_intermediates(mechanism);
    JointTree joints = tree_with_masses(m).value();
    Intermediates& z = *m.z;
    const BodyTree<Named> tree = tree_of_names(joints, z);
    const std::vector<std::vector<Named>> M = composite_bodies(tree);

    Equations equations = equations_without_terms("recursive", m);
    const int n = m.size();
    std::vector<GiNaC::exvector> mass(static_cast<std::size_t>(n) * n);
    const SparseRows S = entries_of_S(joints, m);
    std::vector<GiNaC::exvector> own = forces_of_motion(tree, S, n);
    for (std::size_t j = 0; j < M.size(); ++j)
        for (std::size_t i = 0; i <= j; ++i) {
            if (M[j][i].e.is_zero()) continue;
            for (const auto& [a, s] : S[j])
                for (const auto& [b, t] : S[i]) {
                    mass[a * n + b].push_back(s * t * M[j][i].e);
                    if (i != j) mass[b * n + a].push_back(s * t * M[j][i].e);
                }
        }
    joints.forces = potential_forces(m);
    equations.dissipative = m.generalized_forces(true);
    equations.applied = m.generalized_forces(false);
    for (int a = 0; a < n; ++a) {
        own[a].push_back(joints.forces[a]);
        equations.own.push_back(z.name(GiNaC::add(std::move(own[a]))));
        for (int b = 0; b < n; ++b) equations.M(a, b) = z.name(GiNaC::add(std::move(mass[a * n + b])));
    }
    for (int a = 0; a < n; ++a)
        joints.forces[a] = z.name(joints.forces[a] + equations.dissipative[a] + equations.applied[a]);
    equations.tree = std::make_shared<const JointTree>(std::move(joints));
    attach_constraints(m, equations);
    return equations;
}

}  // namespace alembert
