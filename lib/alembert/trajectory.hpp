// SPDX-License-Identifier: MIT
#pragma once

/// What an integration gives: rows on the sample grid, events, statistics, and why it ended.
///
///     const Trajectory motion = integrate(rhs, initial, options);
///     for (std::size_t row = 0; row < motion.rows(); ++row)
///         … motion.times[row], motion.state(row)[0] …
///     if (motion.failure) throw_failure(*motion.failure);       // or keep what there is
///
/// Rows: start, start + sample, start + 2 sample … and the last time always, once: exactly start + duration, or
/// the time of the event that stopped the run, or of the last good state if the numbers failed. States are
/// row-major, in the units of the scene, quadratures last. A state on a row between steps comes from dense output.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace alembert {

enum class Ending { completed, stopped_by_event, failed };

enum class FailureKind {
    not_a_number,    ///< a rate is infinite or not a number where a step must start
    step_underflow,  ///< the step has become so short that time stands still: 16 ε |t|
    budget_used_up,
    no_contact_mode,  ///< contacts that cannot all stay closed or open (phases.hpp)
    endless_kicks,    ///< impulses of events that have no rates after, or come without end (phases.hpp)
    no_side           ///< a sign in the right-hand side of which no value, or more than one, is consistent
                      ///< (switching.hpp)
};

struct Failure {
    FailureKind kind = FailureKind::not_a_number;
    std::string message;        ///< what happened, when, and what to do
    double time = 0;            ///< of the last good state
    std::vector<double> state;  ///< the last good one
    int component = -1;         ///< the one to blame: not finite, or of the largest scaled error; -1: none
};

struct EventRecord {
    int index = 0;  ///< in the list of events
    std::string name;
    double time = 0;
    std::vector<double> state;
    std::vector<double> impulse = {};  ///< generalized, by coordinate, where the event has one (phases.hpp)
    double energy_gain = 0;            ///< by it: ½ impulse·(q'⁻ + q'⁺)
};

/// A zero where an event has stopped the run.
struct LastZero {
    int event = 0;
    int direction = 0;    ///< +1: the value grows, −1: falls
    bool counts = false;  ///< that is the event's direction
};

/// An explicit method that gave way to one for stiff systems.
struct Switch {
    double time = 0;
    std::string method;         ///< that the run went on with
    double largest_eigenvalue;  ///< of ∂f/∂y then, in size, 1/s
    double step;                ///< s, at which the first method had come to be held
};

struct Statistics {
    long steps = 0;  ///< accepted
    long rejected = 0;
    long evaluations = 0;  ///< of the right-hand side, those for dense output and events included
    double seconds = 0;    ///< processor time of this thread, without set-up of the system
    std::string method;    ///< the one of the start
    std::optional<Switch> switched = {};
};

struct Trajectory {
    int dimension = 0;
    std::vector<std::string> names;  ///< of the components; may be empty
    std::vector<double> times;
    std::vector<double> states;  ///< rows() × dimension
    std::vector<EventRecord> events;
    std::vector<LastZero> last_zeros =
        {};  ///< all events that are zero where one has stopped the run, in the order of `events`
    Statistics statistics;
    Ending ending = Ending::completed;
    std::optional<Failure> failure;  ///< there if and only if ending is `failed`

    std::size_t rows() const { return times.size(); }
    std::span<const double> state(std::size_t row) const {
        const auto width = static_cast<std::size_t>(dimension);
        return std::span(states).subspan(row * width, width);
    }
    std::span<const double> final_state() const { return state(rows() - 1); }
};

/// Throws the failure as an IntegrationError, for callers who want no partial result.
[[noreturn]] void throw_failure(const Failure& failure);

/// Adds the rows, events and statistics of what follows; how it ended is how all ended. The row where the two meet
/// stands once, and only if it is on the grid of rows, `grid` + k·`sample`.
void append(Trajectory& first, Trajectory next, double grid, double sample);

}  // namespace alembert
