// SPDX-License-Identifier: GPL-2.0-or-later
/// The shapes of bodies, and the moments of inertia of homogeneous solids about their mass centres (Zhang & Qin,
/// chapter 3; of a polygon by Green's formula, from the sums over its edges).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "base/language/say.hpp"
#include "scene/plain_number.hpp"
#include "scene/tables.hpp"
#include "scene/text.hpp"

namespace alembert {
namespace {

using Solid = Shape::Kind;

/// A key, the kind, and how many sizes it has at least and at most.
struct SolidRow {
    std::string_view key;
    Solid kind;
    std::size_t least, most;
    std::string_view sizes;                             ///< as examples in messages
    std::array<std::string_view, 2> beside = {"size"};  ///< the keys of its sizes beside shape = "box"
};

constexpr std::size_t any_corners = 1000;

constexpr SolidRow solids[] = {
    {"box", Solid::box, 2, 3, "[\"a\", \"b\"]"},
    {"disc", Solid::disc, 1, 1, "\"r\"", {"radius"}},
    {"ring", Solid::ring, 1, 1, "\"r\"", {"radius"}},
    {"rod", Solid::rod, 1, 1, "\"l\"", {"length"}},
    {"ball", Solid::ball, 1, 1, "\"r\"", {"radius"}},
    {"ellipsoid", Solid::ellipsoid, 3, 3, "[\"a\", \"b\", \"c\"]"},
    {"cylinder", Solid::cylinder, 2, 2, "[\"r\", \"h\"]", {"radius", "height"}},
    {"cone", Solid::cone, 2, 2, "[\"r\", \"h\"]", {"radius", "height"}},
    {"wedge", Solid::polygon, 2, 2, "[\"b\", \"h\"]"},
    {"polygon", Solid::polygon, 3, any_corners, "[[\"0\", \"0\"], [\"b\", \"0\"], [\"0\", \"h\"]]"},
};

/// The parts have been parsed before; together they may divide by zero, or be too large.
Expression formula(const std::string& text, Place place, const Reading& reading) {
    std::vector<Diagnostic> mistakes;
    Expression result =
        parse_expression(text, std::vector<Place>(text.size() + 1, place), mistakes, &reading.names);
    if (result) return result;
    reading.complain(place, say("a moment of inertia of this shape has no value: {}; a shape needs an area",
                                mistakes.at(0).message));
    return zero(place);
}

/// The corners of a right triangle with legs b and h along x and y, from its centroid.
std::vector<Expression> corners_of_wedge(const std::vector<Expression>& legs, Place place,
                                         const Reading& reading) {
    std::vector<Expression> corners;
    for (const auto& [x, y] : {std::pair("-1/3", "-1/3"), std::pair("2/3", "-1/3"), std::pair("-1/3", "2/3")}) {
        corners.push_back(formula(fmt::format("({})*({})", x, legs[0].text), place, reading));
        corners.push_back(formula(fmt::format("({})*({})", y, legs[1].text), place, reading));
    }
    return corners;
}

/// The sizes that stand after `key`, the row's own or that of shape = "box".
std::optional<std::vector<Expression>> read_sizes(const Table& table, const SolidRow& row, std::string_view key) {
    const Entry& entry = *table.find(key);
    const Reading& reading = table.reading();
    const toml::array* const list = entry.node->as_array();
    const std::size_t count = list ? list->size() : 1;
    const bool needs_list = row.most > 1;
    if ((list != nullptr) != needs_list || count < row.least || count > row.most) {
        table.complain(key, say("{} needs its sizes: {} = {}", table.what(key), key, row.sizes));
        return {};
    }
    std::vector<Expression> sizes;
    const std::size_t before = reading.mistakes();
    if (!list) sizes.push_back(read_expression(reading, *entry.node, table.what(key)));
    for (std::size_t k = 0; list && k < count; ++k)
        if (row.key == "polygon") {
            const Vector corner = read_vector(reading, *list->get(k), say("a corner"));
            sizes.push_back(corner.component[0]);
            sizes.push_back(corner.component[1]);
        } else {
            sizes.push_back(read_expression(reading, *list->get(k), say("a size")));
        }
    if (reading.mistakes() > before) return {};
    return row.key == "wedge" ? corners_of_wedge(sizes, place_of(*entry.node), reading) : std::move(sizes);
}

char read_letter_of_axis(const Table& table) {
    const std::optional<Name> axis = table.name("axis");
    if (!axis) return 0;
    if (axis->text == "x" || axis->text == "y" || axis->text == "z") return axis->text[0];
    table.complain("axis", say("the axis {} is none of \"x\", \"y\", \"z\"", in_quotes(axis->text)));
    return 0;
}

}  // namespace

bool names_solid(std::string_view key) {
    return std::any_of(std::begin(solids), std::end(solids), [&](const SolidRow& row) { return row.key == key; });
}

void check_sizes(const Shape& shape, bool has_inertia, const Scene& scene, std::vector<Diagnostic>& mistakes) {
    if (shape.kind == Solid::polygon) return;  // of corners
    for (std::size_t k = 0; k < shape.sizes.size(); ++k) {
        const std::optional<double> size = plain_number(shape.sizes[k], has_inertia ? scene : Scene{});
        if (!size || !(*size < 0) || (shape.kind == Solid::cone && k > 0)) continue;  // a cone may point down
        const auto row = std::find_if(std::begin(solids), std::end(solids),
                                      [&](const SolidRow& one) { return one.kind == shape.kind; });
        mistakes.push_back(
            {shape.sizes[k].place(), say("a size of {} is {}; expected more than 0",
                                         in_quotes(std::string(row->key)), fmt::format("{:.6g}", *size))});
    }
}

void read_attitude(const Table& table, Shape& shape) {
    shape.place = table.place();
    shape.axis = read_letter_of_axis(table);
    shape.axes = table.name("axes");
    shape.turn = table.expression("turn");
    for (Expression& component : shape.middle.component) component = zero(shape.place);
    if (std::optional<Vector> middle = table.vector("middle")) shape.middle = std::move(*middle);
}

std::optional<Shape> read_solid(const Table& table) {
    std::vector<std::string_view> keys;
    const SolidRow* found = nullptr;
    for (const SolidRow& row : solids) {
        keys.push_back(row.key);
        if (!table.has(row.key)) continue;
        if (found) {
            table.complain(row.key,
                           say("{} has both '{}' and '{}'; give one", table.title(), found->key, row.key));
            return {};
        }
        found = &row;
    }
    if (!found) {
        table.reading().complain(table.place(), say("{} needs one of {}", table.title(), fmt::join(keys, ", ")));
        return {};
    }
    std::optional<std::vector<Expression>> sizes = read_sizes(table, *found, found->key);
    if (!sizes) return {};
    Shape shape{.kind = found->kind, .sizes = std::move(*sizes)};
    read_attitude(table, shape);
    return shape;
}

namespace {

constexpr std::string_view keys_of_sizes[] = {"size", "radius", "length", "height"};

/// "size", or "radius and height".
std::string keys_in_words(const SolidRow& row) {
    return row.beside[1].empty() ? in_quotes(row.beside[0])
                                 : say("{} and {}", in_quotes(row.beside[0]), in_quotes(row.beside[1]));
}

bool is_size_of(const SolidRow& row, std::string_view key) {
    return key == row.beside[0] || key == row.beside[1];
}

/// Complains of a size that does not belong to the shape; `row` is null if its sizes stand in `shape` itself.
bool has_superfluous_size(const Table& table, const SolidRow* row) {
    for (const std::string_view key : keys_of_sizes) {
        if (!table.has(key) || (row && is_size_of(*row, key))) continue;
        table.complain(key,
                       row ? say("a {} has no {}: its sizes are {}", row->key, in_quotes(key), keys_in_words(*row))
                           : say("the sizes stand in 'shape' already; leave out {}", in_quotes(key)));
        return true;
    }
    return false;
}

/// shape = "box" and the keys of its sizes.
std::optional<Shape> read_shape_word(const Table& table, const std::string& word) {
    const SolidRow* const row = std::find_if(std::begin(solids), std::end(solids), [&](const SolidRow& one) {
        return one.key == word && one.key != "polygon";
    });
    if (row == std::end(solids)) {
        std::vector<std::string_view> words;
        for (const SolidRow& one : solids)
            if (one.key != "polygon") words.push_back(one.key);
        table.complain("shape", say("there is no shape {}; there are {}, and lists of corners", in_quotes(word),
                                    fmt::join(words, ", ")));
        return {};
    }
    if (has_superfluous_size(table, row)) return {};
    for (const std::string_view key : row->beside)
        if (!key.empty() && !table.has(key)) {
            table.complain("shape", say("shape = \"{}\" needs {}", row->key, keys_in_words(*row)));
            return {};
        }
    std::optional<std::vector<Expression>> sizes;
    if (row->beside[0] == "size") {
        sizes = read_sizes(table, *row, "size");
    } else {
        const std::size_t before = table.reading().mistakes();
        sizes.emplace();
        for (const std::string_view key : row->beside)
            if (!key.empty())
                sizes->push_back(read_expression(table.reading(), *table.find(key)->node, table.what(key)));
        if (table.reading().mistakes() > before) return {};
    }
    if (!sizes) return {};
    Shape shape{.kind = row->kind, .sizes = std::move(*sizes), .place = table.find("shape")->place};
    for (Expression& component : shape.middle.component) component = zero(shape.place);
    return shape;
}

}  // namespace

std::optional<Shape> read_shape(const Table& table) {
    const Entry* const entry = table.find("shape");
    if (!entry) {
        for (const std::string_view key : keys_of_sizes)
            if (table.has(key)) {
                table.complain(key, say("{} is the size of a shape, and there is no 'shape', such as shape = "
                                        "\"disc\"",
                                        table.what(key)));
                break;
            }
        return {};
    }
    if (const auto* const word = entry->node->as_string()) return read_shape_word(table, word->get());
    if (has_superfluous_size(table, nullptr)) return {};
    if (entry->node->is_array()) {
        const SolidRow& polygon = *std::find_if(std::begin(solids), std::end(solids),
                                                [](const SolidRow& one) { return one.key == "polygon"; });
        std::optional<std::vector<Expression>> corners = read_sizes(table, polygon, "shape");
        if (!corners) return {};
        Shape shape{.kind = Solid::polygon, .sizes = std::move(*corners), .place = entry->place};
        for (Expression& component : shape.middle.component) component = zero(shape.place);
        return shape;
    }
    const toml::table* const inner = entry->node->as_table();
    if (!inner) {
        table.complain("shape", say("{} is {}; expected a solid and its sizes: shape = {{ disc = \"r\" }}",
                                    table.what("shape"), kind_of(*entry->node)));
        return {};
    }
    const Table own(table.reading(), *inner, say("the shape"), entry->place);
    own.allow("body.shape");
    return read_solid(own);
}

namespace {

/// Texts of the elements xx, yy, zz, xy of the tensor of a unit mass about the centroid.
struct Moments {
    std::string xx = "0", yy = "0", zz = "0", xy = "0";
};

/// About an axis of symmetry, and about the two that are perpendicular to it.
Moments symmetric(char axis, const std::string& along, const std::string& across) {
    return {.xx = axis == 'x' ? along : across,
            .yy = axis == 'y' ? along : across,
            .zz = axis == 'z' ? along : across};
}

/// With c_k = x_k y_{k+1} − x_{k+1} y_k: area A = Σ c/2, ∫y² = Σ c (y_k² + y_k y_{k+1} + y_{k+1}²)/12,
/// ∫xy = Σ c (x_k y_{k+1} + 2 x_k y_k + 2 x_{k+1} y_{k+1} + x_{k+1} y_k)/24, ∫x = Σ c (x_k + x_{k+1})/6.
Moments of_polygon(const std::vector<Expression>& corners) {
    std::string area, xx, yy, xy, x, y;
    const std::size_t count = corners.size() / 2;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t next = (k + 1) % count;
        const auto side = [&](std::size_t i) { return fmt::format("({})", corners[i].text); };
        const std::string a = side(2 * k), b = side(2 * k + 1), c = side(2 * next), d = side(2 * next + 1),
                          cross = fmt::format("({0}*{3}-{2}*{1})", a, b, c, d);
        const auto add = [&](std::string& sum, const std::string& term) {
            sum += fmt::format("{}{}*({})", sum.empty() ? "" : "+", cross, term);
        };
        add(area, "1");
        add(xx, fmt::format("{0}^2+{0}*{1}+{1}^2", b, d));
        add(yy, fmt::format("{0}^2+{0}*{1}+{1}^2", a, c));
        add(xy, fmt::format("{0}*{3}+2*{0}*{1}+2*{2}*{3}+{2}*{1}", a, b, c, d));
        add(x, fmt::format("{}+{}", a, c));
        add(y, fmt::format("{}+{}", b, d));
    }
    Moments moments;
    const std::string x0 = fmt::format("({})/(3*({}))", x, area), y0 = fmt::format("({})/(3*({}))", y, area);
    moments.xx = fmt::format("(({})/(6*({}))-({})^2)", xx, area, y0);
    moments.yy = fmt::format("(({})/(6*({}))-({})^2)", yy, area, x0);
    moments.zz = fmt::format("({}+{})", moments.xx, moments.yy);
    moments.xy = fmt::format("(({})*({})-({})/(12*({})))", x0, y0, xy, area);
    return moments;
}

Moments moments_of(const Shape& shape) {
    const auto square = [&](std::size_t k) {
        return k < shape.sizes.size() ? fmt::format("({})^2", shape.sizes[k].text) : std::string("0");
    };
    const auto times = [](const char* factor, const std::string& what) {
        return fmt::format("{}*({})", factor, what);
    };
    const char axis = shape.axis != 0 ? shape.axis : shape.kind == Solid::rod ? 'x' : 'z';
    switch (shape.kind) {
        case Solid::box:
            return {.xx = times("1/12", square(1) + "+" + square(2)),
                    .yy = times("1/12", square(0) + "+" + square(2)),
                    .zz = times("1/12", square(0) + "+" + square(1))};
        case Solid::disc:
            return symmetric(axis, times("1/2", square(0)), times("1/4", square(0)));
        case Solid::ring:
            return symmetric(axis, square(0), times("1/2", square(0)));
        case Solid::rod:
            return symmetric(axis, "0", times("1/12", square(0)));
        case Solid::ball:
            return symmetric(axis, times("2/5", square(0)), times("2/5", square(0)));
        case Solid::ellipsoid:
            return {.xx = times("1/5", square(1) + "+" + square(2)),
                    .yy = times("1/5", square(0) + "+" + square(2)),
                    .zz = times("1/5", square(0) + "+" + square(1))};
        case Solid::cylinder:
            return symmetric(axis, times("1/2", square(0)), times("1/12", "3*" + square(0) + "+" + square(1)));
        case Solid::cone:
            return symmetric(axis, times("3/10", square(0)), times("3/80", "4*" + square(0) + "+" + square(1)));
        case Solid::polygon:
            return of_polygon(shape.sizes);
    }
    return {};
}

}  // namespace

Inertia inertia_of(const Shape& shape, const Expression& mass, const Reading& reading) {
    const Moments own = moments_of(shape);
    Inertia inertia;
    inertia.place = shape.place;
    const std::string texts[] = {own.xx, own.yy, own.zz, own.xy, "0", "0"};
    const std::size_t before = reading.mistakes();
    for (std::size_t k = 0; k < 6; ++k) {
        const bool is_zero = texts[k] == "0" || reading.mistakes() > before;  // one message is enough
        inertia.tensor[k] = is_zero ? zero(shape.place)
                                    : formula(fmt::format("({})*({})", mass.text, texts[k]), shape.place, reading);
    }
    inertia.is_diagonal = own.xy == "0";
    return inertia;
}

}  // namespace alembert
