// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The same tree along other axes: link frames put where constant rotations and shifts have few entries.
///
///     const BodyTree<Symbolic> lean = regrouped(reframed(program, tree));
///
/// A link that turns about its z may have its frame turned about z and its origin shifted along z, by constants,
/// and turns as before; its angle then counts from elsewhere. With R = Rz(a) Rx(b) Rz(c) between two such links,
/// Rz(a) goes to the parent's frame and Rz(c) to the link's own, and Rx(b) is left; of the shift between them one
/// entry becomes zero by each origin, more where axes meet (Khalil & Kleinfinger, ICRA 1986, 1174: modified
/// Denavit-Hartenberg parameters). A link with several children serves the one with most links on it. Only
/// rotations that are numbers are taken apart: with parameters in them, axes might become parallel, and the
/// division by their sine zero.

#include "formalism/tree_recursions.hpp"
#include "program/symbolic_scalar.hpp"

namespace alembert {

BodyTree<Symbolic> reframed(Program& program, BodyTree<Symbolic> tree);

}  // namespace alembert
