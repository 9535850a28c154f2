// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A homogeneous solid inside a surface of triangles, from a file of the kinds that robots have: STL, binary or
/// ASCII, and OBJ.
///
///     const Triangles surface = triangles_of_file(bytes, "hand.stl");
///     const MeshSolid solid = mesh_solid(surface);        // of density 1
///     solid.is_closed                                     // otherwise there is no inside
///
/// Both throw MeshMistake, with the reason, for what is no such file.

#include <stdexcept>
#include <string>
#include <vector>

#include "scene/import/robot.hpp"

namespace alembert {

struct MeshMistake : std::runtime_error {
    using std::runtime_error::runtime_error;
};

using Triangles = std::vector<std::array<Real3, 3>>;

/// `name` tells the kind by its ending.
Triangles triangles_of_file(const std::string& bytes, const std::string& name);

struct MeshSolid {
    double volume = 0;
    Real3 centre = Real3::Zero();
    Real33 inertia = Real33::Zero();  ///< of density 1, about the centre
    bool is_closed = false;           ///< whether each edge has a triangle on either side, all turned alike
    /// The volume of MuJoCo's usual algorithm, "legacy": the sum of the sizes of the pyramids over the triangles,
    /// with the centre of the surface as apex. It is `volume` where that point sees the whole surface from inside.
    double volume_of_pyramids = 0;
};

MeshSolid mesh_solid(const Triangles& surface);

}  // namespace alembert
