// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// States of a mechanism in numbers that a reader can substitute (analysis/exact/real_values.hpp), with the
/// accelerations and multipliers that follow from them exactly.
///
///     for (unsigned seed = 0; seed < 100; ++seed)
///         if (const auto state = real_state(motions, claims, roots, seed))
///             // a counterexample
///             if (const auto r = evaluate(claims, *state, roots); r && !r->front().is_zero()) …

#include "analysis/exact/cells.hpp"
#include "analysis/exact/motions.hpp"
#include "analysis/exact/real_values.hpp"

namespace alembert {

inline constexpr unsigned first_float_seed = 400, first_far_seed = 60;

/// A state that obeys the constraints. The larger the seed, the less simple are the numbers; from first_float_seed
/// on, floats are used if a constraint has no fraction as a solution. `roots` of `claims` will be evaluated at the
/// state; variables that occur only in sines and cosines, in them and in the equations, are angles. Nothing for an
/// unusable seed.
std::optional<RealState> real_state(const Motions& motions, const Program& claims, const std::vector<int>& roots,
                                    unsigned seed);

/// A cell of `claims`, and nodes of it that are to be positive.
struct Wanted {
    const Cells& cells;
    Cell cell;
    const std::vector<int>& positive;
};
/// The same, drawn so that it is likely to lie in a cell of `claims`: thresholds are passed where values that are
/// drawn decide. Whoever asks has to look whether it does.
std::optional<RealState> real_state_towards(const Motions& motions, const Program& claims,
                                            const std::vector<int>& roots, const Wanted& wanted, unsigned seed);

/// The same on the scene's own branch, for motions that know it: near a place of it, and at seed 0 with the
/// scene's parameters; from first_far_seed on also far from where the scene starts. Positions that follow from
/// others are floats. At random what is free is one of 2³⁰ fractions, so that an equation which holds there by
/// chance is unlikely.
enum class Draws { simple, at_random };
std::optional<RealState> real_state_on_own_branch(const Motions& motions, const Program& claims,
                                                  const std::vector<int>& roots, unsigned seed,
                                                  Draws draws = Draws::simple);

}  // namespace alembert
