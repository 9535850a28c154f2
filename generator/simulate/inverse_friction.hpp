// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// What dry friction and closed contacts do to the loads of given accelerations (inverse.hpp). Friction that does
/// not slide yet acts against the sliding that the accelerations begin; where they begin none, it bears any force
/// up to a bound.
///
///     const FrictionAtState friction(mechanism, state);
///     minus_f += friction.against(accelerations).load;      // M q'' − f, with friction among the loads of f

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

class FrictionAtState {
public:
    /// The state of coordinates and rates.
    FrictionAtState(const Mechanism& mechanism, const State<double>& state);

    struct Against {
        Eigen::VectorXd load;            ///< along coordinates, to be added to M q'' − f
        std::vector<int> directions;     ///< signs that tell whether the sliding that begins is another one
        std::vector<std::size_t> stuck;  ///< frictions that neither slide nor begin to
    };
    /// Of friction along a line, what the sign of its velocity does not say; of friction in a plane all
    /// (`without_plane_friction`).
    Against against(const Eigen::VectorXd& accelerations) const;

    /// The largest force of friction k while it sticks.
    double bound(std::size_t k) const { return list_[k].bound; }
    const std::string& name(std::size_t k) const { return list_[k].name; }

private:
    /// A sliding velocity v = J q' + …, with one row or two, and the force while it slides.
    struct One {
        std::string name;
        bool is_plane = false, slides = false;
        double force = 0, bound = 0;
        Eigen::VectorXd v, rest;  ///< v, and v' at q'' = 0
        Eigen::MatrixXd J;
    };
    std::vector<One> list_;
};

/// Names of the contacts that are closed at this state and that these accelerations do not open. Throws ModelError
/// for accelerations that go into one.
std::vector<std::string> contacts_not_opened(const Mechanism& mechanism, State<double> state,
                                             const Eigen::VectorXd& accelerations);

}  // namespace alembert
