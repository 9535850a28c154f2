// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/mass_watch.hpp"

#include <algorithm>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"

namespace alembert {

MassWatch::MassWatch(const Derived& derived, std::vector<double> parameters, std::size_t speeds)
    : MassWatch(derived, std::move(parameters), speeds,
                std::make_shared<const InertiaCheck>(derived.scene, derived.mechanism)) {}

MassWatch::MassWatch(const Derived& derived, std::vector<double> parameters, std::size_t speeds,
                     std::shared_ptr<const InertiaCheck> check)
    : derived_(derived), parameters_(std::move(parameters)), speeds_(speeds), check_(std::move(check)) {}

void MassWatch::operator()(double t, std::span<const double> state) const {
    for (const Diagnostic& found : check_->findings(pose_at(t, state)))
        if (found.severity == Severity::error)
            throw IntegrationError(say("at t = {:.6g} {}", t, found.message), t, {});
}

std::optional<std::string> MassWatch::used_up(const Instant& start, const Instant& now) const {
    return check_->used_up(pose_at(start.t, start.state), pose_at(now.t, now.state));
}

/// The state with the rates of the coordinates 0, on which masses cannot depend.
State<double> MassWatch::pose_at(double t, std::span<const double> state) const {
    const std::size_t n = derived_.mechanism.q.size(), z = derived_.mechanism.states.size();
    const auto at = [&](std::size_t k) { return state.begin() + static_cast<std::ptrdiff_t>(k); };
    State<double> pose{.parameters = parameters_, .t = t, .q = {at(0), at(n)}, .qdot = {}, .qddot = {}};
    pose.qdot.assign(n, 0);
    pose.qdot.insert(pose.qdot.end(), at(n + speeds_ - z), at(n + speeds_));
    return pose;
}

bool changes_masses(const Scene& scene) {
    return !changing_masses(scene).empty();
}

std::vector<std::string> changing_masses(const Scene& scene) {
    std::vector<std::string> names;
    for (const Particle& one : scene.particles)
        if (one.leaves) names.push_back(one.name.text);
    return names;
}

Scene with_masses_watched(Scene scene) {
    for (const Particle& one : scene.particles)
        if (one.leaves)
            scene.events.push_back({.name = {"mass of " + one.name.text, one.name.place},
                                    .when = one.mass,
                                    .stop = true,
                                    .direction = -1});
    return scene;
}

}  // namespace alembert
