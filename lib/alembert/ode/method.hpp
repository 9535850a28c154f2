// SPDX-License-Identifier: MIT
#pragma once

/// The integrators by name, and what each of them needs of a system.
///
///     const std::optional<Method> method = method_named("gauss");
///     has_fixed_step(*method), uses_jacobian(*method)      // true, true
///
/// `integrate.hpp` describes each of them; what is known of them stands in one table (method_table.hpp).

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
    rkn86,
    rkn1210,
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
    int order = 0;  ///< 0 for methods that choose it
    /// The value of −hλ up to which an explicit method is stable; 0 if it is not known, or chosen by the method.
    double stable_interval = 0;
    bool fixed_step = false;
    bool jacobian = false;  ///< implicit: solves its equations with ∂f/∂y
    /// The method is only for systems q' = v, v' = a(q, t); the caller must make sure of that
    /// (symplectic_composition.hpp).
    bool separable = false;
    bool series = false;     ///< only for right-hand sides with Rhs::series
    bool canonical = false;  ///< only for right-hand sides with Rhs::canonical
};

/// The name of a method, "dop853" and so on.
std::string_view name(Method method);
std::optional<Method> method_named(std::string_view name);
const MethodTraits& traits(Method method);
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
/// Names that are kept for SUNDIALS' integrators (System::by); they choose their own steps.
std::span<const std::string_view> sundials_methods();
/// All words that may be written where a method is chosen: "auto", the methods, and those of SUNDIALS.
std::vector<std::string> method_words();

}  // namespace alembert
