// SPDX-License-Identifier: MIT
#pragma once

/// Finds out whether stability rather than accuracy limits the steps of an explicit method.
///
///     StiffnessWatch watch(Method::dop853);
///     if (watch.finds_stiff(rhs, t, y, rate, h)) ...          // after each accepted step
///
/// At every fourth step one evaluation gives ρ = ‖f(t, y + δv) − f(t, y)‖/δ with ‖v‖ = 1. The difference is the
/// next v, so that in the course of the run the power method finds the modulus of the largest eigenvalue of ∂f/∂y
/// (as RKC does: Sommeijer, Shampine, Verwer, J. Comput. Appl. Math. 88 (1998) 315-326, §3). There are two signs
/// of stiffness; each must have been seen at many checks in a row, with at most five exceptions:
///
///  - hρ is near the border of the region of stability, while a step that accuracy chose is well inside (Hairer &
///    Wanner, Solving ODEs II, §IV.2): fifteen times.
///  - The largest eigenvalue is real and negative (v is an eigenvector), hρ is at least a seventh of the border,
///    and the rate changes so little in a step that steps many times longer would follow the motion: then the mode
///    that has died away long ago still makes the estimates of the error. Ten times. "Many times" means more than
///    an implicit step costs in explicit ones, `dearer`; with 0 this sign is not looked for.

#include <algorithm>
#include <cmath>
#include <vector>

#include "alembert/ode/method.hpp"
#include "alembert/ode/rhs.hpp"

namespace alembert {

class StiffnessWatch {
public:
    explicit StiffnessWatch(Method method) : StiffnessWatch(traits(method).stable_interval) {}
    /// `patience`: the steps before which nothing is found.
    explicit StiffnessWatch(double stable_interval, double dearer = 0, long patience = 0)
        : border_(0.7 * stable_interval), damped_border_(stable_interval / 7), dearer_(dearer), step_(-patience) {}

    bool finds_stiff(const Rhs& rhs, double t, const double* y, const double* rate, double h) {
        if (border_ == 0 || ++step_ <= 0) return false;
        const auto n = static_cast<std::size_t>(rhs.dimension - rhs.extra);
        if (step_ % 4 == 3 && dearer_ > 0) before_.assign(rate, rate + n);
        if (step_ % 4 != 0) return false;
        if (direction_.empty()) direction_.assign(rate, rate + n);
        shares_.resize(n);
        for (std::size_t i = 0; i < n; ++i) shares_[i] = 1 / std::max(1.0, std::abs(y[i]));
        const double length = norm(direction_.data());
        if (!(length > 0) || !std::isfinite(length)) {
            direction_.clear();
            return false;
        }
        constexpr double delta = 1e-7;
        moved_.assign(y, y + rhs.dimension);
        for (std::size_t i = 0; i < n; ++i) moved_[i] += delta / length * direction_[i];
        rate_.resize(moved_.size());
        rhs(t, moved_.data(), rate_.data());
        ++evaluations_;
        for (std::size_t i = 0; i < n; ++i) rate_[i] -= rate[i];
        const double along =
            sum_over(n, [this](std::size_t i) { return (rate_[i] * shares_[i]) * (direction_[i] * shares_[i]); });
        std::copy_n(rate_.begin(), n, direction_.begin());
        const double now = norm(direction_.data());
        rho_ = now / delta;
        const bool is_damped = along < -0.95 * length * now;
        const bool is_quiet = dearer_ > 0 && is_damped && changes_little(rate);
        return limit_.counts(h * rho_ > border_ && h * rho_ < HUGE_VAL, 15) ||
               quiet_.counts(is_quiet && h * rho_ > damped_border_, 10);
    }

    double largest_eigenvalue() const { return rho_; }
    long evaluations() const { return evaluations_; }

private:
    /// How often something was seen, and not seen, since it was not seen six times.
    struct Sightings {
        int seen = 0, missed = 0;
        bool counts(bool sighted, int enough) {
            if (sighted) return ++seen >= enough;
            if (++missed > 5) seen = missed = 0;
            return false;
        }
    };

    bool changes_little(const double* rate) {
        if (before_.size() != shares_.size()) return false;
        for (std::size_t i = 0; i < before_.size(); ++i) before_[i] -= rate[i];
        return norm(before_.data()) * 2 * dearer_ < norm(rate);
    }

    double norm(const double* v) const {
        return std::sqrt(sum_over(shares_.size(), [&](std::size_t i) {
            const double x = v[i] * shares_[i];
            return x * x;
        }));
    }

    /// Four sums side by side, so that few additions wait for each other.
    template <class Term>
    static double sum_over(std::size_t n, Term term) {
        double part[4] = {};
        std::size_t i = 0;
        for (; i + 4 <= n; i += 4)
            for (std::size_t k = 0; k < 4; ++k) part[k] += term(i + k);
        for (; i < n; ++i) part[0] += term(i);
        return (part[0] + part[1]) + (part[2] + part[3]);
    }

    double border_, damped_border_, dearer_, rho_ = 0;
    long step_ = 0, evaluations_ = 0;
    Sightings limit_, quiet_;
    std::vector<double> direction_, moved_, rate_, before_;
    std::vector<double> shares_;  ///< 1 / max(1, |y|), by which components are measured
};

}  // namespace alembert
