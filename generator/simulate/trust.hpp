// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Decides from all measurements of a run whether two digits of it can be trusted.
///
///     const Evidence evidence{.error = estimate, .energy = drift.energy_of_motion(), …};
///     const std::vector<std::string> reasons = distrust_reasons(evidence);
///     reasons.empty();         // trusted
///
/// A run is not trusted if one of these is above its limit:
///
/// | what | limit | because |
/// | --- | --- | --- |
/// | estimated error, relative to max(1, \|y\|), and to the motion's size | 0.01 | two digits |
/// | the tolerance, relative to how far any coordinate moves | 1 | below that nothing was resolved |
/// | energy, work balance, Jacobi's integral, in units of the largest kinetic energy | 0.02 | 1 % of the rates |
/// | constraints, relative to the largest coordinate or rate | 0.01 | the state itself is off by that much |
/// | what a singular pose nearer than 0.1 makes of an error | 0.01 | see below |
/// | a fixed step, relative to the time in which an input changes | 2 pieces | no stage need have met it |
/// | steps that pass a feature of a long table at once | none | likewise |
///
/// Poses where the description is singular (gimbal lock, poles of spherical coordinates): there M, scaled to ones
/// on its diagonal, has an eigenvalue that vanishes as the square of the distance. δ², its smallest value during
/// the motion relative to the largest, shows how near the motion came. An error e of the state becomes e/δ in the
/// rates, where e is the tolerance, or the estimated error of fixed steps. Motions that the constraints exclude
/// need no inertia: AᵀA is added to M. Poses near which the constraints lose rank, where linkages lie flat, do not
/// count: the run passes them by other equations (project.hpp), and the estimated error tells what that costs.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "alembert/ode/input_time_scale.hpp"
#include "simulate/estimate.hpp"
#include "simulate/loaded_modes.hpp"
#include "simulate/table_watch.hpp"

namespace alembert {

/// A missing value means that the quantity does not apply.
struct Evidence {
    const ErrorEstimate& error;
    std::optional<double> energy = {}, balance = {},
                          jacobi = {};  ///< in units of the energy of the motion (alembert/ode/energy_error.hpp)
    double constraints = 0;  ///< the largest |f|, |A q' + b|, in units of the largest coordinate or rate
    double singular = 1;     ///< δ² above
    double precision = 0;    ///< e above
    double fixed_step = 0;   ///< in s; 0 if the method chose its steps
    std::vector<InputTimeScale> inputs = {};
    std::optional<TableWatch::Passed> passed = {};
    std::optional<double> passed_place = {};  ///< Statistics::passed_place
};

/// The reasons as sentences without capital and full stop, the most important first. If there are none, the run is
/// trusted.
std::vector<std::string> distrust_reasons(const Evidence& evidence);

/// Collects poses of a run to find the most singular one. M is evaluated where a rate is at its largest, because
/// rates are large near such a pose.
class PoseWatch {
public:
    /// Remembers the state if one of its speeds is the largest so far.
    void operator()(double t, std::span<const double> state, std::size_t coordinates, std::size_t speeds);
    const std::vector<std::vector<double>>& states() const { return states_; }
    double time(std::size_t k) const { return times_[k]; }

private:
    std::vector<double> largest_, times_;
    std::vector<std::vector<double>> states_;
};

/// The coordinates and speeds for the estimate. Those with the same unit are of one kind; one without a unit is a
/// kind of its own.
Components components_of(const Program& program, std::size_t coordinates, std::size_t speeds);

/// δ² above, from M at the rows and where a rate was at its largest; 1 if M is not available or there are more
/// than 40 speeds.
double most_singular(const HybridMotion& motion, const LoadedMode& mode, const PoseWatch& poses);

/// The largest size of the first `count` components on the rows.
double size_of(const HybridMotion& motion, std::size_t count);

}  // namespace alembert
