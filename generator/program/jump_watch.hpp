// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Notices where a motion passes a jump of its rates that no sign shows: the cut of atan2 along y = 0, x < 0, and
/// a pole within a function that has values beyond it, as of atan(1/x) at x = 0.
///
///     JumpWatch watch(program, parameters);
///     watch(t, state);               // at the end of each step, in order; throws IntegrationError at such a jump
///
/// Along a motion that stays on one side these functions are smooth, and so a look at their form does not decide
/// (jumps_along_motion of switches.hpp). An angle by atan2 of which only sines and cosines are taken has no jump.

#include <optional>
#include <vector>

#include "program/tape.hpp"

namespace alembert {

class JumpWatch {
public:
    JumpWatch(const Program& program, const std::vector<double>& parameters);

    /// Coordinates, then speeds.
    void operator()(double t, const double* state);

private:
    void look(double t, const double* state, std::size_t border);

    std::size_t size_ = 0, coordinates_ = 0, borders_ = 0;
    std::vector<std::string> names_;
    std::optional<Tape<double>> tape_;  ///< what is zero at borders, then the rates
    double last_time_ = 0;
    std::vector<double> last_, before_, now_;
};

}  // namespace alembert
