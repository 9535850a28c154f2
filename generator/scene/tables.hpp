// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The tables of a scene (scene/keys.hpp says which keys they have), and the functions that read them. Each reads
/// one table and appends its contents to the scene.
///
///     for (const TableReader& section : load_sections()) …   // {"force", …}, {"impulse", …}

#include <span>

#include "scene/looks.hpp"
#include "scene/value.hpp"

namespace alembert {

struct TableReader {
    std::string_view name;  ///< in scene/keys.hpp
    void (*read)(Table, Scene&);
};

std::span<const TableReader> symbol_sections();  ///< tables.cpp: symbols and their values
std::span<const TableReader> body_sections();    ///< bodies.cpp: where things are, and how heavy
std::span<const TableReader> joint_sections();   ///< joints.cpp: what holds them together
std::span<const TableReader> load_sections();    ///< loads.cpp: what acts on them
std::span<const TableReader> run_sections();     ///< runs.cpp: what is to be done

/// tabulated.cpp: functions by points.
void read_point_tables(Table table, Scene& scene);

/// Of coordinates, and of the drives of joints.
void read_forces(Table table, Scene& scene);
Coordinate read_coordinate(const Reading& reading, const Entry& entry);
std::vector<Rotation> read_rotations(const Table& table, std::string_view key);
/// Reads the axis of a rotation; the angle stays null.
Rotation read_axis(const Reading& reading, const toml::node& node);

/// scenery.cpp: all shapes and all that is drawn beside them.
Looks read_looks(const Reading& reading, const toml::table& root);
/// shapes.cpp: the shape of a body or particle, `shape = { disc = "r" }`, if it has one.
std::optional<Shape> read_shape(const Table& table);
/// The shape that one of the keys of a table names; nothing after a mistake, which is reported.
std::optional<Shape> read_solid(const Table& table);
/// Complains of sizes that are negative as written; if an inertia is that of the shape, also of those that are
/// negative at the values of the parameters.
void check_sizes(const Shape& shape, bool has_inertia, const Scene& scene, std::vector<Diagnostic>& mistakes);
/// Where its middle and its axes are.
void read_attitude(const Table& table, Shape& shape);
bool names_solid(std::string_view key);
/// The moments of inertia of a homogeneous solid of that mass about its centroid; complains where they have no
/// value.
Inertia inertia_of(const Shape& shape, const Expression& mass, const Reading& reading);

}  // namespace alembert
