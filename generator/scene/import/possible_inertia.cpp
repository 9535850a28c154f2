// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/import/possible_inertia.hpp"

#include "alembert/base/inertia.hpp"
#include "base/language/say.hpp"
#include "scene/text.hpp"

namespace alembert {

std::optional<std::string> impossible_inertia(const std::string& link, const Real33& own, double mass) {
    constexpr double square_of_micrometre = 1e-12;
    const double scale = mass * square_of_micrometre / rounded_moment;
    const PrincipalAxes<> principal = principal_axes<double>(own);
    const Real3& moments = principal.moments;
    if (has_negative_moment(principal, scale))
        return say(
            "the principal moments of inertia of link {}, {:.6g}, {:.6g} and {:.6g}, are not all zero or more; no "
            "body has them",
            in_quotes(link), moments[0], moments[1], moments[2]);
    if (breaks_triangle_inequality(principal, scale))
        return say(
            "the principal moments of inertia of link {} break the triangle inequality: {:.6g} + {:.6g} is less "
            "than {:.6g}; no body has them (--mend-inertia takes the nearest that a body has)",
            in_quotes(link), moments[0], moments[1], moments[2]);
    return std::nullopt;
}

}  // namespace alembert
