// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/separable.hpp"

#include <fmt/format.h>

#include "base/language/say.hpp"
#include "model/formalism/recursive.hpp"

namespace alembert {

namespace {

/// The coordinate in whose equation a rate occurs.
std::optional<std::string> coordinate_with_rate(const Equations& e, const Intermediates& z,
                                                const std::vector<GiNaC::ex>& forcing) {
    for (std::size_t i = 0; i < forcing.size(); ++i)
        if (z.depends(forcing[i], e.u)) return e.q[i].get_name();
    return std::nullopt;
}

std::optional<std::string> rate_in(const std::optional<std::string>& coordinate) {
    if (!coordinate) return std::nullopt;
    return say("a rate occurs in the equation of {}", *coordinate);
}

}  // namespace

std::optional<std::string> inseparable(const Derived& d) {
    const Equations& e = d.equations;
    if (!e.speeds_are_rates()) return say("the equations are in generalized speeds");
    if (!d.mechanism.states.empty()) return say("the scene has first-order states ([states])");
    if (!d.mechanism.constraints.empty() || !d.mechanism.unilateral.empty()) return say("there are constraints");
    if (e.M.rows() == 0 && e.tree) {
        // Where M changes with a coordinate or with t, its derivative stands in f beside rates.
        const Mechanism m = in_terms_of(e, d.mechanism);
        return rate_in(coordinate_with_rate(e, *m.z, forcing_of_tree(e, m)));
    }
    std::vector<GiNaC::symbol> moving = e.q;
    moving.insert(moving.end(), e.u.begin(), e.u.end());
    moving.push_back(d.mechanism.t);
    std::vector<GiNaC::ex> forcing;
    for (int i = 0; i < e.size(); ++i) {
        forcing.push_back(e.forcing(i));
        for (int j = 0; j < e.size(); ++j)
            if (e.z->depends(e.M(i, j), moving))
                return say("the inertia of {} changes with the motion", e.q[i].get_name());
    }
    return rate_in(coordinate_with_rate(e, *e.z, forcing));
}

void need_separable(const Derived& d, std::string_view method) {
    if (const auto why = inseparable(d))
        throw ModelError(
            say("method '{}' needs kinetic energy of the rates alone and forces of the coordinates and t "
                "alone, but {}; take gauss (symplectic for any energy) or dop853",
                method, *why));
}

}  // namespace alembert
