// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The scalar functions of the scene language. One table gives the parser's names, GiNaC's functions, their
/// derivatives and the operations of `Program`.

#include <ginac/ginac.h>

#include <optional>
#include <string>
#include <vector>

namespace alembert {

/// min and max, which GiNaC does not have; of numbers they have values.
DECLARE_FUNCTION_2P(minimum)
DECLARE_FUNCTION_2P(maximum)

/// |x| of a real x: GiNaC's abs makes x times its conjugate of a square.
DECLARE_FUNCTION_1P(absolute)

/// The sign of a real x, which does not change but where x is zero: GiNaC's csgn has no derivative.
DECLARE_FUNCTION_1P(signum)

/// `name(args)` as a GiNaC expression; empty if the language has no such function.
std::optional<GiNaC::ex> apply_function(const std::string& name, const std::vector<GiNaC::ex>& args);

/// The scene language's name of a GiNaC function call ("sin", "sign", "min" …).
/// Throws std::invalid_argument for a function that the language does not have.
std::string function_name(const GiNaC::ex& call);

/// ∂call/∂(argument k). The result may contain `call` itself (for tan, exp and functions like sqrt).
GiNaC::ex function_derivative(const GiNaC::ex& call, int k);

/// sin and cos. For multiples of π that are no multiples of π/4 or π/6 they are not evaluated: GiNaC would write
/// (√5 − 1)/4 for sin(π/10), and arithmetic without √5 cannot see there that sin² + cos² = 1.
GiNaC::ex exact_sine(const GiNaC::ex& angle);
GiNaC::ex exact_cosine(const GiNaC::ex& angle);

}  // namespace alembert
