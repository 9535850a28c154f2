// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/multipliers.hpp"

namespace alembert {

std::vector<GiNaC::symbol> multipliers_of(const Mechanism& m) {
    std::vector<GiNaC::symbol> result;
    for (const auto* list : {&m.constraints, &m.redundant})
        for (const Mechanism::Constraint& c : *list) result.push_back(c.multiplier);
    for (const Mechanism::Unilateral& u : m.unilateral) result.push_back(u.gap.multiplier);
    return result;
}

}  // namespace alembert
