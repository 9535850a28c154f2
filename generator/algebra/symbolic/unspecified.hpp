// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Calls of functions that the scene leaves open, and their partial derivatives: V(r), dV/dr, ∂²f/∂x∂y.
///
///     const ex V = unspecified_value({.function = V_symbol, .arguments = {r}, .orders = {0}});
///     V.diff(r)                                   // the same call with the order 1
///
/// In GiNaC, in a Phrase and in a Program such a call is one function named `unspecified` of the symbol of the
/// function and, for each argument, how often is differentiated by it, then the argument. So whatever treats a
/// function by its name and arguments treats it rightly; only what gives a derivative, a value or a notation looks
/// inside. As nothing is known of the function, its value and those of its derivatives at a point are independent.

#include <ginac/ginac.h>

#include <optional>
#include <vector>

namespace alembert {

inline constexpr const char* unspecified_name = "unspecified";

struct UnspecifiedCall {
    GiNaC::ex function;  ///< its symbol
    std::vector<GiNaC::ex> arguments;
    std::vector<int> orders;  ///< how often is differentiated by each argument
};

/// The call as an expression. There are at most four arguments.
GiNaC::ex unspecified_value(const UnspecifiedCall& call);

/// The call that `e` is; nothing if it is none.
std::optional<UnspecifiedCall> unspecified_call(const GiNaC::ex& e);

/// The same call, differentiated once more by the argument at this position.
UnspecifiedCall differentiated_by(UnspecifiedCall call, std::size_t argument);

}  // namespace alembert
