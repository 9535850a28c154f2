// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/lower/articulated_bodies.hpp"

#include "base/language/say.hpp"
#include "model/formalism/articulated_tree.hpp"
#include "model/formalism/planar_chain.hpp"
#include "program/lower/joint_change.hpp"
#include "program/lower/link_frames.hpp"
#include "program/solve.hpp"

namespace alembert {

std::string RecursionForm::text() const {
    const std::string name = solve == Solve::matrix        ? to_say("composite bodies")
                             : solve == Solve::articulated ? to_say("articulated bodies")
                                                           : to_say("chain from both ends");
    return name + (axes == LinkAxes::still ? std::string(", ") + to_say("parallel axes") : "");
}

RecursionNodes recursion(Program& program, const JointTree& joints, Intermediates& z, const RecursionForm& form,
                         bool with_matrix, const std::function<int(const GiNaC::ex&)>& lowering) {
    const std::function<Symbolic(const GiNaC::ex&)> value = [&](const GiNaC::ex& e) {
        return Symbolic(program, lowering(e));
    };
    const BodyTree<Symbolic> bare = reframed(program, dressed<Symbolic>(joints, form.axes, z, value)),
                             tree = regrouped(bare);
    const JointChange change(program, joints, form.axes, lowering);
    const auto nodes = [&](const std::vector<Symbolic>& list) {
        std::vector<int> result;
        for (const Symbolic& s : list) result.push_back(s.node(program));
        return result;
    };
    const auto symbols = [&](const std::vector<int>& list) {
        std::vector<Symbolic> result;
        for (const int node : list) result.emplace_back(program, node);
        return result;
    };
    std::vector<int> Q;
    for (const GiNaC::ex& force : joints.forces) Q.push_back(lowering(force));
    const Bias<Symbolic> bias(tree);
    const std::vector<int> n = nodes(joint_loads(tree, bias.wrenches));
    std::vector<int> lower;
    RecursionNodes result;
    if (with_matrix) {
        const std::vector<std::vector<Symbolic>> M = composite_bodies(tree);
        std::vector<std::vector<int>> full(M.size(), std::vector<int>(M.size(), program.number(0)));
        for (std::size_t j = 0; j < M.size(); ++j)
            for (std::size_t i = 0; i <= j; ++i) lower.push_back(full[j][i] = full[i][j] = M[j][i].node(program));
        result = {.mass = change.mass(full), .forcing = change.forces(n)};
        for (std::size_t a = 0; a < Q.size(); ++a)
            result.forcing[a] = program.sum(0, {{1, Q[a]}, {-1, result.forcing[a]}});
    }
    if (!change.determines()) return result;
    result.multipliers = change.multipliers(Q);
    const std::vector<int> loads = change.loads(Q);
    if (form.solve == RecursionForm::Solve::articulated) {
        result.acceleration = change.accelerations(nodes(articulated_bodies(tree, bias.wrenches, symbols(loads))));
    } else if (form.solve == RecursionForm::Solve::both_ends) {
        result.acceleration = change.accelerations(nodes(from_both_ends(bare, symbols(loads))));
    } else {
        std::vector<int> f;
        for (std::size_t j = 0; j < n.size(); ++j) f.push_back(program.sum(0, {{1, loads[j]}, {-1, n[j]}}));
        if (const auto rates = solve_symmetric(program, lower, f))
            result.acceleration = change.accelerations(*rates);
    }
    return result;
}

void add_rotors(Program& program, const JointTree& joints, Intermediates& z,
                const std::vector<GiNaC::symbol>& qddot, const std::function<int(const GiNaC::ex&)>& lowering,
                std::vector<int>& loads) {
    for (const Rotor& rotor : joints.rotors) {
        const auto a = static_cast<std::size_t>(rotor.coordinate);
        loads[a] = program.sum(0, {{1, loads[a]}, {1, lowering(z.name(rotor.inertia * qddot[a]))}});
    }
}

std::vector<int> inverse_recursion(Program& program, const JointTree& joints, Intermediates& z,
                                   const std::vector<GiNaC::symbol>& qddot,
                                   const std::function<int(const GiNaC::ex&)>& lowering) {
    const std::function<Symbolic(const GiNaC::ex&)> value = [&](const GiNaC::ex& e) {
        return Symbolic(program, lowering(e));
    };
    BodyTree<Symbolic> tree = regrouped(dressed<Symbolic>(joints, LinkAxes::own, z, value));
    const JointChange change(program, joints, LinkAxes::own, lowering);
    for (std::size_t j = 0; j < joints.joints.size(); ++j) {
        GiNaC::ex w = joints.joints[j].bias;
        for (std::size_t a = 0; a < qddot.size(); ++a) w += joints.joints[j].row[a] * qddot[a];
        tree.links[j].bias = value(z.name(w));
    }
    std::vector<int> second;
    for (const GiNaC::symbol& a : qddot) second.push_back(lowering(a));
    for (const auto& [j, added] : change.ball_accelerations(second))
        tree.links[j].bias = tree.links[j].bias + Symbolic(program, added);
    std::vector<int> loads;
    for (const Symbolic& s : joint_loads(tree, Bias<Symbolic>(tree).wrenches)) loads.push_back(s.node(program));
    loads = change.forces(loads);
    add_rotors(program, joints, z, qddot, lowering, loads);
    for (std::size_t a = 0; a < loads.size(); ++a)
        loads[a] = program.sum(0, {{1, loads[a]}, {-1, lowering(joints.forces[a])}});
    return loads;
}

}  // namespace alembert
