// SPDX-License-Identifier: MIT
#pragma once

/// Adams-Bashforth-Moulton: predict, evaluate, correct, evaluate, with order 4 and Milne's device.
///
///     y_p = y + h Σ_{j<k} g_j ∇^j f,     y₁ = y_p + h g_{k−1} ∇^k f_p,     error = (g_k/g_{k−1} − 1)(y₁ − y_p)
///
/// with g = 1, 1/2, 5/12, 3/8, 251/720 and f_p = f(t + h, y_p): for k = 4 the error is 19/270 of the correction.
/// The first steps have k = 1, 2, 3. When the step length changes, which it does at most once in five steps, the
/// polynomial through the past rates is evaluated at the new distances (differences.hpp). Each step takes two
/// evaluations. Dense output is the integral of that polynomial, of order 4. The method is stable for −1.28 < hλ <
/// 0.
///
/// Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, §III.1 (the formulas)
/// and §III.7; Milne 1926.

#include "alembert/ode/differences.hpp"
#include "alembert/ode/formula_stepper.hpp"

namespace alembert {

class Abm {
public:
    static constexpr bool has_fixed_step = false;
    static constexpr Between between = Between::own;
    static constexpr int estimate_order = 2;  // order of the error estimate in the first step

    Abm(const Ends& ends, double /*tolerance*/)
        : size_(ends.y.size()), old_(size_, rows), new_(size_, rows), predicted_(size_), rate_(size_) {
        std::copy(ends.rate.begin(), ends.rate.end(), old_.row(0));
    }

    int most_evaluations() const { return 1; }

    bool increment(Ends& ends, double h, double* change, double*) {
        if (length_ > 0 && std::abs(h - length_) > 1e-11 * h) {
            old_.stretch(order_ - 1, h / length_);
            equal_steps_ = 0;
        }
        length_ = h;
        for (std::size_t i = 0; i < size_; ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < order_; ++j) sum += g[j] * old_.row(j)[i];
            change[i] = h * sum;
            predicted_[i] = ends.y[i] + (change[i] + ends.rest[i]);
        }
        ends.evaluate(ends.t + h, predicted_.data(), rate_.data());
        const double milne = g[order_] / g[order_ - 1] - 1;
        for (std::size_t i = 0; i < size_; ++i) {
            double difference = rate_[i];
            for (std::size_t j = 0; j < order_; ++j) difference -= old_.row(j)[i];
            const double correction = h * g[order_ - 1] * difference;
            change[i] += correction;
            ends.error[i] = milne * correction;
        }
        return true;
    }

    void finished(const Ends& ends) {
        std::copy(ends.end_rate.begin(), ends.end_rate.end(), new_.row(0));
        for (std::size_t j = 0; j < order_; ++j)
            for (std::size_t i = 0; i < size_; ++i) new_.row(j + 1)[i] = new_.row(j)[i] - old_.row(j)[i];
    }

    /// y₁ + h ∫ from the end backwards; the difference that remains at the start is spread over the step.
    void interpolate(const Ends& ends, double theta, double* out) const {
        const auto at = integrals(theta - 1), at_start = integrals(-1);
        const double share = (1 - theta) * (1 - theta) * (1 + 2 * theta);
        for (std::size_t i = 0; i < size_; ++i) {
            double sum = 0, missing = (ends.y[i] - ends.next[i]) + (ends.rest[i] - ends.next_rest[i]);
            for (std::size_t j = 0; j < order_; ++j) {
                sum += ends.h * at[j] * new_.row(j)[i];
                missing -= ends.h * at_start[j] * new_.row(j)[i];
            }
            out[i] = ends.next[i] + (sum + share * missing + ends.next_rest[i]);
        }
    }

    void advance(const Ends&) {
        std::swap(old_, new_);
        ++equal_steps_;
        if (order_ < 4) ++order_;
    }

    double next_length(const Ends& ends, bool accepted, double ratio) const {
        const double order = static_cast<double>(order_) + 1;
        const double wish = 0.9 * std::pow(std::max(ratio, 1e-10), -1 / order);
        if (!accepted) return ends.h * (std::isfinite(ratio) ? std::clamp(wish, 0.2, 0.9) : 0.5);
        if (wish < 0.9) return ends.h * std::max(wish, 0.5);
        return ends.h * (equal_steps_ > 4 && wish > 1.2 ? std::min(wish, 2.0) : 1);
    }

private:
    static constexpr std::array<double, 5> g = {1, 1. / 2, 5. / 12, 3. / 8, 251. / 720};
    static constexpr std::size_t rows = 5;

    /// ∫₀ˢ of σ (σ+1) … (σ+j−1)/j!
    static std::array<double, 4> integrals(double s) {
        const double s2 = s * s;
        return {s, s2 / 2, s2 * (s / 3 + 0.5) / 2, s2 * (s2 / 4 + s + 1) / 6};
    }

    std::size_t size_;
    Differences old_, new_;  ///< of the rate at the start and at the end
    std::vector<double> predicted_, rate_;
    std::size_t order_ = 1;
    int equal_steps_ = 0;
    double length_ = 0;
};

}  // namespace alembert
