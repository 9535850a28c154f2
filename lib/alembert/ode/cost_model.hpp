// SPDX-License-Identifier: MIT
#pragma once

/// What steps cost, as it is predicted from counts, so that two methods can be compared during a run and the
/// comparison is the same in every run.
///
///     CostModel cost;
///     cost.add(t, evaluations * effort_of_evaluation(rhs, method));    // after each accepted step
///     cost.effort_per_time();                                          // over the last steps; 0 at first
///
/// Efforts are nanoseconds of a processor with AVX-512 (Zen 5), on which they were fitted (by `bench`, on systems
/// of 2 to 50 components): a right-hand side takes Rhs::effort; an explicit method adds 13 + 0.15 n for each
/// evaluation of n components. An implicit one adds 10 n + 0.45 n², in which are its linear algebra and its
/// Jacobians (fitted on a Zen 4, to six systems of 4 to 28 components). The step of a power series has its own law
/// (taylor.hpp). On other processors both are longer, and not by the same factor (Rhs::slowness): with AVX2 the
/// sums of products, which are most of a series, have half as wide registers.

#include <array>
#include <cstddef>

#include "alembert/native/registers.hpp"
#include "alembert/ode/method.hpp"
#include "alembert/ode/rhs.hpp"

namespace alembert {

/// By the registers that a processor has, where the factors are not measured. With AVX2 alone 41 systems took 2.2
/// and 3.7 times as long on an AMD EPYC (tests/bench/step_costs.sh); after that their times differ from the laws
/// by 19 % and 10 % (root mean square).
inline constexpr Slowness slowness_of(Registers kind) {
    return kind == Registers::wide ? Slowness{.evaluation = 2.2, .series = 3.7} : Slowness{};
}

/// The effort of one evaluation within a step. `method` must not be a Taylor series, which has its own
/// (taylor.hpp).
inline double effort_of_evaluation(const Rhs& rhs, bool implicit) {
    const double n = rhs.dimension, call = rhs.effort > 0 ? rhs.effort : 10 * n;
    return rhs.slowness.evaluation * (call + (implicit ? n * (10 + 0.45 * n) : 13 + 0.15 * n));
}

/// The evaluations of a usual step of radau.
inline constexpr double evaluations_of_radau = 20;

class CostModel {
public:
    static constexpr std::size_t window = 16;  ///< steps

    void add(double time, double effort) {
        times_[count_ % times_.size()] = time;
        efforts_[count_ % times_.size()] = effort;
        ++count_;
    }

    bool is_known() const { return count_ > window; }

    /// Over the last `window` steps; 0 before there are so many.
    double effort_per_time() const {
        if (!is_known()) return 0;
        const std::size_t last = (count_ - 1) % times_.size(), first = count_ % times_.size();
        return (efforts_[last] - efforts_[first]) / (times_[last] - times_[first]);
    }

private:
    std::array<double, window + 1> times_ = {}, efforts_ = {};
    std::size_t count_ = 0;
};

}  // namespace alembert
