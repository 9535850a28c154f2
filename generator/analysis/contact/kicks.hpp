// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The values that the runtime needs where the impulses of events act (alembert/hybrid/hybrid_motion.hpp),
/// evaluated by interpretation.
///
///     const KickView view(mechanism, scene);
///     view.set({0}, before, after);               // the states that event 0 sets
///     view.kicks({0}, before).list[0].impulse;    // Q̂ of event 0, of the rates before
///     view.passed(before, after)[0].side;         // to which side the value of event 0 goes
///
/// States have the rates q', not speeds, and for `passed` also q''.

#include <Eigen/Dense>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "alembert/hybrid/impulsive_events.hpp"
#include "model/mechanism.hpp"
#include "program/interpret.hpp"
#include "scene/scene.hpp"

namespace alembert {

class KickView {
public:
    KickView(const Mechanism& mechanism, const Scene& scene);

    /// What events do to the rates.
    struct Kicks {
        struct Kick {  ///< n numbers each; none where the event does nothing of the kind
            Eigen::VectorXd impulse, change_of_rates;
        };
        std::vector<Kick> list;                   ///< a rate that several set is in the first of them
        std::optional<std::string> refusal = {};  ///< why they cannot act: a value is no number, or two differ
    };
    /// Of events of one instant, by the state before them.
    Kicks kicks(const std::vector<int>& events, const State<double>& before) const;
    /// Why the rates after are not those that the event sets.
    std::optional<std::string> refusal(int event, const State<double>& before, const State<double>& after) const;
    /// Puts the values of the states that these events of one instant set into (q, q', states, …). Of a state that
    /// several set, each takes the value that the one before has left. Returns why there is no such value, or none
    /// without asking which event comes first.
    std::optional<std::string> set(const std::vector<int>& events, const State<double>& before,
                                   double* after) const;

    /// For each event, the side to which its value goes if its zero has just been passed. If the jump of the rates
    /// has changed the value, that is the sign of the value; otherwise it is the sign of its rate, or of its
    /// second derivative if the rate is zero. Nothing is known of a value that holds multipliers: its size is
    /// negative.
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
        std::string text;
    };
    std::string not_finite(int event, const std::string& what, const Given& given, double t) const;
    std::vector<bool> holds_multipliers_;  ///< for each event
    std::vector<std::vector<Given>> set_, rates_;
    std::vector<std::map<std::string, std::string>> texts_;  ///< of impulses, by coordinate
    std::vector<std::string> names_, coordinates_, states_;
};

}  // namespace alembert
