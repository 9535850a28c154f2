// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `sweep`: the motions from many initial states or with many parameters.
///
///     const Sweep swept = sweep(scene, {{{"theta1", 0, 3, 1000}}}, {.duration = 10});
///     swept.members[7].final_coordinates[0];

#include "analysis/derive/derived.hpp"
#include "scene/grid.hpp"
#include "simulate/options.hpp"

namespace alembert {

struct SweptMotion {
    std::vector<double> varied;  ///< in the order of Grid::names
    std::vector<double> final_coordinates, final_rates,
        final_speeds,  ///< NaN if the motion did not begin; speeds only of scenes that have their own
        final_states;  ///< of first-order states; NaN in the same case
    std::vector<double> along = {};  ///< in the order of along_columns; NaN in the same case
    double time = 0, drift = 0;      ///< NaN in the same case; `drift` is that of the energy, or the work balance
    long steps = 0, rejected = 0, evaluations = 0;
    std::string status = {};  ///< "done", "stopped" (by an event), or the reason for a failure
    bool failed = false;
};

struct Sweep : Derived {
    Grid grid = {};
    std::vector<std::string> coordinates = {}, speeds = {}, states = {};
    std::vector<std::string> along = {};    ///< of min, max, mean: what is known along each motion
    std::vector<SweptMotion> members = {};  ///< in the order of Grid::point
    bool conserved = true;  ///< whether the energy is conserved; if not, `drift` is that of E − E₀ − W
    std::string method = {}, formulation = {};
    int operations = 0;   ///< operations of one right-hand side
    bool packed = false;  ///< whether eight motions ran side by side
    int threads = 1;
    struct Timings {
        double compile = 0, start = 0, integrate = 0;
    };
    Timings timings = {};  ///< processor time, s
    double computed = 0;   ///< right-hand sides, or power series, in the time of integrating
};

/// Motions of a sweep that follow each other.
struct SweepPart {
    std::size_t first = 0, count = 0;
};

/// The whole sweep in memory (simulate/sweeper.hpp for more than fit there). `threads` is 0 for as many as there
/// are cores. Throws what Sweeper throws; std::invalid_argument if it is negative.
Sweep sweep(Scene scene, const Grid& grid, const RunOptions& wishes = {}, int threads = 0);

/// The names of the values at the end of each motion: t, coordinates, rates (theta1'), the scene's own speeds,
/// its first-order states, and energy_drift or work_balance.
std::vector<std::string> end_columns(const Sweep& sweep);
/// The values under these names.
std::vector<double> end_values(const SweptMotion& motion);

/// The names of what is known along each motion: min_theta, min_theta', max_theta …
std::vector<std::string> along_columns(const Sweep& sweep);

/// The cost of the whole sweep, and a summary of its results. Motions are added in the order of Grid::point.
struct SweepTotals {
    long steps = 0, rejected = 0, evaluations = 0, failed = 0;
    double drift = 0;
    std::string first_failure;

    void add(const SweptMotion& motion, const std::vector<std::string>& names);
};
SweepTotals totals_of(const Sweep& sweep);

}  // namespace alembert
