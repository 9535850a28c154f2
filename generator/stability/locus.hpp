// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The root locus: eigenvalues, multipliers or roots over one parameter.
///
///     const RootLocus locus = root_locus(scene, {"k", 0, 20, 200}, {});
///     locus.crossings[0].value                 // of k where a root passes the imaginary axis
///
/// Values are added where a root moves far between two of them, so that each branch can be followed.

#include <algorithm>

#include "stability/chart.hpp"

namespace alembert {

struct RootLocus {
    std::string title = {}, name = {};
    SpectrumOf of = SpectrumOf::eigenvalues;
    double from = 0, to = 0;
    UnitOfName unit = {};  ///< in which texts and pictures show the parameter
    std::vector<double> values = {};
    std::vector<Spectra::Roots> roots =
        {};  ///< at each value; the k-th of each is one branch. Empty: none found there
    /// Where the number of roots beyond the axis or circle changes, by bisection to the last digits.
    struct Crossing {
        double value;
        std::complex<double> root;               ///< the one that passes
        int before = 0, after = 0;               ///< how many are beyond
        SpectrumKind kind = SpectrumKind::none;  ///< what it is on the unstable side
    };
    std::vector<Crossing> crossings = {};
    /// Where the roots jump, because the state at which they are taken does: whether one crosses there is unknown.
    std::vector<double> jumps = {};

    /// At how many of the values there are no roots.
    std::size_t without_roots() const {
        return static_cast<std::size_t>(
            std::count_if(roots.begin(), roots.end(), [](const Spectra::Roots& at) { return at.empty(); }));
    }
    /// The first and the last of each row of values without roots.
    std::vector<std::pair<double, double>> gaps() const;
};

/// Throws as stability_chart.
RootLocus root_locus(Scene scene, const Axis& axis, const ChartOptions& options = {});

}  // namespace alembert
