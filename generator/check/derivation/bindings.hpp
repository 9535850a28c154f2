// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What a letter that the scene does not have may stand for: a coordinate or velocity of a point, an angular
/// velocity, a moment of inertia.
///
///     for (const Binding& b : bindings_of({.base = "x", .index = "1"}, scene))
///         b.text                    // "dot(pos(M1),ex(N))"
///
/// Those whose point is named by the index, or has its number, come first and alone.

#include <string>
#include <vector>

#include "check/written/math.hpp"
#include "scene/scene.hpp"

namespace alembert {

struct Binding {
    std::string text;       ///< in the language of claims
    bool named = false;     ///< whether the index names the point or body, or there is only one
    bool spoken = false;    ///< whether the words before it speak of its body
    bool reversed = false;  ///< whether the axis points the other way: y downwards for y upwards
    std::string point{};    ///< of a place or velocity: the particle, body or point
    std::string size{};     ///< of a lone ω: the size of the whole vector, which it may be
};

/// Whether the scene counts its things itself: m1, theta2. Otherwise an author counts in an order of his own.
bool is_counted(const Scene& scene);

/// Whether an index is a number: that of x_1.
bool is_count(const std::string& index);

std::vector<Binding> bindings_of(const Letter& letter, const Scene& scene);

/// x_1 along all axes of space and of the scene's frames, as an author may lay his own.
std::vector<Binding> other_axes_of(const Letter& letter, const Scene& scene);

/// The points that a vector letter may stand for, \vec r_1 or \mathbf{v}_C: three components each.
struct VectorBinding {
    std::string component[3];
    bool named = false;
    std::string point{};
};
std::vector<VectorBinding> vector_bindings_of(const Letter& letter, const Scene& scene);

}  // namespace alembert
