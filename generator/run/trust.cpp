// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/trust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "alembert/dense.hpp"
#include "language/say.hpp"

namespace alembert {

namespace {

constexpr double two_digits = 1e-2, two_digits_of_energy = 2e-2, near = 0.1;

/// The shortest time in which an input changes, apart from switches, which a step cannot pass over unnoticed.
const QuickTime* quickest(const std::vector<QuickTime>& inputs) {
    const QuickTime* found = nullptr;
    for (const QuickTime& q : inputs)
        if (!q.is_switch && (found == nullptr || q.step < found->step)) found = &q;
    return found;
}

/// The smallest eigenvalue of M (n×n, row-major) scaled to ones on its diagonal; nothing if M has no such form.
std::optional<double> conditioning(const std::vector<double>& M, std::size_t n) {
    Eigen::MatrixXd scaled(n, n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const double own = M[i * n + i] * M[j * n + j];
            if (!(own > 0) || !std::isfinite(own)) return std::nullopt;
            scaled(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = M[i * n + j] / std::sqrt(own);
        }
    if (!scaled.allFinite()) return std::nullopt;
    return std::max(0.0, eigenpairs(scaled).values[0]);
}

}  // namespace

std::vector<std::string> doubts(const Evidence& e) {
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
            say("the motion is chaotic (Lyapunov exponent {:.2g}), from t = {:.4g} on no digit is left",
                *e.error.lyapunov, *e.error.horizon));
    const auto hold = [&](const std::string& what, const std::optional<double>& drift) {
        if (drift && !(*drift <= two_digits_of_energy))
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
    if (const QuickTime* const q = quickest(e.inputs); q != nullptr && e.fixed_step > q->step)
        reasons.push_back(
            say("an input changes within {:.2g} s near t = {:.6g}, which steps of {:g} s may pass over; "
                "take shorter ones, or a method "
                "that chooses them",
                q->step, (q->from + q->to) / 2, e.fixed_step));
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

double most_singular(const PhasedMotion& motion, const LoadedMode& mode, const PoseWatch& poses) {
    constexpr int most_speeds = 40;  // for larger matrices the eigenvalues would take as long as the run
    const alembert_solver_table& table = mode.module.table();
    if (table.mass_forcing == nullptr || table.speeds > most_speeds || table.speeds < 2) return 1;
    const auto n = static_cast<std::size_t>(table.speeds);
    std::vector<double> M(n * n), forcing(n);
    double smallest = HUGE_VAL, largest = 0;
    const auto look = [&](double t, const double* state) {
        table.mass_forcing(t, state, mode.par.data(), M.data(), forcing.data());
        if (const auto value = conditioning(M, n)) {
            smallest = std::min(smallest, *value);
            largest = std::max(largest, *value);
        }
    };
    for (const Phase& phase : motion.phases)
        for (std::size_t row = 0; row < phase.motion.rows(); row += 1 + phase.motion.rows() / 400)
            look(phase.motion.times[row], phase.motion.state(row).data());
    for (std::size_t k = 0; k < poses.states().size(); ++k) look(poses.time(k), poses.states()[k].data());
    return largest > 0 ? smallest / largest : 1;
}

double size_of(const PhasedMotion& motion, std::size_t count) {
    double largest = 0;
    for (const Phase& phase : motion.phases)
        for (std::size_t row = 0; row < phase.motion.rows(); ++row)
            for (std::size_t i = 0; i < count; ++i)
                largest = std::max(largest, std::abs(phase.motion.state(row)[i]));
    return largest;
}

}  // namespace alembert
