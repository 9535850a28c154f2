// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/formalism/equations.hpp"

namespace alembert {

Equations::Equations() = default;
Equations::Equations(const Equations&) = default;
Equations::Equations(Equations&&) noexcept = default;
Equations& Equations::operator=(const Equations&) = default;
Equations& Equations::operator=(Equations&&) noexcept = default;
Equations::~Equations() = default;

Mechanism in_terms_of(const Equations& equations, const Mechanism& mechanism) {
    Mechanism result = mechanism;
    result.z = std::make_shared<Intermediates>(*equations.z);
    result.z->adopt(*mechanism.z);
    return result;
}

}  // namespace alembert
