// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The ends of motions as bytes, without what is varied, which follows from the grid.
///
///     const std::string bytes = bytes_of(motions);
///     motions_of(bytes, sweep, {128, 64});               // the same motions again

#include <string_view>

#include "simulate/sweep.hpp"

namespace alembert {

std::string bytes_of(const std::vector<SweptMotion>& motions);

/// Throws std::runtime_error if the bytes are not those of so many motions of this sweep.
std::vector<SweptMotion> motions_of(std::string_view bytes, const Sweep& sweep, SweepPart part);

}  // namespace alembert
