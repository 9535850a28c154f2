// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Settings for the integration of a motion, which override those of the scene.
///
///     RunOptions wishes{.method = "taylor", .tolerance = 1e-12};

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace alembert {

struct RunOptions {
    std::string by = {};      ///< a formalism; if empty, the program chooses
    std::string method = {};  ///< if empty, the scene's
    /// "memory", "compiled" or "auto" (solver_code.hpp); if empty, that of the environment's ALEMBERT_CODE, or
    /// auto.
    std::string code = {};
    std::optional<double> duration = {}, tolerance = {}, step = {}, sample = {},
                          max_step = {};  ///< in s, except the tolerance; if missing, the scene's
    long budget = 10'000'000;             ///< the most right-hand sides
    bool fast_math = false;               ///< whether the compiler may reorder sums
    bool estimate = true;                 ///< whether to estimate the error by a second run
    /// Whether the choice of a method takes account of this processor; otherwise it follows from counts alone, and
    /// is the same on every machine.
    bool tuning = true;
    bool regularize = false;  ///< whether steps are short where the potential is deep (regularization.hpp)
    bool reactions = false;   ///< whether to add the reactions of joints to every row
    /// Columns that the table of rows must have. A missing one is reported before the motion is integrated.
    std::vector<std::string> columns = {};

    /// Coordinates, rates, speeds and parameters by whose values at the start the end is differentiated
    /// (sensitivity.hpp).
    std::vector<std::string> sensitivity = {};
    /// What is differentiated: components of the state and outputs; if empty, all components.
    std::vector<std::string> sensitivity_of = {};
    bool sensitivity_rows = false;  ///< whether also at the times of the rows

    /// Called now and then with the current task and the part of it that is done, from 0 to 1.
    std::function<void(std::string_view what, double part)> progress = {};
};

/// Throws std::invalid_argument for a number that none of these can be (alembert/base/argument.hpp).
void check_numbers(const RunOptions& wishes);

}  // namespace alembert
