// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "derive/derive.hpp"
#include "report/json.hpp"

namespace alembert {

Json as_json(const DerivedScene& derived);

struct PageOptions {
    std::string format = "text";  ///< text, latex or mathml
    bool steps = false;           ///< coordinates, energies, generalized forces, then the equations
};

/// The whole derivation in one notation.
std::string as_page(const DerivedScene& derived, const PageOptions& options = {});

}  // namespace alembert
