// SPDX-License-Identifier: MIT
#pragma once

/// What the driver (driver.hpp) needs of a stepper: one step of a method after the other, from a state on.
///
///     step.attempt(t + h);                     // a step that ends there
///     if (step.error_norm() <= tolerance)      // the largest error of a component
///         if (step.finish())                   // the rate at the end; false: something is not finite
///             step.interpolate(0.5, middle);   // the state anywhere in the step, θ = 0…1
///     step.advance();                          // the end becomes the start
///
/// `SomeStepper` is what every stepper has; each of the other concepts is an ability that some have, with what the
/// driver does where it is missing. There are two kinds of steppers: ExplicitRK (explicit_rk.hpp) of a tableau and
/// FormulaStepper (formula_stepper.hpp) of a formula. The table of methods (method_table.hpp) checks each of its
/// rows.

#include <concepts>
#include <functional>
#include <span>

#include "alembert/ode/rhs.hpp"

namespace alembert {

template <class S>
concept SomeStepper = requires(S step, const S& now, const Rhs& rhs, std::span<const double> start, double number,
                               double* state, const std::function<void(double, double*)>& project) {
    // From the system, the time, the state and the tolerance.
    S(rhs, number, start, number);
    // Whether all steps have the length that is asked for, without an estimated error.
    { S::has_fixed_step } -> std::convertible_to<bool>;
    // The order of the error estimate, from which the first step follows; 1 with fixed steps.
    { S::estimate_order } -> std::convertible_to<int>;
    // The start of the step: time, state, rate. The pointers hold until the next `advance`.
    { now.time() } -> std::same_as<double>;
    { now.state() } -> std::same_as<const double*>;
    { now.rate() } -> std::same_as<const double*>;
    // Its end and its length, after `attempt`; the rate at the end after `finish`.
    { now.end_time() } -> std::same_as<double>;
    { now.length() } -> std::same_as<double>;
    { now.end_state() } -> std::same_as<const double*>;
    { now.end_rate() } -> std::same_as<const double*>;
    // The system, the evaluations so far, and the most of one step.
    { now.rhs() } -> std::same_as<const Rhs&>;
    { now.evaluations() } -> std::same_as<long>;
    { now.most_evaluations() } -> std::same_as<int>;
    // Whether the first rate is finite; the component that is to blame for a failure.
    { now.starts_finite() } -> std::same_as<bool>;
    { now.worst_component() } -> std::same_as<int>;
    step.attempt(number);
    { step.error_norm() } -> std::same_as<double>;
    // Moves the end onto the constraints.
    step.correct(project);
    { step.finish() } -> std::same_as<bool>;
    step.interpolate(number, state);
    step.advance();
};

/// Chooses the length of the next step itself, together with other things: an order, or whether to keep a
/// factorization. Others have StepSize (step_size.hpp).
template <class S>
concept ChoosesLength = requires(S step, bool accepted, double ratio) {
    { step.next_length(accepted, ratio) } -> std::same_as<double>;
};

/// Knows the motion ahead as a power series. So it knows how long its first step may be, for which others need an
/// evaluation; whether it has passed over something, which others are looked through for; and what one of its
/// evaluations costs, where one of others costs as much as the right-hand side. It may also take fixed steps.
template <class S>
concept KnowsSeries = requires(S step, const S& now) {
    { step.first_length() } -> std::same_as<double>;
    { step.foresees_end() } -> std::same_as<bool>;
    { now.effort() } -> std::same_as<double>;
};

/// Knows −hλ up to which it is stable. That of others stands in the table of methods.
template <class S>
concept KnowsStableInterval = requires(const S& now) {
    { now.stable_interval() } -> std::same_as<double>;
};

/// Knows what part of its error estimate may be rounding. For others RoundingWatch finds it (rounding_watch.hpp).
template <class S>
concept KnowsRounding = requires(const S& now) {
    { now.rounding() } -> std::same_as<double>;
};

/// Knows the modulus of the largest eigenvalue of ∂f/∂y, by which a run may come back from it to an explicit
/// method. Of others it counts as 0.
template <class S>
concept KnowsEigenvalue = requires(const S& now) {
    { now.largest_eigenvalue() } -> std::same_as<double>;
};

/// Solves equations in a step, and tells whether that went well. Others fail only by numbers that are not finite.
template <class S>
concept SolvesEquations = requires(const S& now) {
    { now.solved() } -> std::same_as<bool>;
};

/// Takes few long steps, so that the change of the last two is expected of the next one (StepSize). Others have
/// steps enough to follow.
template <class S>
concept PredictsLength = requires {
    requires S::predicts_length;
};

/// Is told where the run ends, because it makes use of it. Others need not know.
template <class S>
concept PlansToTheEnd = requires(S step, double end) {
    step.end_run_at(end);
};

}  // namespace alembert
