// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/inertia_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/inertia.hpp"
#include "base/language/say.hpp"
#include "model/formalism/elements.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

const Body* body_of(const Scene& scene, const Origin& origin) {
    return origin.kind == Origin::Kind::body ? &scene.bodies[static_cast<std::size_t>(origin.index)] : nullptr;
}

}  // namespace

std::vector<GiNaC::ex> masses_and_moments(const Mechanism& m) {
    std::vector<GiNaC::ex> wanted;
    for (const MassElement& element : m.masses) {
        wanted.push_back(element.mass);
        if (!element.rotation) continue;
        const std::array<GiNaC::ex, 6> I = central_inertia(element, *m.z);
        wanted.insert(wanted.end(), I.begin(), I.end());
        wanted.insert(wanted.end(), element.rotation->inertia.begin(), element.rotation->inertia.begin() + 3);
    }
    return wanted;
}

bool has_own_moments(const Scene& scene, const MassElement& element) {
    const Body* const body = body_of(scene, element.origin);
    return element.rotation && body != nullptr && body->inertia;
}

InertiaCheck::InertiaCheck(const Scene& scene, const Mechanism& mechanism) : scene_(scene), m_(mechanism) {
    nodes_ = lower_expressions(program_, m_, masses_and_moments(m_));
}

Place InertiaCheck::place_of(const Origin& origin) const {
    if (const Body* const body = body_of(scene_, origin))
        return body->inertia ? body->inertia->place : body->name.place;
    if (origin.kind == Origin::Kind::particle)
        return scene_.particles[static_cast<std::size_t>(origin.index)].name.place;
    return {};
}

std::vector<Diagnostic> InertiaCheck::findings(const State<double>& state) const {
    State<double> here = state;
    std::fill_n(here.qdot.begin(), m_.q.size(), 0);
    const std::vector<double> value = interpret(program_, here);
    std::vector<Diagnostic> found;
    std::size_t next = 0;
    for (const MassElement& element : m_.masses) {
        if (const double mass = value[nodes_[next++]]; !(mass >= 0))
            found.push_back({place_of(element.origin), say("the mass of {} is {}; expected zero or more",
                                                           shown_label(element.origin), mass)});
        if (!element.rotation) continue;
        std::array<double, 6> I;
        for (double& entry : I) entry = value[nodes_[next++]];
        double given = 0;
        for (int k = 0; k < 3; ++k) given = std::max(given, std::abs(value[nodes_[next++]]));
        if (has_own_moments(scene_, element) &&
            std::all_of(I.begin(), I.end(), [](double x) { return std::isfinite(x); }))
            add_moments(found, *body_of(scene_, element.origin), I, given);
    }
    return found;
}

std::optional<std::string> InertiaCheck::used_up(const State<double>& start, const State<double>& now) const {
    constexpr double next_to_nothing = 1e-9;
    const std::vector<double> before = interpret(program_, start), value = interpret(program_, now);
    std::size_t next = 0;
    for (const MassElement& element : m_.masses) {
        const int node = nodes_[next];
        next += element.rotation ? 10 : 1;
        if (value[node] < next_to_nothing * before[node])
            return say(
                "the mass of {} is {:.3g}, of {:.6g} at the start; let it stop falling before nothing is left, "
                "as with max(0, …) in its rate",
                shown_label(element.origin), value[node], before[node]);
    }
    return std::nullopt;
}

void InertiaCheck::add_moments(std::vector<Diagnostic>& found, const Body& body, const std::array<double, 6>& I,
                               double given) const {
    const Place place = body.inertia->place;
    const std::string about =
        body.about ? say(" (about its mass centre; they are given about '{}')", body.about->text) : "";
    if (body.inertia->planar) {
        if (I[2] < -rounded_moment * given)
            found.push_back({place, say("the moment of inertia of body '{}' is {}{}; expected zero or more",
                                        body.name.text, I[2], about)});
        return;
    }
    const PrincipalAxes<> own =
        principal_axes<double>(inertia_matrix<double>({I[0], I[1], I[2], I[3], I[4], I[5]}));
    const std::string moments = say("the principal moments of inertia of body '{}'{}, {:.6g}, {:.6g} and {:.6g},",
                                    body.name.text, about, own.moments[0], own.moments[1], own.moments[2]);
    if (has_negative_moment(own, given))
        found.push_back({place, say("{} are not all zero or more; no body has them", moments)});
    else if (breaks_triangle_inequality(own, given))
        found.push_back(
            {place,
             say("{} break the triangle inequality: {:.6g} + {:.6g} is less than {:.6g}; no distribution of mass "
                 "has them",
                 moments, own.moments[0], own.moments[1], own.moments[2]),
             Severity::warning, "suspicious_number", body.name.text});
}

}  // namespace alembert
