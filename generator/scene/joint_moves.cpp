// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/joint_moves.hpp"

#include <algorithm>
#include <utility>

#include "base/language/say.hpp"

namespace alembert {

namespace {

using MoveKind = Move::Kind;
using Type = Joint::Type;

const std::vector<std::pair<Type, JointMoves>>& table() {
    static const std::vector<std::pair<Type, JointMoves>> rows{
        {Type::fixed, {"fixed", {}}},
        {Type::revolute, {"revolute", {{MoveKind::turn}}}},
        {Type::prismatic, {"prismatic", {{MoveKind::shift}}}},
        {Type::cylindrical, {"cylindrical", {{MoveKind::turn}, {MoveKind::shift}}}},
        {Type::universal, {"universal", {{MoveKind::turn, 'x'}, {MoveKind::turn, 'y'}}}},
        {Type::spherical, {"spherical", {{MoveKind::turn_in_space}}}},
        {Type::planar, {"planar", {{MoveKind::shift, 'x'}, {MoveKind::shift, 'y'}, {MoveKind::turn, 'z'}}}},
        {Type::screw, {"screw", {{MoveKind::turn}, {MoveKind::screw}}}},
        {Type::free,
         {"free",
          {{MoveKind::shift, 'x'}, {MoveKind::shift, 'y'}, {MoveKind::shift, 'z'}, {MoveKind::turn_in_space}}}},
    };
    return rows;
}

std::string words_of(const Move& move, bool by_angles) {
    const bool own = move.along == 'a';
    switch (move.kind) {
        case MoveKind::turn:
            return own ? say("the turn") : say("the turn about {}", move.along);
        case MoveKind::shift:
            return own ? say("the shift") : std::string(1, move.along);
        case MoveKind::turn_in_space:
            return by_angles ? say("the three angles")
                             : say("a quaternion, scalar first (or three angles, with 'angles')");
        case MoveKind::screw:
            break;
    }
    return {};
}

}  // namespace

bool JointMoves::has(MoveKind kind) const {
    return std::any_of(moves.begin(), moves.end(), [&](const Move& move) { return move.kind == kind; });
}

bool JointMoves::has_axis() const {
    return std::any_of(moves.begin(), moves.end(),
                       [](const Move& move) { return move.along == 'a' && move.kind != MoveKind::turn_in_space; });
}

std::size_t JointMoves::before_turn_in_space() const {
    const auto turn = std::find_if(moves.begin(), moves.end(),
                                   [](const Move& move) { return move.kind == MoveKind::turn_in_space; });
    return static_cast<std::size_t>(turn - moves.begin());
}

const JointMoves& moves_of(Type type) {
    return std::find_if(table().begin(), table().end(), [&](const auto& row) { return row.first == type; })
        ->second;
}

const std::vector<std::string>& joint_types() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const auto& row : table()) list.push_back(row.second.name);
        return list;
    }();
    return names;
}

std::optional<Type> joint_type_named(const std::string& name) {
    for (const auto& [type, moves] : table())
        if (moves.name == name) return type;
    return std::nullopt;
}

std::size_t coordinates_of(const Joint& joint) {
    std::size_t count = 0;
    for (const Move& move : moves_of(joint.type).moves)
        count += move.kind == MoveKind::screw           ? 0
                 : move.kind != MoveKind::turn_in_space ? 1
                 : joint.angles.empty()                 ? 4
                                                        : 3;
    return count;
}

std::string meaning_of_coordinates(const Joint& joint) {
    if (coordinates_of(joint) < 2) return {};
    std::vector<std::string> words;
    for (const Move& move : moves_of(joint.type).moves)
        if (move.kind != MoveKind::screw) words.push_back(words_of(move, !joint.angles.empty()));
    std::string text = ": ";
    for (std::size_t k = 0; k < words.size(); ++k)
        text += (k == 0 ? "" : k + 1 == words.size() ? say(", then ") : ", ") + words[k];
    return text;
}

int locked_directions(Type type) {
    int locked = 6;
    for (const Move& move : moves_of(type).moves)
        locked -= move.kind == MoveKind::screw ? 0 : move.kind == MoveKind::turn_in_space ? 3 : 1;
    return locked;
}

}  // namespace alembert
