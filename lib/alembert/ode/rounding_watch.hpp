// SPDX-License-Identifier: MIT
#pragma once

/// How much of an error estimate of an explicit step is rounding of the right-hand side.
///
///     RoundingWatch rounding(tolerance);
///     rounding.look(rhs, t, y, rate);      // after accepted steps; evaluates at few of them
///     rounding.level(h);                   // no estimate of a step of length h can be relied on to be smaller
///
/// The right-hand side at a state whose components are moved by one unit in the last place differs by about what
/// its roundings make: δ. The stages of a step differ by such amounts among each other, and their weighted
/// differences, the estimate, by about 4 h δ. A stiff spring makes that larger than a strict tolerance; shorter
/// and shorter steps would then follow each other without a smaller error at the end.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "alembert/ode/rhs.hpp"

namespace alembert {

class RoundingWatch {
public:
    explicit RoundingWatch(double tolerance) : is_needed_(tolerance < loosest) {}

    void look(const Rhs& rhs, double t, const double* y, const double* rate) {
        if (!is_needed_ || ++step_ % every != 0) return;
        const auto n = static_cast<std::size_t>(rhs.dimension - rhs.extra);
        moved_.assign(y, y + rhs.dimension);
        // Up and down by turns, so that a common factor of all components does not hide the change.
        for (std::size_t i = 0; i < n; ++i)
            moved_[i] *= (i + static_cast<std::size_t>(calls_)) % 3 == 0 ? 1 - one_unit : 1 + one_unit;
        rate_.resize(moved_.size());
        rhs(t, moved_.data(), rate_.data());
        ++calls_;
        double largest = 0;
        for (std::size_t i = 0; i < n; ++i)
            largest = std::max(largest, std::abs(rate_[i] - rate[i]) / std::max(1.0, std::abs(y[i])));
        if (std::isfinite(largest)) change_ = std::max(largest, change_ / 2);
    }

    double level(double h) const { return 4 * h * change_; }
    long evaluations() const { return calls_; }

private:
    static constexpr double loosest = 1e-10;  ///< rounding reaches no tolerance above it
    static constexpr long every = 64;         ///< steps; shorter runs have no need of it
    static constexpr double one_unit = std::numeric_limits<double>::epsilon();

    bool is_needed_;
    long step_ = 0, calls_ = 0;
    double change_ = 0;
    std::vector<double> moved_, rate_;
};

}  // namespace alembert
