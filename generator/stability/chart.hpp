// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Stability over two parameters, with its boundary.
///
///     const StabilityChart chart = stability_chart(scene, {}, {Axis{"a", 0, 5, 121}, Axis{"q", 0, 4, 91}});
///     chart.kinds, chart.boundaries
///
/// The eigenvalues, multipliers or roots are taken at the nodes of a grid (spectra.hpp). On each side of a cell of
/// which one end is unstable and the other is not the boundary is found by bisection, and between these points it
/// is divided until no piece differs from it by more than a hundredth of a pixel of the picture (chart_width ×
/// chart_height pixels). In floating point: a picture and no proof. What is smaller than a cell may be missed.

#include "scene/grid.hpp"
#include "scene/units.hpp"
#include "stability/spectra.hpp"

namespace alembert {

inline constexpr double chart_width = 600, chart_height = 450;  ///< pixels

struct ChartPoint {
    double x = 0, y = 0;  ///< in the parameters
};

struct StabilityChart {
    std::string title = {};
    SpectrumOf of = SpectrumOf::eigenvalues;
    Axis x = {}, y = {};
    UnitOfName x_unit = {}, y_unit = {};   ///< in which pictures show them
    std::vector<SpectrumKind> kinds = {};  ///< of the nodes, y the faster
    std::vector<double> beyond = {};       ///< of the nodes: the largest real part, or |multiplier| − 1; NaN
    std::vector<std::vector<ChartPoint>> boundaries = {};
    /// In cells that a boundary passes: the unstable parts, each a polygon.
    struct Piece {
        SpectrumKind kind;
        std::vector<ChartPoint> polygon;
    };
    std::vector<Piece> pieces = {};
    long evaluations = 0;

    SpectrumKind kind(std::size_t i, std::size_t j) const { return kinds[i * y.count + j]; }
};

struct ChartOptions {
    StabilityOptions stability = {};
    std::function<void(std::string_view what, double part)> progress = {};
};

/// Throws as Spectra; ModelError where both axes have one name, no range, or fewer than two values.
StabilityChart stability_chart(Scene scene, const Axis& x, const Axis& y, const ChartOptions& options = {});

}  // namespace alembert
