// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Lyapunov exponents of a motion.
///
///     const LyapunovExponents found = lyapunov_exponents(scene, {.count = 1, .duration = 1000});
///     found.exponents[0], found.spread[0]
///
/// The variational equations δ' = ∂f/∂x δ, emitted and compiled with the equations of motion, carry `count`
/// tangent vectors along; again and again they are made orthonormal (QR), and the logarithms of the lengths that
/// they had are added up (Benettin, Galgani, Giorgilli & Strelcyn, Meccanica 15 (1980) 9). With constraints they
/// are put back into the tangent space then, and the state onto the constraints. In floating point: how far the
/// estimates have settled is told, and nothing is proved. Through impacts, events that change the motion and jumps
/// of forces the vectors go by saltation matrices (simulate/hybrid_variation.hpp).

#include "analysis/derive/derived.hpp"

namespace alembert {

struct ExponentOptions {
    std::string by = {};
    Overrides at = {};
    int count = 1;           ///< how many, the largest first; 0: all
    double duration = 1000;  ///< s
    double tolerance = 1e-10;
    std::function<void(std::string_view what, double part)> progress = {};
};

struct LyapunovExponents {
    std::string title = {};
    std::vector<std::string> warnings = {};
    std::vector<double> exponents = {};  ///< 1/s, the largest first, over the last nine tenths of the motion
    std::vector<double> spread = {};     ///< how much each estimate still moved in the second half
    struct Row {
        double time;
        std::vector<double> estimates;
    };
    std::vector<Row> rows = {};      ///< estimates over the motion
    int size = 0;                    ///< of the tangent space
    std::optional<double> sum = {};  ///< of all exponents, where all were asked for
    std::optional<double> divergence =
        {};  ///< mean of the trace of ∂f/∂x, which the sum equals; without constraints
    double duration = 0, interval = 0;  ///< s; between two times of making them orthonormal
};

/// Throws ModelError for scenes with dry friction, and for a count that is too large; IntegrationError where the
/// motion fails, or jumps in a way that leaves no derivatives.
LyapunovExponents lyapunov_exponents(Scene scene, const ExponentOptions& options = {});

}  // namespace alembert
