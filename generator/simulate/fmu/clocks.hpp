// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Watched functions of time alone, such as t − 5 or sin(π t), whose zeros a unit knows before it reaches them.
///
///     // the first event; inputs are par[2] … par[5]
///     const std::vector<TimedZero> clocks = add_clocks(program, 1, {2, 6});
///
/// Each clock is an argument linear in time; what is watched changes its sign where the argument is zero, or its
/// sine, or its cosine, or where it is a whole number of turns: sin a = c where a − asin c or a + asin c − π is.
/// The arguments become roots of Group::event, after those that are there.

#include <string>
#include <vector>

#include "program/program.hpp"

namespace alembert {

struct TimedZero {
    enum class Kind { zero, sine, cosine, turn };
    int watched;  ///< among the roots of Group::event
    Kind kind;
};

/// The parameters from `first` to before `behind`: what an importer may set at any time, so that no zero is known.
struct SetParameters {
    int first, behind;
};

/// Looks at the first `watched` roots of Group::event.
std::vector<TimedZero> add_clocks(Program& program, int watched, const SetParameters& set);

}  // namespace alembert
