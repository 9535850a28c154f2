// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Masses that change along a run: it ends where one has become negative.
///
///     std::optional<MassWatch> masses;
///     if (changes_masses(d.scene)) masses.emplace(d, start.parameters, first.qdot.size());
///     if (masses) (*masses)(t, state);         // throws IntegrationError: "at t = 12.6 the mass of … is -0.8"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/derive/derived.hpp"
#include "analysis/state/inertia_check.hpp"

namespace alembert {

class MassWatch {
public:
    /// `speeds` is how many the state has, with the scene's states at their end. `derived` must outlive this.
    MassWatch(const Derived& derived, std::vector<double> parameters, std::size_t speeds);
    /// With a check that many motions share.
    MassWatch(const Derived& derived, std::vector<double> parameters, std::size_t speeds,
              std::shared_ptr<const InertiaCheck> check);

    void operator()(double t, std::span<const double> state) const;

    struct Instant {
        double t;
        std::span<const double> state;
    };
    /// Says of a mass that next to nothing is left of it; nothing if all are left.
    std::optional<std::string> used_up(const Instant& start, const Instant& now) const;

private:
    State<double> pose_at(double t, std::span<const double> state) const;

    const Derived& derived_;
    std::vector<double> parameters_;
    std::size_t speeds_;
    std::shared_ptr<const InertiaCheck> check_;
};

/// Whether a mass of the scene changes along a run.
bool changes_masses(const Scene& scene);

/// The scene with an event, behind its own ones, that stops the motion where nothing is left of a mass that
/// changes: for what is written and runs by itself. They are listed in the order of `changing_masses`.
Scene with_masses_watched(Scene scene);
/// The names of the particles whose masses change.
std::vector<std::string> changing_masses(const Scene& scene);

}  // namespace alembert
