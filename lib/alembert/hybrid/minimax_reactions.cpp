// SPDX-License-Identifier: MIT
#include "alembert/hybrid/minimax_reactions.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/dense.hpp"

namespace alembert {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_newton_rounds = 60;
constexpr double centring = 0.1;      // each round aims at a tenth of the gap
constexpr double to_boundary = 0.99;  // of the way to where a slack or a weight would be zero
constexpr double closed_gap = 1e-15;  // between level and lower bound, relative to the level
constexpr double not_moved = 1e-12;   // of the largest element of `free`

/// One contact: its squared share |a + N z|².
struct Part {
    VectorXd a;
    MatrixXd N;
    VectorXd now(const VectorXd& z) const { return a + N * z; }
};

double longest_step(const VectorXd& x, const VectorXd& change) {
    double step = 1;
    for (Eigen::Index c = 0; c < x.size(); ++c)
        if (change[c] < 0) step = std::min(step, -to_boundary * x[c] / change[c]);
    return step;
}

/// min τ with |a_c + N_c z|² ≤ τ, by the primal-dual interior-point method (Nocedal & Wright, Numerical
/// Optimization, 2nd ed., §19.2), with slacks s and weights w of the contacts.
VectorXd least_level(const std::vector<Part>& parts, Eigen::Index free) {
    const auto m = static_cast<Eigen::Index>(parts.size());
    VectorXd z = VectorXd::Zero(free), s(m), w = VectorXd::Constant(m, 1.0 / static_cast<double>(m)), q(m);
    MatrixXd slopes(free, m);
    for (Eigen::Index c = 0; c < m; ++c) q[c] = parts[static_cast<std::size_t>(c)].a.squaredNorm();
    double level = 2 * q.maxCoeff();
    if (!(level > 0) || !std::isfinite(level)) return z;
    s = level - q.array();
    for (int round = 0; round < most_newton_rounds && s.dot(w) > closed_gap * level; ++round) {
        const double aim = centring * s.dot(w) / static_cast<double>(m);
        MatrixXd H = MatrixXd::Zero(free + 1, free + 1);
        for (Eigen::Index c = 0; c < m; ++c) {
            const Part& part = parts[static_cast<std::size_t>(c)];
            const VectorXd share = part.now(z);
            q[c] = share.squaredNorm();
            slopes.col(c) = 2 * part.N.transpose() * share;
            H.topLeftCorner(free, free) += 2 * w[c] * part.N.transpose() * part.N;
        }
        const VectorXd uneven = level - q.array() - s.array(), stiff = w.array() / s.array(),
                       push = (aim - w.array() * s.array() - w.array() * uneven.array()) / s.array();
        H.topLeftCorner(free, free) += slopes * stiff.asDiagonal() * slopes.transpose();
        H.topRightCorner(free, 1) = -slopes * stiff;
        H.bottomLeftCorner(1, free) = H.topRightCorner(free, 1).transpose();
        H(free, free) = stiff.sum();
        VectorXd right(free + 1);
        right.head(free) = -slopes * (w + push);
        right[free] = w.sum() + push.sum() - 1;
        const VectorXd step = least_norm(H, right).x;
        const VectorXd of_s = uneven.array() + step[free] - (slopes.transpose() * step.head(free)).array();
        const VectorXd of_w = push - stiff.cwiseProduct(of_s - uneven);
        if (!step.allFinite()) break;
        const double length = std::min(longest_step(s, of_s), longest_step(w, of_w));
        z += length * step.head(free);
        level += length * step[free];
        s += length * of_s;
        w += length * of_w;
    }
    return z;
}

}  // namespace

VectorXd minimax_reactions(const VectorXd& given, const MatrixXd& free,
                           const std::vector<ReactionBound>& contacts) {
    if (free.cols() == 0) return given;
    std::vector<Part> parts;
    for (const ReactionBound& contact : contacts) {
        const MatrixXd N = free.middleRows(contact.first, contact.size) / contact.bound;
        if (!(N.cwiseAbs().maxCoeff() * contact.bound > not_moved * free.cwiseAbs().maxCoeff())) continue;
        parts.push_back({given.segment(contact.first, contact.size) / contact.bound, N});
    }
    if (parts.empty()) return given;
    return given + free * least_level(parts, free.cols());
}

}  // namespace alembert
