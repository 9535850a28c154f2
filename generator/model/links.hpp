// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Links that a scene does not name: positions written with sines and cosines as points of turning frames.
///
///     [[particle]] position = ["l*sin(q)", "-l*cos(q)"]      // ↦ at [0, −l] in a frame that turns about z by q
///
/// A position is a sum of steps, each along the axes of one frame: constant, prescribed in time, or moved by the
/// same coordinates. Steps that more points share come first; so points whose positions have a part in common,
/// given with `from` or written out from O, become points of one link, and the others of links attached to it. An
/// angle turns a frame where the step turns with it; a frame of the scene that turns by the same angle is taken
/// instead of a new one.
///
/// An angle is a sum of coordinates with rational factors, and time. With unit vector n along x, y or z,
///     c₀ + c cos φ + s sin φ = c₀ + R_n(φ) c   if n·c = 0 and s = n × c,
/// where c may depend on other coordinates; then it is taken apart in the frame that turns by φ.

#include <optional>

#include "model/step_frames.hpp"

namespace alembert {

/// The skeleton with the same points (and more behind them) on such links; nothing if no position of a mass moves.
std::optional<Skeleton> with_links(const Mechanism& mechanism, TurningFrames turns);

}  // namespace alembert
