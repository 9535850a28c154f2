// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The moves that joints allow: one row of a table for each type. From the row follow the number of coordinates,
/// their meaning in words, the keys of the joint, the number of rows that close a loop, and the geometry and the
/// closing conditions (model/joints.hpp).
///
///     moves_of(Joint::Type::cylindrical).moves      // turn about the axis, shift along it
///     locked_directions(Joint::Type::cylindrical)   // 4

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

/// The move of one coordinate. A turn in space has three angles, or the four coordinates of a quaternion.
struct Move {
    enum class Kind {
        turn,
        shift,
        turn_in_space,
        screw
    };  ///< the shift of a screw, which comes with its turn and has no coordinate
    Kind kind;
    char along = 'a';  ///< x, y, z of the joint's axes; 'a': the axis that the scene gives
};

struct JointMoves {
    std::string name;         ///< "cylindrical"
    std::vector<Move> moves;  ///< in the order of the coordinates

    bool has(Move::Kind kind) const;
    bool has_axis() const;
    /// The number of coordinates before those of the turn in space.
    std::size_t before_turn_in_space() const;
};
const JointMoves& moves_of(Joint::Type type);

/// The names of all types.
const std::vector<std::string>& joint_types();
std::optional<Joint::Type> joint_type_named(const std::string& name);

/// The number of coordinates of the joint, if it places a body.
std::size_t coordinates_of(const Joint& joint);

/// ": the turn, then the shift"; empty if there is at most one coordinate.
std::string meaning_of_coordinates(const Joint& joint);

/// The number of rows of a joint that closes a loop.
int locked_directions(Joint::Type type);

}  // namespace alembert
