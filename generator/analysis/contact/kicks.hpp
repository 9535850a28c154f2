// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The values that the runtime needs where the impulses of events act (alembert/hybrid/hybrid_motion.hpp),
/// evaluated by interpretation.
///
///     const KickView view(mechanism);
///     view.impulse(0, state);                 // Q̂ of event 0, of the rates in `state`
///     view.passed(before, after)[0].side;     // to which side the value of event 0 goes
///     view.set(0, before, after);             // the states that event 0 sets
///
/// States have the rates q', not speeds, and for `passed` also q''.

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "alembert/hybrid/impulsive_events.hpp"
#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

class KickView {
public:
    explicit KickView(const Mechanism& mechanism);

    /// n numbers; none if the event has no impulses.
    Eigen::VectorXd impulse(int event, const State<double>& state) const;

    /// By how much the rates change that the event sets, n numbers; none if it sets none.
    Eigen::VectorXd change_of_rates(int event, const State<double>& before) const;
    /// Why the rates after are not those that the event sets.
    std::optional<std::string> refusal(int event, const State<double>& before, const State<double>& after) const;
    /// Puts the values of the states that the event sets into (q, q', states, …).
    void set(int event, const State<double>& before, double* after) const;

    /// For each event, the side to which its value goes if its zero has just been passed. If the jump of the rates
    /// has changed the value, that is the sign of the value; otherwise it is the sign of its rate, or of its
    /// second derivative if the rate is zero.
    std::vector<PassedZero> passed(const State<double>& before, const State<double>& after) const;

    /// The scene's speeds from the rates.
    std::vector<double> speeds(const State<double>& state) const;

private:
    Program program_;
    std::vector<int> values_, slopes_, bends_, speeds_;
    std::vector<std::vector<int>> impulses_, gradients_;  ///< nodes for each event
    struct Given {
        int index;  ///< of a state or coordinate
        int node;
    };
    std::vector<std::vector<Given>> set_, rates_;
    std::vector<std::string> names_, coordinates_;
};

}  // namespace alembert
