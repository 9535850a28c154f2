// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The strokes of what stands still: supports, guides, floors and walls, with their hatching.

#include "present/report/stroke_board.hpp"

namespace alembert {

void add_support(StrokeBoard& board, const FigureElement& e);
void add_guide(StrokeBoard& board, const FigureElement& e);
void add_floor(StrokeBoard& board, const FigureElement& e);
/// A wall or a floor between two places.
void add_ground(StrokeBoard& board, const FigureElement& e);
void add_wall(StrokeBoard& board, const FigureElement& e);

}  // namespace alembert
