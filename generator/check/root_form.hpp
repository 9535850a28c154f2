// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A claim with one square root, in the form A + B √s. If A² = B² s on every motion, the claim holds for one sign
/// of the root at each state: on the branch on which −A/B > 0.
///
///     x = r*cos(th) + sqrt(l^2 - r^2*sin(th)^2)      // of a slider-crank: proved where x − r cos(th) > 0

#include <optional>
#include <vector>

#include "check/claims.hpp"

namespace alembert {

struct RootForm {
    GiNaC::ex norm;  ///< A² − B² s
    GiNaC::ex root;  ///< −A/B, which is √s or −√s where `norm` vanishes
};

/// Nothing if there is no root, or more than one, or if the expression is too long.
std::optional<RootForm> root_form(const GiNaC::ex& residual, const Mechanism& mechanism);

/// Every s of which the square root stands in the expression; none if it is too long.
std::vector<GiNaC::ex> squares_in(const GiNaC::ex& residual, const Mechanism& mechanism);

/// x with x² = s on the constraints, from one of them that is quadratic in a coordinate: of a q² + b q + c = 0, a
/// multiple of 2 a q + b, whose square is b² − 4 a c. Nothing if no constraint is of this kind.
std::optional<GiNaC::ex> root_of_positions(const GiNaC::ex& s, const Mechanism& mechanism);

}  // namespace alembert
