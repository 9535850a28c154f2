// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/trust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "alembert/base/dense.hpp"
#include "base/language/say.hpp"

namespace alembert {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double two_digits = 1e-2, two_digits_of_energy = 2e-2, near = 0.1;

/// The shortest time in which an input changes, apart from switches, which a step cannot pass over unnoticed.
const InputTimeScale* quickest(const std::vector<InputTimeScale>& inputs) {
    const InputTimeScale* found = nullptr;
    for (const InputTimeScale& q : inputs)
        if (!q.is_switch && (found == nullptr || q.step < found->step)) found = &q;
    return found;
}

/// How well a pose determines the motion there. Both numbers are the smallest eigenvalue of a matrix.
struct Conditioning {
    double inertia = 1;  ///< of M with ones on its diagonal, and AᵀA added: what A excludes needs no inertia
    double rows = 1;     ///< of A Aᵀ
};

/// M: n×n; A: m×n, m may be 0. A has the scale of M and rows of length 1 here. Nothing if M has no ones on its
/// diagonal in any scale.
std::optional<Conditioning> conditioning(const Rows& M, Rows A) {
    const Eigen::VectorXd own = M.diagonal();
    for (Eigen::Index i = 0; i < own.size(); ++i)
        if (!(own[i] > 0) || !std::isfinite(own[i])) return std::nullopt;
    const Eigen::VectorXd scale = own.cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd scaled = scale.asDiagonal() * M * scale.asDiagonal();
    A *= scale.asDiagonal();
    for (Eigen::Index k = 0; k < A.rows(); ++k)
        if (const double length = A.row(k).norm(); length > 0) A.row(k) /= length;
    scaled += A.transpose() * A;
    const Eigen::MatrixXd products = A * A.transpose();
    if (!scaled.allFinite() || !products.allFinite()) return std::nullopt;
    return Conditioning{.inertia = std::max(0.0, eigenpairs(scaled).values[0]),
                        .rows = A.rows() == 0 ? 1 : std::max(0.0, eigenpairs(products).values[0])};
}

}  // namespace

std::vector<std::string> distrust_reasons(const Evidence& e) {
    std::vector<std::string> reasons;
    if (!e.error.value) reasons.push_back(say("{}, so the error is unknown", e.error.by));
    const double value = e.error.value.value_or(0), scaled = e.error.scaled.value_or(0);
    if (!(value <= two_digits))
        reasons.push_back(say("the estimated error is {:.1e}", value));
    else if (!(scaled <= two_digits))
        reasons.push_back(say("the estimated error is {:.1e} of the motion's size", scaled));
    if (e.fixed_step == 0 && e.error.moved > 0 && e.error.moved < e.precision)
        reasons.push_back(
            say("the coordinates move by {:.1e} at the most, less than the tolerance {:g}, so the "
                "tolerance limited no step",
                e.error.moved, e.precision));
    if (e.error.lyapunov && !reasons.empty())
        reasons.push_back(
            say("neighbouring motions part by a factor e each {:.2g} s, from t = {:.4g} on no digit is left",
                1 / *e.error.lyapunov, *e.error.horizon));
    const auto hold = [&](const std::string& what, const std::optional<double>& drift) {
        if (drift && !std::isfinite(*drift))
            reasons.push_back(
                say("{} is not a number: its terms are too large or too small for double precision", what));
        else if (drift && !(*drift <= two_digits_of_energy))
            reasons.push_back(say("{} is off by {:.1e} of the largest kinetic energy", what, *drift));
    };
    hold(say("the energy, which should stay,"), e.energy);
    hold(say("the energy less the work done, which should stay,"), e.balance);
    hold(say("T2 - T0 + V, which should stay,"), e.jacobi);
    if (!(e.constraints <= two_digits))
        reasons.push_back(say("the constraints are off by {:.1e} of the motion's size", e.constraints));
    if (const double distance = std::sqrt(std::max(0.0, e.singular));
        distance < near && e.precision > two_digits * distance)
        reasons.push_back(
            say("the motion passes a singular pose of its coordinates (as in gimbal lock) at a relative "
                "distance of {:.1e}, where rates magnify an error of {:.1e} to {:.1e}; other "
                "coordinates, or a quaternion, have no such pose there",
                distance, e.precision, distance > 0 ? e.precision / distance : HUGE_VAL));
    if (const InputTimeScale* const q = quickest(e.inputs); q != nullptr && e.fixed_step > q->step)
        reasons.push_back(
            say("an input changes within {:.2g} s near t = {:.6g}, which steps of {:g} s may pass over; "
                "take shorter ones, or a method "
                "that chooses them",
                q->step, (q->from + q->to) / 2, e.fixed_step));
    if (e.passed_place)
        reasons.push_back(
            say("the motion meets a place near t = {:.6g} where a force changes fast, which steps of {:g} s pass "
                "over; take shorter ones, or a method that chooses them",
                *e.passed_place, e.fixed_step));
    if (e.passed) reasons.push_back(TableWatch::text_of(*e.passed));
    return reasons;
}

void PoseWatch::operator()(double t, std::span<const double> state, std::size_t coordinates, std::size_t speeds) {
    if (largest_.empty()) {
        largest_.assign(speeds, 0);
        times_.assign(speeds, t);
        states_.assign(speeds, {state.begin(), state.begin() + static_cast<std::ptrdiff_t>(coordinates + speeds)});
    }
    for (std::size_t i = 0; i < speeds; ++i) {
        const double u = std::abs(state[coordinates + i]);
        if (!(u > largest_[i])) continue;
        largest_[i] = u;
        times_[i] = t;
        std::copy_n(state.begin(), coordinates + speeds, states_[i].begin());
    }
}

Components components_of(const Program& program, std::size_t coordinates, std::size_t speeds) {
    Components result{.coordinates = coordinates};
    std::map<std::string, int> kinds;
    const auto kind_of = [&](const Quantity& one) {
        return kinds.emplace(one.unit.empty() ? "one: " + one.name : one.unit, static_cast<int>(kinds.size()))
            .first->second;
    };
    for (std::size_t i = 0; i < coordinates; ++i) result.kinds.push_back(kind_of(program.coordinates[i]));
    for (std::size_t i = 0; i < speeds; ++i)
        result.kinds.push_back(kind_of(program.speeds.empty() ? program.coordinates[i] : program.speeds[i]));
    return result;
}

double most_singular(const HybridMotion& motion, const LoadedMode& mode, const PoseWatch& poses) {
    constexpr int most_speeds = 40;  // for larger matrices the eigenvalues would take as long as the run
    const alembert_solver_table& table = mode.module.table();
    if (table.mass_forcing == nullptr || table.speeds > most_speeds || table.speeds < 2) return 1;
    const int n = table.coordinates, s = table.speeds, m = table.constraints;
    const std::ptrdiff_t in_speeds = table.speed_names != nullptr ? std::ptrdiff_t(m) * n : 0;
    Rows M(s, s);
    std::vector<double> forcing(static_cast<std::size_t>(s)), position(static_cast<std::size_t>(m)),
        velocity(position.size()), rows(static_cast<std::size_t>(in_speeds + std::ptrdiff_t(m) * s));
    std::vector<Conditioning> found;
    const auto look = [&](double t, const double* state) {
        table.mass_forcing(t, state, mode.par.data(), M.data(), forcing.data());
        if (m > 0) table.constraints_at(t, state, mode.par.data(), position.data(), velocity.data(), rows.data());
        const int independent = mode.module.independent_constraints();
        if (const auto one = conditioning(M, Eigen::Map<const Rows>(rows.data() + in_speeds, independent, s)))
            found.push_back(*one);
    };
    for (const Phase& phase : motion.phases)
        for (std::size_t row = 0; row < phase.motion.rows(); row += 1 + phase.motion.rows() / 400)
            look(phase.motion.times[row], phase.motion.state(row).data());
    for (std::size_t k = 0; k < poses.states().size(); ++k) look(poses.time(k), poses.states()[k].data());
    double smallest = HUGE_VAL, largest = 0, most_rows = 0;
    for (const Conditioning& one : found) most_rows = std::max(most_rows, one.rows);
    for (const Conditioning& one : found) {
        if (one.rows < near * near * most_rows) continue;
        smallest = std::min(smallest, one.inertia);
        largest = std::max(largest, one.inertia);
    }
    return largest > 0 ? smallest / largest : 1;
}

double size_of(const HybridMotion& motion, std::size_t count) {
    double largest = 0;
    for (const Phase& phase : motion.phases)
        for (std::size_t row = 0; row < phase.motion.rows(); ++row)
            for (std::size_t i = 0; i < count; ++i)
                largest = std::max(largest, std::abs(phase.motion.state(row)[i]));
    return largest;
}

}  // namespace alembert
