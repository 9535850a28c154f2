// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The tables of a scene and the keys of each. The reader uses this list only. A test compares
/// docs/scene-language.md and docs/scene.schema.json with it.
///
///     keys_of("force")            // at, vector, axes, reaction
///
/// A table inside another is named by its path: "body.inertia". A star stands for a name that the user chooses:
/// "parameters.*" is the longer form of one parameter, { value, unit, about }.

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace alembert {

struct TableKeys {
    enum class Shape {
        one,   ///< [table], once in a scene
        list,  ///< [[table]], any number of times
        inner  ///< a table as a value: { … }
    };
    std::string_view table;
    Shape shape;
    /// Followed by empty entries; all are empty if the user chooses the names.
    std::array<std::string_view, 32> known = {};

    constexpr std::span<const std::string_view> keys() const {
        return {known.data(), static_cast<std::size_t>(std::find(known.begin(), known.end(), "") - known.begin())};
    }
};

inline constexpr TableKeys table_keys[] = {
    {"", TableKeys::Shape::one, {"title", "source", "notes", "gravity", "allow"}},
    {"parameters", TableKeys::Shape::one},
    {"parameters.*", TableKeys::Shape::inner, {"value", "unit", "about"}},
    {"inputs", TableKeys::Shape::one},
    {"inputs.*", TableKeys::Shape::inner, {"value", "unit", "about", "given"}},
    {"coordinates", TableKeys::Shape::one},
    {"coordinates.*", TableKeys::Shape::inner, {"initial", "rate", "guess", "rate_guess", "unit", "about"}},
    {"speeds", TableKeys::Shape::one},
    {"speeds.*", TableKeys::Shape::inner, {"form", "initial", "unit", "about"}},
    {"states", TableKeys::Shape::one},
    {"states.*", TableKeys::Shape::inner, {"rate", "initial", "unit", "about"}},
    {"definitions", TableKeys::Shape::one},
    {"functions", TableKeys::Shape::one},
    {"tables", TableKeys::Shape::one},
    {"tables.*",
     TableKeys::Shape::inner,
     {"arguments", "points", "file", "interpolation", "outside", "period", "units", "unit", "about"}},
    {"frame", TableKeys::Shape::list, {"name", "parent", "rotate", "quaternion"}},
    {"point", TableKeys::Shape::list, {"name", "from", "offset", "axes"}},
    {"particle",
     TableKeys::Shape::list,
     {"name", "mass", "at", "position", "from", "axes", "shape", "size", "radius", "length", "height", "leaves",
      "leaves_along"}},
    {"body",
     TableKeys::Shape::list,
     {"name", "mass", "frame", "at", "position", "from", "axes", "inertia", "about", "shape", "size", "radius",
      "length", "height", "centre"}},
    {"body.inertia", TableKeys::Shape::inner, {"xx", "yy", "zz", "xy", "yz", "zx"}},
    {"body.shape",
     TableKeys::Shape::inner,
     {"box", "disc", "ring", "rod", "ball", "ellipsoid", "cylinder", "cone", "wedge", "polygon", "axis", "middle",
      "axes", "turn"}},
    {"joint",
     TableKeys::Shape::list,
     {"name", "type", "parent", "child", "parent_point", "child_point", "parent_rotate", "child_rotate", "axis",
      "pitch", "coordinates", "angles", "motion", "drive", "armature"}},
    {"force", TableKeys::Shape::list, {"at", "vector", "axes", "reaction", "on"}},
    {"torque", TableKeys::Shape::list, {"on", "vector", "axes", "reaction"}},
    {"spring", TableKeys::Shape::list, {"between", "along", "stiffness", "length"}},
    {"damper", TableKeys::Shape::list, {"between", "along", "damping"}},
    {"constraint", TableKeys::Shape::list, {"name", "holonomic", "nonholonomic", "multiplier"}},
    {"rolling", TableKeys::Shape::list, {"name", "body", "contact", "axes", "on"}},
    {"unilateral", TableKeys::Shape::list, {"name", "gap", "restitution"}},
    {"friction", TableKeys::Shape::list, {"name", "coefficient", "static", "slip", "on", "normal", "restitution"}},
    {"impulse", TableKeys::Shape::list, {"at", "vector", "axes"}},
    {"impulses", TableKeys::Shape::one},
    {"energy", TableKeys::Shape::one, {"kinetic", "potential", "lagrangian"}},
    {"dissipation", TableKeys::Shape::one, {"rayleigh"}},
    {"forces", TableKeys::Shape::one},
    {"outputs", TableKeys::Shape::one},
    {"event",
     TableKeys::Shape::list,
     {"name", "when", "stop", "direction", "impulses", "set", "rates", "record", "count"}},
    {"polynomial", TableKeys::Shape::one, {"coefficients"}},
    {"simulation",
     TableKeys::Shape::one,
     {"start", "duration", "tolerance", "step", "max_step", "sample", "method", "regularize", "period"}},
    {"letters", TableKeys::Shape::one},
    {"units", TableKeys::Shape::one},
    {"scenery",
     TableKeys::Shape::list,
     {"box",   "disc",  "ring", "rod",    "ball",   "ellipsoid", "cylinder", "cone",   "wedge", "polygon", "line",
      "wall",  "floor", "rope", "spring", "damper", "support",   "dot",      "circle", "curve", "pulley",  "name",
      "label", "at",    "turn", "axis",   "axes",   "middle",    "from",     "to",     "over"}},
    {"claim", TableKeys::Shape::list, {"equation", "source", "unknowns", "constants", "at", "near", "where"}},
};

/// Throws std::logic_error if the list has no such table, which is a mistake in the reader.
inline const TableKeys& table_named(std::string_view name) {
    for (const TableKeys& one : table_keys)
        if (one.table == name) return one;
    throw std::logic_error("scene/keys.hpp has no table '" + std::string(name) + "'");
}

inline std::span<const std::string_view> keys_of(std::string_view table) {
    return table_named(table).keys();
}

}  // namespace alembert
