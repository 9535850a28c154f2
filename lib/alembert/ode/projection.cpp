// SPDX-License-Identifier: MIT
#include "alembert/ode/projection.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/dense.hpp"

namespace alembert {

namespace {

constexpr int most_corrections = 8;       // from the end of an accepted step, Newton's method needs one or two
constexpr double small_change = 1e-8;     // its square is rounding
constexpr double one_rounding = 0x1p-53;  // rounding of a number of size 1
constexpr double singular_pivot = 1e-5;
constexpr double held = 5e-5;

}  // namespace

/// What a guarded right-hand side needs.
struct Projection::Guard {
    Rhs rhs;
    Projection* projection;
    std::vector<double> par;
    ForcesOfMultipliers others;
};

Projection::Projection(const Module& module, const std::vector<double>& values)
    : module_(module),
      par_(prepared(module, values)),
      n_(module.table().coordinates),
      s_(module.table().speeds),
      m_(module.independent_constraints()),
      all_(module.table().constraints),
      position_(m_),
      velocity_(m_),
      forcing_(s_),
      gamma_(Eigen::VectorXd::Zero(m_)),
      mass_(s_, s_),
      rows_(static_cast<std::size_t>(all_) * static_cast<std::size_t>(n_ + s_)),
      off_(static_cast<std::size_t>(2 * all_)),
      moved_(static_cast<std::size_t>(n_ + s_)),
      violation_(static_cast<std::size_t>(m_)),
      pivots_(violation_.size()),
      largest_pivots_(violation_.size()),
      saddle_(s_, m_) {}

void Projection::evaluate(double t, const double* state, const double* par) {
    double* const velocity = off_.data() + all_;
    module_.table().constraints_at(t, state, par, off_.data(), velocity, rows_.data());
    position_ = Eigen::Map<const Eigen::VectorXd>(off_.data(), m_);
    velocity_ = Eigen::Map<const Eigen::VectorXd>(velocity, m_);
    module_.table().mass_forcing(t, state, par, mass_.data(), forcing_.data());
}

void Projection::forget() {
    std::fill(largest_pivots_.begin(), largest_pivots_.end(), 0);
    saddle_.forget();
    is_near_singular_ = have_grown_ = false;
}

/// The pose beside the start is where the coordinate that moves fastest has gone a tenth of a radian, or of the
/// largest coordinate if that is less than 1. It does not count if pivots grow like those beside a pole there.
/// Whether the start is singular shows when it is projected, at rest too.
void Projection::begin(double t, const double* start) {
    constexpr double distance = 0.1,
                     steepest = 20;  // twice as far from a singular pose pivots are four times as large
    forget();
    if (module_.projection() == nullptr || module_.projection()->project == nullptr) return;
    std::vector<double> state(start, start + n_ + s_), rate(state.size());
    module_.table().rhs(t, start, par_.data(), rate.data());
    Eigen::Map<Eigen::VectorXd> q(state.data(), n_);
    const Eigen::VectorXd first = q, along = Eigen::Map<Eigen::VectorXd>(rate.data(), n_);
    const double fastest = along.lpNorm<Eigen::Infinity>(), size = q.lpNorm<Eigen::Infinity>();
    const auto pivots = [&](double share) {
        q = first + share * distance * (size > 0 ? std::min(size, 1.0) : 1) / fastest * along;
        module_.projection()->project(t, state.data(), par_.data(), moved_.data(), violation_.data(),
                                      pivots_.data());
        return pivots_;
    };
    const auto measure_beside = [&] {
        if (!(fastest > 0 && fastest < HUGE_VAL)) return;
        const std::vector<double> halfway = pivots(0.5), beside = pivots(1);
        for (std::size_t k = 0; k < beside.size(); ++k)
            if (!(std::abs(beside[k]) <= steepest * std::abs(halfway[k]))) return;
        pivots_are_small();
        evaluate(t, state.data());
        saddle_.measure(mass_, Rows(in_speeds()));
    };
    measure_beside();
    q = first;
    (*this)(t, state.data());
}

std::function<void(double t, double* state)> Projection::after_steps() {
    const bool is_idle = m_ == 0 || (module_.projection() != nullptr && module_.projection()->project == nullptr);
    if (is_idle) return {};
    return std::ref(*this);
}

/// The pivots that the emitted step has found; a pivot is 0 if the step does not divide by one.
bool Projection::pivots_are_small() {
    bool small = false;
    for (std::size_t k = 0; k < pivots_.size(); ++k) {
        const double size = std::abs(pivots_[k]);
        have_grown_ = have_grown_ || size > 2 * largest_pivots_[k];
        largest_pivots_[k] = std::max(largest_pivots_[k], size);
        small = small || (pivots_[k] != 0 && !(size > singular_pivot * largest_pivots_[k]));
    }
    return small;
}

/// x of least norm with B x = r. Near a singular pose it is x = Bᵀ (B Bᵀ + τ²)⁻¹ r (Tikhonov), with each row
/// divided by its largest length so far; x along a direction with singular value σ is then smaller by the factor
/// σ²/(σ² + τ²), which varies smoothly.
Eigen::VectorXd Projection::least(Eigen::MatrixXd B, Eigen::VectorXd r) const {
    if (!is_near_singular_) return least_norm(B, r).x;
    for (Eigen::Index k = 0; k < B.rows(); ++k) {
        const double length = std::sqrt(largest_pivots_[static_cast<std::size_t>(k)]);
        if (!(length > 0)) continue;
        B.row(k) /= length;
        r[k] /= length;
    }
    Eigen::MatrixXd G = B * B.transpose();
    G.diagonal().array() += held * held;
    return B.transpose() * G.llt().solve(r);
}

/// Projects by the emitted step; false if its result is not to be trusted.
bool Projection::unrolled(double t, double* state) {
    if (module_.projection() == nullptr) return false;
    const auto project = module_.projection()->project;
    is_near_singular_ = false;
    double former = HUGE_VAL;
    for (int round = 0; round < most_corrections && project != nullptr; ++round) {
        project(t, state, par_.data(), moved_.data(), violation_.data(), pivots_.data());
        double size = 0, zero = 0;
        bool moves = false, is_large = false;
        for (const double violation : violation_) size = std::max(size, std::abs(violation));
        for (std::size_t i = 0; i < moved_.size(); ++i) {
            const double change = std::abs(moved_[i] - state[i]), scale = std::max(1.0, std::abs(state[i]));
            moves |= change > one_rounding * scale;
            is_large |= i < static_cast<std::size_t>(n_) && change >= small_change * scale;
            zero += moved_[i] * 0;
        }
        if (zero != 0 || pivots_are_small()) {
            is_near_singular_ = true;
            return false;
        }
        if (!moves || (!(size < former / 2) && size > 0)) return true;
        former = size;
        std::copy(moved_.begin(), moved_.end(), state);
        if (!is_large) return true;
    }
    return true;
}

/// M⁻¹Bᵀ (B M⁻¹Bᵀ)⁺ violation = L⁻ᵀ (B L⁻ᵀ)⁺ violation, B being A in speeds
Eigen::VectorXd Projection::along_speeds(const Eigen::VectorXd& violation) const {
    const Rows B = in_speeds();
    const Cholesky factors(mass_);
    if (!factors.exists() && is_near_singular_)
        return saddle_.solve(mass_, B, Eigen::VectorXd::Zero(s_), violation);
    if (!factors.exists()) {
        const Eigen::MatrixXd across = solve_symmetric(mass_, B.transpose());
        return across * least_norm(B * across, violation).x;
    }
    return factors.solve_upper(least(factors.solve_lower(B.transpose()).transpose(), violation));
}

/// S M⁻¹Bᵀ (B M⁻¹Bᵀ)⁺ f, with S from differences of the file's q', which is linear in u; or Aₑ⁺ f if the speeds
/// have eliminated all rows of B.
Eigen::VectorXd Projection::in_positions(double t, const double* state) const {
    if (!own_speeds()) return along_speeds(position_);
    if (in_speeds().isZero(0)) {
        std::vector<Eigen::Index> holonomic;
        for (Eigen::Index k = 0; k < m_; ++k)
            if (position_[k] != 0 || pivots_[static_cast<std::size_t>(k)] != 0) holonomic.push_back(k);
        return least_norm(in_rates()(holonomic, Eigen::all), position_(holonomic)).x;
    }
    const Eigen::VectorXd along = along_speeds(position_);
    Eigen::VectorXd change = Eigen::VectorXd::Zero(n_);
    std::vector<double> here(state, state + n_ + s_), rate(here.size()), rate_at_rest(here.size());
    const auto evaluate = [&](std::vector<double>& out) {
        module_.table().rhs(t, here.data(), par_.data(), out.data());
    };
    std::fill(here.begin() + n_, here.end(), 0);
    evaluate(rate_at_rest);
    for (int k = 0; k < s_; ++k) {
        double& u = here[static_cast<std::size_t>(n_ + k)];
        u = 1;
        evaluate(rate);
        u = 0;
        for (int i = 0; i < n_; ++i)
            change[i] +=
                (rate[static_cast<std::size_t>(i)] - rate_at_rest[static_cast<std::size_t>(i)]) * along[k];
    }
    return change;
}

void Projection::operator()(double t, double* state) {
    const bool is_done = unrolled(t, state);
    if (have_grown_) {
        evaluate(t, state);
        saddle_.measure(mass_, Rows(in_speeds()));
        have_grown_ = false;
    }
    if (is_done) return;
    Eigen::Map<Eigen::VectorXd> q(state, n_), u(state + n_, s_);
    double former = HUGE_VAL;
    for (int round = 0; round < most_corrections; ++round) {
        evaluate(t, state);
        const double size = position_.lpNorm<Eigen::Infinity>();
        if (!(size > 0) || !(size < former / 2)) break;
        former = size;
        const Eigen::VectorXd change = in_positions(t, state);
        if (!change.allFinite()) return;
        q -= change;
    }
    evaluate(t, state);
    for (int round = 0; round < 2; ++round) {  // the second round removes what rounding left in the first
        const Eigen::VectorXd change = along_speeds(velocity_);
        if (!change.allFinite()) return;
        u -= change;
        evaluate(t, state);
    }
}

double Projection::residual(double t, const double* state) {
    evaluate(t, state);
    return m_ == 0 ? 0 : std::max(position_.lpNorm<Eigen::Infinity>(), velocity_.lpNorm<Eigen::Infinity>());
}

/// λ of (B Bᵀ + B L⁻¹C + τ²) λ = r near a singular pose, with Bᵀ in `across` and L⁻¹C in `others`, scaled as in
/// `least`.
Eigen::VectorXd Projection::multipliers(Eigen::MatrixXd across, Eigen::MatrixXd others, Eigen::VectorXd r) const {
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(m_);
    for (Eigen::Index k = 0; k < m_; ++k)
        if (const double length = std::sqrt(largest_pivots_[static_cast<std::size_t>(k)]); length > 0)
            scale[k] = 1 / length;
    across *= scale.asDiagonal();
    others *= scale.asDiagonal();
    const Eigen::MatrixXd G = across.transpose() * (across + others);
    Eigen::MatrixXd regular = G;
    regular.diagonal().array() += held * held;
    const Orthogonal factors(regular, one_rounding);
    const Eigen::VectorXd scaled = scale.cwiseProduct(r), first = factors.solve(scaled);
    // The correction leaves τ⁴ of λ in directions that are held well, which friction there would show.
    return scale.cwiseProduct(first + factors.solve(scaled - G * first));
}

/// u' = L⁻ᵀ (L⁻¹ f + x), x of least norm with (A L⁻ᵀ) x = γ − A M⁻¹ f, or x = (Bᵀ + L⁻¹C) λ
bool Projection::accelerations(double t, const double* state, const double* par, const ForcesOfMultipliers& others,
                               double* acceleration) {
    if (!is_near_singular_ || module_.projection() == nullptr || module_.projection()->gamma_at == nullptr)
        return false;
    evaluate(t, state, par);
    module_.projection()->gamma_at(t, state, par, gamma_.data());
    const Cholesky factors(mass_);
    if (!factors.exists()) {
        if (others) return false;
        const Eigen::VectorXd found = saddle_.solve(mass_, Rows(in_speeds()), forcing_, gamma_);
        std::copy_n(found.data(), s_, acceleration);
        return true;
    }
    const Eigen::MatrixXd across = factors.solve_lower(Rows(in_speeds()).transpose());
    const Eigen::VectorXd free = factors.solve_lower(forcing_);
    const Eigen::VectorXd lacking = gamma_ - across.transpose() * free;
    Eigen::VectorXd along;
    if (others) {
        const Eigen::MatrixXd against_friction = factors.solve_lower(others(t, state));
        along = (across + against_friction) * multipliers(across, against_friction, lacking);
    } else {
        along = least(across.transpose(), lacking);
    }
    const Eigen::VectorXd found = factors.solve_upper(free + along);
    std::copy_n(found.data(), s_, acceleration);
    return true;
}

void Projection::careful(const void* context, double t, const double* state, double* rate) {
    const Guard& guard = *static_cast<const Guard*>(context);
    Projection& self = *guard.projection;
    guard.rhs(t, state, rate);
    if (!self.accelerations(t, state, guard.par.data(), guard.others, rate + self.n_)) return;
    if (guard.rhs.dimension == self.n_ + self.s_) return;
    double energy[4], jacobi = 0;
    self.module_.table().energy(t, state, rate, guard.par.data(), energy, &jacobi);
    rate[self.n_ + self.s_] = energy[3];
}

Rhs Projection::guarded(Rhs rhs, const std::vector<double>& values, ForcesOfMultipliers others) {
    if (module_.projection() == nullptr || module_.projection()->gamma_at == nullptr) return rhs;
    Rhs result = rhs;
    result.context = std::make_shared<const Guard>(Guard{
        .rhs = std::move(rhs), .projection = this, .par = prepared(module_, values), .others = std::move(others)});
    result.call = careful;
    result.energies = nullptr;
    if (result.jacobian != nullptr)
        result.jacobian = [](const void* context, double t, const double* state, double* values) {
            const Rhs& inner = static_cast<const Guard*>(context)->rhs;
            inner.jacobian(inner.context.get(), t, state, values);
        };
    return result;
}

}  // namespace alembert
