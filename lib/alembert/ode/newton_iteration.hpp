// SPDX-License-Identifier: MIT
#pragma once

/// What implicit methods share: ∂f/∂y, and the iteration x ← x + δ with a forecast of its convergence.
///
///     Jacobian jacobian(n);
///     jacobian.evaluate(ends);                  // at the start of the step
///     NewtonIteration iteration(tolerance);
///     for (...) if (iteration.after(ends.norm(delta)) != NewtonIteration::more) break;
///
/// ∂f/∂y is the right-hand side's own where it has one (Rhs::jacobian; it counts as one evaluation) and is finite,
/// else by differences, n evaluations: a part of a derivative may overflow where the function does not, as those
/// of 1/(1 + exp(x)). The differences are taken over √ε max(|y_i|, |h f_i|, 1e-3). They have half the digits,
/// which costs the simplified Newton method some speed of convergence but no accuracy. The forecast is that of
/// Hairer & Wanner, Solving Ordinary Differential Equations II, 2nd ed. 1996, §IV.8: if Θ is the ratio of two
/// successive changes, the error that remains is Θ/(1−Θ) of the last change.

#include <Eigen/Dense>

#include "alembert/ode/formula_stepper.hpp"

namespace alembert {

struct Jacobian {
    explicit Jacobian(int size) : values(size, size), moved(static_cast<std::size_t>(size)), rate(moved.size()) {}

    void evaluate(Ends& ends) {
        if (ends.rhs.jacobian != nullptr) {
            ends.rhs.jacobian(ends.rhs.context.get(), ends.t, ends.y.data(), values.data());
            ++ends.evaluations;
            if (values.allFinite()) return;
        }
        constexpr double root_epsilon = 1.4901161193847656e-8;
        moved = ends.y;
        for (std::size_t j = 0; j < moved.size(); ++j) {
            const double size = std::max({std::abs(moved[j]), std::abs(ends.h * ends.rate[j]), 1e-3});
            const double was = moved[j];
            moved[j] += std::copysign(root_epsilon * size, ends.rate[j]);
            const double difference = moved[j] - was;
            ends.evaluate(ends.t, moved.data(), rate.data());
            for (std::size_t i = 0; i < rate.size(); ++i)
                values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                    (rate[i] - ends.rate[i]) / difference;
            moved[j] = was;
        }
    }

    Eigen::MatrixXd values;
    std::vector<double> moved, rate;
};

/// Decides from the sizes of the changes whether an iteration has ended.
class NewtonIteration {
public:
    enum Verdict { more, done, hopeless };

    /// `rounding`: if `enough` is not many times larger, neither are changes that may be rounding.
    NewtonIteration(double enough, int most, double rounding = 0)
        : enough_(enough), rounding_(rounding), most_(most) {}

    Verdict after(double change) {
        ++round_;
        if (!(change < HUGE_VAL)) return hopeless;
        if (change == 0) return done;
        if (round_ > 1) {
            ratio_ = change / before_;
            const bool is_rounding = std::max(change, enough_) <= several * rounding_;
            if (!is_rounding) known_ratio_ = ratio_;
            if (is_rounding && ratio_ > 0.5) return done;  // it does not become more exact
            if (ratio_ >= 1) return change <= enough_ ? done : hopeless;
            const double left = ratio_ / (1 - ratio_) * change;
            if (left <= enough_) return done;
            if (left * std::pow(ratio_, most_ - round_ - 1) > enough_) return hopeless;
        }
        before_ = change;
        return round_ < most_ ? more : hopeless;
    }

    /// The last Θ of changes that are more than rounding; 0 if there were not two of these.
    double ratio() const { return known_ratio_; }
    int rounds() const { return round_; }

private:
    static constexpr double several = 10;
    double enough_, rounding_;
    int most_;
    int round_ = 0;
    double before_ = 0, ratio_ = 0, known_ratio_ = 0;
};

}  // namespace alembert
