// SPDX-License-Identifier: MIT
#pragma once

/// The result of an integration: rows on the sample grid, events, statistics, and the reason why it ended.
///
///     const Trajectory motion = integrate(rhs, initial, options);
///     for (std::size_t row = 0; row < motion.rows(); ++row)
///         … motion.times[row], motion.state(row)[0] …
///     if (motion.failure) throw_failure(*motion.failure);       // or keep what there is
///
/// Rows stand at start, start + sample, start + 2 sample … and always once at the last time. That is exactly start
/// + duration, or the time of the event that stopped the run, or the time of the last good state if the run
/// failed. States are row-major, in the units of the scene, quadratures last. A state on a row between steps comes
/// from dense output.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace alembert {

enum class Ending { completed, stopped_by_event, failed };

enum class FailureKind {
    not_a_number,    ///< a rate is infinite or not a number where a step must start
    step_underflow,  ///< the step has become shorter than 16 ε |t|, so that time hardly advances
    budget_used_up,
    no_contact_mode,   ///< contacts that cannot all stay closed or open (hybrid_motion.hpp)
    impossible_event,  ///< an event sets what cannot be, or there are no rates after its impulses
                       ///< (hybrid_motion.hpp)
    endless_kicks,     ///< infinitely many impulses in a finite time (hybrid_motion.hpp)
    no_side  ///< a sign in the right-hand side has no consistent value, or more than one (filippov_system.hpp)
};

struct Failure {
    FailureKind kind = FailureKind::not_a_number;
    std::string message;        ///< what happened, when, and what to do
    double time = 0;            ///< the time of the last good state
    std::vector<double> state;  ///< the last good state
    int component = -1;  ///< the component responsible: not finite, or with the largest scaled error; -1: none
};

struct EventRecord {
    int index = 0;  ///< the number of the event in the list
    std::string name;
    double time = 0;
    std::vector<double> state;
    /// The generalized impulse, by coordinate, if the event has one (hybrid_motion.hpp).
    std::vector<double> impulse = {};
    double energy_gain = 0;  ///< the work of the impulse, ½ impulse·(q'⁻ + q'⁺)
    /// The contacts closed before it, where these are not those of its phase, because another event of the instant
    /// has changed them.
    std::optional<std::vector<int>> closed = {};
    double width = 0;  ///< of a touch: its value is zero to rounding as long as that before and after it, in s
};

/// An event that is zero at the instant where an event has stopped the run.
struct LastZero {
    int event = 0;
    int direction = 0;     ///< +1: the value grows; −1: it falls
    bool counts = false;   ///< whether that is the event's direction
    bool touches = false;  ///< whether the value goes back to where it came from
    double width = 0;      ///< the value is zero to rounding as long as that before and after it, in s
};

/// The change from one method to another, or back.
struct Switch {
    enum class Why {
        stiff,   ///< stability limits the steps
        mild,    ///< it would not limit the steps of the explicit method any more
        dear,    ///< the steps of the method for stiff systems cost more than those of the other did
        stuck,   ///< the steps of the method became very short (Options::when_stuck)
        cheaper  ///< a power series was predicted to cost less (Options::when_cheaper)
    };
    double time = 0;
    std::string method;         ///< the method with which the run went on
    double largest_eigenvalue;  ///< the modulus of the largest eigenvalue of ∂f/∂y at that time, 1/s
    double step;                ///< the step at that time, in s
    Why why = Why::stiff;
    double effort_per_time = 0;  ///< of the method until then (cost_model.hpp)
};

struct Statistics {
    long steps = 0;  ///< accepted steps
    long rejected = 0;
    long evaluations = 0;                 ///< of the right-hand side, those for dense output and events included
    long work = 0;                        ///< the same, a series counting as the evaluations that take as long
    double seconds = 0;                   ///< processor time of this thread, without setting up the system
    std::string method;                   ///< the method at the start
    std::optional<Switch> switched = {};  ///< the first change of method
    std::vector<Switch> later_switches = {};
    std::optional<double> passed_place =
        {};  ///< where a step of fixed length first passed a place (quick_places.hpp)
};

struct Trajectory {
    int dimension = 0;
    std::vector<std::string> names;  ///< names of the components; may be empty
    std::vector<double> times;
    std::vector<double> states;  ///< rows() × dimension
    std::vector<EventRecord> events;
    std::vector<LastZero> last_zeros =
        {};  ///< all events that are zero where one of them has stopped the run, in the order of `events`
    Statistics statistics;
    Ending ending = Ending::completed;
    std::optional<Failure> failure;  ///< has a value if and only if `ending` is `failed`

    std::size_t rows() const { return times.size(); }
    std::span<const double> state(std::size_t row) const {
        const auto width = static_cast<std::size_t>(dimension);
        return std::span(states).subspan(row * width, width);
    }
    std::span<const double> final_state() const { return state(rows() - 1); }
};

/// Throws the failure as an IntegrationError, for callers who want no partial result.
[[noreturn]] void throw_failure(const Failure& failure);

/// Appends the rows, events and statistics of `next`, whose ending becomes that of the whole. The row at which the
/// two meet is kept once, and only if it is on the grid of rows, `grid` + k·`sample`.
void append(Trajectory& first, Trajectory next, double grid, double sample);

}  // namespace alembert
