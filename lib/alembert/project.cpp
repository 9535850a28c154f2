// SPDX-License-Identifier: MIT
#include "alembert/project.hpp"

#include <cmath>

namespace alembert {

namespace {

constexpr int most_rounds = 8;  // Newton's method from the end of an accepted step needs one or two

}  // namespace

Projection::Projection(const Module& module, const std::vector<double>& values)
    : module_(module),
      par_(prepared(module, values)),
      n_(module.table().coordinates),
      s_(module.table().speeds),
      m_(module.table().constraints),
      position_(m_),
      velocity_(m_),
      forcing_(s_),
      mass_(s_, s_),
      rows_(static_cast<std::size_t>(m_) * static_cast<std::size_t>(n_ + s_)) {}

void Projection::evaluate(double t, const double* state) {
    module_.table().constraints_at(t, state, par_.data(), position_.data(), velocity_.data(), rows_.data());
    module_.table().mass_forcing(t, state, par_.data(), mass_.data(), forcing_.data());
}

/// M⁻¹Aᵀ (A M⁻¹Aᵀ)⁺ misfit
Eigen::VectorXd Projection::correction(const Rows& A, bool weighed, const Eigen::VectorXd& misfit) const {
    const Eigen::MatrixXd across = weighed ? Eigen::MatrixXd(mass_.ldlt().solve(A.transpose())) : Eigen::MatrixXd(A.transpose());
    return across * (A * across).completeOrthogonalDecomposition().solve(misfit);
}

void Projection::operator()(double t, double* state) {
    Eigen::Map<Eigen::VectorXd> q(state, n_), u(state + n_, s_);
    const bool own_speeds = module_.table().speed_names != nullptr;
    const Eigen::Map<const Rows> in_rates(rows_.data(), m_, n_), in_speeds(rows_.data() + (own_speeds ? m_ * n_ : 0), m_, s_);
    double former = HUGE_VAL;
    for (int round = 0; round < most_rounds; ++round) {
        evaluate(t, state);
        const double size = position_.lpNorm<Eigen::Infinity>();
        if (!(size > 0) || !(size < former / 2)) break;
        former = size;
        const Eigen::VectorXd change = correction(in_rates, !own_speeds, position_);
        if (!change.allFinite()) return;
        q -= change;
    }
    evaluate(t, state);
    for (int round = 0; round < 2; ++round) {  // the second takes what rounding left of the first
        const Eigen::VectorXd change = correction(in_speeds, true, velocity_);
        if (!change.allFinite()) return;
        u -= change;
        evaluate(t, state);
    }
}

double Projection::residual(double t, const double* state) {
    evaluate(t, state);
    return m_ == 0 ? 0 : std::max(position_.lpNorm<Eigen::Infinity>(), velocity_.lpNorm<Eigen::Infinity>());
}

}  // namespace alembert
