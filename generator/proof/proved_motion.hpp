// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Boxes that contain the true motion.
///
///     const ProvedMotion motion = proved_motion(program, start, {.sample = 1});
///     motion.rows.back().box[0];      // contains q_0 at motion.rows.back().t
///     motion.reached;                 // the time up to which all is proved
///
/// Steps of a power series in intervals. A box around the motion of a whole step is proved first: the series of
/// order p − 1 with the remainder over that box must lie within it (Nedialkov, Jackson & Pryce, An effective
/// high-order interval method for validating existence and uniqueness of the solution of an IVP for an ODE,
/// Reliable Computing 7 (2001), §3). Then the end follows from the series at the middle and the derivatives over
/// the box by the mean value theorem, and the rest is carried in the coordinates of an orthogonal matrix, so that
/// boxes that turn do not grow (Lohner, Enclosing the solutions of ordinary initial and boundary value problems
/// (1987)).
///
/// The scene's decimals are exact (interval_start.hpp), and every rounding error is counted
/// (alembert/base/interval.hpp).

#include <functional>
#include <string>
#include <vector>

#include "alembert/base/interval.hpp"
#include "program/program.hpp"
#include "proof/interval_start.hpp"

namespace alembert {

struct ProofOptions {
    double duration = 10;
    double sample = 0;  ///< s between rows; 0 for the end alone
    int order = 24;     ///< of the series
    long most_steps = 100'000;
    double widest = 0.1;  ///< a box that is wider than this part of max(1, |y|) proves too little to go on
    std::function<void(double part)> progress = {};
};

struct ProvedRow {
    double t = 0;
    std::vector<Interval> box;  ///< coordinates, then speeds; at t, and at the decimal that rounds to it
};

struct ProvedMotion {
    std::vector<ProvedRow> rows;  ///< the start is the first; the last is the end, or where the proof ended
    double reached = 0;
    bool complete = false;  ///< whether that is the end
    long steps = 0;
    std::string why = {};  ///< it goes no further, in words; empty if it is complete
};

/// Throws what `recurrences` throws.
ProvedMotion proved_motion(const Program& program, const IntervalStart& start, const ProofOptions& options);

}  // namespace alembert
