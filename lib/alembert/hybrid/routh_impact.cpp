// SPDX-License-Identifier: MIT
#include "alembert/hybrid/routh_impact.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/dense.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_pieces = 6;        // sliding, sticking or sliding back, in compression and in restitution
constexpr int most_halvings = 60;     // until a share is known in double precision
constexpr double no_sliding = 1e-13;  // a sliding velocity below this, relative to its terms, is zero

class Striking {
public:
    Striking(const MatrixXd& mass, const VectorXd& before, const MatrixXd& rows, const RoughContact& contact)
        : contact_(contact),
          u_(before),
          by_normal_(response_to(mass, rows, contact.normal.transpose())),
          by_tangent_(response_to(mass, rows, contact.tangent.transpose())) {
        settle_sliding();
    }

    RouthImpact go(double restitution) {
        RouthImpact hit;
        const bool compressed = run_to([&](double rate) { return -gap() / rate; }, hit);
        if (!compressed || !u_.allFinite()) {
            hit.failure = "friction makes the contact force grow without bound during the impact";
            return hit;
        }
        const double all = (1 + restitution) * hit.impulse;
        run_to([&](double) { return all - hit.impulse; }, hit);
        hit.after = u_;
        hit.slides = !sticks_;
        return hit;
    }

private:
    double gap() const { return contact_.normal.dot(u_) + contact_.normal_offset; }
    double sliding_velocity() const { return contact_.tangent.dot(u_) + contact_.tangent_offset; }

    /// Decides whether the contact slides, and to which side; a velocity within rounding does not count as
    /// sliding.
    void settle_sliding() {
        const double size = contact_.tangent.cwiseAbs().dot(u_.cwiseAbs()) + std::abs(contact_.tangent_offset);
        side_ = std::abs(sliding_velocity()) <= no_sliding * size ? 0 : sliding_velocity() > 0 ? 1 : -1;
        if (side_ != 0) return;
        const double across = contact_.tangent.dot(by_normal_), along = contact_.tangent.dot(by_tangent_);
        sticks_ = std::abs(across) <= contact_.resting * along;
        if (!sticks_) side_ = across > 0 ? 1 : -1;
    }

    /// Goes on piece by piece until no impulse is left; `left` computes from the rate of the gap how much is left
    /// in a piece. False if that never happens.
    template <typename Left>
    bool run_to(const Left& left, RouthImpact& hit) {
        for (int piece = 0; piece < most_pieces; ++piece) {
            const double along = contact_.tangent.dot(by_tangent_);
            const double tau = sticks_ ? (along > 0 ? -contact_.tangent.dot(by_normal_) / along : 0)
                                       : -contact_.coefficient * side_;
            const VectorXd direction = by_normal_ + tau * by_tangent_;
            const double rate = contact_.normal.dot(direction), turning = contact_.tangent.dot(direction);
            const double needed = left(rate);
            const double until_still =
                sticks_ || !(turning * side_ < 0) ? HUGE_VAL : -sliding_velocity() / turning;
            const bool ends = needed >= 0 && needed <= until_still;
            if (!ends && !std::isfinite(until_still)) return false;
            const double step = ends ? needed : until_still;
            const double normal = gap(), sliding = sliding_velocity();
            u_ += step * direction;
            hit.impulse += step;
            hit.tangential += tau * step;
            const double mean_normal = (normal + gap()) / 2, mean_sliding = (sliding + sliding_velocity()) / 2;
            hit.work +=
                step * (mean_normal - contact_.normal_offset + tau * (mean_sliding - contact_.tangent_offset));
            hit.loss -= step * (mean_normal + tau * mean_sliding);
            if (ends) return true;
            u_ -= sliding_velocity() / along * by_tangent_;  // removes what rounding has left of it
            settle_sliding();
        }
        return false;
    }

    const RoughContact& contact_;
    VectorXd u_, by_normal_, by_tangent_;
    int side_ = 0;
    bool sticks_ = false;
};

/// The impulses that take the sliding velocity of an impact without sliding at its end to −e_t times the one
/// before.
class Gripping {
public:
    Gripping(const MatrixXd& mass, const VectorXd& before, const MatrixXd& bilateral, const RoughContact& contact,
             const RouthImpact& hit)
        : contact_(contact), hit_(hit) {
        const Index components = contact.across.size() > 0 ? 2 : 1;
        rows_.resize(1 + components, before.size());
        offset_.resize(1 + components);
        rows_.row(0) = contact.normal;
        rows_.row(1) = contact.tangent;
        offset_[0] = contact.normal_offset;
        offset_[1] = contact.tangent_offset;
        if (components == 2) {
            rows_.row(2) = contact.across;
            offset_[2] = contact.across_offset;
        }
        responses_.resize(before.size(), rows_.rows());
        for (Index i = 0; i < rows_.rows(); ++i)
            responses_.col(i) = response_to(mass, bilateral, rows_.row(i).transpose());
        VectorXd wanted = -(rows_ * hit.after + offset_) - contact.grip * (rows_ * before + offset_);
        wanted[0] = 0;
        impulses_ = least_norm(rows_ * responses_, wanted).x.col(0);
    }

    RouthImpact go() const {
        double possible = 0, beyond = 1;
        if (is_possible(1)) possible = 1;
        for (int n = 0; n < most_halvings && possible < 1; ++n) {
            const double middle = (possible + beyond) / 2;
            (is_possible(middle) ? possible : beyond) = middle;
        }
        return with(possible);
    }

private:
    RouthImpact with(double share) const {
        RouthImpact hit = hit_;
        const VectorXd x = share * impulses_;
        hit.after += responses_ * x;
        const VectorXd mean = rows_ * (hit_.after + hit.after) / 2 + offset_;
        hit.impulse += x[0];
        hit.tangential += x[1];
        if (x.size() == 3) hit.across += x[2];
        hit.work += x.dot(mean - offset_);
        hit.loss -= x.dot(mean);
        return hit;
    }

    bool is_possible(double share) const {
        const RouthImpact hit = with(share);
        return hit.impulse >= 0 && hit.loss >= -1e-12 * std::abs(hit_.loss) &&
               std::hypot(hit.tangential, hit.across) <= contact_.resting * hit.impulse;
    }

    const RoughContact& contact_;
    const RouthImpact& hit_;
    MatrixXd rows_, responses_;
    VectorXd offset_, impulses_;
};

}  // namespace

VectorXd response_to(const MatrixXd& mass, const MatrixXd& rows, const VectorXd& row) {
    const Index n = mass.rows(), m = rows.rows();
    MatrixXd K = MatrixXd::Zero(n + m, n + m);
    K.topLeftCorner(n, n) = mass;
    K.topRightCorner(n, m) = rows.transpose();
    K.bottomLeftCorner(m, n) = rows;
    VectorXd right = VectorXd::Zero(n + m);
    right.head(n) = row;
    return least_norm(K, right).x.col(0).head(n);
}

RouthImpact strike_rough(const MatrixXd& mass, const VectorXd& before, const MatrixXd& bilateral_rows,
                         const RoughContact& contact, double restitution) {
    const RouthImpact hit = contact.across.size() > 0
                                ? strike_in_plane(mass, before, bilateral_rows, contact, restitution)
                                : Striking(mass, before, bilateral_rows, contact).go(restitution);
    if (!hit || hit.slides || contact.grip == 0) return hit;
    return Gripping(mass, before, bilateral_rows, contact, hit).go();
}

}  // namespace alembert
