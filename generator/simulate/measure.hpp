// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Measures a run: its time, its distance from the reference, and the drift of conserved quantities.
///
///     const Workbench workbench(derived, program, module, start, initial, reference_state);
///     const Measured run = workbench.measure({.method = Method::dop853, .duration = 10, .tolerance = 1e-9});
///
/// `error` is the largest |y − reference| / max(1, |reference|) of coordinates and rates at the end. `seconds` is
/// processor time of the integration only, without rows, dense output or records: the median of as many runs as
/// fit in 20 ms (at least three, or one if it takes longer than 0.3 s). Drifts come from a separate run.

#include <optional>

#include "alembert/native/module.hpp"
#include "alembert/ode/energy_error.hpp"
#include "alembert/ode/hamiltonian_system.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/projection.hpp"
#include "alembert/ode/series.hpp"
#include "analysis/derive/derived.hpp"

namespace alembert {

struct Measured {
    std::string who = "alembert", method = {};
    std::string chosen = {};   ///< the method that `auto` has chosen; empty for the others
    std::string went_on = {};  ///< the method to which the run changed when it was found stiff; may be empty
    std::optional<double> tolerance = {}, step = {};  ///< one of the two is set
    std::optional<double> error = {};                 ///< nothing if the run failed or there is no reference
    double seconds = 0;
    long evaluations = 0, steps = 0;
    std::optional<double> energy_drift = {}, constraint_error = {},
                          momentum_error = {};  ///< nothing if the quantity is not conserved
    bool work = false;                          ///< whether energy_drift is that of E − E₀ − W
    std::string failure = {};
    bool budget_used_up = false;  ///< whether that is the failure
};

/// Coordinates, then their rates.
std::vector<double> coordinates_and_rates(const Rhs& rhs, double t, const double* state, std::size_t coordinates);

/// The largest |y − reference| / max(1, |reference|); infinite if one is not finite.
double error_against(const std::vector<double>& reference, const std::vector<double>& y);

class Workbench {
public:
    struct Parts {
        const Derived& derived;
        const Module& module;
        SeriesModule series = {}, series_with_work = {};  ///< null if methods that need them are not measured
        std::shared_ptr<const HamiltonianSystem> canonical = {};  ///< likewise
        std::vector<double> parameters, initial;
        std::vector<InputTimeScale> quick_times = {};  ///< System::quick_times
        QuickPlaces quick_places = {};                 ///< System::quick_places
        double effort = 0;                             ///< Rhs::effort
        Slowness slowness = {};                        ///< Rhs::slowness
        bool conserved = true;                         ///< whether the energy is conserved
        std::vector<double> reference = {};            ///< coordinates, then rates, at the end; may be empty
    };
    explicit Workbench(Parts parts);

    /// `rivals`: methods that a long run tries (method_trial.hpp), which belongs to its time.
    Measured measure(Options options, const std::vector<Method>& rivals = {});
    /// Coordinates and rates at the end; nothing if the run failed.
    std::optional<std::vector<double>> end_of(const Options& options);
    const Rhs& rhs() const { return rhs_; }
    void set_reference(std::vector<double> reference) { parts_.reference = std::move(reference); }

private:
    void kept(const Options& options, Measured& result);
    /// Sets the method to the fastest of a trial, if the run is long.
    void choose(Options& options, const System& system, const std::vector<Method>& rivals);
    /// The right-hand side with what the system can do besides.
    System able(const Rhs& rhs);
    std::vector<double> momenta(double t, const double* state, const Rhs& rhs);

    Parts parts_;
    std::vector<double> par_;
    Rhs rhs_, with_work_;
    Projection projection_;
    Program momentum_program_;
    std::vector<int> momentum_nodes_;
};

}  // namespace alembert
