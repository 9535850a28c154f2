// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the runtime must know of the scene's events where their impulses act (alembert/phases.hpp), by interpretation.
///
///     const KickView view(mechanism);
///     view.impulse(0, state);                 // Q̂ of event 0, of the rates in `state`
///     view.passed(before, after);             // Event::start of all events
///
/// States hold rates, q' and not speeds, and q'' where `passed` is asked.

#include <Eigen/Dense>
#include <vector>

#include "lower/interpret.hpp"
#include "model/mechanism.hpp"

namespace alembert {

class KickView {
public:
    explicit KickView(const Mechanism& mechanism);

    /// n; of an event that has impulses.
    Eigen::VectorXd impulse(int event, const State<double>& state) const;

    /// For each event the value to start from where its zero has just been passed: as it is where the jump of the rates has changed
    /// it, else something tiny on the side to which it goes, zero where its rate is gone.
    std::vector<double> passed(const State<double>& before, const State<double>& after) const;

    /// Of the scene, from the rates.
    std::vector<double> speeds(const State<double>& state) const;

private:
    Program program_;
    std::vector<int> values_, slopes_, speeds_;
    std::vector<std::vector<int>> impulses_;  ///< by event
};

}  // namespace alembert
