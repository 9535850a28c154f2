// SPDX-License-Identifier: MIT
#pragma once

/// Notices that a power series comes to a pose at which its coefficients lose their digits.
///
///     StepCollapse watch;
///     if (watch.shrinks(h, fastest)) …     // for each step that it would take next
///
/// Where a linkage lies flat, pivots of its equations pass through zero, and the steps of a series become a fixed
/// part of the distance to that pose, though the motion is no faster. Where a motion is fast, as near a
/// pericentre, steps are short too, but the state changes as much in each.

#include <algorithm>

namespace alembert {

class StepCollapse {
public:
    /// Whether h is a twentieth of the longest length so far, and h times the largest rate a twentieth of its
    /// largest.
    bool shrinks(double h, double fastest) {
        constexpr double small = 0.05;  // a distance to the pose at which a step of dop853 passes over it
        longest_ = std::max(longest_, h);
        widest_ = std::max(widest_, h * fastest);
        return h < small * longest_ && h * fastest < small * widest_;
    }

private:
    double longest_ = 0, widest_ = 0;
};

}  // namespace alembert
