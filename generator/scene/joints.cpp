// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/language/say.hpp"
#include "scene/advice.hpp"
#include "scene/joint_moves.hpp"
#include "scene/quaternions.hpp"
#include "scene/tables.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

void read_type(const Table& table, Joint& joint) {
    const Name type = table.needed_name("type");
    if (type.place.line == 0) return;
    if (const std::optional<Joint::Type> known = joint_type_named(type.text)) {
        joint.type = *known;
        return;
    }
    std::string small = bare(type.text);
    if (const std::string_view meant = joint_type_meant(type.text); !meant.empty()) small = meant;
    if (const std::optional<Joint::Type> known = joint_type_named(small)) {
        joint.type = *known;
        return;
    }
    const std::string meant = nearest(type.text, joint_types());
    table.reading().complain(type.place, say("unknown type {} of joint; {}", in_quotes(type.text),
                                             meant.empty() ? say("it may be {}", fmt::join(joint_types(), ", "))
                                                           : say("did you mean '{}'?", meant)));
}

Joint::Side read_side(const Table& table, const std::string& which) {
    Joint::Side side{
        .body = table.needed_name(which), .point = {}, .rotate = read_rotations(table, which + "_rotate")};
    if (auto point = table.vector(which + "_point")) {
        side.point = std::move(*point);
    } else {
        side.point.place = table.place();
        for (Expression& component : side.point.component) component = zero(table.place());
    }
    return side;
}

void read_axis(const Table& table, Joint& joint) {
    joint.axis.letter = 'z';
    const Entry* const entry = table.find("axis");
    if (!entry) return;
    if (!moves_of(joint.type).has_axis())
        return table.complain("axis", say("a {} joint has no 'axis' of its own; turn its axes in the bodies with "
                                          "'parent_rotate' and 'child_rotate'",
                                          moves_of(joint.type).name));
    joint.axis = alembert::read_axis(table.reading(), *entry->node);
}

void read_pitch(const Table& table, Joint& joint) {
    if (moves_of(joint.type).has(Move::Kind::screw))
        joint.pitch = table.needed_expression("pitch");
    else if (table.has("pitch"))
        table.complain("pitch",
                       say("'pitch' belongs to a screw; {} is {}", table.title(), moves_of(joint.type).name));
}

void read_angles(const Table& table, Joint& joint) {
    const Entry* const entry = table.find("angles");
    if (!entry) return;
    if (!moves_of(joint.type).has(Move::Kind::turn_in_space))
        return table.complain(
            "angles", say("'angles' belongs to a spherical or a free joint; the others have angles of their own"));
    joint.angles = table.text("angles");
    if (joint.angles.empty()) return;
    const std::string& a = joint.angles;
    if (a.size() != 3 || a.find_first_not_of("xyz") != std::string::npos || a[0] == a[1] || a[1] == a[2])
        return table.complain("angles",
                              say("{} is no sequence of axes; expected three of x, y, z, no two neighbours "
                                  "the same, as in \"zxz\" or \"xyz\"",
                                  in_quotes(a)));
}

/// Reads the inertia of rotors. Each belongs to a coordinate of the joint that is not prescribed, and that is an
/// angle or a shift.
void read_armatures(const Table& table, const Joint& joint, Scene& scene) {
    const std::vector<Name> quaternion = quaternion_of(joint);
    const auto is_among = [](const auto& list, const std::string& name) {
        return std::any_of(list.begin(), list.end(), [&](const auto& one) { return one.name.text == name; });
    };
    const auto is_name = [](const std::string& name) {
        return [&name](const Name& one) { return one.text == name; };
    };
    for (const Entry& entry : table.entries()) {
        const std::string name = table.reading().names.spelled(entry.key);
        Armature rotor{{name, entry.place},
                       read_expression(table.reading(), *entry.node, labelled(say("the armature of"), entry.key))};
        if (std::none_of(joint.coordinates.begin(), joint.coordinates.end(), is_name(name)))
            table.reading().complain(entry.place, say("{} is no coordinate of joint {}; a rotor turns with one",
                                                      in_quotes(name), in_quotes(joint.name.text)));
        else if (std::any_of(quaternion.begin(), quaternion.end(), is_name(name)))
            table.reading().complain(
                entry.place, say("{} is part of a quaternion, whose rate turns no rotor; give the joint 'angles'",
                                 in_quotes(name)));
        else if (!is_among(scene.coordinates, name))
            table.reading().complain(
                entry.place, say("the motion of {} is prescribed, so that its rotor changes nothing; leave it out",
                                 in_quotes(name)));
        else
            scene.armatures.push_back(std::move(rotor));
    }
}

/// x, y or z of a shift, by the name: "y", "cart_y".
char letter_of(const std::string& name) {
    const bool has_letter = !name.empty() && name.back() >= 'x' && name.back() <= 'z' &&
                            (name.size() == 1 || name[name.size() - 2] == '_');
    return has_letter ? name.back() : 0;
}

/// A motion that is not among the coordinates stands where the file has it, so that a name may be that of another
/// shift of the joint. A single letter is refused; a longer name that ends so may mean something else.
void check_order(const Table& coordinates, const Table& motion, const Joint& joint) {
    const auto& entries = motion.entries();
    const auto absent = std::find_if(entries.begin(), entries.end(),
                                     [&](const Entry& entry) { return !coordinates.has(entry.key); });
    if (absent == entries.end()) return;
    const std::vector<Move>& moves = moves_of(joint.type).moves;
    const auto shifts_along = [](const Move& move, char letter) {
        return move.kind == Move::Kind::shift && move.along == letter;
    };
    for (std::size_t k = 0; k < joint.coordinates.size(); ++k) {
        const Name& name = joint.coordinates[k];
        const char letter = letter_of(name.text);
        const bool is_shift =
            std::any_of(moves.begin(), moves.end(), [&](const Move& move) { return shifts_along(move, letter); });
        const bool has_own = k < moves.size() && moves[k].kind == Move::Kind::shift;
        if (!is_shift || (has_own && moves[k].along == letter)) continue;
        const std::string what = has_own ? std::string(1, moves[k].along) : say("an angle");
        const bool is_single = name.text.size() == 1;
        motion.reading().diagnostics.push_back(
            {name.place,
             say("coordinates and prescribed motions of joint {} count in the order of the file, so that {} is {} "
                 "here; write the prescribed one in 'coordinates' too, at its place: {} = 0",
                 in_quotes(joint.name.text), in_quotes(name.text), what, absent->key),
             is_single ? Severity::error : Severity::warning, is_single ? "" : "joint_order"});
        return;
    }
}

/// Reads coordinates, prescribed motions, drives and rotors. A motion takes the place of the coordinate of its
/// name, otherwise its place in the order of the file.
void read_coordinates_of(const Table& table, Joint& joint, Scene& scene) {
    const auto inner = [&](std::string_view key) -> std::optional<Table> {
        const Entry* const entry = table.find(key);
        if (!entry) return {};
        if (const toml::table* const node = entry->node->as_table())
            return Table(table.reading(), *node, table.what(key), entry->place);
        table.complain(key,
                       say("{} is {}; expected a table: {{ q1 = {} }}", table.what(key), kind_of(*entry->node),
                           key == "motion"        ? say("\"expression in t\"")
                           : key == "coordinates" ? "{ initial = 0.1 }"
                                                  : say("\"expression\"")));
        return {};
    };
    const std::optional<Table> coordinates = inner("coordinates"), motion = inner("motion"),
                               drive = inner("drive"), armature = inner("armature");
    if (motion)
        for (const Entry& entry : motion->entries()) {
            joint.coordinates.push_back({entry.key, entry.place});
            scene.definitions.push_back(
                {{entry.key, entry.place},
                 read_expression(table.reading(), *entry.node, labelled(say("the motion of"), entry.key)),
                 true});
        }
    if (coordinates)
        for (const Entry& entry : coordinates->entries()) {
            Coordinate made = read_coordinate(table.reading(), entry);
            const auto prescribed = std::find_if(joint.coordinates.begin(), joint.coordinates.end(),
                                                 [&](const Name& name) { return name.text == entry.key; });
            if (prescribed != joint.coordinates.end()) {
                prescribed->place = entry.place;
                continue;
            }
            joint.coordinates.push_back(made.name);
            scene.coordinates.push_back(std::move(made));
        }
    std::sort(joint.coordinates.begin(), joint.coordinates.end(),
              [](const Name& a, const Name& b) { return a.place < b.place; });
    if (coordinates && motion) check_order(*coordinates, *motion, joint);
    if (drive) read_forces(*drive, scene);
    if (armature) read_armatures(*armature, joint, scene);
}

void read_joint(Table table, Scene& scene) {
    const std::size_t mistakes = table.reading().mistakes();
    table.allow("joint");
    Joint joint;
    joint.name = table.needed_name("name");
    table.entitle(joint.name);
    read_type(table, joint);
    joint.parent = read_side(table, "parent");
    joint.child = read_side(table, "child");
    if (table.reading().mistakes() == mistakes) {
        read_axis(table, joint);
        read_pitch(table, joint);
        read_angles(table, joint);
    }
    read_coordinates_of(table, joint, scene);
    joint.is_whole = table.reading().mistakes() == mistakes;
    scene.joints.push_back(std::move(joint));
}

}  // namespace

std::span<const TableReader> joint_sections() {
    static constexpr TableReader all[] = {
        {"joint", read_joint},
    };
    return all;
}

}  // namespace alembert
