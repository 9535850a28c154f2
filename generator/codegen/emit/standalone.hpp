// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A main program beside an emitted file, which integrates the system and prints its motion.
///
///     const SourceFile main = standalone(program, {.state = {0.5, 0, 0, 0}}, {.language = CodeLanguage::c});
///     main.name;    // "double_pendulum_main.c"
///
/// The template is templates/standalone.mustache.

#include <string>

#include "alembert/ode/input_time_scale.hpp"
#include "codegen/emit/emit.hpp"

namespace alembert {

/// An event that ends the motion where its function passes zero: up (+1), down (−1), or in both directions (0).
struct StopEvent {
    int event, direction;
    std::string failure = {};  ///< why the motion cannot go on from there; empty where it may end
};

struct StandaloneStart {
    double t = 0;                                  ///< s
    std::vector<double> state;                     ///< q, then u
    double duration = 10;                          ///< s
    double tolerance = 1e-9;                       ///< the tolerance of a step, relative to max(1, |y|)
    std::vector<InputTimeScale> quick_times = {};  ///< sudden_times
    std::vector<StopEvent> stops = {};
    int event_places = 0;  ///< values of the function of that name in the emitted file; 0: there is none
};

/// "{from, to, enter, step}" of each, as C has it.
std::vector<std::string> quick_rows(const std::vector<InputTimeScale>& quick);

/// The options are those of the emitted file beside it.
SourceFile standalone(const Program& program, const StandaloneStart& start, const EmitOptions& options);

}  // namespace alembert
