// SPDX-License-Identifier: MIT
#pragma once

/// Finds out during a run of an explicit method whether a power series would be cheaper, from the lengths of the
/// steps that either would take at the same states.
///
///     TaylorSwitch watch(rhs, with_series, effort_of_making, tolerance);
///     watch.finds_cheaper({.t = t, .y = y, .h = h, .spent = effort, .left = end - t}, effort_per_time);
///
/// `with_series` gives the same system with its series, if it has one; if empty, `rhs` is taken. Nothing is done
/// as long as half of the effort that is left would not pay for making the series. Then the series is evaluated at
/// one state and, while it seems cheaper, at two more, four steps apart. Its effort per time is the mean of
/// effort/length, weighted with the steps of the run; it must be two thirds of that of the run over the same time
/// (cost_model.hpp), or less. A look takes no more than a fortieth of what the run has taken until then, and after
/// one that finds nothing the run takes four times as much before the next, so that looks cost a small part of any
/// run. Throws what the making of the series throws.

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "alembert/ode/rhs.hpp"

namespace alembert {

class TaylorSwitch {
public:
    /// `rhs` must live as long as this.
    TaylorSwitch(const Rhs& rhs, std::function<Rhs()> with_series, double effort_of_making, double tolerance)
        : given_(rhs), make_(std::move(with_series)), effort_of_making_(effort_of_making), tolerance_(tolerance) {}

    /// The end of a step.
    struct Place {
        double t;
        const double* y;
        double h;      ///< the length of the step
        double spent;  ///< the effort of the run so far
        double left;   ///< the time to its end
    };
    /// `effort_per_time` is that of the last steps; 0 if it is not known.
    bool finds_cheaper(const Place& here, double effort_per_time);

    long evaluations() const { return evaluations_; }

private:
    struct Look;

    bool is_worth_making(const Place& here, double effort_per_time);

    const Rhs& given_;
    std::function<Rhs()> make_;
    double effort_of_making_, tolerance_;
    std::optional<Rhs> made_ = {};
    const Rhs* rhs_ = nullptr;  ///< with the series, once it is known
    std::shared_ptr<Look> look_ = {};
    double until_ = 0;  ///< no look before the run has spent this
    long pause_ = 0;    ///< steps before the next look
    long evaluations_ = 0;
    int looked_ = 0;
    double effort_ = 0, time_ = 0;  ///< of the series over the steps at which it was looked at
};

}  // namespace alembert
