// SPDX-License-Identifier: MIT
#pragma once

/// How far E, E − W and T₂ − T₀ + V depart from their values at the start, over all accepted steps of a run.
///
///     EnergyError error(n, s, with_work);
///     error(table, par, t, state, rate);       // at the start and after each step
///     error.add({.kinetic = T, .total = E, .jacobi = h}, work);        // the same with the energies in hand
///     error.balance();
///
/// Where rates jump, E changes by the work of the impulses, and by the jump of T₁ + 2T₀ = E − h that is due to a
/// moving frame (energy.hpp); both count as work. If one of these was not a number at any step, neither is what is
/// told.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "alembert/native/abi.hpp"

namespace alembert {

class EnergyError {
public:
    /// The state has n coordinates and s speeds; with `with_work`, ∫ power dt follows them.
    EnergyError(int n, int s, bool with_work) : size_(n + s), with_work_(with_work) {}

    void operator()(const alembert_solver_table& table, const std::vector<double>& par, double t,
                    std::span<const double> state, std::span<const double> rate) {
        add(energies(table, par, t, state.data(), rate.data()), with_work_ ? state[size_] : 0);
    }

    struct Energies {
        double kinetic, total, jacobi;
    };

    void add(const Energies& e, double quadrature) {
        const double work = quadrature + jumps_;
        if (first_) {
            energy_start_ = e.total;
            jacobi_start_ = e.jacobi;
            first_ = false;
        }
        largest_kinetic_ = std::max(largest_kinetic_, e.kinetic);
        largest_energy_ = std::max(largest_energy_, std::abs(e.total));
        largest_work_ = std::max(largest_work_, std::abs(work));
        grow(energy_, std::abs(e.total - energy_start_));
        grow(balance_, std::abs(e.total - energy_start_ - work));
        grow(jacobi_, std::abs(e.jacobi - jacobi_start_));
    }

    /// To be called when rates have jumped.
    void jump(const alembert_solver_table& table, const std::vector<double>& par, double t, const double* before,
              const double* after, double work) {
        const std::vector<double> still(static_cast<std::size_t>(size_),
                                        0.0);  // only the power depends on the rate
        const Energies a = energies(table, par, t, before, still.data()),
                       b = energies(table, par, t, after, still.data());
        if (first_) {
            energy_start_ = a.total;
            jacobi_start_ = a.jacobi;
            largest_kinetic_ = a.kinetic;
            first_ = false;
        }
        jumps_ += work + (b.total - b.jacobi) - (a.total - a.jacobi);
    }

    /// To be called when numbers on which the energy depends, but no rates, have been set.
    void set(const alembert_solver_table& table, const std::vector<double>& par, double t, const double* before,
             const double* after) {
        const std::vector<double> still(static_cast<std::size_t>(size_), 0.0);
        const Energies a = energies(table, par, t, before, still.data()),
                       b = energies(table, par, t, after, still.data());
        if (a.total == b.total) return;
        jumps_ += b.total - a.total;
        set_change_ = set_change_.value_or(0) + b.total - a.total;
    }
    /// The sum of these changes of E; nothing if none has moved it.
    std::optional<double> set_change() const { return set_change_; }

    /// The same departures relative to the largest kinetic energy, for motions so small that E is nearly all
    /// potential energy. The divisor is at least 1e-10 of E, since rounding limits how well E is known, and for
    /// the balance at least 1e-4 of the work.
    double energy_of_motion() const { return of_motion(energy_, largest_energy_, 0); }
    double balance_of_motion() const { return of_motion(balance_, largest_energy_, largest_work_); }
    double jacobi_of_motion() const {
        return of_motion(jacobi_, std::max(largest_energy_, std::abs(jacobi_start_)), 0);
    }

    double energy() const { return energy_ / scale(energy_start_); }
    double balance() const { return balance_ / scale(energy_start_); }
    double jacobi() const { return jacobi_ / scale(jacobi_start_); }

private:
    static Energies energies(const alembert_solver_table& table, const std::vector<double>& par, double t,
                             const double* state, const double* rate) {
        double energy[4], jacobi = 0;
        table.energy(t, state, rate, par.data(), energy, &jacobi);
        return {energy[0], energy[2], jacobi};
    }

    double of_motion(double drift, double energy, double work) const {
        const double size = std::max({largest_kinetic_, 1e-10 * energy, 1e-4 * work});
        return drift == 0 ? 0 : drift / size;
    }

    /// What is not a number stays so: it says nothing of how far a quantity has departed.
    static void grow(double& most, double departure) {
        if (!(departure <= most) && !std::isnan(most)) most = departure;
    }

    double scale(double start) const {
        const double size = std::max(std::abs(start), largest_kinetic_);
        return size > nothing ? size : 1;
    }

    static constexpr double nothing = 1e-26;  // the square of what rounding leaves of the speed of a body at rest
    int size_;
    bool with_work_, first_ = true;
    double energy_start_ = 0, jacobi_start_ = 0, largest_kinetic_ = 0, largest_energy_ = 0, largest_work_ = 0;
    double energy_ = 0, balance_ = 0, jacobi_ = 0, jumps_ = 0;
    std::optional<double> set_change_;
};

}  // namespace alembert
