// SPDX-License-Identifier: MIT
#pragma once

/// A system with held signs (switching.hpp) at one state, for given sides of its functions.
///
///     SwitchSides at(system, {{1, 0}}, dimension);    // the first is positive, the second slides along its zero
///     at.evaluate(t, y);
///     at.sigma()[1];                                  // α, for which ġ = 0
///     at.rate();                                      // f

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "alembert/dense.hpp"
#include "alembert/even_shares.hpp"
#include "alembert/switching.hpp"

namespace alembert {

/// f and σ for given sides. The σ of functions that slide follow from ġ = 0.
class SwitchSides {
public:
    SwitchSides(const Switching& system, SideSet sides, int dimension)
        : system_(system),
          sides_(std::move(sides)),
          sigma_(system.sigma(sides_)),
          f_(dimension),
          g_(2 * system.count()),
          bounds_(2 * system.count(), 1.0) {
        for (int k = 0; k < system.count(); ++k)
            if (sides_[k] == 0) sliding_.push_back(k);
    }

    int count() const { return system_.count(); }
    bool has_bounds() const { return static_cast<bool>(system_.bounds); }
    const SideSet& sides() const { return sides_; }
    const std::vector<int>& sliding() const { return sliding_; }
    const std::vector<double>& sigma() const { return sigma_; }
    /// σ of the function k.
    double sign(int k) const { return sigma_[system_.place(k)]; }
    /// |σ| of the function k, and |α| of a pair.
    double share(int k) const { return sides_.is_pair(k) ? std::hypot(sign(k), sign(k + 1)) : std::abs(sign(k)); }
    double value(int k) const { return g_[k]; }
    double slope(int k) const { return g_[system_.count() + k]; }
    /// v of a pair, and v'.
    Eigen::Vector2d velocity(int k) const { return {value(k), value(k + 1)}; }
    Eigen::Vector2d acceleration(int k) const { return {slope(k), slope(k + 1)}; }
    /// How far the direction of a pair is from turning by 60°: w·e − |w|/2.
    double ahead(int k) const {
        const SideSet::Slide& slide = sides_.slides[static_cast<std::size_t>(k / 2)];
        const Eigen::Vector2d e(slide.along, slide.across), w = velocity(k) + slide.grain * e;
        return w.dot(e) - w.norm() / 2;
    }
    const std::vector<double>& rate() const { return f_; }
    /// The bound of |α_k|, and the numbers that must not be negative; both are known after `find_bounds`.
    double bound(int k) const { return bounds_[k]; }
    double normal(int k) const { return bounds_[system_.count() + k]; }
    /// ∂ġ_k/∂σ_k at the last evaluation, for a function that slides.
    double steepness(std::size_t position) const {
        return B_(static_cast<Eigen::Index>(position), static_cast<Eigen::Index>(position));
    }
    /// Whether a force against v reduces it, whatever its direction, for a pair that sticks.
    bool resists(int k) const {
        const auto at = std::find(sliding_.begin(), sliding_.end(), k) - sliding_.begin();
        const Eigen::Matrix2d all = B_.block<2, 2>(at, at), even = all + all.transpose();
        return even.trace() < 0 && even.determinant() > 0;
    }

    /// Computes f, g and ġ at a state, and the σ of functions that slide; NaN where no σ keeps ġ = 0.
    void evaluate(double t, const double* y) {
        const auto s = static_cast<Eigen::Index>(sliding_.size());
        for (const int k : sliding_) sigma_[system_.place(k)] = 0;
        rates(t, y);
        if (s == 0) return;
        const Eigen::VectorXd none = slopes();
        B_.resize(s, s);
        for (Eigen::Index j = 0; j < s; ++j) {
            held(j) = 1;
            rates(t, y);
            B_.col(j) = slopes() - none;
            held(j) = 0;
        }
        const double enough = 1e-13 * B_.cwiseAbs().maxCoeff();
        Eigen::VectorXd alpha = Eigen::VectorXd::Zero(s), slope = none;
        const auto go_to = [&](const Eigen::VectorXd& to) {
            alpha = to;
            for (Eigen::Index j = 0; j < s; ++j) held(j) = alpha[j];
            rates(t, y);
            slope = slopes();
            return !(slope.cwiseAbs().maxCoeff() > enough);
        };
        // Where ġ bends, the slope there takes the place of that between 0 and 1, which may have the other sign.
        const auto look_around = [&] {
            for (Eigen::Index j = 0; j < s; ++j) {
                held(j) = alpha[j] + apart;
                rates(t, y);
                B_.col(j) = (slopes() - slope) / apart;
                held(j) = alpha[j];
            }
            rates(t, y);
        };
        if (go_to(-decomposed(B_).solve(none))) return;
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
            const Eigen::VectorXd step = -decomposed(secant).solve(slope);
            if (go_to(alpha + step)) return look_around();
            secant += slope * step.transpose() / step.squaredNorm();
        }
        if (slope.cwiseAbs().maxCoeff() > negligible * B_.cwiseAbs().maxCoeff())  // no σ can keep g at zero
            for (Eigen::Index j = 0; j < s; ++j) held(j) = std::numeric_limits<double>::quiet_NaN();
    }

    /// To be called after `evaluate` at the same state. Where pairs stick and the motion does not determine their
    /// σ, the even ones are taken (even_shares.hpp), with which the motion is the same.
    void find_bounds(double t, const double* y) {
        if (!system_.bounds) return;
        system_.bounds(t, y, sigma_.data(), f_.data(), bounds_.data());
        shares_are_free_ = false;
        const auto is_pair = [&](int k) { return sides_.is_pair(k); };
        if (sliding_.size() < 3 || std::none_of(sliding_.begin(), sliding_.end(), is_pair)) return;
        const SingularValues parts = singular_values(B_.transpose());
        const auto rank = (parts.values.array() > dependent * parts.values[0]).count(), s = B_.rows();
        if (rank == s || !B_.allFinite()) return;
        shares_are_free_ = true;
        std::vector<ShareOfContact> contacts;
        for (std::size_t j = 0; j < sliding_.size(); j += static_cast<std::size_t>(contacts.back().size))
            contacts.push_back({static_cast<Eigen::Index>(j), is_pair(sliding_[j]) ? 2 : 1, bound(sliding_[j])});
        Eigen::VectorXd alpha(s);
        for (Eigen::Index j = 0; j < s; ++j) alpha[j] = held(j);
        alpha = even_shares(alpha, parts.left.rightCols(s - rank), contacts);
        for (Eigen::Index j = 0; j < s; ++j) held(j) = alpha[j];
    }
    /// Whether `find_bounds` has chosen among several σ.
    bool shares_are_free() const { return shares_are_free_; }

    /// Moves the state to where the g of sliding functions are zero, along the directions in which their σ change
    /// the motion.
    void bring_back(double t, double* y) {
        const auto s = static_cast<Eigen::Index>(sliding_.size());
        evaluate(t, y);
        Eigen::VectorXd off(s);
        for (Eigen::Index j = 0; j < s; ++j) off[j] = g_[sliding_[j]];
        if (off.isZero(0)) return;
        const Eigen::VectorXd along = -decomposed(B_).solve(off);
        const std::vector<double> alpha = sigma_, before = f_;
        for (Eigen::Index j = 0; j < s; ++j) held(j) += along[j];
        rates(t, y);
        for (std::size_t i = 0; i < f_.size(); ++i) y[i] += f_[i] - before[i];
        sigma_ = alpha;
    }

private:
    // A rate of g below this, relative to the change that its σ makes, is zero.
    static constexpr double negligible = 1e-9;
    // Two σ between which the slope of ġ is taken: ε^(1/4), a power of two. Rounding makes ε^(3/4) of the slope,
    // which is 2e-12, and a bend of ġ over the whole range of σ 1e-4; Broyden's method needs its sign and about
    // its size.
    static constexpr double apart = 1.0 / 8192;
    static constexpr double dependent = 1e-10;  // the size of a pivot, relative to the largest, that is zero

    /// Where functions that slide depend on each other, as the velocities of two ends of one rod, their σ are not
    /// unique; the least are taken.
    static Orthogonal decomposed(const Eigen::MatrixXd& matrix) { return {matrix, dependent}; }

    /// The zero of ġ(α) = (a + b α)/(1 + c α) and the slope there, with a, b and c such that it has the values
    /// found at −1, 0 and 1. Friction that changes its own normal force has this form.
    struct Quotient {
        double zero, slope;
    };
    Quotient by_quotient(double t, const double* y, double at_none, double at_one) {
        held(0) = -1;
        rates(t, y);
        const double at_minus = slopes()[0];
        const double c = (2 * at_none - at_one - at_minus) / (at_one - at_minus);
        const double b = at_one * (1 + c) - at_none, zero = -at_none / b, below = 1 + c * zero;
        return {.zero = zero, .slope = (b - at_none * c) / (below * below)};
    }

    /// σ of the function at this position of `sliding`.
    double& held(Eigen::Index position) { return sigma_[system_.place(sliding_[position])]; }
    void rates(double t, const double* y) {
        system_.rates(t, y, sigma_.data(), f_.data());
        system_.values(t, y, sigma_.data(), f_.data(), g_.data());
    }
    Eigen::VectorXd slopes() const {
        Eigen::VectorXd result(static_cast<Eigen::Index>(sliding_.size()));
        for (Eigen::Index j = 0; j < result.size(); ++j) result[j] = slope(sliding_[j]);
        return result;
    }

    const Switching& system_;
    SideSet sides_;
    std::vector<int> sliding_;
    std::vector<double> sigma_, f_, g_, bounds_;
    Eigen::MatrixXd B_;
    bool shares_are_free_ = false;
};

}  // namespace alembert
