// SPDX-License-Identifier: GPL-2.0-or-later
/// What is drawn beside the bodies: walls, ropes, pulleys, curves; and how a scene that gives energies looks.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/language/say.hpp"
#include "scene/keys.hpp"
#include "scene/tables.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

using Drawn = Scenery::Kind;

/// What stands after a key: places in a list, one place, or sizes.
struct SceneryRow {
    std::string_view key;
    Drawn kind;
    std::size_t least, most;  ///< number of places
};

constexpr std::size_t any_places = 1000;

constexpr SceneryRow of_places[] = {
    {"line", Drawn::line, 2, any_places}, {"wall", Drawn::wall, 2, 2},     {"floor", Drawn::floor, 2, 2},
    {"rope", Drawn::rope, 2, any_places}, {"spring", Drawn::spring, 2, 2}, {"damper", Drawn::damper, 2, 2},
    {"support", Drawn::support, 1, 1},    {"dot", Drawn::dot, 1, 1},
};

/// "P", or [x, y] from O.
Scenery::Spot read_spot(const Reading& reading, const toml::node& node) {
    Scenery::Spot spot;
    spot.position.place = place_of(node);
    for (Expression& component : spot.position.component) component = zero(place_of(node));
    if (node.is_string())
        spot.name = read_name(reading, node, say("a place"));
    else
        spot.position = read_vector(reading, node, say("a place"));
    return spot;
}

void read_places(const Table& table, const SceneryRow& row, Scenery& scenery) {
    const toml::node& node = *table.find(row.key)->node;
    if (row.most == 1) {
        scenery.spots.push_back(read_spot(table.reading(), node));
        return;
    }
    const toml::array* const list = node.as_array();
    if (!list || list->size() < row.least || list->size() > row.most) {
        table.complain(row.key, say("{} needs {} places in a list: {} = [\"P\", [\"x\", 0]]", table.what(row.key),
                                    row.most == 2 ? say("two") : say("two or more"), row.key));
        return;
    }
    for (const toml::node& place : *list) scenery.spots.push_back(read_spot(table.reading(), place));
}

void read_at(const Table& table, Scenery& scenery) {
    if (const Entry* const at = table.find("at"))
        scenery.spots.push_back(read_spot(table.reading(), *at->node));
    else
        table.complain_of_missing({"at"}, say("{} needs 'at': where it is", table.title()));
}

void read_curve(const Table& table, Scenery& scenery) {
    scenery.kind = Drawn::curve;
    Scenery::Spot spot;
    spot.position = table.needed_vector("curve");
    scenery.spots.push_back(spot);
    scenery.over = table.needed_name("over");
    scenery.from = table.needed_expression("from");
    scenery.to = table.needed_expression("to");
}

/// The key that says what it is; nothing after a mistake.
std::optional<std::string_view> kind_key(const Table& table) {
    std::vector<std::string_view> given;
    for (const Entry& entry : table.entries()) {
        const bool is_place = std::any_of(std::begin(of_places), std::end(of_places),
                                          [&](const SceneryRow& row) { return row.key == entry.key; });
        if (is_place || names_solid(entry.key) || entry.key == "circle" || entry.key == "curve" ||
            entry.key == "pulley")
            given.push_back(entry.key);
    }
    if (given.size() == 1) return given[0];
    if (given.empty())
        table.reading().complain(table.place(),
                                 say("{} does not say what is drawn: line, wall, floor, rope, spring, damper, "
                                     "support, dot, circle, curve, pulley, or a solid such as box or disc",
                                     table.title()));
    else
        table.complain(given[1], say("{} has both '{}' and '{}'; give one", table.title(), given[0], given[1]));
    return {};
}

void read_scenery(const Table& table, Looks& looks) {
    table.allow("scenery");
    const std::optional<std::string_view> key = kind_key(table);
    if (!key) return;
    Scenery scenery;
    scenery.name = table.name("name");
    scenery.label = table.text("label");
    if (const auto row = std::find_if(std::begin(of_places), std::end(of_places),
                                      [&](const SceneryRow& one) { return one.key == *key; });
        row != std::end(of_places)) {
        scenery.kind = row->kind;
        read_places(table, *row, scenery);
    } else if (*key == "curve") {
        read_curve(table, scenery);
    } else if (names_solid(*key)) {
        scenery.kind = Drawn::solid;
        std::optional<Shape> shape = read_solid(table);
        if (!shape) return;
        scenery.shape = std::move(*shape);
        read_at(table, scenery);
    } else {
        scenery.kind = *key == "circle" ? Drawn::circle : Drawn::pulley;
        scenery.shape.kind = Shape::Kind::ring;
        read_attitude(table, scenery.shape);
        scenery.shape.sizes.push_back(table.needed_expression(*key));
        scenery.from = table.expression("from");
        scenery.to = table.expression("to");
        read_at(table, scenery);
    }
    if (!scenery.spots.empty()) looks.scenery.push_back(std::move(scenery));
}

}  // namespace

Looks read_looks(const Reading& reading, const toml::table& root) {
    Looks looks;
    const auto each = [&](const char* key, const auto& read) {
        const toml::node* const node = root.get(key);
        const toml::array* const list = node ? node->as_array() : nullptr;
        if (!list) {
            if (node && std::string_view(key) == "scenery")
                reading.complain(place_of(*node),
                                 say("there may be many of these in a scene; write [[{}]] for each", key));
            return;
        }
        for (const toml::node& one : *list)
            if (const toml::table* const table = one.as_table())
                read(Table(reading, *table, fmt::format("[[{}]]", key), place_of(one)));
    };
    for (const char* key : {"particle", "body"})
        each(key, [&](const Table& table) {
            std::optional<Shape> shape = read_shape(table);
            if (!shape) return;
            std::optional<Name> name = table.name("name");
            if (name) looks.shapes.emplace_back(std::move(*name), std::move(*shape));
        });
    each("scenery", [&](const Table& table) { read_scenery(table, looks); });
    return looks;
}

const Shape* Looks::shape_of(const std::string& name) const {
    const auto found =
        std::find_if(shapes.begin(), shapes.end(), [&](const auto& one) { return one.first.text == name; });
    return found == shapes.end() ? nullptr : &found->second;
}

}  // namespace alembert
