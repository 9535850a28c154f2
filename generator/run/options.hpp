// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How a motion is to be integrated: the wishes of whoever asks, and what they mean for a scene.
///
///     RunOptions wishes{.method = "taylor", .tolerance = 1e-12};

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace alembert {

struct RunOptions {
    std::string by = {};      ///< a formalism; empty: the program chooses
    std::string method = {};  ///< empty: the scene's
    double duration = -1, tolerance = -1, step = -1, sample = -1,
           max_step = -1;      ///< s, but for the tolerance; negative: the scene's
    long budget = 10'000'000;  ///< right-hand sides, at the most
    bool fast_math = false;    ///< the compiler may reorder sums
    bool estimate = true;      ///< of the error, by a second run
    bool reactions = false;    ///< what joints bear, on every row
    /// Columns that the table of rows must have: whoever asks for others is told before the motion is integrated.
    std::vector<std::string> columns = {};

    /// Told now and then what is being done and which part of it is over, from 0 to 1.
    std::function<void(std::string_view what, double part)> progress = {};
};

}  // namespace alembert
