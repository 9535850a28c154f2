// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "analysis/derive/derive.hpp"
#include "base/language/screens.hpp"
#include "present/report/formula_page.hpp"
#include "present/report/json.hpp"

namespace alembert {

/// With `dimensions`, also those of coordinates, speeds and multipliers.
Json as_json(const DerivedScene& derived, bool dimensions = false);

struct PageOptions {
    std::string format = "text";  ///< text, latex or mathml
    bool dimensions = false;      ///< whether to tell the dimensions of coordinates, speeds and multipliers
    bool steps = false;  ///< whether to show coordinates, energies and generalized forces before the equations
    bool full = false;   ///< whether to show what exceeds two screens too
};

/// The derivation as words and formulas in a notation; with `with_steps`, also everything before the equations.
std::vector<Block> blocks_of(const DerivedScene& derived, const Notation& notation, bool with_steps);

/// What people may read at once: lines, and operations in all and in one of them. The usual ones are two screens,
/// or 20 kB.
struct Readable {
    std::size_t lines = lines_of_two_screens, operations = 3000, of_one = 800;
};

/// What is too long to be read is named with its size in place of its equations.
void leave_out_what_is_too_long(std::vector<Block>& blocks, const Readable& most = {});

/// The whole derivation in one notation.
std::string as_page(const DerivedScene& derived, const PageOptions& options = {});

}  // namespace alembert
