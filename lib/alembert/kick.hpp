// SPDX-License-Identifier: MIT
#pragma once

/// Events of the scene whose zeros bring impulses: what the scene must say of them, and what a run must keep in
/// mind.
///
///     Contacts contacts{.kicks = {.events = {true}, .impulse = …, .passed = …}};
///     const PhasedMotion motion = follow(contacts, modes, initial, options);        // phases.hpp
///     motion.events[0].energy_gain;
///
/// A zero that has just been passed is left to rounding no more: its value is held on the side to which it goes
/// until it has risen above rounding (`with_zeros_passed`). Kicks without end in finite time are recognized where
/// the way of the value from zero to zero comes below the tolerance, or the time below rounding, after it was
/// longer (`KickSeries`).

#include <Eigen/Dense>
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "alembert/events.hpp"
#include "alembert/trajectory.hpp"

namespace alembert {

/// An event where rates have jumped: what of its value is not to be left to rounding if its zero has just been
/// passed.
struct PassedZero {
    bool is_zero = false;  ///< its value is, to rounding
    int side = 0;          ///< to which its value goes: +1, −1, or 0 where that is not known
    double hold = 0;       ///< s, for how long it is there whatever rounding says
    double band = 0;  ///< values of this size are zero, where it does not leave it: its own contact is closed, say
    double slope = 0;  ///< its rate before the jump
    double size = 0;   ///< of the terms of its value, and of what coordinates of size max(1, |q|) make of it: what
                       ///< errors are measured by
};

/// All states are (q, q', …), whatever the run integrates.
struct Kicks {
    std::vector<bool> events = {};  ///< which of the scene's; empty: none
    std::function<Eigen::VectorXd(int event, double t, const double* state)> impulse =
        {};  ///< generalized, of the rates before
    /// For each event of the scene. `acceleration` is q'' after; may be empty.
    std::function<std::vector<PassedZero>(double t, const double* before, const double* after,
                                          const Eigen::VectorXd& acceleration)>
        passed = {};
    int coordinates = 0;  ///< n
    /// The speeds that the run integrates in the place of rates; empty: it integrates the rates.
    std::function<std::vector<double>(double t, const double* state)> speeds = {};

    bool any() const { return std::find(events.begin(), events.end(), true) != events.end(); }
    bool has(std::size_t event) const { return event < events.size() && events[event]; }
};

/// (q, q', …) of what the run integrates, and back; the same where that holds rates. `rhs` gives q' in its first
/// places.
std::vector<double> in_rates(const Kicks& kicks, const Rhs& rhs, double t, const std::vector<double>& state);
std::vector<double> as_integrated(const Kicks& kicks, double t, const std::vector<double>& rates);

/// The same events, of which the first have just been passed as said, from `start` on.
Events with_zeros_passed(const Events& events, std::vector<Event> list, std::vector<PassedZero> passed,
                         double start);

/// The kicks of one event.
class KickSeries {
public:
    /// One more; why this is no way to go on, or nothing.
    std::optional<std::string> add(const std::string& name, double t, const LastZero& zero,
                                   const PassedZero& passed, double tolerance, double duration);

private:
    std::vector<double> times_;
    double longest_ = 0;  ///< time between two of them
    int lost_ = 0;        ///< how many of the last are too near to each other
};

}  // namespace alembert
