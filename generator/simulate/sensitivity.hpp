// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// How the end of a motion depends on the values at its start and on parameters.
///
///     const Run run = simulate(scene, {.duration = 3, .sensitivity = {"theta1", "l1"}});
///     run.sensitivity->values[0][1];      // ∂(theta1 at the end)/∂l1
///     run.sensitivity->rows[5][0][1];     // at times[5], with .sensitivity_rows = true
///
/// The variational equations Φ' = ∂f/∂x Φ + ∂f/∂p are integrated together with the motion by dop853, under the
/// control of the errors of both (Hairer, Nørsett & Wanner, Solving ODEs I, §I.14). Where few quantities are
/// wanted by many names, the adjoint equations are integrated back from the end instead: their number does not
/// grow with that of the names. The state is then taken anew from the motion every few steps, so that what damping
/// makes unstable backwards cannot grow; a stiff motion is not run backwards.
///
/// The time of the end is held. By a parameter the whole derivative is meant, that of a run with another value:
/// initial values that the scene writes with it change too. With constraints, guesses follow at the start
/// (analysis/state/start_derivatives.hpp), and the columns of Φ stay tangent to the constraints.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "alembert/ode/integrate.hpp"
#include "analysis/derive/derived.hpp"
#include "program/lower/start.hpp"
#include "simulate/hybrid_variation.hpp"

namespace alembert {

struct Sensitivity {
    double time = 0;                          ///< of the end, in s
    std::vector<std::string> of, by;          ///< names of the quantities at the end, and of what is varied
    std::vector<std::vector<double>> values;  ///< [of][by], in the scene's units
    std::vector<double> times = {};           ///< of the rows, if these were asked for
    std::vector<std::vector<std::vector<double>>> rows = {};  ///< [time][of][by]; the last are `values`
    bool adjoint = false;                                     ///< whether the adjoint equations gave them
    long steps = 0, evaluations = 0;                          ///< of all integrations, forwards and backwards
};

struct SensitivityOptions {
    double tolerance = 1e-9;
    long budget = 10'000'000;
    double sample = 0;                                                      ///< s between rows; 0 for none
    JumpInstants instants = {};                                             ///< of the run
    std::function<void(std::string_view what, double part)> progress = {};  ///< may be empty
};

class Sensitivities {
public:
    /// `of`: names of components of the state or of outputs; if empty, all components. `program` is that of
    /// `derived`; the arguments must outlive the object. Throws ModelError for names that the scene does not have,
    /// that follow from others or cannot vary by themselves, and for a scene whose motion is not smooth, whose
    /// constraints are redundant, or whose derivatives are too long.
    Sensitivities(const Derived& derived, const Program& program, const Start& start,
                  const std::vector<std::string>& names, const std::vector<std::string>& of);

    /// At the time `end`. Throws IntegrationError if the equations cannot be integrated to it.
    Sensitivity at(double end, const SensitivityOptions& options) const;

private:
    /// The derivatives of what is wanted, at the end itself: [of][state], [of][name].
    struct AtEnd {
        std::vector<std::vector<double>> by_state, by_name;
    };

    void find_wanted(const Program& program, const std::vector<std::string>& of);
    AtEnd at_end(double t, std::span<const double> state, const std::vector<double>& parameters) const;
    /// ∂(what is wanted)/∂name at t, of the state and the columns of Φ after it.
    std::vector<std::vector<double>> values_at(double t, std::span<const double> state_and_columns,
                                               const std::vector<double>& parameters) const;
    Sensitivity through_instants(double end, const SensitivityOptions& options) const;
    std::vector<double> at_start() const;
    std::vector<std::string> names_of_all() const;
    Sensitivity forwards(double end, const SensitivityOptions& options) const;
    std::optional<Sensitivity> backwards(double end, const SensitivityOptions& options) const;
    System watched(Rhs rhs, double end) const;
    /// Throws where the motion passes a jump, at the end of a step.
    OnStep for_jumps() const;
    Trajectory integrated(const System& system, const std::vector<double>& start, Options options) const;

    Program program_;
    Start start_;
    std::vector<double> state_;  ///< at the start
    std::vector<std::string> of_, names_;
    std::vector<int> components_;               ///< of the state, or ~k for output k
    std::vector<int> parameters_;               ///< the position of the parameter of each name, or −1
    std::optional<HybridVariation> hybrid_;     ///< where derivatives jump
    std::vector<std::vector<double>> columns_;  ///< the derivative of the state at the start by each name
};

}  // namespace alembert
