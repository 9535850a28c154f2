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

    /// Why the state in which these events have left it cannot be: the energy has no finite value there. `after`
    /// has what they have set.
    std::optional<std::string> without_energy(const std::vector<int>& events, const State<double>& after) const;
    /// "event 'flip' sets k to -k = -1", of all that these events set.
    std::string what_is_set(const std::vector<int>& events, const State<double>& after) const;

    /// For each event, the side to which its value goes if its zero has just been passed. If the jump of the rates
    /// has changed the value, that is the sign of the value; otherwise it is the sign of its rate, or of its
    /// second derivative if the rate is zero. Nothing is said of values that hold multipliers.
    std::vector<PassedZero> passed(const State<double>& before, const State<double>& after) const;

    /// For each event, whether its value holds multipliers.
    const std::vector<bool>& of_multipliers() const { return holds_multipliers_; }
    /// Whether it changes only where events set states: states without a rate are all that moves it.
    const std::vector<bool>& of_modes() const { return holds_modes_alone_; }
    /// The value of an event that holds no multipliers.
    double value(std::size_t event, const State<double>& state) const {
        return interpret(program_, state)[static_cast<std::size_t>(values_[event])];
    }

    /// The scene's speeds from the rates.
    std::vector<double> speeds(const State<double>& state) const;

private:
    Program program_;
    std::vector<int> values_, slopes_, bends_, speeds_;
    std::optional<int> energy_ = {};                      ///< T − V, where events set states
    std::vector<std::vector<int>> impulses_, gradients_;  ///< nodes for each event
    struct Given {
        int index;  ///< of a state or coordinate
        int node;
        std::string text;
    };
    using Setters = std::vector<std::pair<int, const Given*>>;  ///< the events that set a state
    double set_in_turn(const Setters& setters, std::size_t at, const State<double>& before) const;
    std::optional<Setters> other_order(const Setters& setters, std::size_t at, const State<double>& before) const;
    std::string contradiction(const Setters& setters, const Setters& other, std::size_t at,
                              const State<double>& before) const;
    std::string not_finite(int event, const std::string& what, const Given& given, double t) const;
    std::vector<bool> holds_multipliers_, holds_modes_alone_;  ///< for each event
    std::vector<std::vector<Given>> set_, rates_;
    std::vector<std::map<std::string, std::string>> texts_;  ///< of impulses, by coordinate
    std::vector<std::string> names_, coordinates_, states_;
};

}  // namespace alembert
