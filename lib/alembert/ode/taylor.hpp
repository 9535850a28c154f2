// SPDX-License-Identifier: MIT
#pragma once

/// Taylor's method: a step evaluates the power series of the motion at the start of the step, which Rhs::series
/// computes.
///
///     y(t + h) = Σ_{k≤p} c_k h^k
///
/// The step is chosen before it is taken: with n_j the largest of |c_j| / max(1, |y|),
///
///     h = min over j = p−1, p of (a tolerance / n_j)^(1/j)                (series_length.hpp)
///
/// (Jorba & Zou, Experimental Math. 14 (2005) 99-117, §3.2: their ρ e^(−2 − 0.7/(p−1)) is that for p = ⌈1 − ½ ln
/// tolerance⌉ and a = ½), so that the last terms are a times the tolerance and the omitted terms are smaller. Here
/// a = 1/200, because the errors of the steps of a long run add up. The step length is proportional to
/// tolerance^(1/p), and the time of a step is about 1 + c p + d p² (c and d come with the series); p is
/// chosen so that the time per length is least. A series knows nothing of what changes fast further on, such as a
/// pulse or the jump of a steep tanh: a step is repeated with half its length where the rate at its end is not
/// that of the polynomial. Where the terms of a series do not decay, as in free flight far from everything,
/// nothing but the tolerance or the end of the run limits the step: then the rate is compared within it, too, at
/// places that are a 64th of the run apart (missed_feature_check.hpp). (What is over between two of these, or is
/// hidden within a step whose terms decay, is not seen; steps of a given length are not checked.) If products of
/// series take all the time, this is Jorba & Zou's order (§3.1), otherwise it is higher. The polynomial is kept,
/// so that a state within the step only costs its evaluation. `error` is the last term.

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "alembert/ode/formula_stepper.hpp"
#include "alembert/ode/missed_feature_check.hpp"
#include "alembert/ode/series_length.hpp"
#include "alembert/ode/series_sum.hpp"

namespace alembert {

inline constexpr double shortest_tried = 1e-11;  ///< of t; a jump that is no event cannot be foreseen
inline constexpr double taylor_share = 0.005;    ///< a: the last term as a part of the tolerance

/// The order that makes (1 + order_cost p + product_cost p²) tolerance^(−1/p) least, at least ⌈1 − ½ ln tolerance⌉
/// and 4. The derivative is a cubic whose coefficients change their sign once, so that it has one positive zero
/// (Descartes): the effort falls up to it and grows from there, and halving the interval finds the order.
inline int taylor_order(double tolerance, double order_cost = 0, double product_cost = 1, int most = most_order) {
    const double digits = -std::log(taylor_share * tolerance);
    int best = std::clamp(static_cast<int>(std::ceil(1 - std::log(tolerance) / 2)), 4, most);
    const auto of_step = [&](int p) { return 1 + order_cost * p + product_cost * p * p; };
    const auto falls = [&](int p) { return of_step(p + 1) * std::exp(-digits / (p * (p + 1))) < of_step(p); };
    for (int end = most; best < end;) {
        const int middle = (best + end) / 2;
        if (falls(middle))
            best = middle + 1;
        else
            end = middle;
    }
    return best;
}

/// The effort of a step of this order in ns (cost_model.hpp), fitted to 77 systems of 2 to 36 components in
/// memory, from which it differs by 9 % (root mean square).
inline double taylor_effort(double order_cost, double product_cost, int order, int components) {
    constexpr double each_step = 165, each_component = 6.5, each_order = 45, each_product = 103;
    return each_step + each_component * components + each_order * order_cost * order +
           each_product * product_cost * order * order;
}

/// By what a step is shortened whose last term is `ratio` times what is allowed, or whose end was not foreseen.
inline double shorter_taylor_step(int order, double ratio) {
    return std::isfinite(ratio) ? std::min(0.8, 0.9 * std::pow(ratio, -1.0 / order)) : 0.5;
}

class Taylor {
public:
    static constexpr bool has_fixed_step = false;
    static constexpr int estimate_order = 8;  // never used, because the step length comes from the series
    static constexpr Between between = Between::own;

    Taylor(const Ends& ends, double tolerance)
        : allowed_(tolerance),
          most_missed_(terms_left_out * tolerance),
          order_(
              taylor_order(tolerance, ends.rhs.series.module->order_cost, ends.rhs.series.module->product_cost)),
          lengths_(order_, std::log(taylor_share * tolerance)),
          size_(ends.y.size()),
          coefficients_(static_cast<std::size_t>(order_ + 1) * size_ + room_behind_rows),
          next_(coefficients_.size()),
          slopes_(size_),
          shrink_(static_cast<std::size_t>(ends.controlled)),
          work_(static_cast<std::size_t>(ends.rhs.series.workspace) + 8) {
        effort_ = ends.rhs.slowness.series * taylor_effort(ends.rhs.series.module->order_cost,
                                                           ends.rhs.series.module->product_cost, order_,
                                                           static_cast<int>(size_));
        void* start = work_.data();
        std::size_t room = work_.size() * sizeof(double);
        aligned_ = static_cast<double*>(std::align(64, room - 64, start, room));
    }

    int most_evaluations() const { return 1; }
    /// The value of −hλ up to which the polynomial of this order is smaller than 1 (to 2 %, for orders from 4 to
    /// 30).
    double stable_interval() const { return 1.3 + 0.37 * order_; }

    /// Of one series with its step (cost_model.hpp).
    double effort() const { return effort_; }

    bool increment(Ends& ends, double h, double* change, double*) {
        if (!expanded_) expand(ends, ends.t, ends.y, coefficients_, order_);
        expanded_ = true;
        sum_series(coefficients_.data(), order_, static_cast<int>(size_), h, change, slopes_.data());
        const double power = whole_power(h, order_);
        for (std::size_t i = 0; i < size_; ++i) ends.error[i] = row(order_)[i] * power;
        return true;
    }

    /// Computes the series at the end of the step, whose second coefficient is the rate there. No step follows the
    /// end of the run, which needs no more than that.
    void evaluate_end(Ends& ends) {
        expand(ends, ends.end, ends.next, next_, ends.end == ends.end_of_run ? 1 : order_);
        std::copy_n(next_.data() + size_, size_, ends.end_rate.data());
    }

    /// Whether the rate at the end is that of the polynomial. Times the length of the step, the terms left out
    /// change it by about p a tolerances, and what moves the end onto constraints by hL, at most
    /// stable_interval(): together by less than terms_left_out tolerances. Rounding changes it by a small part of
    /// itself.
    bool foresees_end(Ends& ends) {
        if (ends.h < shortest_tried * std::max(1.0, std::abs(ends.t))) return true;  // a jump
        const int places = places_within(ends.h, ends.length_of_run);
        return foresees(ends, 1, ends.end_rate) &&
               (places <= 1 || decays(ends) || is_steady(ends) || foresees_within(ends, places));
    }

    void advance(const Ends&) { std::swap(coefficients_, next_); }

    /// The state of the ends is another one now.
    void forget() { expanded_ = false; }

    double first_length(Ends& ends) {
        if (!expanded_) expand(ends, ends.t, ends.y, coefficients_, order_);
        expanded_ = true;
        return length(ends);
    }

    double next_length(Ends& ends, bool accepted, double ratio) {
        return accepted ? length(ends) : ends.h * shorter_taylor_step(order_, ratio);
    }

    void interpolate(const Ends& ends, double theta, double* out) const {
        sum_series(coefficients_.data(), order_, static_cast<int>(size_), theta * ends.h, out, nullptr);
        for (std::size_t i = 0; i < size_; ++i) out[i] = ends.y[i] + (out[i] + ends.rest[i]);
    }

private:
    const double* row(int k) const { return coefficients_.data() + static_cast<std::size_t>(k) * size_; }

    void expand(Ends& ends, double t, const std::vector<double>& y, std::vector<double>& out, int order) {
        ends.rhs.series(t, y.data(), order, out.data(), aligned_);
        ++ends.evaluations;
    }

    /// Compares `rate` at the part theta of the step with the slopes of the polynomial there.
    bool foresees(const Ends& ends, double theta, const std::vector<double>& rate) const {
        constexpr double rounded = 1e-8;
        const double of_whole = 1 / theta;
        const auto miss = [&](std::size_t i) { return std::abs(slopes_[i] * of_whole - ends.h * rate[i]); };
        const auto count = static_cast<std::size_t>(ends.controlled);
        double largest = 0;
        for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, miss(i));
        if (largest <= most_missed_) return true;
        for (std::size_t i = 0; i < count; ++i)
            if (miss(i) > most_missed_ * ends.scale(static_cast<int>(i)) &&
                miss(i) > rounded * ends.h * std::max(std::abs(ends.rate[i]), std::abs(rate[i])))
                return false;
        return true;
    }

    /// Whether the series tells how far it holds; a step that was cut short has smaller terms than it might have.
    bool decays(const Ends& ends) {
        const double longest = length(ends);
        const auto most = [this](int first, int end, double ratio) { return most_of(first, end, ratio); };
        return lengths_.decays(ends.h, most) || lengths_.decays(longest, most);
    }

    bool is_steady(const Ends& ends) const {
        return alembert::is_steady(ends.rhs, ends.y.data(), allowed_, [&](int i) {
            double change = 0, power = ends.h;
            for (int k = 1; k <= order_; ++k, power *= ends.h) change += std::abs(row(k)[i]) * power;
            return change;
        });
    }

    bool foresees_within(Ends& ends, int places) {
        std::vector<double> state(size_), rate(size_);
        for (int place = 1; place < places; ++place) {
            const double theta = static_cast<double>(place) / places;
            sum_series(coefficients_.data(), order_, static_cast<int>(size_), theta * ends.h, state.data(),
                       slopes_.data());
            for (std::size_t i = 0; i < size_; ++i) state[i] = ends.y[i] + (state[i] + ends.rest[i]);
            ends.evaluate(ends.t + theta * ends.h, state.data(), rate.data());
            if (!foresees(ends, theta, rate)) return false;
        }
        return true;
    }

    double length(const Ends& ends) {
        for (std::size_t i = 0; i < shrink_.size(); ++i) shrink_[i] = 1 / std::max(1.0, std::abs(ends.y[i]));
        return lengths_([this](int k) { return norm(k); },
                        [this](int first, int end, double ratio) { return most_of(first, end, ratio); });
    }

    /// The largest of |c_k| / max(1, |y|), y being that of the last call of `length`; infinite if one is not
    /// finite.
    double norm(int k) const {
        double largest = 0, zero = 0;
        for (std::size_t i = 0; i < shrink_.size(); ++i) {
            largest = std::max(largest, std::abs(row(k)[i]) * shrink_[i]);
            zero += row(k)[i] * 0;
        }
        return zero == 0 ? largest : HUGE_VAL;
    }

    /// The largest of norm(k) ratio^k, first ≤ k < end: component by component, each with its own maximum, because
    /// these do not wait for each other.
    double most_of(int first, int end, double ratio) const {
        double power[SeriesLength::most_terms] = {whole_power(ratio, first)}, most = 0;
        for (int k = 1; k < end - first; ++k) power[k] = power[k - 1] * ratio;
        for (std::size_t i = 0; i < shrink_.size(); ++i) {
            double largest = 0;
            for (int k = first; k < end; ++k) largest = std::max(largest, std::abs(row(k)[i]) * power[k - first]);
            most = std::max(most, largest * shrink_[i]);
        }
        return most;
    }

    double allowed_, most_missed_, effort_ = 0;
    int order_;
    SeriesLength lengths_;
    std::size_t size_;
    std::vector<double> coefficients_, next_;
    std::vector<double> slopes_;  ///< of the polynomial at the end of the step, times its length
    std::vector<double> shrink_;  ///< 1 / max(1, |y|), for norms
    std::vector<double> work_;
    double* aligned_ = nullptr;
    bool expanded_ = false;  ///< whether the series at the start of the run has been computed
};

}  // namespace alembert
