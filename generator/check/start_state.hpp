// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The scene's initial state, assembled, with the accelerations and multipliers that its equations give there, in
/// floating point: what is proved must hold there too.
///
///     if (fails_at_start(residual, claims, equations)) …      // it is not proved, whatever was found elsewhere

#include <optional>

#include "check/claims.hpp"
#include "check/counterexample.hpp"

namespace alembert {

/// Is `value` (of coordinates, rates, accelerations and multipliers) positive at the scene's initial state? False
/// also if that cannot be decided.
bool is_positive_at_start(const GiNaC::ex& value, const Claims& claims, const Equations& equations);

/// The initial state if `residual` is surely not zero there. Nothing if it is, or if it has no value there; with
/// `at_rest` also if the scene does not start at rest.
std::optional<Counterexample> fails_at_start(const GiNaC::ex& residual, const Claims& claims,
                                             const Equations& equations, bool at_rest);

}  // namespace alembert
