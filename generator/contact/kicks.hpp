// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What the runtime must know of the scene's events where their impulses act (alembert/phases.hpp), by
/// interpretation.
///
///     const KickView view(mechanism);
///     view.impulse(0, state);                 // Q̂ of event 0, of the rates in `state`
///     view.passed(before, after)[0].side;     // to which side the value of event 0 goes
///
/// States hold rates, q' and not speeds, and q'' where `passed` is asked.

#include <Eigen/Dense>
#include <vector>

#include "alembert/kick.hpp"
#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

class KickView {
public:
    explicit KickView(const Mechanism& mechanism);

    /// n; of an event that has impulses.
    Eigen::VectorXd impulse(int event, const State<double>& state) const;

    /// For each event, in case its zero has just been passed. Its value as it is tells where the jump of the rates
    /// has changed it; else the sign of its rate, or of its second derivative where the rate is gone.
    std::vector<PassedZero> passed(const State<double>& before, const State<double>& after) const;

    /// Of the scene, from the rates.
    std::vector<double> speeds(const State<double>& state) const;

private:
    Program program_;
    std::vector<int> values_, slopes_, bends_, speeds_;
    std::vector<std::vector<int>> impulses_, gradients_;  ///< by event
};

}  // namespace alembert
