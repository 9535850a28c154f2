// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The end of a motion in numbers with 34 digits, computed by two methods, as a reference for runs in double
/// precision.
///
///     const QuadStart start = quad_start(mechanism, equations, doubles, {});
///     const std::optional<Reference> end = reference(program, start, {.seconds = 30});
///     end->digits;                     // in which the two methods agree, relative to max(1, |y|)
///
/// The scene's decimals are exact (0.1 is 1/10), initial values are recomputed from the scene's expressions, and
/// guesses are moved until the constraints hold to 34 digits. Constraints need no projection during the motion,
/// because their drift is of the size of the tolerance. For methods and tolerances see quad_motion.hpp; if the
/// time is too short for the strict tolerance, a looser one is used.

#include <optional>

#include "model/formalism/equations.hpp"
#include "program/lower/start.hpp"
#include "program/quad_motion.hpp"

namespace alembert {

struct QuadStart {
    std::vector<Quad> parameters;  ///< the independent parameters
    Quad t = 0, duration = 0;
    std::vector<Quad> state;  ///< (q, q'), or (q, u)
};

/// `start` is the same in doubles, assembled. `duration` is given if it is not the scene's.
QuadStart quad_start(const Mechanism& mechanism, const Equations& equations, const Start& start,
                     std::optional<double> duration);

struct Reference {
    std::vector<Quad> coordinates, rates, speeds;  ///< values at the end; speeds only if they are not the rates
    int digits = 0;
    std::string by;
    long evaluations = 0;
};

struct ReferenceOptions {
    double seconds = 30;                                 ///< process time, for each of the two methods
    std::function<void(double fraction)> progress = {};  ///< called often; may be empty
};

/// Nothing if the time is too short or the motion ends in a singularity.
std::optional<Reference> reference(const Program& program, const QuadStart& start,
                                   const ReferenceOptions& options);

}  // namespace alembert
