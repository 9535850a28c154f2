// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <utility>

#include "base/language/say.hpp"
#include "scene/keys.hpp"
#include "scene/tables.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

/// Reads `at = "P"`, or `key` (a vector) with `from` and `axes`.
Position read_position(const Table& table, std::string_view key, bool has_at) {
    Position position;
    position.offset.place = table.place();
    if (has_at && table.has("at")) {
        for (const std::string_view other : {key, std::string_view("from"), std::string_view("axes")})
            if (table.has(other))
                table.complain(
                    other, say("{} has both 'at' and '{}'; 'at' alone says where it is", table.title(), other));
        position.from = table.needed_name("at");
        for (Expression& component : position.offset.component) component = zero(position.from.place);
        return position;
    }
    if (has_at && !table.has(key)) {
        if (!table.reading().has_joints)
            table.complain_of_missing({"at", key}, say("{} needs 'at' or '{}': where it is", table.title(), key));
    } else {
        position.offset = table.needed_vector(key);
    }
    if (auto from = table.name("from")) position.from = std::move(*from);
    if (auto axes = table.name("axes")) position.axes = std::move(*axes);
    return position;
}

std::optional<Rotation> read_rotation(const Reading& reading, const toml::node& node, std::string_view key) {
    const toml::array* const pair = node.as_array();
    if (!pair || pair->size() != 2) {
        reading.complain(place_of(node),
                         pair ? say("a rotation has two parts: [axis, angle]")
                              : say("'{}' is an array of rotations, each [axis, angle]: [[\"z\", \"psi\"]]", key));
        return {};
    }
    Rotation rotation = read_axis(reading, *pair->get(0));
    rotation.angle = read_expression(reading, *pair->get(1), say("the angle"));
    return rotation;
}

/// Reads four names; none if they are wrong, which is then reported.
std::vector<Name> read_quaternion(const Table& table) {
    const toml::node& node = *table.find("quaternion")->node;
    const toml::array* const list = node.as_array();
    const std::string expected = say("expected four coordinates, scalar first: [\"e0\", \"e1\", \"e2\", \"e3\"]");
    if (!list || list->size() != 4) {
        table.complain(
            "quaternion",
            fmt::format("{} {}; {}", table.what("quaternion"),
                        list ? say("has {} elements", list->size()) : say("is ") + kind_of(node), expected));
        return {};
    }
    std::vector<Name> names = table.names("quaternion");
    if (names.size() != 4) names.clear();
    return names;
}

Inertia read_tensor(const Reading& reading, const toml::table& node, Place place) {
    Inertia inertia;
    const Table table(reading, node, say("the inertia"), place);
    table.allow("body.inertia");
    const auto keys = keys_of("body.inertia");
    for (std::size_t i = 0; i < 6; ++i)
        inertia.tensor[i] = table.has(keys[i]) ? table.expression(keys[i]) : zero(place);
    return inertia;
}

std::optional<Inertia> read_inertia(const Table& table) {
    const Entry* const entry = table.find("inertia");
    if (!entry) return {};
    const Reading& reading = table.reading();
    Inertia inertia;
    if (const toml::table* const tensor = entry->node->as_table()) {
        inertia = read_tensor(reading, *tensor, entry->place);
    } else if (const toml::array* const diagonal = entry->node->as_array()) {
        inertia.is_diagonal = true;
        if (diagonal->size() != 3)
            reading.complain(place_of(*entry->node),
                             say("the inertia has {} elements; expected one expression about z, "
                                 "[Ixx, Iyy, Izz] or {{ xx, yy, zz, xy, yz, zx }}",
                                 diagonal->size()));
        for (std::size_t i = 0; i < 6; ++i)
            inertia.tensor[i] = i < 3 && i < diagonal->size()
                                    ? read_expression(reading, *diagonal->get(i), say("an element of the inertia"))
                                    : zero(entry->place);
    } else {
        inertia.planar = read_expression(reading, *entry->node, table.what("inertia"));
    }
    inertia.place = place_of(*entry->node);
    return inertia;
}

constexpr std::string_view from_shape = "from shape";

bool is_from_shape(const Table& table) {
    const Entry* const entry = table.find("inertia");
    const auto* const text = entry ? entry->node->as_string() : nullptr;
    return text != nullptr && text->get() == from_shape;
}

std::optional<Inertia> inertia_from_shape(const Table& table, const Expression& mass) {
    if (!table.has("shape")) {
        table.complain("inertia", say("{} is \"{}\", but there is no 'shape', such as shape = {{ disc = \"r\" }}",
                                      table.what("inertia"), from_shape));
        return {};
    }
    std::vector<Diagnostic> elsewhere;  // `read_looks` reports the mistakes of all shapes
    const Reading quiet{table.reading().source, elsewhere, table.reading().has_joints, table.reading().names};
    const std::optional<Shape> shape = read_shape(table.with(quiet));
    if (!shape || !mass) return {};
    if (table.has("about") || shape->axes || shape->turn)
        table.complain(
            table.has("about") ? "about" : "shape",
            say("the inertia from a shape is about the mass centre, along the axes of the body; leave out "
                "'{}'",
                table.has("about") ? "about"
                : shape->axes      ? "axes"
                                   : "turn"));
    Inertia inertia = inertia_of(*shape, mass, table.reading());
    inertia.place = place_of(*table.find("inertia")->node);
    return inertia;
}

}  // namespace

Rotation read_axis(const Reading& reading, const toml::node& axis) {
    Rotation rotation;
    if (const auto* letter = axis.as_string()) {
        const std::string& name = letter->get();
        if (name == "x" || name == "y" || name == "z")
            rotation.letter = name[0];
        else
            reading.complain(
                place_of(axis),
                say("the axis {} is none of \"x\", \"y\", \"z\"; or give a vector of three", in_quotes(name)));
    } else if (const auto* components = axis.as_array(); components && components->size() == 3) {
        rotation.axis = read_vector(reading, axis, say("the axis"));
    } else {
        reading.complain(place_of(axis),
                         say("the axis is {}; expected \"x\", \"y\", \"z\" or a vector of three",
                             components ? say("an array of {}", components->size()) : kind_of(axis)));
    }
    return rotation;
}

std::vector<Rotation> read_rotations(const Table& table, std::string_view key) {
    std::vector<Rotation> rotations;
    const Entry* const entry = table.find(key);
    if (!entry) return rotations;
    const toml::array* const list = entry->node->as_array();
    if (!list) {
        table.complain(key, say("{} is {}; expected an array of rotations: [[\"z\", \"psi\"]]", table.what(key),
                                kind_of(*entry->node)));
        return rotations;
    }
    for (const toml::node& node : *list)
        if (auto rotation = read_rotation(table.reading(), node, key))
            rotations.push_back(std::move(*rotation));
        else
            break;
    return rotations;
}

namespace {

void read_frame(Table table, Scene& scene) {
    table.allow("frame");
    Frame frame;
    frame.name = table.needed_name("name");
    table.entitle(frame.name);
    if (auto parent = table.name("parent")) frame.parent = std::move(*parent);
    if (table.has("quaternion")) {
        if (table.has("rotate"))
            table.complain("rotate", say("{} has both 'quaternion' and 'rotate'; give one", table.title()));
        frame.quaternion = read_quaternion(table);
    } else if (table.has("rotate")) {
        frame.rotations = read_rotations(table, "rotate");
    } else {
        table.complain_of_missing({"rotate", "quaternion"},
                                  say("{} needs 'rotate' or 'quaternion'", table.title()));
    }
    scene.frames.push_back(std::move(frame));
}

void read_point(Table table, Scene& scene) {
    table.allow("point");
    Point point;
    point.name = table.needed_name("name");
    table.entitle(point.name);
    point.position = read_position(table, "offset", false);
    scene.points.push_back(std::move(point));
}

void read_particle(Table table, Scene& scene) {
    table.allow("particle");
    Particle particle;
    particle.name = table.needed_name("name");
    table.entitle(particle.name);
    particle.mass = table.needed_expression("mass");
    particle.position = read_position(table, "position", true);
    particle.leaves = table.vector("leaves");
    if (auto along = table.name("leaves_along")) particle.along = std::move(*along);
    if (table.has("leaves_along") && !particle.leaves)
        table.complain("leaves_along", say("{} says along which axes 'leaves' is, and there is no 'leaves'",
                                           table.what("leaves_along")));
    scene.particles.push_back(std::move(particle));
}

void read_body(Table table, Scene& scene) {
    table.allow("body");
    Body body;
    body.name = table.needed_name("name");
    table.entitle(body.name);
    body.mass = table.needed_expression("mass");
    if (auto frame = table.name("frame")) body.frame = std::move(*frame);
    body.position = read_position(table, "position", true);
    body.has_position = table.has("at") || table.has("position");
    body.inertia = is_from_shape(table) ? inertia_from_shape(table, body.mass) : read_inertia(table);
    body.about = table.name("about");
    if (auto centre = table.name("centre")) body.centre = std::move(*centre);
    if (body.about && !table.has("inertia"))
        table.complain("about", say("{} says about which point the inertia is, but there is no 'inertia'",
                                    table.what("about")));
    scene.bodies.push_back(std::move(body));
}

}  // namespace

std::span<const TableReader> body_sections() {
    static constexpr TableReader all[] = {
        {"frame", read_frame},
        {"point", read_point},
        {"particle", read_particle},
        {"body", read_body},
    };
    return all;
}

}  // namespace alembert
