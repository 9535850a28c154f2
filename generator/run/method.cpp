// SPDX-License-Identifier: GPL-2.0-or-later
#include "run/method.hpp"

#include <fmt/format.h>

#include "alembert/error.hpp"
#include "language/say.hpp"
#include "program/recurrence.hpp"
#include "run/canonical.hpp"
#include "run/separable.hpp"
#include "run/sundials_methods.hpp"

namespace alembert {

namespace {

constexpr double many_steps = 1e4;
constexpr double most_products = 300;  // the most products of a series that compiles in about a second

/// The number of Cauchy products at each order; nothing if there is no series.
std::optional<double> products_of_series(const Program& program, const Derived& d) {
    if (!d.mechanism.unilateral.empty()) return std::nullopt;
    if (program.count(program.right_hand_side()).total() > 20 * most_products) return std::nullopt;
    if (obstacle_to_recurrences(program)) return std::nullopt;
    return recurrences(program).products();
}

MethodChoice automatic(const RunOptions& request, const Derived& d, const Program& program, const Start& start) {
    const auto wish = [](double asked, double scene) { return asked >= 0 ? asked : scene; };
    const double step = wish(request.step, start.step), duration = wish(request.duration, start.duration);
    const double tolerance = wish(request.tolerance, start.tolerance);
    if (step > 0) {
        const double steps = duration / step;
        if (steps >= many_steps && !inseparable(d))
            return {.method = Method::kahanli8,
                    .why = say("a fixed step was asked for, forces depend on positions alone, and in "
                               "{:.0f} steps the energy must not drift",
                               steps)};
        return {.method = Method::rk4, .why = say("a fixed step was asked for")};
    }
    if (tolerance < 1e-12)
        if (const auto products = products_of_series(program, d); products && *products <= most_products)
            return {.method = Method::taylor,
                    .when_stiff = Method::radau,
                    .why = say("the tolerance is {:g} and the motion has a power series ({:g} products at "
                               "each order); if the system turns out "
                               "stiff, radau goes on",
                               tolerance, *products)};
    const Method method = tolerance > 1e-5     ? Method::dopri5
                          : tolerance >= 1e-12 ? Method::dop853
                                               : Method::verner98;
    return {.method = method,
            .when_stiff = Method::radau,
            .why = say("the tolerance is {:g}; if the system turns out stiff, radau goes on", tolerance)};
}

std::string name_given(const RunOptions& request, const Derived& d) {
    return request.method.empty() ? d.mechanism.run.method : request.method;
}

}  // namespace

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
            .when_stiff = choice.when_stiff};
}

}  // namespace alembert
