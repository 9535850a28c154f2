// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/method.hpp"

#include <fmt/format.h>

#include <cmath>

#include "alembert/error.hpp"
#include "alembert/taylor.hpp"
#include "alembert/verner.hpp"
#include "emit/taylor.hpp"
#include "language/say.hpp"
#include "program/cost.hpp"
#include "program/recurrence.hpp"
#include "run/canonical.hpp"
#include "run/regularization.hpp"
#include "run/separable.hpp"
#include "run/solver_code.hpp"
#include "run/sundials_methods.hpp"

namespace alembert {

namespace {

constexpr double many_steps = 1e4;
constexpr double most_products = 300;   // of a series that compiles in about a second; longer ones gain little
constexpr double usual_operations = 4;  // of a right-hand side for each product, at most
/// At 3e-5 verner98 becomes faster than dop853 (tests/bench/regret.sh).
constexpr double loose = 3e-5;

/// The tolerances below which a series may be taken; whole powers of ten are well within or outside, however their
/// decimals are rounded. With constraints, dop853 passes through flat poses of linkages at which others stop.
struct Strict {
    double free, constrained;
};
constexpr Strict in_memory{1.01e-6, 1.01e-6}, by_compiler{0.99e-10, 0.99e-12};

/// The number of Cauchy products at each order; nothing if there is no series.
std::optional<double> products_of_series(const Program& program, const Derived& d) {
    if (!d.mechanism.unilateral.empty()) return std::nullopt;
    if (program.count(program.right_hand_side()).total() > usual_operations * most_products) return std::nullopt;
    if (obstacle_to_recurrences(program)) return std::nullopt;
    return recurrences(program).products();
}

/// Whether taylor is likely to be faster than verner98, by the cost of a compiled series, to which long runs go
/// over. A step of taylor has its order chosen by the tolerance, so that its length hardly depends on it, while a
/// step of order 9 becomes shorter: the quotient of the lengths for the same error at the end grows by 23 % in
/// each decade (the median of 16 systems; theory says 22 % with 24 orders). Against that stands the predicted cost
/// of each step.
bool is_series_faster(const Program& program, double tolerance) {
    const double longer = 1.1 * std::pow(1e-6 / tolerance, 0.09);
    const SeriesCost cost = series_cost(program);
    const int order = taylor_order(tolerance, cost.order, cost.product);
    const double n = static_cast<double>(program.coordinates.size() +
                                         (program.speeds.empty() ? program.coordinates : program.speeds).size());
    const double explicit_step = verner98_tableau.stages * (effort_of(program) + 4 + n);
    return taylor_effort(cost.order, cost.product, order) < longer * explicit_step;
}

MethodChoice automatic(const RunOptions& request, const Derived& d, const Program& program, const Start& start) {
    const auto wish = [](double asked, double scene) { return asked >= 0 ? asked : scene; };
    const double step = wish(request.step, start.step), duration = wish(request.duration, start.duration);
    const double tolerance = wish(request.tolerance, start.tolerance);
    if (asks_regularization(request, d.mechanism)) {
        if (step > 0)
            return {.method = inseparable(d) ? Method::gauss : Method::kahanli8,
                    .why = say("a fixed step was asked for, in a time of its own")};
        return {.method = tolerance > loose ? Method::dop853 : Method::verner98,
                .why = say("the tolerance is {:g}, and the run is regularized", tolerance)};
    }
    if (step > 0) {
        const double steps = duration / step;
        if (steps >= many_steps && !inseparable(d))
            return {.method = Method::kahanli8,
                    .why = say("a fixed step was asked for, forces depend on positions alone, and in "
                               "{:.0f} steps the energy must not drift",
                               steps)};
        return {.method = Method::rk4, .why = say("a fixed step was asked for")};
    }
    const bool constrained = !d.mechanism.constraints.empty();
    const Strict& strict = needs_compiler_for_series(request) ? by_compiler : in_memory;
    const bool is_strict = tolerance < (constrained ? strict.constrained : strict.free);
    if (is_strict)
        if (const auto products = products_of_series(program, d);
            products && *products <= most_products && is_series_faster(program, tolerance))
            return {.method = Method::taylor,
                    .when_stiff = Method::radau,
                    .when_stuck = constrained ? std::optional(Method::dop853) : std::nullopt,
                    .why = say("the tolerance is {:g} and the motion has a power series ({:g} products at "
                               "each order); if the system turns out "
                               "stiff, radau goes on",
                               tolerance, *products)};
    return {.method = tolerance > loose || (constrained && tolerance > by_compiler.constrained) ? Method::dop853
                                                                                                : Method::verner98,
            .when_stiff = Method::radau,
            .why = say("the tolerance is {:g}; if the system turns out stiff, radau goes on", tolerance)};
}

std::string name_given(const RunOptions& request, const Derived& d) {
    return request.method.empty() ? d.mechanism.run.method : request.method;
}

}  // namespace

double effort_of(const Program& program) {
    constexpr double nanoseconds = 0.4;  // of a cycle
    return nanoseconds * cost_of(program).time();
}

std::optional<Method> given_method(const RunOptions& request, const Derived& d) {
    const std::string given = name_given(request, d);
    if (given == automatic_method) return std::nullopt;
    const auto known = method_named(given);
    if (is_sundials(given))
        throw ModelError(say("method '{}' is one of 'simulate' alone; take bdf or radau", given));
    if (!known)
        throw ModelError(say("unknown method '{}'; expected {}, {}; or {}", given, automatic_method,
                             method_names(), fmt::join(sundials_methods(), ", ")));
    if (needs_separable(*known)) need_separable(d, given);
    if (needs_canonical(*known)) need_canonical(d, given);
    return known;
}

MethodChoice method_for(const RunOptions& request, const Derived& d, const Program& program, const Start& start) {
    const std::string name = name_given(request, d);
    if (is_sundials(name)) {
        need_sundials(d, name);
        return {.method = Method::bdf, .sundials = name};  // for which the Jacobian is emitted
    }
    if (const auto given = given_method(request, d)) {
        if (request.step >= 0 && !request.method.empty() && !has_fixed_step(*given))
            throw ModelError(
                say("a step of {:g} s was asked for, but {} chooses its own steps; give a tolerance, or a "
                    "method with fixed steps (rk4, gauss, kahanli8 …)",
                    request.step, name));
        return {.method = *given};
    }
    return automatic(request, d, program, start);
}

double longest_step(const RunOptions& wishes, const Start& start) {
    return wishes.max_step >= 0 ? wishes.max_step : start.max_step;
}

Options options_of(const RunOptions& wishes, const MethodChoice& choice, const Start& start) {
    const bool fixed = has_fixed_step(choice.method) && choice.sundials.empty();
    if (fixed && wishes.max_step >= 0)
        throw ModelError(
            say("a longest step of {:g} s was asked for, but {} has a fixed step; methods that choose "
                "their steps (dop853, radau …) "
                "take a longest one",
                wishes.max_step, name(choice.method)));
    const auto wish = [](double asked, double scene) { return asked >= 0 ? asked : scene; };
    return {.method = choice.method,
            .start = start.t,
            .duration = wish(wishes.duration, start.duration),
            .tolerance = wish(wishes.tolerance, start.tolerance),
            .step = wish(wishes.step, start.step),
            .longest_step = longest_step(wishes, start),
            .sample = wish(wishes.sample, start.sample),
            .budget = wishes.budget,
            .when_stiff = choice.when_stiff,
            .when_stuck = choice.when_stuck};
}

}  // namespace alembert
