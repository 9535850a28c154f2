// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Tangent vectors that are made orthonormal again and again, and the logarithms of the lengths that they had.
///
///     Stretching stretching(space, columns);
///     stretching.vectors = carried_on(stretching.vectors);   // over an interval
///     stretching.renew(t, interval, counts, trace);
///     stretching.finish(result);

#include <Eigen/Dense>

#include "stability/exponents.hpp"

namespace alembert {

class Stretching {
public:
    /// `columns` vectors at random, the same in each run, in the space that the columns of `space` span.
    Stretching(const Eigen::MatrixXd& space, int columns);

    Eigen::MatrixXd vectors;  ///< columns

    /// After an interval that ends at the time t of the motion. The first intervals do not count.
    void renew(double t, double interval, bool counts, double trace = 0);
    /// Sets exponents, rows and the sum; the mean trace where there is one.
    void finish(LyapunovExponents& result, bool has_trace) const;

private:
    Eigen::VectorXd orthonormal();

    Eigen::VectorXd sums_;
    double trace_ = 0, counted_ = 0;
    std::vector<LyapunovExponents::Row> all_;
};

/// The part of a motion before estimates begin.
constexpr double forgotten_part = 0.1;
/// How many intervals a motion has whose rates change by this much per second.
int intervals_of(double duration, double fast);

/// The exponents of a motion with impacts, events that change it and forces that jump; `scene` has its own values.
/// Throws ModelError for what derivatives cannot be carried through.
LyapunovExponents exponents_through_jumps(const Scene& scene, const ExponentOptions& options);

}  // namespace alembert
