// SPDX-License-Identifier: MIT
#pragma once

/// The sides to which functions at their zeros may move (filippov_system.hpp).

#include <vector>

#include "alembert/hybrid/filippov_system.hpp"

namespace alembert {

struct SideChoice {
    FilippovMode sides;
    double margin;  ///< the choice is consistent if this is positive
    bool jumps;     ///< whether f differs on the two sides of the open functions

    /// Whether the motion may go on with it, within a margin relative to the rates of g on both sides.
    bool is_consistent() const { return margin > -1e-9; }
    /// The same beyond doubt.
    bool is_clear() const { return margin > 1e-6; }
};

/// All choices of sides for the `open` functions, the most consistent first; the other functions have their sides
/// as in `sides`. A pair, of which `open` has the first function, may stick, or slide in the direction that it
/// takes. There are 3 to the power of the number of open functions, with 2 for a pair. If all of them are pairs
/// that may stick together with some margin, that choice is the only one. In all choices those of `resting`, whose
/// rates are zero and do not depend on σ, stay zero with a σ within their bounds.
std::vector<SideChoice> side_choices(const FilippovSystem& system, FilippovMode sides,
                                     const std::vector<int>& open, double t, const std::vector<double>& state,
                                     const std::vector<int>& resting = {});

/// Whether the equations do not say which of these choices is taken.
bool are_ambiguous(const std::vector<SideChoice>& choices);

/// Gives a pair that begins to slide its direction d, for which v' = r d, and returns r; the other functions have
/// their sides. If there are several, that with the largest r is taken, and r is negative if there is none.
double begin_to_slide(const FilippovSystem& system, FilippovMode& sides, int pair, double t,
                      const std::vector<double>& state);

/// Lets the pair, which has reached its bound, slide, and all those that reach theirs with it because the forces
/// of neither are determined. Returns the pairs.
std::vector<int> give_way(const FilippovSystem& system, FilippovMode& sides, int pair, double t,
                          const std::vector<double>& state);

}  // namespace alembert
