// SPDX-License-Identifier: MIT
#pragma once

/// Finds out whether stability rather than accuracy limits the steps of an explicit method.
///
///     StiffnessWatch watch(Method::dop853);
///     if (watch.finds_stiff(rhs, t, y, rate, h)) ...          // after each accepted step
///
/// At every fourth step one evaluation gives ρ = ‖f(t, y + δv) − f(t, y)‖/δ with ‖v‖ = 1. The difference is the
/// next v, so that in the course of the run the power method finds the modulus of the largest eigenvalue of ∂f/∂y
/// (as RKC does: Sommeijer, Shampine, Verwer, J. Comput. Appl. Math. 88 (1998) 315-326, §3). A step that accuracy
/// chose is well inside the region of stability. If hρ has been near the border of that region fifteen times in a
/// row, with at most five exceptions, stability limits the step (Hairer & Wanner, Solving ODEs II, §IV.2).

#include <algorithm>
#include <cmath>
#include <vector>

#include "alembert/integrate.hpp"

namespace alembert {

class StiffnessWatch {
public:
    explicit StiffnessWatch(Method method) : StiffnessWatch(stable_interval(method)) {}
    explicit StiffnessWatch(double stable_interval) : border_(0.7 * stable_interval) {}

    /// The value of −hλ up to which the method is stable; 0 if it is not known.
    static double stable_interval(Method method) {
        switch (method) {
            case Method::dopri5:
                return 3.31;
            case Method::dop853:
                return 6.1;
            case Method::verner76:
                return 4.64;
            case Method::verner98:
                return 4.48;
            case Method::abm:
                return 1.28;
            default:
                return 0;
        }
    }

    bool finds_stiff(const Rhs& rhs, double t, const double* y, const double* rate, double h) {
        if (border_ == 0 || ++step_ % 4 != 0) return false;
        const auto n = static_cast<std::size_t>(rhs.dimension - rhs.extra);
        if (direction_.empty()) direction_.assign(rate, rate + n);
        const double length = norm(direction_.data(), y, n);
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
        for (std::size_t i = 0; i < n; ++i) direction_[i] = rate_[i] - rate[i];
        rho_ = norm(direction_.data(), y, n) / delta;
        if (h * rho_ > border_ && h * rho_ < HUGE_VAL) {
            above_ += 1;
            if (above_ >= 15) return true;
        } else if (++below_ > 5) {
            above_ = below_ = 0;
        }
        return false;
    }

    double largest_eigenvalue() const { return rho_; }
    long evaluations() const { return evaluations_; }

private:
    static double norm(const double* v, const double* y, std::size_t n) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double x = v[i] / std::max(1.0, std::abs(y[i]));
            sum += x * x;
        }
        return std::sqrt(sum);
    }

    double border_, rho_ = 0;
    long step_ = 0, evaluations_ = 0;
    int above_ = 0, below_ = 0;
    std::vector<double> direction_, moved_, rate_;
};

}  // namespace alembert
