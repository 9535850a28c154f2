// SPDX-License-Identifier: MIT
// The impact is a motion with the normal impulse for its time, in which friction sticks and slides as always.
#include <cmath>

#include "alembert/hybrid/filippov_system.hpp"
#include "alembert/hybrid/routh_impact.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double longest = 1e6;  // the longest compression, relative to that without friction

class PlaneStriking {
public:
    PlaneStriking(const MatrixXd& mass, const VectorXd& before, const MatrixXd& bilateral,
                  const RoughContact& contact)
        : contact_(contact), n_(before.size()), unit_(before.cwiseAbs().maxCoeff()) {
        tangent_.resize(2, n_);
        tangent_ << contact.tangent, contact.across;
        tangent_offset_ = Vector2d(contact.tangent_offset, contact.across_offset) / unit_;
        gap_offset_ = contact.normal_offset / unit_;
        by_normal_ = response_to(mass, bilateral, contact.normal.transpose());
        by_tangent_.resize(n_, 2);
        for (Index i = 0; i < 2; ++i)
            by_tangent_.col(i) = response_to(mass, bilateral, tangent_.row(i).transpose());
        state_.assign(static_cast<std::size_t>(n_ + quantities), 0);
        for (Index i = 0; i < n_; ++i) state_[static_cast<std::size_t>(i)] = before[i] / unit_;
    }

    RouthImpact go(double restitution) {
        RouthImpact hit;
        const double free = contact_.normal.dot(by_normal_);
        const Events compressed =
            make_events({{.name = "compressed", .stop = true, .at_once = true, .direction = 1}},
                        [this](double, const double* y, const double*, double* g) { g[0] = gap(y); });
        const double all = follow(longest * -gap(state_.data()) / free, compressed);
        if (!(all > 0)) {
            hit.failure = "friction makes the contact force grow without bound during the impact";
            return hit;
        }
        if (restitution > 0) follow(restitution * all, {});
        hit.after.resize(n_);
        for (Index i = 0; i < n_; ++i) hit.after[i] = unit_ * state_[static_cast<std::size_t>(i)];
        const double* const sums = state_.data() + n_;
        hit.impulse = unit_ * (1 + restitution) * all;
        hit.tangential = unit_ * sums[0];
        hit.across = unit_ * sums[1];
        hit.work = unit_ * unit_ * sums[2];
        hit.loss = unit_ * unit_ * sums[3];
        hit.slides = slides_;
        return hit;
    }

private:
    static constexpr Index quantities = 4;  // both components of ∫ τ dπ, the work and the loss

    double gap(const double* y) const {
        return contact_.normal.dot(Eigen::Map<const VectorXd>(y, n_)) + gap_offset_;
    }
    Vector2d sliding_velocity(const double* y) const {
        return tangent_ * Eigen::Map<const VectorXd>(y, n_) + tangent_offset_;
    }

    /// The direction of the sliding velocity as FilippovSystem describes it.
    static Vector2d direction(const Vector2d& v, const double* sigma) {
        const Vector2d p(sigma[2], sigma[3]), aside(-p[1], p[0]);
        if (sigma[0] == 0) return p;
        const Vector2d w = v + sigma[1] * p;
        const double turn = w.dot(aside) / w.dot(p);
        return (p + turn * aside) / std::sqrt(1 + turn * turn);
    }

    void rates(const double* y, const double* sigma, double* rate) const {
        const Vector2d v = sliding_velocity(y), tau = -contact_.coefficient * direction(v, sigma);
        Eigen::Map<VectorXd>(rate, n_) = by_normal_ + by_tangent_ * tau;
        double* const sums = rate + n_;
        sums[0] = tau[0];
        sums[1] = tau[1];
        sums[2] = gap(y) - gap_offset_ + tau.dot(v - tangent_offset_);
        sums[3] = -(gap(y) + tau.dot(v));
    }

    FilippovSystem as_motion() {
        FilippovSystem made;
        made.names = {"first", "second"};
        made.pairs = 1;
        made.speed = 1;  // in units of the largest rate
        made.rates = [this](double, const double* y, const double* sigma, double* rate) { rates(y, sigma, rate); };
        made.smooth = [this](const std::vector<double>& sigma) {
            return make_rhs(static_cast<int>(state_.size()), [this, sigma](double, const double* y, double* rate) {
                rates(y, sigma.data(), rate);
            });
        };
        made.values = [this](double, const double* y, const double*, const double* rate, double* out) {
            const Vector2d v = sliding_velocity(y), change = tangent_ * Eigen::Map<const VectorXd>(rate, n_);
            std::copy_n(v.data(), 2, out);
            std::copy_n(change.data(), 2, out + 2);
        };
        made.bounds = [r = contact_.resting / contact_.coefficient](double, const double*, const double*,
                                                                    const double*, double* out) {
            out[0] = r;
            out[1] = out[2] = out[3] = 1;
        };
        made.on_change = [this](const ModeChange& change) { slides_ = change.side != 0; };
        return made;
    }

    /// Goes on for this impulse at most, and returns the one at the end; 0 where there is none, or the event has
    /// not come.
    double follow(double impulse, const Events& until) {
        const Trajectory motion = integrate(
            as_motion(), state_,
            {.method = Method::verner98, .duration = impulse, .tolerance = 1e-13, .sample = impulse}, until);
        const bool has_come =
            until.list.empty() ? motion.ending == Ending::completed : motion.ending == Ending::stopped_by_event;
        const auto last = motion.final_state();
        state_.assign(last.begin(), last.end());
        return has_come ? motion.times.back() : 0;
    }

    const RoughContact& contact_;
    Index n_;
    double unit_;
    Eigen::Matrix<double, 2, Eigen::Dynamic> tangent_;
    Vector2d tangent_offset_;
    double gap_offset_ = 0;
    VectorXd by_normal_;
    Eigen::Matrix<double, Eigen::Dynamic, 2> by_tangent_;
    std::vector<double> state_;
    bool slides_ = true;
};

}  // namespace

RouthImpact strike_in_plane(const MatrixXd& mass, const VectorXd& before, const MatrixXd& bilateral_rows,
                            const RoughContact& contact, double restitution) {
    if (contact.coefficient > 0) return PlaneStriking(mass, before, bilateral_rows, contact).go(restitution);
    RoughContact smooth = contact;  // nothing acts along a sliding velocity that is always 0
    smooth.tangent.setZero();
    smooth.tangent_offset = 0;
    smooth.across.resize(0);
    smooth.grip = 0;
    RouthImpact hit = strike_rough(mass, before, bilateral_rows, smooth, restitution);
    hit.slides = true;
    return hit;
}

}  // namespace alembert
