// SPDX-License-Identifier: MIT
#pragma once

/// A system with held signs (filippov_system.hpp) at one state, for given sides of its functions.
///
///     SlidingField at(system, {{1, 0}}, dimension);   // the first is positive, the second slides along its zero
///     at.evaluate(t, y);
///     at.sigma()[1];                                  // α, for which ġ = 0, or g̈ = 0 for functions of positions
///     at.rate();                                      // f

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "alembert/hybrid/filippov_system.hpp"

namespace alembert {

/// f and σ for given sides. The σ of functions that slide follow from ġ = 0.
class SlidingField {
public:
    SlidingField(const FilippovSystem& system, FilippovMode sides, int dimension)
        : system_(system),
          sides_(std::move(sides)),
          sigma_(system.sigma(sides_)),
          f_(dimension),
          g_(system.numbers()),
          bounds_(2 * system.count(), 1.0) {
        for (int k = 0; k < system.count(); ++k)
            if (sides_.slides_at_zero(k)) sliding_.push_back(k);
    }

    int count() const { return system_.count(); }
    bool has_bounds() const { return static_cast<bool>(system_.bounds); }
    const FilippovMode& sides() const { return sides_; }
    const std::vector<int>& sliding() const { return sliding_; }
    const std::vector<double>& sigma() const { return sigma_; }
    /// σ of the function k.
    double sign(int k) const { return sigma_[system_.place(k)]; }
    /// |σ| of the function k, and |α| of a pair.
    double share(int k) const { return sides_.is_pair(k) ? std::hypot(sign(k), sign(k + 1)) : std::abs(sign(k)); }
    double value(int k) const { return g_[k]; }
    double slope(int k) const { return g_[system_.count() + k]; }
    /// The rate that σ changes: ġ, or g̈ of a function of positions.
    double push(int k) const { return system_.is_positional(k) ? g_[2 * system_.count() + k] : slope(k); }
    /// v of a pair, and v'.
    Eigen::Vector2d velocity(int k) const { return {value(k), value(k + 1)}; }
    Eigen::Vector2d acceleration(int k) const { return {slope(k), slope(k + 1)}; }
    /// How far the direction of a pair is from turning by 60°: w·e − |w|/2.
    double ahead(int k) const {
        const FilippovMode::Slide& slide = sides_.slides[static_cast<std::size_t>(k / 2)];
        const Eigen::Vector2d e(slide.along, slide.across), w = velocity(k) + slide.smoothing * e;
        return w.dot(e) - w.norm() / 2;
    }
    const std::vector<double>& rate() const { return f_; }
    /// The bound of |α_k|, and the numbers that must not be negative; both are known after `find_bounds`.
    double bound(int k) const { return bounds_[k]; }
    double normal(int k) const { return bounds_[system_.count() + k]; }
    /// The slope of `push` over σ_k at the last evaluation, for a function that slides.
    double steepness(std::size_t position) const {
        return B_(static_cast<Eigen::Index>(position), static_cast<Eigen::Index>(position));
    }
    /// Whether a force against v reduces it, whatever its direction, for a pair that sticks.
    bool resists(int k) const {
        const auto at = std::find(sliding_.begin(), sliding_.end(), k) - sliding_.begin();
        const Eigen::Matrix2d all = B_.block<2, 2>(at, at), even = all + all.transpose();
        return even.trace() < 0 && even.determinant() > 0;
    }

    /// Computes f, g and its rates at a state, and the σ of functions that slide; NaN where no σ keeps them at
    /// their zeros.
    void evaluate(double t, const double* y);

    /// To be called after `evaluate` at the same state. Where pairs stick and the motion does not determine their
    /// σ, the even ones are taken (minimax_reactions.hpp), with which the motion is the same.
    void find_bounds(double t, const double* y);
    /// Whether `find_bounds` has chosen among several σ.
    bool shares_are_free() const { return shares_are_free_; }

    /// Moves the state to where the g of sliding functions are zero, along the directions in which their σ change
    /// the motion; where they depend on positions alone, so that ġ becomes zero, and g by `bring_to_zero`.
    void bring_back(double t, double* y);
    /// Moves the state to g = 0 along the gradient of g, which is found by differences.
    void bring_to_zero(int k, double t, double* y);

private:
    /// The zero of a rate (a + b α)/(1 + c α) and the slope there, with a, b and c such that it has the values
    /// found at −1, 0 and 1. Friction that changes its own normal force has this form.
    struct Quotient {
        double zero, slope;
    };
    Quotient by_quotient(double t, const double* y, double at_none, double at_one);

    /// σ of the function at this position of `sliding`.
    double& held(Eigen::Index position) { return sigma_[system_.place(sliding_[position])]; }
    void rates(double t, const double* y) {
        system_.rates(t, y, sigma_.data(), f_.data());
        system_.values(t, y, sigma_.data(), f_.data(), g_.data());
    }
    Eigen::VectorXd pushes() const {
        Eigen::VectorXd result(static_cast<Eigen::Index>(sliding_.size()));
        for (Eigen::Index j = 0; j < result.size(); ++j) result[j] = push(sliding_[j]);
        return result;
    }

    const FilippovSystem& system_;
    FilippovMode sides_;
    std::vector<int> sliding_;
    std::vector<double> sigma_, f_, g_, bounds_;
    Eigen::MatrixXd B_;
    bool shares_are_free_ = false;
};

}  // namespace alembert
