// SPDX-License-Identifier: MIT
#pragma once

/// Gear's backward differentiation formulas of orders 1 to 5, for stiff systems.
///
///     Σ_{j=1…k} 1/j ∇^j y₁ = h f(t + h, y₁),   or with y₁ = Σ_{j≤k} ∇^j y + d and γ_j = 1 + 1/2 + … + 1/j:
///     d = h/γ_k f(t + h, y₁) − Σ_{j=1…k} γ_j/γ_k ∇^j y
///
/// solved by the simplified Newton method with ∂f/∂y from differences. The error estimate is d/(k + 1). The step
/// length is quasi-constant: after k + 1 equal steps the order among k − 1, k, k + 1 that allows the longest step
/// is taken, and the differences are stretched (differences.hpp). Dense output: the polynomial of degree k. Orders
/// 1 and 2 are A-stable; 3, 4 and 5 are stable in the sectors of 86°, 73° and 51° to either side of the negative
/// axis, so that orders 3 to 5 do not suit stiff oscillations.
///
/// The method is weak where a very stiff spring holds a coordinate (with a stiffness of 1e8 in units of mass and
/// second): a change of the step length then disturbs the rate, many changes are rejected, and steps stay about
/// ten times too short. Use radau for such systems.
///
/// Sources: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, §III.1; Shampine & Reichelt, SIAM
/// J. Sci. Comput. 18 (1997) 1-22, §2, with κ = 0; Hairer & Wanner II, §V.2, table 2.1 (the angles).

#include "alembert/base/dense.hpp"
#include "alembert/ode/differences.hpp"
#include "alembert/ode/newton_iteration.hpp"

namespace alembert {

class Bdf {
public:
    static constexpr bool has_fixed_step = false;
    static constexpr Between between = Between::own;
    static constexpr int estimate_order = 2;  // order of the error estimate in the first step

    Bdf(const Ends& ends, double tolerance)
        : n_(ends.size),
          size_(ends.y.size()),
          tolerance_(tolerance),
          enough_(std::max(1e-2 * tolerance, 4e-16)),
          jacobian_(n_),
          matrix_(n_, n_),
          side_(n_),
          solution_(n_),
          old_(size_, rows),
          new_(size_, rows),
          predicted_(size_),
          known_(size_),
          d_(size_),
          state_(size_),
          rate_(size_) {}

    int most_evaluations() const { return n_ + 2 * most_rounds; }

    bool increment(Ends& ends, double h, double* change, double*) {
        if (length_ == 0) {
            for (std::size_t i = 0; i < size_; ++i) old_.row(1)[i] = h * ends.rate[i];
        } else if (std::abs(h - length_) > 1e-11 * h) {
            old_.stretch(order_, h / length_);
            equal_steps_ = 0;
        }
        length_ = h;
        const double c = h / gamma[order_];
        for (std::size_t i = 0; i < size_; ++i) {
            predicted_[i] = known_[i] = 0;
            for (std::size_t j = order_; j >= 1; --j) {
                predicted_[i] += old_.row(j)[i];
                known_[i] += gamma[j] / gamma[order_] * old_.row(j)[i];
            }
        }
        bool solved = has_jacobian_ && solve(ends, h, c);
        if (!solved && !is_fresh_) {
            jacobian_.evaluate(ends);
            has_jacobian_ = is_fresh_ = true;
            factored_for_ = 0;
            solved = solve(ends, h, c);
        }
        for (std::size_t i = 0; i < size_; ++i) {
            change[i] = predicted_[i] + d_[i];
            ends.error[i] = d_[i] / static_cast<double>(order_ + 1);
        }
        return solved;
    }

    void finished(const Ends& ends) {
        for (std::size_t i = 0; i < size_; ++i) {
            const double d = (ends.next[i] - ends.y[i]) + (ends.next_rest[i] - ends.rest[i]) -
                             predicted_[i];  // whether or not the end was projected
            new_.row(order_ + 2)[i] = d - old_.row(order_ + 1)[i];
            new_.row(order_ + 1)[i] = d;
            for (std::size_t j = order_; j >= 1; --j) new_.row(j)[i] = old_.row(j)[i] + new_.row(j + 1)[i];
        }
    }

    void interpolate(const Ends& ends, double theta, double* out) const {
        const double s = theta - 1;
        for (std::size_t i = 0; i < size_; ++i) {
            double sum = 0;
            for (std::size_t j = order_; j >= 1; --j) {
                const double back = static_cast<double>(j);
                sum = (s + back - 1) / back * (new_.row(j)[i] + sum);
            }
            out[i] = ends.next[i] + (sum + ends.next_rest[i]);
        }
    }

    void advance(const Ends&) {
        std::swap(old_, new_);
        ++equal_steps_;
        is_fresh_ = false;
    }

    /// `ends` is already past the step, and the differences are those at its end.
    double next_length(const Ends& ends, bool accepted, double ratio) {
        const double h = ends.h;
        const auto factor = [](double of_tolerance, std::size_t order) {
            return std::pow(std::max(of_tolerance, 1e-10), -1 / static_cast<double>(order + 1));
        };
        if (!accepted) return h * (std::isfinite(ratio) ? std::clamp(0.9 * factor(ratio, order_), 0.2, 0.9) : 0.5);
        if (equal_steps_ <= static_cast<int>(order_)) return h;
        const auto of_order = [&](std::size_t k) {
            return factor(ends.norm(old_.row(k + 1)) / static_cast<double>(k + 1) / tolerance_, k);
        };
        const double same = factor(ratio, order_);
        const double lower = order_ > 1 ? of_order(order_ - 1) : 0;
        const double higher = order_ < 5 ? of_order(order_ + 1) : 0;
        const double best = std::max({same, lower, higher});
        const double wish = std::min(10.0, 0.9 * best);
        if (wish < 1.2 && wish >= 0.9) return h;
        if (best > same) order_ += best == higher ? 1 : static_cast<std::size_t>(-1);
        equal_steps_ = 0;
        return h * wish;
    }

private:
    static constexpr std::size_t rows = 8;
    static constexpr int most_rounds = 6;
    static constexpr std::array<double, 6> gamma = {0, 1, 3. / 2, 11. / 6, 25. / 12, 137. / 60};

    bool solve(Ends& ends, double h, double c) {
        if (!(std::abs(c - factored_for_) <= 1e-9 * c)) {
            matrix_.noalias() = -c * jacobian_.values;
            matrix_.diagonal().array() += 1;
            lu_.factor(matrix_);
            factored_for_ = c;
        }
        std::fill(d_.begin(), d_.end(), 0.0);
        NewtonIteration iteration(enough_, most_rounds);
        for (;;) {
            for (std::size_t i = 0; i < size_; ++i) state_[i] = ends.y[i] + (predicted_[i] + d_[i] + ends.rest[i]);
            ends.evaluate(ends.t + h, state_.data(), rate_.data());
            for (std::size_t i = 0; i < size_; ++i)
                side_[static_cast<Eigen::Index>(i)] = c * rate_[i] - known_[i] - d_[i];
            lu_.solve(side_, solution_);
            for (std::size_t i = 0; i < size_; ++i) d_[i] += solution_[static_cast<Eigen::Index>(i)];
            const auto verdict = iteration.after(ends.norm(solution_.data()));
            if (verdict != NewtonIteration::more) return verdict == NewtonIteration::done;
        }
    }

    int n_;
    std::size_t size_;
    double tolerance_, enough_;
    Jacobian jacobian_;
    Eigen::MatrixXd matrix_;
    Elimination lu_;
    Eigen::VectorXd side_, solution_;
    Differences old_, new_;  ///< of the state at the start and at the end; row 0 is not used
    std::vector<double> predicted_, known_, d_, state_, rate_;
    std::size_t order_ = 1;
    int equal_steps_ = 0;
    double length_ = 0, factored_for_ = 0;
    bool has_jacobian_ = false, is_fresh_ = false;
};

}  // namespace alembert
