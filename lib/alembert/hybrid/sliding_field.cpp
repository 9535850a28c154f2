// SPDX-License-Identifier: MIT
#include "alembert/hybrid/sliding_field.hpp"

#include <limits>

#include "alembert/base/dense.hpp"
#include "alembert/hybrid/minimax_reactions.hpp"

namespace alembert {

namespace {

// A rate of g below this, relative to the change that its σ makes, is zero.
constexpr double negligible = 1e-9;
// Two σ between which the slope of ġ is taken: ε^(1/4), a power of two. Rounding makes ε^(3/4) of the slope,
// which is 2e-12, and a bend of ġ over the whole range of σ 1e-4; Broyden's method needs its sign and about
// its size.
constexpr double probe = 1.0 / 8192;
constexpr double dependent_pivot = 1e-10;  // its size, relative to the largest, that is zero

/// Where functions that slide depend on each other, as the velocities of two ends of one rod, their σ are not
/// unique; the least are taken.
Orthogonal with_least_sigma(const Eigen::MatrixXd& matrix) {
    return {matrix, dependent_pivot};
}

}  // namespace

void SlidingField::evaluate(double t, const double* y) {
    const auto s = static_cast<Eigen::Index>(sliding_.size());
    for (const int k : sliding_) sigma_[system_.place(k)] = 0;
    rates(t, y);
    if (s == 0) return;
    const Eigen::VectorXd none = pushes();
    B_.resize(s, s);
    for (Eigen::Index j = 0; j < s; ++j) {
        held(j) = 1;
        rates(t, y);
        B_.col(j) = pushes() - none;
        held(j) = 0;
    }
    const double enough = 1e-13 * B_.cwiseAbs().maxCoeff();
    Eigen::VectorXd alpha = Eigen::VectorXd::Zero(s), slope = none;
    const auto go_to = [&](const Eigen::VectorXd& to) {
        alpha = to;
        for (Eigen::Index j = 0; j < s; ++j) held(j) = alpha[j];
        rates(t, y);
        slope = pushes();
        return !(slope.cwiseAbs().maxCoeff() > enough);
    };
    // Where ġ bends, the slope there takes the place of that between 0 and 1, which may have the other sign.
    const auto look_around = [&] {
        for (Eigen::Index j = 0; j < s; ++j) {
            held(j) = alpha[j] + probe;
            rates(t, y);
            B_.col(j) = (pushes() - slope) / probe;
            held(j) = alpha[j];
        }
        rates(t, y);
    };
    if (go_to(-with_least_sigma(B_).solve(none))) return;
    if (s == 1) {
        const Quotient quotient = by_quotient(t, y, none[0], none[0] + B_(0, 0));
        const bool is_found = go_to(Eigen::VectorXd::Constant(1, quotient.zero));
        if (std::isfinite(quotient.slope)) B_(0, 0) = quotient.slope;
        if (is_found) return;
    } else {
        look_around();
    }
    Eigen::MatrixXd secant = B_;
    for (int round = 0; round < 20; ++round) {  // Broyden's method
        const Eigen::VectorXd step = -with_least_sigma(secant).solve(slope);
        if (go_to(alpha + step)) return look_around();
        secant += slope * step.transpose() / step.squaredNorm();
    }
    if (slope.cwiseAbs().maxCoeff() > negligible * B_.cwiseAbs().maxCoeff())  // no σ can keep g at zero
        for (Eigen::Index j = 0; j < s; ++j) held(j) = std::numeric_limits<double>::quiet_NaN();
}

SlidingField::Quotient SlidingField::by_quotient(double t, const double* y, double at_none, double at_one) {
    held(0) = -1;
    rates(t, y);
    const double at_minus = pushes()[0];
    const double c = (2 * at_none - at_one - at_minus) / (at_one - at_minus);
    const double b = at_one * (1 + c) - at_none, zero = -at_none / b, below = 1 + c * zero;
    return {.zero = zero, .slope = (b - at_none * c) / (below * below)};
}

void SlidingField::find_bounds(double t, const double* y) {
    if (!system_.bounds) return;
    system_.bounds(t, y, sigma_.data(), f_.data(), bounds_.data());
    shares_are_free_ = false;
    const auto is_pair = [&](int k) { return sides_.is_pair(k); };
    if (sliding_.size() < 3 || std::none_of(sliding_.begin(), sliding_.end(), is_pair)) return;
    const SingularValues parts = singular_values(B_.transpose());
    const auto rank = (parts.values.array() > dependent_pivot * parts.values[0]).count(), s = B_.rows();
    if (rank == s || !B_.allFinite()) return;
    shares_are_free_ = true;
    std::vector<ReactionBound> contacts;
    for (std::size_t j = 0; j < sliding_.size(); j += static_cast<std::size_t>(contacts.back().size))
        contacts.push_back({static_cast<Eigen::Index>(j), is_pair(sliding_[j]) ? 2 : 1, bound(sliding_[j])});
    Eigen::VectorXd alpha(s);
    for (Eigen::Index j = 0; j < s; ++j) alpha[j] = held(j);
    alpha = minimax_reactions(alpha, parts.left.rightCols(s - rank), contacts);
    for (Eigen::Index j = 0; j < s; ++j) held(j) = alpha[j];
}

void SlidingField::bring_back(double t, double* y) {
    const auto s = static_cast<Eigen::Index>(sliding_.size());
    for (const int k : sliding_)
        if (system_.is_positional(k)) bring_to_zero(k, t, y);
    evaluate(t, y);
    Eigen::VectorXd off(s);
    for (Eigen::Index j = 0; j < s; ++j)
        off[j] = system_.is_positional(sliding_[j]) ? slope(sliding_[j]) : value(sliding_[j]);
    if (off.isZero(0)) return;
    const Eigen::VectorXd along = -with_least_sigma(B_).solve(off);
    const std::vector<double> alpha = sigma_, before = f_;
    for (Eigen::Index j = 0; j < s; ++j) held(j) += along[j];
    rates(t, y);
    for (std::size_t i = 0; i < f_.size(); ++i) y[i] += f_[i] - before[i];
    sigma_ = alpha;
}

void SlidingField::bring_to_zero(int k, double t, double* y) {
    const auto at = [&] {
        system_.values(t, y, sigma_.data(), f_.data(), g_.data());
        return value(k);
    };
    const double g = at();
    if (g == 0) return;
    std::vector<double> gradient(f_.size());
    double square = 0;
    for (std::size_t i = 0; i < gradient.size(); ++i) {
        const double kept = y[i], step = 1e-7 * std::max(1.0, std::abs(kept));
        y[i] += step;
        gradient[i] = (at() - g) / step;
        square += gradient[i] * gradient[i];
        y[i] = kept;
    }
    if (square > 0)
        for (std::size_t i = 0; i < gradient.size(); ++i) y[i] -= g * gradient[i] / square;
}

}  // namespace alembert
