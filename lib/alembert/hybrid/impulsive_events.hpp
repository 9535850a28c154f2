// SPDX-License-Identifier: MIT
#pragma once

/// Impulsive events, or kicks: events of the scene that apply impulses at their zeros, set states, or are counted.
/// This header has what the scene must provide for them and what a run must remember.
///
///     Contacts contacts{.kicks = {.events = {true}, .impulses = …, .passed = …}};
///     const HybridMotion motion = follow(contacts, modes, initial, options);        // hybrid_motion.hpp
///     motion.events[0].energy_gain;
///
/// Rounding must not repeat a zero that has just been passed: the event's value is held on the side to which it
/// moves until it has risen above rounding (`held_from`). Infinitely many kicks in a finite time are
/// recognized when the distance that the value travels from zero to zero falls below the tolerance, or the time
/// between kicks below rounding, after both were larger, and where the times shrink by one ratio (`KickSeries`).

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "alembert/hybrid/held_guard.hpp"
#include "alembert/ode/events.hpp"
#include "alembert/ode/trajectory.hpp"

namespace alembert {

/// What is known about the value of an event at an instant where rates have jumped, so that rounding does not
/// decide whether its zero has been passed.
struct PassedZero {
    bool is_zero = false;  ///< whether its value is zero to rounding
    int side = 0;          ///< the side to which its value moves: +1, −1, or 0 if that is not known
    double hold = 0;       ///< the time in seconds for which it counts as being there, whatever rounding says
    double band = 0;       ///< values up to this size count as zero, if the value does not leave zero, for example
                           ///< because its own contact is closed
    double slope = 0;      ///< the rate of the value before the jump
    double size = 0;       ///< the size of the terms of its value and of what coordinates of size max(1, |q|)
                           ///< contribute; errors are measured relative to it
};

/// The generalized impulses of events of one instant, one for each; empty where an event gives none.
struct Impulses {
    std::vector<Eigen::VectorXd> list = {};
    std::optional<std::string> refusal = {};  ///< why there are none, where that is so
};

/// All states here are (q, q', …), whichever speeds the run integrates.
struct ImpulsiveEvents {
    std::vector<bool> events = {};  ///< which of the scene's events kick; if empty, none does
    /// `before` is the state before the events, `set` the same with what they set, which gives the masses.
    std::function<Impulses(const std::vector<int>& events, double t, const double* before, const double* set)>
        impulses = {};
    /// One for each event of the scene. `acceleration` is q'' after the jump; it may be empty.
    std::function<std::vector<PassedZero>(double t, const double* before, const double* after,
                                          const Eigen::VectorXd& acceleration)>
        passed = {};
    int coordinates = 0;         ///< n
    std::vector<int> last = {};  ///< at which of its zeros an event ends the run; 0 or missing: at none
    std::vector<bool> of_modes =
        {};  ///< whether the value of an event changes only where events set states; missing: it does not
    std::vector<bool> of_multipliers = {};  ///< whether it holds multipliers; missing: it does not
    /// Sets what follows q' in `after`; `before` is the state before these events of one instant. Returns why
    /// that cannot be, or nothing. May be empty.
    std::function<std::optional<std::string>(const std::vector<int>& events, double t, const double* before,
                                             double* after)>
        set = {};
    /// Called where events have set something, before their impulses act. May be empty.
    std::function<void(double t, const double* before, const double* after)> on_set = {};
    /// Why the state after the impulses is not what an event wants; nothing if it is. May be empty.
    std::function<std::optional<std::string>(int event, double t, const double* before, const double* after)>
        refusal = {};
    /// The speeds that the run integrates in place of the rates; if empty, it integrates the rates.
    std::function<std::vector<double>(double t, const double* state)> speeds = {};

    bool any() const { return std::find(events.begin(), events.end(), true) != events.end(); }
    int last_of(std::size_t event) const { return event < last.size() ? last[event] : 0; }
    bool is_of_modes(std::size_t event) const { return event < of_modes.size() && of_modes[event]; }
    bool is_of_multipliers(std::size_t event) const {
        return event < of_multipliers.size() && of_multipliers[event];
    }
    bool looks_at_forces() const {
        return std::find(of_multipliers.begin(), of_multipliers.end(), true) != of_multipliers.end();
    }
    bool has(std::size_t event) const { return event < events.size() && events[event]; }
};

/// Converts the state that the run integrates to (q, q', …), and back; if the run integrates rates, the state is
/// unchanged. `rhs` gives q' in its first places.
std::vector<double> in_rates(const ImpulsiveEvents& kicks, const Rhs& rhs, double t,
                             const std::vector<double>& state);
std::vector<double> as_integrated(const ImpulsiveEvents& kicks, double t, const std::vector<double>& rates);

/// How an event that has just been passed is held from `start` on.
HeldGuard held_from(double start, const PassedZero& passed);

/// The series of kicks of one event.
class KickSeries {
public:
    /// Adds a kick. Returns the reason why the run cannot go on, or nothing if it can.
    std::optional<std::string> add(const std::string& name, double t, const LastZero& zero,
                                   const PassedZero& passed, double tolerance, double duration);

private:
    std::vector<double> times_;
    double longest_ = 0;                              ///< the longest time between two kicks
    int lost_ = 0;                                    ///< how many of the last kicks are too near to each other
    double last_flight_ = HUGE_VAL, last_ratio_ = 0;  ///< the last time between two, as a part of the one before
    int alike_ = 0;                                   ///< how many ratios in succession were the same
};

}  // namespace alembert
