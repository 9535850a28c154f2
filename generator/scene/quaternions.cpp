// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/quaternions.hpp"

#include <algorithm>

#include "scene/joint_moves.hpp"

namespace alembert {

std::vector<Name> quaternion_of(const Joint& joint) {
    const JointMoves& moves = moves_of(joint.type);
    const std::size_t first = moves.before_turn_in_space();
    if (!moves.has(Move::Kind::turn_in_space) || !joint.angles.empty() || joint.coordinates.size() != first + 4)
        return {};
    return {joint.coordinates.begin() + static_cast<std::ptrdiff_t>(first), joint.coordinates.end()};
}

std::vector<FrameQuaternion> quaternions_of(const Scene& scene) {
    std::vector<FrameQuaternion> result;
    for (const Frame& frame : scene.frames)
        if (!frame.quaternion.empty()) result.push_back({frame.name, frame.quaternion});
    for (const Joint& joint : scene.joints) {
        if (!joint.places_child) continue;
        const std::vector<Name> e = quaternion_of(joint);
        const bool moves = !e.empty() && std::all_of(e.begin(), e.end(), [&](const Name& name) {
            return std::any_of(scene.coordinates.begin(), scene.coordinates.end(),
                               [&](const Coordinate& c) { return c.name.text == name.text; });
        });
        if (moves)
            result.push_back(
                {{(*joint.places_child ? joint.child : joint.parent).body.text, joint.name.place}, e});
    }
    return result;
}

Name multiplier_of(const FrameQuaternion& quaternion) {
    return {"lambda_" + quaternion.of.text, quaternion.of.place};
}

}  // namespace alembert
