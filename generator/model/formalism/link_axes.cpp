// SPDX-License-Identifier: GPL-2.0-or-later
// What can be read off a tree of joints without its values.
#include <algorithm>

#include "model/formalism/joint_tree.hpp"

namespace alembert {

std::optional<std::vector<int>> norms_alone(const JointTree& tree, const Mechanism& m) {
    std::vector<int> norms;
    for (const BallJoint& ball : tree.balls)
        for (std::size_t c = 0; c < m.constraints.size(); ++c)
            if (m.constraints[c].norm &&
                !m.constraints[c].row[static_cast<std::size_t>(ball.coordinate[0])].is_zero())
                norms.push_back(static_cast<int>(c));
    if (norms.size() != m.constraints.size() || norms.size() != tree.balls.size()) return std::nullopt;
    return norms;
}

std::vector<Dress> dress(const JointTree& tree, LinkAxes axes) {
    std::vector<Dress> result(tree.joints.size());
    if (axes == LinkAxes::own || !tree.rotors.empty()) return result;
    std::vector<char> turns(result.size(), 1);  // whether the link turns relative to the ground
    for (std::size_t j = 0; j < result.size(); ++j) {
        const TreeLink<Named>& link = tree.joints[j].link;
        const bool rooted = link.parent < 0 || turns[static_cast<std::size_t>(link.parent)] == 0;
        result[j].still = !link.slides;
        if (rooted) {
            turns[j] = link.slides ? 0 : 1;
            result[j].absolute = !link.slides;
            continue;
        }
        const Dress& parent = result[link.parent];
        const TreeJoint& above = tree.joints[link.parent];
        result[j].continues = tree.joints[j].parallel && parent.still;
        if (!result[j].continues) continue;
        result[j].still = true;
        const int base = above.link.slides ? parent.base : link.parent;
        const bool counted = above.link.slides ? parent.base >= 0 : parent.absolute;
        result[j].base = counted ? base : -1;
        result[j].absolute = !link.slides && counted;
    }
    // A link whose axis is not followed by a parallel one keeps its own axes.
    std::vector<char> followed(result.size(), 0);
    for (std::size_t j = 0; j < result.size(); ++j)
        if (result[j].continues) followed[static_cast<std::size_t>(tree.joints[j].link.parent)] = 1;
    for (std::size_t j = 0; j < result.size(); ++j)
        if (!result[j].continues && followed[j] == 0) result[j].still = false;
    return result;
}

bool has_parallel_axes(const JointTree& tree) {
    const std::vector<Dress> how = dress(tree, LinkAxes::still);
    return std::any_of(how.begin(), how.end(), [](const Dress& d) { return d.continues; });
}

bool is_planar_chain(const JointTree& tree) {
    const std::vector<Dress> how = dress(tree, LinkAxes::still);
    for (std::size_t j = 0; j < how.size(); ++j)
        if (tree.joints[j].link.parent != static_cast<int>(j) - 1 || !how[j].absolute ||
            (j > 0 && !how[j].continues))
            return false;
    return how.size() > 1;
}

bool is_planar_in_space(const JointTree& tree) {
    std::optional<int> normal;  // x or y, along the ground's axes
    std::vector<char> turns(tree.joints.size(), 0);
    for (std::size_t j = 0; j < tree.joints.size(); ++j) {
        const TreeLink<Named>& link = tree.joints[j].link;
        const bool on_ground = link.parent < 0 || turns[static_cast<std::size_t>(link.parent)] == 0;
        turns[j] = link.slides && on_ground ? 0 : 1;
        if (link.slides) continue;
        const int first = on_ground ? 0 : 2, last = on_ground ? 1 : 2;
        int along = -1;
        for (int k = first; k <= last; ++k)
            if (link.R[k][2].e.is_equal(1) || link.R[k][2].e.is_equal(-1)) along = k;
        if (along < 0 || (on_ground && normal && *normal != along)) return false;
        if (on_ground) normal = along;
    }
    if (!normal) return false;
    for (std::size_t j = 0; j < tree.joints.size(); ++j)
        if (const TreeLink<Named>& link = tree.joints[j].link;
            link.slides && !link.slide[turns[j] != 0 ? 2 : *normal].e.is_zero())
            return false;
    return true;
}

std::vector<std::vector<GiNaC::numeric>> rate_rows(const JointTree& tree, LinkAxes axes) {
    const std::vector<Dress> how = dress(tree, axes);
    std::vector<std::vector<GiNaC::numeric>> rows;
    for (std::size_t j = 0; j < tree.joints.size(); ++j) {
        rows.push_back(tree.joints[j].row);
        if (!how[j].absolute || how[j].base < 0) continue;
        for (std::size_t i = 0; i < rows[j].size(); ++i)
            rows[j][i] += rows[static_cast<std::size_t>(how[j].base)][i];
    }
    return rows;
}

}  // namespace alembert
