// SPDX-License-Identifier: MIT
#pragma once

/// The integrators by name, and what each of them needs of a system.
///
///     const std::optional<Method> method = method_named("gauss");
///     has_fixed_step(*method), uses_jacobian(*method)      // true, true
///
/// `integrate.hpp` describes each of them. A new method needs a value and a row here, and its steps in
/// integrate.cpp.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace alembert {

enum class Method {
    euler,
    rk2,
    rk4,
    dopri5,
    dop853,
    verner76,
    verner98,
    verlet,
    kahanli8,
    gauss,
    rattle,
    rattle8,
    abm,
    bdf,
    radau,
    radau5,
    radau9,
    radau13,
    taylor
};

/// The properties of a method.
struct MethodTraits {
    Method method;
    std::string_view name;
    bool fixed_step = false;
    bool jacobian = false;  ///< implicit: solves its equations with ∂f/∂y
    /// The method is only for systems q' = v, v' = a(q, t); the caller must make sure of that (symplectic.hpp).
    bool separable = false;
    bool series = false;     ///< only for right-hand sides with Rhs::series
    bool canonical = false;  ///< only for right-hand sides with Rhs::canonical
};

/// One row for each value of Method, in the same order.
inline constexpr std::array method_table = {
    MethodTraits{.method = Method::euler, .name = "euler", .fixed_step = true},
    MethodTraits{.method = Method::rk2, .name = "rk2", .fixed_step = true},
    MethodTraits{.method = Method::rk4, .name = "rk4", .fixed_step = true},
    MethodTraits{.method = Method::dopri5, .name = "dopri5"},
    MethodTraits{.method = Method::dop853, .name = "dop853"},
    MethodTraits{.method = Method::verner76, .name = "verner76"},
    MethodTraits{.method = Method::verner98, .name = "verner98"},
    MethodTraits{.method = Method::verlet, .name = "verlet", .fixed_step = true, .separable = true},
    MethodTraits{.method = Method::kahanli8, .name = "kahanli8", .fixed_step = true, .separable = true},
    MethodTraits{.method = Method::gauss, .name = "gauss", .fixed_step = true, .jacobian = true},
    MethodTraits{.method = Method::rattle, .name = "rattle", .fixed_step = true, .canonical = true},
    MethodTraits{.method = Method::rattle8, .name = "rattle8", .fixed_step = true, .canonical = true},
    MethodTraits{.method = Method::abm, .name = "abm"},
    MethodTraits{.method = Method::bdf, .name = "bdf", .jacobian = true},
    MethodTraits{.method = Method::radau, .name = "radau", .jacobian = true},
    MethodTraits{.method = Method::radau5, .name = "radau5", .jacobian = true},
    MethodTraits{.method = Method::radau9, .name = "radau9", .jacobian = true},
    MethodTraits{.method = Method::radau13, .name = "radau13", .jacobian = true},
    MethodTraits{.method = Method::taylor, .name = "taylor", .series = true},
};

/// The name of a method, "dop853" and so on.
std::string_view name(Method method);
std::optional<Method> method_named(std::string_view name);
bool has_fixed_step(Method method);
bool uses_jacobian(Method method);
bool needs_separable(Method method);
bool needs_series(Method method);
bool needs_canonical(Method method);
/// All values of Method, in their order.
std::vector<Method> all_methods();
/// "euler, rk2, ... or taylor", for messages.
std::string method_names();

/// The name that leaves the choice to the program.
constexpr std::string_view automatic_method = "auto";
/// Names that are kept for SUNDIALS' integrators (Options::by); they choose their own steps.
std::span<const std::string_view> sundials_methods();
/// All words that may be written where a method is chosen: "auto", the methods, and those of SUNDIALS.
std::vector<std::string> method_words();

}  // namespace alembert
