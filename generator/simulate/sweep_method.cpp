// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/sweep_method.hpp"

#include <cmath>

#include "alembert/base/error.hpp"
#include "alembert/ode/taylor.hpp"
#include "alembert/ode/verner.hpp"
#include "base/language/say.hpp"
#include "codegen/machine/memory_series_packs.hpp"
#include "model/energy.hpp"
#include "simulate/solver_code.hpp"

namespace alembert {

namespace {

/// Whether power series in packs are likely to be faster than verner98 in packs, by the predicted times of a step
/// for one of eight motions, in ns (tests/bench/sweep.sh), and the quotient of the lengths of steps for the same
/// error at the end, which grows from decade to decade as in method.cpp.
bool is_series_faster_in_packs(const Program& program, bool conserved, double tolerance) {
    const std::shared_ptr<const PackSeries> packs = memory_series_packs(program, !conserved);
    if (!packs) return false;
    constexpr double rest = 45;  // of a step of taylor, besides its series
    const int order = taylor_order(tolerance, packs->order_cost, packs->product_cost);
    const double series = rest * (1 + packs->order_cost * order + packs->product_cost * order * order);
    const double right_hand_side = 0.1 * effort_of(program) + 0.45 * packs->places.width;
    const double longer = 1.3 * std::pow(1e-6 / tolerance, 0.09);
    return series < longer * verner98_tableau.stages * right_hand_side;
}

}  // namespace

MethodChoice method_for_sweep(const RunOptions& wishes, const Derived& derived, const Program& program,
                              const Start& start, bool along) {
    const std::optional<Method> given = given_method(wishes, derived);
    if (given && needs_canonical(*given))
        throw ModelError(
            say("sweep does not run '{}', which needs more than the right-hand side; take dop853 or gauss",
                name(*given)));
    if (given) return {.method = *given};
    const double tolerance = wishes.tolerance.value_or(start.tolerance);
    if (wishes.step.value_or(start.step) > 0) return {.method = Method::rk4};
    MethodChoice choice = method_for(wishes, derived, program, start);
    if (along)
        choice.method = Method::dop853;
    else if (choice.method == Method::taylor && derived.mechanism.constraints.empty() &&
             (needs_compiler_for_series(wishes) ||
              !is_series_faster_in_packs(program, energy_of(derived.mechanism).conserved, tolerance)))
        choice.method = without_series(tolerance);
    else if (needs_separable(choice.method))  // whose members would not run side by side
        choice.method = without_series(tolerance);
    return choice;
}

}  // namespace alembert
