// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Checks that the masses and moments of inertia of a scene are physically possible, at the numbers of a run,
/// including replaced parameters.
///
///     scene.toml:12:1: warning: the principal moments of inertia of body 'B', 1, 1 and 3, break the
///     triangle inequality 1 + 1 >= 3 …
///
/// Moments are checked about the mass centre, whatever the point about which the scene gives them.

#include "model/mechanism.hpp"
#include "program/interpret.hpp"

namespace alembert {

/// For each element of the mechanism its mass and, if it rotates, its six moments about the mass centre, xx yy zz
/// xy yz zx, and the first three as the scene gives them.
std::vector<GiNaC::ex> masses_and_moments(const Mechanism& mechanism);

/// Whether the principal moments of an element are of a body of the scene, so that none of them may be negative.
bool has_own_moments(const Scene& scene, const MassElement& element);

/// Lowers the masses and moments once, for many sets of numbers. The arguments must outlive it.
class InertiaCheck {
public:
    InertiaCheck(const Scene& scene, const Mechanism& mechanism);

    /// Errors are a mass that is negative or not a number, and a negative principal moment; a broken triangle
    /// inequality is a warning. The single moment of a planar scene has no triangle inequality. `state` has the
    /// parameters, and q if moments are given about another point.
    std::vector<Diagnostic> findings(const State<double>& state) const;

    /// What says that next to nothing is left of a mass that there was at the start; nothing if all are left.
    std::optional<std::string> used_up(const State<double>& start, const State<double>& now) const;

private:
    /// The place in the scene: that of the body's inertia, else that of the name of the body or the particle.
    Place place_of(const Origin& origin) const;
    /// `given` is the largest moment in the scene, about the point given there.
    void add_moments(std::vector<Diagnostic>& found, const Body& body, const std::array<double, 6>& I,
                     double given) const;

    const Scene& scene_;
    const Mechanism& m_;
    Program program_;
    std::vector<int> nodes_;  ///< masses_and_moments
};

}  // namespace alembert
