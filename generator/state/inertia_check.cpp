// SPDX-License-Identifier: GPL-2.0-or-later
#include "state/inertia_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/inertia.hpp"
#include "formalism/elements.hpp"
#include "lower/lower.hpp"

namespace alembert {

std::vector<Diagnostic> inertia_findings(const Scene& scene, const Mechanism& m, const State<double>& state) {
    Program program;
    std::vector<GiNaC::ex> wanted;
    for (const MassElement& element : m.masses) {
        wanted.push_back(element.mass);
        if (!element.rotation) continue;
        const std::array<GiNaC::ex, 6> I = central_inertia(element, *m.z);
        wanted.insert(wanted.end(), I.begin(), I.end());
    }
    const std::vector<int> nodes = lower_expressions(program, m, wanted);
    State<double> here = state;
    here.qdot.assign(m.q.size(), 0);
    const std::vector<double> value = interpret(program, here);

    std::vector<Diagnostic> found;
    std::size_t next = 0;
    for (const MassElement& element : m.masses) {
        const auto body = element.origin.kind == Origin::Kind::body ? scene.bodies.begin() + element.origin.index
                                                                    : scene.bodies.end();
        const Place place = body != scene.bodies.end() && body->inertia ? body->inertia->place
                            : body != scene.bodies.end()                ? body->name.place
                                                                        : Place{};
        if (const double mass = value[nodes[next++]]; mass < 0)
            found.push_back({place, fmt::format("the mass of {} is {}; expected zero or more", label(element.origin), mass)});
        if (!element.rotation) continue;
        std::array<double, 6> I;
        for (double& entry : I) entry = value[nodes[next++]];
        if (body == scene.bodies.end() || !body->inertia || !std::all_of(I.begin(), I.end(), [](double x) { return std::isfinite(x); }))
            continue;
        const std::string about = body->about ? fmt::format(" (about its mass centre; they are given about '{}')", body->about->text) : "";
        if (body->inertia->planar) {
            if (I[2] < 0)
                found.push_back({place, fmt::format("the moment of inertia of body '{}' is {}{}; expected zero or more",
                                                    body->name.text, I[2], about)});
            continue;
        }
        const PrincipalAxes<> own = principal_axes<double>(inertia_matrix<double>({I[0], I[1], I[2], I[3], I[4], I[5]}));
        const std::string moments = fmt::format("the principal moments of inertia of body '{}'{}, {:.6g}, {:.6g} and {:.6g},", body->name.text,
                                                about, own.moments[0], own.moments[1], own.moments[2]);
        if (has_negative_moment(own))
            found.push_back({place, moments + " are not all zero or more; no body has them"});
        else if (breaks_triangle_inequality(own))
            found.push_back({place,
                             fmt::format("{} break the triangle inequality: {:.6g} + {:.6g} is less than {:.6g}; no distribution of mass "
                                         "has them",
                                         moments, own.moments[0], own.moments[1], own.moments[2]),
                             Severity::warning});
    }
    return found;
}

}  // namespace alembert
