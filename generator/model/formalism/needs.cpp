// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/formalism/needs.hpp"

#include <stdexcept>

namespace alembert {

const Formalism& formalism_for(Need need) {
    switch (need) {
        case Need::independent:
            return formalism("lagrange");
        case Need::multipliers:
            return formalism("routh");
        case Need::minimal_speeds:
            return formalism("kane");
        case Need::fastest:
            return formalism("recursive");
    }
    throw std::logic_error("a need that no formalism serves");
}

bool serves(const Equations& equations, Need need, const Mechanism& mechanism) {
    const Formalism& wanted = formalism_for(need);
    return equations.formalism == wanted.name ||
           (mechanism.constraints.empty() && equations.formalism == wanted.without_constraints);
}

const Formalism& formalism_in_rates(const Mechanism& mechanism) {
    return formalism_for(mechanism.constraints.empty() ? Need::independent : Need::multipliers);
}

}  // namespace alembert
