// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "derive/derive.hpp"
#include "report/formula_page.hpp"
#include "report/json.hpp"

namespace alembert {

Json as_json(const DerivedScene& derived);

struct PageOptions {
    std::string format = "text";  ///< text, latex or mathml
    bool steps = false;           ///< coordinates, energies, generalized forces, then the equations
};

/// The derivation as words and formulas in that notation; `with_steps`: all that stands before the equations too.
std::vector<Block> blocks_of(const DerivedScene& derived, const Notation& notation, bool with_steps);

/// The whole derivation in one notation.
std::string as_page(const DerivedScene& derived, const PageOptions& options = {});

}  // namespace alembert
