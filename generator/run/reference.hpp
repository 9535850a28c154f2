// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Where a motion ends, in numbers of 34 digits and by two methods, to hold runs in double precision against.
///
///     const QuadStart start = quad_start(mechanism, equations, doubles, {});
///     const std::optional<Reference> end = reference(program, start, {.seconds = 30});
///     end->digits;                     // in which the two methods agree, relative to max(1, |y|)
///
/// The scene's decimals are taken as what they say (0.1 is 1/10), initial values are computed anew from the
/// scene's expressions, and guesses are moved until the constraints hold to 34 digits. Constraints need no
/// projection on the way: what they drift by is the tolerance. Methods and tolerances: quad_motion.hpp; a looser
/// tolerance where the time is too short for the strict one.

#include <optional>

#include "formalism/equations.hpp"
#include "lower/start.hpp"
#include "run/quad_motion.hpp"

namespace alembert {

struct QuadStart {
    std::vector<Quad> parameters;  ///< independent ones
    Quad t = 0, duration = 0;
    std::vector<Quad> state;  ///< (q, q'), or (q, u)
};

/// `start`: the same in doubles, assembled. `duration`: where it is not the scene's.
QuadStart quad_start(const Mechanism& mechanism, const Equations& equations, const Start& start,
                     std::optional<double> duration);

struct Reference {
    std::vector<Quad> coordinates, rates, speeds;  ///< at the end; speeds only where they are not the rates
    int digits = 0;
    std::string by;
    long evaluations = 0;
};

struct ReferenceOptions {
    double seconds = 30;                                 ///< process time, for each of the two methods
    std::function<void(double fraction)> progress = {};  ///< told often; may be empty
};

/// Nothing where the time is too short or the motion ends in a singularity.
std::optional<Reference> reference(const Program& program, const QuadStart& start,
                                   const ReferenceOptions& options);

}  // namespace alembert
