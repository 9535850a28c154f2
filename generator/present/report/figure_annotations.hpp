// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The strokes of what a figure tells of a mechanism: forces, torques, gravity, axes, angles and dimensions.

#include "present/report/stroke_board.hpp"

namespace alembert {

/// A force, an impulse, or a force that does not act yet.
void add_arrow(StrokeBoard& board, const FigureElement& e);
void add_torque(StrokeBoard& board, const FigureElement& e);
void add_gravity(StrokeBoard& board, const FigureElement& e);
void add_axes(StrokeBoard& board, const FigureElement& e);
void add_angle(StrokeBoard& board, const FigureElement& e);
/// A dimension line beside a length, or an arrow of fixed length if that is too short.
void add_length(StrokeBoard& board, const FigureElement& e);

}  // namespace alembert
