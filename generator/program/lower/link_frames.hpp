// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The same tree along other axes: the frames of links are moved so that constant rotations and shifts have few
/// entries.
///
///     const BodyTree<Symbolic> lean = regrouped(reframed(program, tree));
///
/// If a link turns about its z axis, its frame may be turned about z and its origin shifted along z, by constants,
/// without any change of its motion; only the zero of its angle changes. With R = Rz(a) Rx(b) Rz(c) between two
/// such links, Rz(a) is moved to the parent's frame and Rz(c) to the link's own, and Rx(b) remains. Each origin
/// makes one entry of the shift between the links zero, or more if axes intersect (Khalil & Kleinfinger, ICRA
/// 1986, 1174: modified Denavit-Hartenberg parameters). The frame of a link with several children is chosen for
/// the child that carries most links. Only rotations that are numbers are decomposed: if they contained
/// parameters, axes might become parallel, and the sine by which is divided would be zero.

#include "model/formalism/body_tree.hpp"
#include "program/symbolic_scalar.hpp"

namespace alembert {

BodyTree<Symbolic> reframed(Program& program, BodyTree<Symbolic> tree);

}  // namespace alembert
