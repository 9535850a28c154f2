// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Words that people bring from other programs and from books, and what they mean here.
///
///     function_meant("arcsin")              // "asin": certain, so it is read
///     advice_on_function("cot")             // "write 1/tan(x)", for a message
///     key_meant("spring", "k")              // "stiffness"
///     table_meant("bodies")                 // "body"
///     joint_type_meant("hinge")             // "revolute": read
///
/// Each gives nothing for a word that is not in its table.

#include <string>
#include <string_view>

namespace alembert {

std::string_view function_meant(std::string_view word);

/// "write 1/tan(x)": what stands in place of a call of this function.
std::string advice_on_function(std::string_view word);

/// What to write in place of a name that the scene does not have: "exp(1)" for e.
std::string advice_on_name(std::string_view word);

std::string_view key_meant(std::string_view table, std::string_view key);

/// Whether the one stands for the other in some table.
bool is_key_meant(std::string_view typed, std::string_view key);

/// A table of scene/keys.hpp, or a key above all tables.
std::string_view table_meant(std::string_view word);

std::string_view joint_type_meant(std::string_view word);

/// A method of integration: "dopri5" for RK45.
std::string_view method_meant(std::string_view word);

/// "lagrange" for "Euler-Lagrange".
std::string_view formalism_meant(std::string_view word);

/// What to write for a command of LaTeX in the quotes of TOML, where a backslash begins another sign: "theta'" for
/// \dot{theta}; empty if this is no command that formulas have.
std::string advice_on_command(std::string_view command);

/// The word in small letters without what separates its parts: "eulerlagrange".
std::string bare(std::string_view word);

}  // namespace alembert
