// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How joints move: one row for each type. The number of coordinates, their meaning in words, which keys a joint
/// has and how many rows close a loop follow from the row; so do the geometry and the closing conditions
/// (model/joints.hpp).
///
///     moves_of(Joint::Type::cylindrical).moves      // turn about the axis, shift along it
///     locked_directions(Joint::Type::cylindrical)   // 4

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace alembert {

/// What one coordinate does; a turn in space has three angles, or the four of a quaternion.
struct Move {
    enum class Kind {
        turn,
        shift,
        turn_in_space,
        screw
    };  ///< of a screw, the shift that comes with the turn: no coordinate
    Kind kind;
    char along = 'a';  ///< x, y, z of the joint's axes; 'a': the axis that the scene gives
};

struct JointMoves {
    std::string name;         ///< "cylindrical"
    std::vector<Move> moves;  ///< in the order of the coordinates

    bool has(Move::Kind kind) const;
    bool has_axis() const;
    /// Coordinates before those of the turn in space.
    std::size_t before_turn_in_space() const;
};
const JointMoves& moves_of(Joint::Type type);

/// Names of all types.
const std::vector<std::string>& joint_types();
std::optional<Joint::Type> joint_type_named(const std::string& name);

/// Coordinates that a joint of this type has, where it places a body.
std::size_t coordinates_of(const Joint& joint);

/// ": the turn, then the shift"; nothing where there is no more than one.
std::string meaning_of_coordinates(const Joint& joint);

/// Rows of a joint that closes a loop.
int locked_directions(Joint::Type type);

}  // namespace alembert
