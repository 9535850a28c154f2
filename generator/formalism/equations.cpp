// SPDX-License-Identifier: GPL-2.0-or-later
#include "formalism/equations.hpp"

namespace alembert {

Mechanism with_own_intermediates(const Mechanism& mechanism) {
    Mechanism result = mechanism;
    result.z = std::make_shared<Intermediates>(*mechanism.z);
    return result;
}

Mechanism in_terms_of(const Equations& equations, const Mechanism& mechanism) {
    Mechanism result = mechanism;
    equations.z->adopt(*mechanism.z);
    result.z = equations.z;
    return result;
}

}  // namespace alembert
