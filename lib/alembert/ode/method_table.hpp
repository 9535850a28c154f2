// SPDX-License-Identifier: MIT
#pragma once

/// The one table of integrators: all that is known of each, and the steps of which it is made.
///
///     std::get<0>(method_rows).traits.name                               // "euler"
///     typename std::tuple_element_t<4, MethodRows>::Steps                // ExplicitRK<dop853_tableau>
///
/// A new integrator is a value of Method (method.hpp), a file with its tableau (tableau.hpp) or its formula
/// (formula_stepper.hpp), and a row here. `integrate`, ensembles, the search for stiffness, the reader of scenes,
/// help and messages go by the row. Only method.cpp, integrate.cpp and ensemble.cpp include this file: all others
/// ask method.hpp.

#include <tuple>

#include "alembert/ode/abm.hpp"
#include "alembert/ode/bdf.hpp"
#include "alembert/ode/dop853.hpp"
#include "alembert/ode/explicit_rk.hpp"
#include "alembert/ode/formula_stepper.hpp"
#include "alembert/ode/gauss.hpp"
#include "alembert/ode/method.hpp"
#include "alembert/ode/nystrom.hpp"
#include "alembert/ode/radau.hpp"
#include "alembert/ode/rattle_step.hpp"
#include "alembert/ode/stepper.hpp"
#include "alembert/ode/symplectic_composition.hpp"
#include "alembert/ode/tableau.hpp"
#include "alembert/ode/taylor.hpp"
#include "alembert/ode/verner.hpp"

namespace alembert {

/// An explicit Runge-Kutta method; members of an ensemble run side by side by the same tableau.
template <const auto& of>
struct ExplicitRow {
    using Steps = ExplicitRK<of>;
    static constexpr const auto& tableau = of;
    MethodTraits traits;
};

/// A method given by a formula.
template <class OfFormula>
struct FormulaRow {
    using Formula = OfFormula;
    using Steps = FormulaStepper<Formula>;
    MethodTraits traits;
};

template <const auto& tableau>
constexpr ExplicitRow<tableau> row(MethodTraits traits) {
    traits.order = tableau.order;
    traits.fixed_step = tableau.error_rows == 0;
    return {traits};
}

template <class Formula>
constexpr FormulaRow<Formula> row(MethodTraits traits) {
    traits.fixed_step = Formula::has_fixed_step;
    return {traits};
}

/// In the order of Method.
inline constexpr std::tuple method_rows{
    row<euler_tableau>({.method = Method::euler, .name = "euler"}),
    row<rk2_tableau>({.method = Method::rk2, .name = "rk2"}),
    row<rk4_tableau>({.method = Method::rk4, .name = "rk4"}),
    row<dopri5_tableau>({.method = Method::dopri5, .name = "dopri5", .stable_interval = 3.31}),
    row<dop853_tableau>({.method = Method::dop853, .name = "dop853", .stable_interval = 6.1}),
    row<verner76_tableau>({.method = Method::verner76, .name = "verner76", .stable_interval = 4.64}),
    row<verner98_tableau>({.method = Method::verner98, .name = "verner98", .stable_interval = 4.48}),
    row<Nystrom<rkn86_tableau>>(
        {.method = Method::rkn86, .name = "rkn86", .order = 8, .stable_interval = 3.3, .separable = true}),
    row<Nystrom<rkn1210_tableau>>(
        {.method = Method::rkn1210, .name = "rkn1210", .order = 12, .stable_interval = 8.33, .separable = true}),
    row<Verlet>({.method = Method::verlet, .name = "verlet", .order = 2, .separable = true}),
    row<KahanLi8>({.method = Method::kahanli8, .name = "kahanli8", .order = 8, .separable = true}),
    row<Gauss>({.method = Method::gauss, .name = "gauss", .order = 6, .jacobian = true}),
    row<Rattle>({.method = Method::rattle, .name = "rattle", .order = 2, .canonical = true}),
    row<Rattle8>({.method = Method::rattle8, .name = "rattle8", .order = 8, .canonical = true}),
    row<Abm>({.method = Method::abm, .name = "abm", .order = 4, .stable_interval = 1.28}),
    row<Bdf>({.method = Method::bdf, .name = "bdf", .jacobian = true}),
    row<RadauOfAnyOrder>({.method = Method::radau, .name = "radau", .jacobian = true}),
    row<Radau5>({.method = Method::radau5, .name = "radau5", .order = 5, .jacobian = true}),
    row<Radau9>({.method = Method::radau9, .name = "radau9", .order = 9, .jacobian = true}),
    row<Radau13>({.method = Method::radau13, .name = "radau13", .order = 13, .jacobian = true}),
    row<Taylor>({.method = Method::taylor, .name = "taylor", .series = true}),
};

/// Whether the steps of a row are a stepper, with the abilities that its traits promise.
template <class Row>
constexpr bool is_stepper(const Row& row) {
    using Steps = typename Row::Steps;
    static_assert(SomeStepper<Steps>);
    static_assert(!Steps::has_fixed_step || !ChoosesLength<Steps>, "fixed steps are those that are asked for");
    return row.traits.fixed_step == Steps::has_fixed_step && row.traits.series == KnowsSeries<Steps> &&
           (row.traits.jacobian ? SolvesEquations<Steps> : !KnowsEigenvalue<Steps>)&&(
               row.traits.stable_interval == 0 || !KnowsStableInterval<Steps>);
}
static_assert(std::apply([](const auto&... rows) { return (is_stepper(rows) && ...); }, method_rows));

/// An array of what `of(row)` gives for each row.
template <class Of>
constexpr auto for_each_method(Of of) {
    return std::apply([&](const auto&... rows) { return std::array{of(rows)...}; }, method_rows);
}

}  // namespace alembert
