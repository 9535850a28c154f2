// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The value of a call of a table for any Real: polynomials between the points, whose coefficients are doubles.
///
///     table_value<Real>(*program.table_of(node), program.table_call(node), [&](int id) -> const Real& { … });
///
/// A Real says by `place_of` between which points it lies; one that cannot is refused.

#include <cmath>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "program/program.hpp"

namespace alembert {

/// `at(id)` is the value of a node.
template <typename Real, typename At>
Real table_value(const TabulatedFunction& table, const Program::TableCall& call, const At& at) {
    if constexpr (requires(const Real& x) { place_of(x); }) {
        const Real* const x[] = {&at(call.argument[0]), call.arguments > 1 ? &at(call.argument[1]) : nullptr};
        TabulatedFunction::Held held{TabulatedFunction::free, TabulatedFunction::free};
        for (std::size_t k = 0; call.is_held && k < call.arguments; ++k) held[k] = place_of(at(call.number[k]));
        for (std::size_t k = 0; call.is_held && call.arguments > 1 && k < 2; ++k) held[k] = std::round(held[k]);
        return table.value<Real>(call.orders, {x[0], x[1]}, held);
    } else {
        throw ModelError(
            say("what is asked for is not found for functions of [tables], which are polynomials "
                "between points alone"));
    }
}

}  // namespace alembert
