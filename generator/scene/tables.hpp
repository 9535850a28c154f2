// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The tables of a scene. There is one function for each, which reads the table and appends its contents to the
/// scene.

#include "scene/value.hpp"

namespace alembert {

// tables.cpp: symbols and their values
void read_parameters(const Table& table, Scene& scene);
void read_inputs(const Table& table, Scene& scene);
void read_coordinates(const Table& table, Scene& scene);
Coordinate read_coordinate(const Reading& reading, const Entry& entry);
void read_speeds(const Table& table, Scene& scene);
void read_definitions(const Table& table, Scene& scene);
void read_functions(const Table& table, Scene& scene);
void read_letters(const Table& table, Scene& scene);
void read_energy(const Table& table, Scene& scene);
void read_dissipation(const Table& table, Scene& scene);
void read_forces(const Table& table, Scene& scene);
void read_impulses(const Table& table, Scene& scene);
void read_outputs(const Table& table, Scene& scene);

// bodies.cpp: where things are, and how heavy
void read_frame(Table table, Scene& scene);
void read_point(Table table, Scene& scene);
void read_particle(Table table, Scene& scene);
void read_body(Table table, Scene& scene);
std::vector<Rotation> read_rotations(const Table& table, std::string_view key);
/// Reads the axis of a rotation; the angle stays null.
Rotation read_axis(const Reading& reading, const toml::node& node);

// joints.cpp: what holds them together
void read_joint(Table table, Scene& scene);

// loads.cpp: what acts on them
void read_force(Table table, Scene& scene);
void read_impulse(Table table, Scene& scene);
void read_torque(Table table, Scene& scene);
void read_spring(Table table, Scene& scene);
void read_damper(Table table, Scene& scene);
void read_constraint(Table table, Scene& scene);
void read_rolling(Table table, Scene& scene);
void read_unilateral(Table table, Scene& scene);
void read_friction(Table table, Scene& scene);

// runs.cpp: what is to be done
void read_polynomial(const Table& table, Scene& scene);
void read_simulation(const Table& table, Scene& scene);
void read_event(Table table, Scene& scene);
void read_claim(Table table, Scene& scene);

}  // namespace alembert
