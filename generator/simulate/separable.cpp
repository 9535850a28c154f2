// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/separable.hpp"

#include <fmt/format.h>

#include "base/language/say.hpp"

namespace alembert {

std::optional<std::string> inseparable(const Derived& d) {
    const Equations& e = d.equations;
    if (!e.speeds_are_rates()) return say("the equations are in generalized speeds");
    if (!d.mechanism.constraints.empty() || !d.mechanism.unilateral.empty()) return say("there are constraints");
    std::vector<GiNaC::symbol> moving = e.q;
    moving.insert(moving.end(), e.u.begin(), e.u.end());
    moving.push_back(d.mechanism.t);
    for (int i = 0; i < e.size(); ++i)
        for (int j = 0; j < e.size(); ++j)
            if (e.z->depends(e.M(i, j), moving))
                return say("the inertia of {} changes with the motion", e.q[i].get_name());
    for (int i = 0; i < e.size(); ++i)
        if (e.z->depends(e.forcing(i), e.u)) return say("a rate occurs in the equation of {}", e.q[i].get_name());
    return std::nullopt;
}

void need_separable(const Derived& d, std::string_view method) {
    if (const auto why = inseparable(d))
        throw ModelError(
            say("method '{}' needs kinetic energy of the rates alone and forces of the coordinates and t "
                "alone, but {}; take gauss (symplectic for any energy) or dop853",
                method, *why));
}

}  // namespace alembert
