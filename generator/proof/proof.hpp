// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene's motion, proved.
///
///     const Proof proof = prove(scene, {.duration = 10});
///     proof.motion.rows.back().box[0];          // contains the first coordinate at the end
///
/// Motions without jumps in independent coordinates: contacts, dry friction, events, impulses, constraints and
/// what has no power series are refused with the reason.

#include "analysis/derive/derived.hpp"
#include "proof/proved_motion.hpp"
#include "simulate/options.hpp"

namespace alembert {

struct Proof : Derived {
    std::vector<std::string> names = {};  ///< of the components: coordinates, then rates, speeds or states
    ProvedMotion motion = {};
};

/// Throws what `derived` throws, and ModelError for what is not proved.
Proof prove(Scene scene, const RunOptions& wishes);

}  // namespace alembert
