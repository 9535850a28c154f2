// SPDX-License-Identifier: MIT
#include "alembert/ode/taylor_switch.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/ode/taylor.hpp"

namespace alembert {

namespace {

constexpr double share = 0.025;  // of the run that a look may take
constexpr int looks = 3, apart = 4;
constexpr double clearly = 1.5;  // how much more the run must cost

}  // namespace

/// Its memory is used for all looks.
struct TaylorSwitch::Look {
    Ends ends;
    Taylor taylor;

    Look(const Rhs& rhs, const Place& here, double tolerance)
        : ends(rhs, here.t, {here.y, static_cast<std::size_t>(rhs.dimension)}), taylor(ends, tolerance) {}

    /// The length of a step from there.
    double length(const Place& here) {
        ends.t = here.t;
        std::copy_n(here.y, ends.y.size(), ends.y.begin());
        taylor.forget();
        return taylor.first_length(ends);
    }
};

bool TaylorSwitch::is_worth_making(const Place& here, double effort_per_time) {
    constexpr double gain = 0.5;
    if (!(gain * effort_per_time * here.left > effort_of_making_)) return false;
    rhs_ = make_ ? &made_.emplace(make_()) : &given_;
    if (!rhs_->series) {
        until_ = HUGE_VAL;
        return false;
    }
    const alembert_series_table& costs = *rhs_->series.module;
    const int order = taylor_order(tolerance_, costs.order_cost, costs.product_cost);
    until_ = rhs_->slowness.series * taylor_effort(costs.order_cost, costs.product_cost, order, rhs_->dimension) /
             share;
    return here.spent >= until_;
}

bool TaylorSwitch::finds_cheaper(const Place& here, double effort_per_time) {
    if (pause_-- > 0 || !(effort_per_time > 0) || here.spent < until_) return false;
    if (!rhs_ && !is_worth_making(here, effort_per_time)) return false;
    if (!look_) {
        look_ = std::make_shared<Look>(*rhs_, here, tolerance_);
        ++evaluations_;  // the rate with which it begins
    }
    ++evaluations_;
    effort_ += look_->taylor.effort() / look_->length(here) * here.h;
    time_ += here.h;
    pause_ = apart - 1;
    if (clearly * effort_ < effort_per_time * time_) return ++looked_ == looks;
    until_ = 4 * here.spent;
    looked_ = 0;
    effort_ = time_ = 0;
    return false;
}

}  // namespace alembert
