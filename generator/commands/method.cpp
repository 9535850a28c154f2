// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/method.hpp"

#include <fmt/format.h>

#include "alembert/error.hpp"

namespace alembert {

namespace {

constexpr double many_steps = 1e4;

MethodChoice automatic(const Request& request, const Derived& d, const Start& start) {
    const auto wish = [](double asked, double scene) { return asked >= 0 ? asked : scene; };
    const double step = wish(request.step, start.step), duration = wish(request.duration, start.duration);
    const double tolerance = wish(request.tolerance, start.tolerance);
    if (step > 0) {
        const double steps = duration / step;
        if (steps >= many_steps && !not_separable(d))
            return {.method = Method::kahanli8,
                    .why = fmt::format("a fixed step was asked for, forces depend on positions alone, and in {:.3g} steps the energy must "
                                       "not drift",
                                       steps)};
        return {.method = Method::rk4, .why = "a fixed step was asked for"};
    }
    const Method method = tolerance > 1e-5 ? Method::dopri5 : tolerance >= 1e-12 ? Method::dop853 : Method::verner98;
    return {.method = method,
            .when_stiff = Method::radau,
            .why = fmt::format("the tolerance is {:g}; if the system turns out stiff, radau goes on", tolerance)};
}

}  // namespace

std::optional<std::string> not_separable(const Derived& d) {
    const Equations& e = d.equations;
    if (!e.h.empty()) return "the equations are in generalized speeds";
    if (!d.mechanism.constraints.empty() || !d.mechanism.unilateral.empty()) return "there are constraints";
    std::vector<GiNaC::symbol> moving = e.q;
    moving.insert(moving.end(), e.u.begin(), e.u.end());
    moving.push_back(d.mechanism.t);
    for (int i = 0; i < e.size(); ++i)
        for (int j = 0; j < e.size(); ++j)
            if (e.z->depends(e.M(i, j), moving)) return fmt::format("the inertia of {} changes with the motion", e.q[i].get_name());
    for (int i = 0; i < e.size(); ++i)
        if (e.z->depends(e.forcing(i), e.u)) return fmt::format("a rate occurs in the equation of {}", e.q[i].get_name());
    return {};
}

MethodChoice method_for(const Request& request, const Derived& d, const Start& start) {
    const std::string given = request.method.empty() ? d.mechanism.run.method : request.method;
    if (given == "auto") return automatic(request, d, start);
    const auto known = method_named(given);
    if (!known) throw ModelError(fmt::format("method '{}' is not supported yet; expected auto, {}", given, method_names()));
    if (needs_separable(*known))
        if (const auto reason = not_separable(d))
            throw ModelError(fmt::format("method '{}' needs kinetic energy of the rates alone and forces of the coordinates and t "
                                         "alone, but {}; take gauss (symplectic for any energy) or dop853", given, *reason));
    return {.method = *known};
}

}  // namespace alembert
