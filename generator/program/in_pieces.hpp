// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Tables of one argument as sums of polynomials, of which the signs at the knots choose one. Where signs are held
/// (switches.hpp) such a program has power series.
///
///     in_pieces(program)       // f(s) → Σ p_k(s) (σ_k − σ_(k+1))/2, σ_k = sign(s − x_k)
///
/// All terms but one are exactly zero. Tables with many points or a period, of two arguments, or without values
/// beyond their points stay as they are.

#include "program/program.hpp"

namespace alembert {

Program in_pieces(const Program& program);

}  // namespace alembert
