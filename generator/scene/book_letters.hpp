// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The letters of a textbook of mechanics that a claim may hold though no scene declares them. A name that the
/// scene declares keeps its own meaning.
///
///     is_book_letter("T", names)            // also V, L, E, H, deltaW; Q_x and delta_x of a coordinate x
///     is_book_call(*parsed.tree, names)     // T(M1), V(spring_1), Q_x(force_1), inertia(B, P)
///
/// What they mean: model/book_letters.hpp.

#include <string>
#include <vector>

#include "scene/names.hpp"

namespace alembert {

bool is_book_letter(const std::string& name, const NameSpaces& names);

/// Whether this is a call by such a letter, whatever its arguments are.
bool is_book_call(const Tree& call, const NameSpaces& names);

/// The first argument is the name of a part of the mechanism; inertia(B, P, u, v) has a point and vectors after
/// it.
constexpr const char* book_inertia = "inertia";

/// "Q_" of Q_theta and "delta_" of delta_theta, with the name that follows; empty if it begins with neither.
std::string after_prefix(const std::string& name, const std::string& prefix);

/// The reactions that `derive --reactions` shows: N_wheel of a rolling condition, F_x_hinge … M_z_hinge of a
/// joint, as far as the scene does not declare these names.
std::vector<std::string> reaction_letters(const Scene& scene, const NameSpaces& names);

/// Every one that claims about this scene may hold, for completion: T, V, …, Q_theta, p_theta.
std::vector<std::string> book_letters(const Scene& scene, const NameSpaces& names);

}  // namespace alembert
