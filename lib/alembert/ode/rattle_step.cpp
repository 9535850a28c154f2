// SPDX-License-Identifier: MIT
#include "alembert/ode/rattle_step.hpp"

#include "alembert/base/dense.hpp"

namespace alembert {

namespace {

constexpr int most_iterations = 50, patience = 8;
constexpr double still_shrinking = 1e-12;  // changes below this that no longer shrink are rounding
constexpr double nothing = 4e-16;

double largest_change(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    const double largest = ((a - b).array().abs() / a.array().abs().max(1.0)).maxCoeff();
    return (a - b).allFinite() ? largest : HUGE_VAL;
}

}  // namespace

RattleStep::RattleStep(const HamiltonianSystem& system)
    : system_(system),
      n_(system.coordinates),
      m_(system.constraints),
      lambda_(Vector::Zero(m_)),
      state_(static_cast<std::size_t>(2 * n_)),
      form_(static_cast<std::size_t>(system.form_size())) {
    for (Side* side : {&here_, &there_}) {
        side->M.resize(n_, n_);
        side->position.resize(m_);
        side->velocity.resize(m_);
        side->A.resize(m_, n_);
    }
}

/// Computes M and its factors, p, p₀ and F; false if M is not positive definite.
bool RattleStep::evaluate(Side& side, double t, const Vector& q, const Vector& v) {
    std::copy_n(q.data(), n_, state_.data());
    std::copy_n(v.data(), n_, state_.data() + n_);
    system_.form(t, state_.data(), form_.data());
    ++evaluations_;
    const double* next = form_.data();
    for (Eigen::Index i = 0; i < n_; ++i)
        for (Eigen::Index j = 0; j <= i; ++j) side.M(i, j) = side.M(j, i) = *next++;
    side.p = Eigen::Map<const Vector>(next, n_);
    side.F = Eigen::Map<const Vector>(next + n_, n_);
    side.free = side.p - side.M * v;
    side.factors.compute(side.M);
    return side.factors.info() == Eigen::Success;
}

void RattleStep::hold(Side& side, double t, const Vector& q, const Vector& v) {
    std::copy_n(q.data(), n_, state_.data());
    std::copy_n(v.data(), n_, state_.data() + n_);
    system_.held(t, state_.data(), side.position.data(), side.velocity.data(), side.A.data());
}

bool RattleStep::operator()(double t, double h, double* state) {
    q_ = Eigen::Map<const Vector>(state, n_);
    u_ = Eigen::Map<const Vector>(state + n_, n_);
    if (!evaluate(here_, t, q_, u_)) return false;
    const Vector p = here_.p;
    Eigen::MatrixXd across, there;  // M⁻¹A(q)ᵀ, with M at either end
    if (m_ > 0) {
        hold(here_, t, q_, u_);
        across = here_.factors.solve(here_.A.transpose());
    }
    v_ = w_ = u_;
    end_ = q_;
    impulse_ = h / 2 * lambda_;  // the impulse of the step before
    Vector P;
    double former = HUGE_VAL, pulled = 0;  // how far the constraints moved the end in the last round
    for (int round = 0;; ++round) {
        if (round == most_iterations) return false;
        P = p + h / 2 * here_.F;
        if (m_ > 0) P += here_.A.transpose() * impulse_;
        before_ = v_;
        v_ = here_.factors.solve(P - here_.free);
        double change = std::max(pulled, std::abs(h) * largest_change(v_, before_));
        if (round == 0) w_ = v_;
        before_ = end_;
        end_ = q_ + h / 2 * (v_ + w_);
        change = std::max(change, largest_change(end_, before_));
        if (!evaluate(there_, t + h, end_, w_)) return false;
        before_ = w_;
        w_ = there_.factors.solve(P - there_.free);
        change = std::max(change, std::abs(h) * largest_change(w_, before_));
        if (!(change < HUGE_VAL)) return false;
        if ((change <= nothing && (round > 0 || m_ == 0)) || (change >= former && change < still_shrinking)) break;
        if (round > patience && change >= former) return false;
        former = change;
        if (m_ > 0) {
            end_ += h / 2 * (w_ - before_);  // then f is taken at the end to which the new rates lead
            hold(there_, t + h, end_, w_);
            there = there_.factors.solve(here_.A.transpose());
            Elimination square;
            square.factor(h / 2 * (there_.A * (across + there)));
            Vector pull;
            square.solve(there_.position, pull);
            impulse_ -= pull;
            v_ -= across * pull;
            w_ -= there * pull;
            before_ = end_;
            end_ -= h / 2 * ((across + there) * pull);
            pulled = largest_change(end_, before_);
        }
        if (!evaluate(here_, t, q_, v_)) return false;
    }
    longest_ = std::max(longest_, std::abs(h));
    if (m_ > 0 && std::abs(h) > 0.01 * longest_)
        lambda_ = 2 / h * impulse_;  // a very short step, to a row close by, would give λ errors of rounding / h²
    if (!evaluate(there_, t + h, end_, w_)) return false;
    u_ = there_.factors.solve(P + h / 2 * there_.F - there_.free);
    if (m_ > 0) {
        hold(there_, t + h, end_, u_);
        there = there_.factors.solve(there_.A.transpose());
        Elimination square;
        square.factor(there_.A * there);
        Vector pull;
        for (int round = 0; round < 2; ++round) {  // the second removes what rounding left
            if (round > 0) hold(there_, t + h, end_, u_);
            square.solve(there_.velocity, pull);
            u_ -= there * pull;
        }
    }
    std::copy_n(end_.data(), n_, state);
    std::copy_n(u_.data(), n_, state + n_);
    return u_.allFinite() && end_.allFinite();
}

}  // namespace alembert
