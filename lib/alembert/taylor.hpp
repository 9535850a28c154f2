// SPDX-License-Identifier: MIT
#pragma once

/// Taylor's method: the motion's own power series at the start of the step, from Rhs::series.
///
///     y(t + h) = Σ_{k≤p} c_k h^k,   p = ⌈1 − ½ ln tolerance⌉
///
/// The step is chosen before it is taken: with n_j the largest of |c_j| / max(1, |y|),
///
///     h = min over j = p−1, p of ρ_j e^(−2 − 0.7/(p−1)),   ρ_j = n_j^(−1/j)
///
/// (Jorba & Zou, Experimental Math. 14 (2005) 99-117, §3.2), so that the last term is about e^(−2) times the tolerance and what
/// is left out less. The polynomial is kept: states within the step cost its evaluation. `error` is the last term.

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "alembert/stepper.hpp"

namespace alembert {

/// ⌈1 − ½ ln tolerance⌉, at least 4.
inline int taylor_order(double tolerance, int most = most_order) {
    return std::clamp(static_cast<int>(std::ceil(1 - std::log(tolerance) / 2)), 4, most);
}

class Taylor {
public:
    static constexpr bool has_fixed_step = false;
    static constexpr int estimate_order = 8;  // never asked: the length comes from the series
    static constexpr Between between = Between::own;

    Taylor(const Ends& ends, double tolerance)
        : order_(taylor_order(tolerance)),
          size_(ends.y.size()),
          coefficients_(static_cast<std::size_t>(order_ + 1) * size_),
          work_(static_cast<std::size_t>(ends.rhs.series.workspace) + 8) {
        void* start = work_.data();
        std::size_t room = work_.size() * sizeof(double);
        aligned_ = static_cast<double*>(std::align(64, room - 64, start, room));
    }

    int most_evaluations() const { return 1; }

    bool increment(Ends& ends, double h, double* change, double*) {
        expand(ends);
        for (std::size_t i = 0; i < size_; ++i) change[i] = 0;
        for (int k = order_; k > 0; --k) {
            const double* const c = row(k);
            for (std::size_t i = 0; i < size_; ++i) change[i] = h * (change[i] + c[i]);
        }
        const double power = std::pow(h, order_);
        for (std::size_t i = 0; i < size_; ++i) ends.error[i] = row(order_)[i] * power;
        return true;
    }

    void advance(const Ends&) { expanded_ = false; }

    double first_length(Ends& ends) {
        expand(ends);
        return length(ends);
    }

    double next_length(Ends& ends, bool accepted, double ratio) {
        expand(ends);
        return accepted ? length(ends) : ends.h * (std::isfinite(ratio) ? std::min(0.8, 0.9 * std::pow(ratio, -1.0 / order_)) : 0.5);
    }

    void interpolate(const Ends& ends, double theta, double* out) const {
        const double h = theta * ends.h;
        for (std::size_t i = 0; i < size_; ++i) out[i] = 0;
        for (int k = order_; k > 0; --k)
            for (std::size_t i = 0; i < size_; ++i) out[i] = h * (out[i] + row(k)[i]);
        for (std::size_t i = 0; i < size_; ++i) out[i] = ends.y[i] + (out[i] + ends.rest[i]);
    }

private:
    const double* row(int k) const { return coefficients_.data() + static_cast<std::size_t>(k) * size_; }

    void expand(Ends& ends) {
        if (expanded_) return;
        ends.rhs.series(ends.t, ends.y.data(), order_, coefficients_.data(), aligned_);
        ++ends.evaluations;
        expanded_ = true;
    }

    double length(const Ends& ends) const {
        double shortest = HUGE_VAL;
        for (const int k : {order_ - 1, order_}) {
            const double size = ends.norm(row(k));
            if (!(size < HUGE_VAL)) return 0;
            if (size > 0) shortest = std::min(shortest, std::exp(-std::log(size) / k));
        }
        return shortest * std::exp(-2 - 0.7 / (order_ - 1));
    }

    int order_;
    std::size_t size_;
    std::vector<double> coefficients_, work_;
    double* aligned_ = nullptr;
    bool expanded_ = false;
};

}  // namespace alembert
