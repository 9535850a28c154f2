// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Do the masses and moments of inertia of a scene belong to bodies that can be? At the numbers that a run has,
/// replaced parameters among them.
///
///     scene.toml:12:1: warning: the principal moments of inertia of body 'B', 1, 1 and 3, break the
///     triangle inequality 1 + 1 >= 3 …
///
/// Moments are looked at about the mass centre, whatever point the scene gives them about.

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// The masses and moments are lowered once, for many numbers. What it is given must outlive it.
class InertiaCheck {
public:
    InertiaCheck(const Scene& scene, const Mechanism& mechanism);

    /// Errors: a mass that is negative or no number, a negative principal moment. Warnings: a broken triangle
    /// inequality. A planar scene's one moment has no triangle to break. `state`: with parameters, and q where
    /// moments are about another point.
    std::vector<Diagnostic> findings(const State<double>& state) const;

private:
    /// Where the scene says it: the body's inertia, else the name of the body or the particle.
    Place place_of(const Origin& origin) const;
    /// `given`: the largest moment as the scene gives it, about whatever point.
    void add_moments(std::vector<Diagnostic>& found, const Body& body, const std::array<double, 6>& I,
                     double given) const;

    const Scene& scene_;
    const Mechanism& m_;
    Program program_;
    std::vector<int>
        nodes_;  ///< of each element: its mass, and where it turns its six moments, and three as given
};

}  // namespace alembert
