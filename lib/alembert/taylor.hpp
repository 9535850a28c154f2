// SPDX-License-Identifier: MIT
#pragma once

/// Taylor's method: the motion's own power series at the start of the step, from Rhs::series.
///
///     y(t + h) = Σ_{k≤p} c_k h^k,   p = ⌈1 − ½ ln tolerance⌉
///
/// The step is chosen before it is taken: with n_j the largest of |c_j| / max(1, |y|),
///
///     h = min over j = p−1, p of (½ tolerance / n_j)^(1/j)
///
/// (Jorba & Zou, Experimental Math. 14 (2005) 99-117, §3.2: their ρ e^(−2 − 0.7/(p−1)) is the same for this order), so that the
/// last terms are half the tolerance and what is left out less. The polynomial is kept: states within the step cost its
/// evaluation. `error` is the last term.

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
        : log_tolerance_(std::log(tolerance / 2)),
          order_(taylor_order(tolerance)),
          size_(ends.y.size()),
          coefficients_(static_cast<std::size_t>(order_ + 1) * size_),
          next_(coefficients_.size()),
          work_(static_cast<std::size_t>(ends.rhs.series.workspace) + 8) {
        void* start = work_.data();
        std::size_t room = work_.size() * sizeof(double);
        aligned_ = static_cast<double*>(std::align(64, room - 64, start, room));
    }

    int most_evaluations() const { return 1; }

    bool increment(Ends& ends, double h, double* change, double*) {
        if (!expanded_) expand(ends, ends.t, ends.y, coefficients_);
        expanded_ = true;
        add_up(h, change);
        double power = h;
        for (int k = 1; k < order_; ++k) power *= h;
        for (std::size_t i = 0; i < size_; ++i) ends.error[i] = row(order_)[i] * power;
        return true;
    }

    /// The series at the end of the step, whose second coefficient is the rate there.
    void evaluate_end(Ends& ends) {
        expand(ends, ends.end, ends.next, next_);
        std::copy_n(next_.data() + size_, size_, ends.end_rate.data());
    }

    void advance(const Ends&) { std::swap(coefficients_, next_); }

    double first_length(Ends& ends) {
        if (!expanded_) expand(ends, ends.t, ends.y, coefficients_);
        expanded_ = true;
        return length(ends);
    }

    double next_length(Ends& ends, bool accepted, double ratio) {
        return accepted ? length(ends) : ends.h * (std::isfinite(ratio) ? std::min(0.8, 0.9 * std::pow(ratio, -1.0 / order_)) : 0.5);
    }

    void interpolate(const Ends& ends, double theta, double* out) const {
        add_up(theta * ends.h, out);
        for (std::size_t i = 0; i < size_; ++i) out[i] = ends.y[i] + (out[i] + ends.rest[i]);
    }

private:
    const double* row(int k) const { return coefficients_.data() + static_cast<std::size_t>(k) * size_; }

    /// Σ_{k≥1} c_k h^k, four components at a time.
    void add_up(double h, double* change) const {
        std::size_t i = 0;
        for (; i + 4 <= size_; i += 4) {
            double sum[4] = {};
            for (int k = order_; k > 0; --k)
                for (std::size_t j = 0; j < 4; ++j) sum[j] = h * (sum[j] + row(k)[i + j]);
            std::copy_n(sum, 4, change + i);
        }
        for (; i < size_; ++i) {
            double sum = 0;
            for (int k = order_; k > 0; --k) sum = h * (sum + row(k)[i]);
            change[i] = sum;
        }
    }

    void expand(Ends& ends, double t, const std::vector<double>& y, std::vector<double>& out) {
        ends.rhs.series(t, y.data(), order_, out.data(), aligned_);
        ++ends.evaluations;
    }

    double length(const Ends& ends) const {
        double shortest = HUGE_VAL;
        for (const int k : {order_ - 1, order_}) {
            const double size = ends.norm(row(k));
            if (!(size < HUGE_VAL)) return 0;
            if (size > 0) shortest = std::min(shortest, (log_tolerance_ - std::log(size)) / k);
        }
        return std::exp(shortest);
    }

    double log_tolerance_;
    int order_;
    std::size_t size_;
    std::vector<double> coefficients_, next_, work_;
    double* aligned_ = nullptr;
    bool expanded_ = false;  ///< once, at the start of the run
};

}  // namespace alembert
