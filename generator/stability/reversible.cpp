// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/reversible.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/language/say.hpp"
#include "stability/exact_field.hpp"
#include "stability/periodic.hpp"

namespace alembert {

Decision by_reversal(const Local& local, const std::vector<RootOf>& roots) {
    const Mechanism& m = local.mechanism;
    RealBall square = 0;  // the sum of the squares of the eigenvalues, −2ω²
    for (int i = 0; i < local.A.rows; ++i)
        for (int k = 0; k < local.A.rows; ++k) square += local.A(i, k) * local.A(k, i);
    if (square.sign() != -1 || !m.unilateral.empty() || changes_with_time(m, local.equations)) return {};
    for (const RootOf& root : roots)
        if (root.side == RootOf::Side::left || root.side == RootOf::Side::right) return {};
    const ExactField field(local.residuals, local.split);
    const std::vector<int> cyclic = local.cyclic();
    for (std::size_t j = 0; j < local.split.u.size(); ++j) {
        const int speed = local.split.u[j];
        if (!local.point.u[speed].is_zero() || !field.is_reversed_with(j, cyclic)) continue;
        return {StabilityVerdict::stable, StabilityTheorem::reversible,
                say("the equations do not change if {} and t change their signs, and one pair of "
                    "eigenvalues +-{:.8g}i is on the imaginary axis: all motions near this one are "
                    "periodic in what is not cyclic, about steady motions near this one",
                    local.equations.u[speed].get_name(), std::sqrt(-square.number() / 2))};
    }
    return {};
}

}  // namespace alembert
