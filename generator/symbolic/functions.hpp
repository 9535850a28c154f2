// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The scalar functions of the scene language: one table for the parser's names, GiNaC's functions, their
/// derivatives and the operations of `Program`.

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <vector>

namespace alembert {

/// min and max as GiNaC functions without rewriting rules of their own (GiNaC has neither).
DECLARE_FUNCTION_2P(minimum)
DECLARE_FUNCTION_2P(maximum)

/// |x| of a real x: GiNaC's abs makes x times its conjugate of a square.
DECLARE_FUNCTION_1P(absolute)

/// `name(args)` as a GiNaC expression; nothing where the language has no such function.
std::optional<GiNaC::ex> apply_function(const std::string& name, const std::vector<GiNaC::ex>& args);

/// The scene language's name of a GiNaC function call ("sin", "sign", "min" …).
/// Throws std::invalid_argument for a function that the language does not have.
std::string function_name(const GiNaC::ex& call);

/// ∂call/∂(argument k). `call` itself may be used in the result (tan, exp, sqrt-like forms).
GiNaC::ex function_derivative(const GiNaC::ex& call, int k);

/// sin and cos. Of multiples of π other than those of π/4 and π/6 they stay as they are: GiNaC would write
/// (√5 − 1)/4 for sin(π/10), and sin² + cos² = 1 is not seen in that by arithmetic without √5.
GiNaC::ex exact_sine(const GiNaC::ex& angle);
GiNaC::ex exact_cosine(const GiNaC::ex& angle);

}  // namespace alembert
