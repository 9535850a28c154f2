// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "alembert/ode/cost_model.hpp"
#include "alembert/ode/taylor.hpp"
#include "alembert/ode/verner.hpp"
#include "base/language/say.hpp"
#include "codegen/emit/taylor.hpp"
#include "codegen/machine/series_steps.hpp"
#include "model/energy.hpp"
#include "program/cost.hpp"
#include "program/motion_system.hpp"
#include "program/recurrence.hpp"
#include "scene/advice.hpp"
#include "simulate/canonical.hpp"
#include "simulate/regularization.hpp"
#include "simulate/separable.hpp"
#include "simulate/solver_code.hpp"
#include "simulate/step_times.hpp"
#include "simulate/sundials_methods.hpp"

namespace alembert {

namespace {

constexpr double many_steps = 1e4;
constexpr double most_products = 300;   // of a series that compiles in about a second; longer ones gain little
constexpr double most_in_memory = 200;  // the factors of more do not stay in the fastest cache, at 25 orders
constexpr double usual_operations = 4;  // of a right-hand side for each product, at most

/// The tolerances below which a series may be taken; whole powers of ten are well within or outside, however their
/// decimals are rounded. At flat poses of linkages dop853 goes on, after which a compiled series was made in vain.
struct Strict {
    double free, linked;
};
constexpr Strict in_memory{1.01e-5, 1.01e-5}, by_compiler{0.99e-10, 0.99e-12};
/// With constraints of position verner98 takes two thirds of the time of dop853 below this tolerance. Where light
/// links vibrate (benchmark/mass_ratio) its rounding stops it earlier; in memory a series is faster there.
constexpr Strict verner98_below{loosest_of_verner98, 0.99e-8};
/// At 1e-3 a series has so few orders that its steps are no longer than those of dop853.
constexpr double loosest_of_series = 3e-4;

/// Whether the rank of the constraints may drop in the course of the motion, as where a linkage lies flat. It does
/// not for the norm of a quaternion, nor for rolling.
bool is_linked(const Mechanism& m) {
    return std::any_of(m.constraints.begin(), m.constraints.end(),
                       [](const Mechanism::Constraint& c) { return c.holonomic && !c.norm; });
}

/// The number of Cauchy products at each order; nothing if there is no series.
std::optional<double> products_of_series(const Program& program, const Derived& d) {
    if (!d.mechanism.unilateral.empty()) return std::nullopt;
    for (int id = 0; id < program.size(); ++id)  // a table, perhaps of a multiplier or event alone
        if (program[id].op == Op::unspecified) return std::nullopt;
    if (program.count(program.right_hand_side()).total() > usual_operations * most_products) return std::nullopt;
    if (obstacle_to_recurrences(program)) return std::nullopt;
    return recurrences(program).products();
}

/// Whether the equations are linear with constant coefficients, so that no series are multiplied. An order is then
/// so cheap that taylor takes many, and is the fastest method at loose tolerances too.
bool is_linear(const Program& program, const Derived& d, const RunOptions& request) {
    constexpr int few = 100;  // operations; more are not looked at
    const Operations operations = program.count(program.right_hand_side());
    return !needs_compiler_for_series(request) && operations.functions == 0 && operations.total() <= few &&
           products_of_series(program, d) == 0;
}

double most_products_of(const RunOptions& request) {
    return needs_compiler_for_series(request) ? most_products : most_in_memory;
}

/// By the code in which it begins.
SeriesCost cost_of_series(const Program& program, const RunOptions& request) {
    return needs_compiler_for_series(request)
               ? series_cost(program)
               : machine::cost_in_memory(machine::series_steps(recurrences(program)));
}

/// Whether accelerations depend on positions alone in a free system whose energy is conserved, so that rkn86 and
/// rkn1210 take its steps as they are: quadratures of work, and looks for events within steps, would cost them
/// more than others.
bool suits_nystrom(const Program& program, const Derived& d) {
    const Mechanism& m = d.mechanism;
    if (!m.constraints.empty() || !m.unilateral.empty() || !m.events.empty() || !program.speeds.empty())
        return false;
    const std::vector<int> needed = program.needed_state();
    const auto n = static_cast<int>(program.coordinates.size());
    return std::all_of(needed.begin(), needed.end(), [n](int i) { return 0 <= i && i < n; }) && !inseparable(d) &&
           energy_of(m).conserved;
}

/// Whether taylor is likely to be faster than verner98, or than rkn1210 where that suits the system. A step of
/// taylor has its order chosen by the tolerance, so that its length hardly depends on it, while a step of order 9
/// becomes shorter: the quotient of the lengths for the same error at the end grows in each decade, by 22 % in
/// theory, with 24 orders (12 % for order 12). The numbers here are those with which the choice comes nearest to
/// the best one on 85 systems, and on five with rkn1210 (tests/bench/regret.sh). Against that stands the predicted
/// cost of each step, of 16 evaluations.
bool is_series_faster(const Program& program, double tolerance, const SeriesCost& cost, const Slowness& slowness,
                      bool nystrom) {
    const double decades = std::log10(1e-6 / tolerance);
    const double longer = nystrom ? 1.5 * std::pow(10, 0.03 * decades) : 1.5 * std::pow(10, 0.08 * decades);
    const int order = taylor_order(tolerance, cost.order, cost.product);
    const auto components = static_cast<int>(program.coordinates.size() + speeds_of(program));
    const Rhs rhs{.dimension = components, .effort = effort_of(program), .slowness = slowness};
    const double explicit_step = verner98_tableau.stages * effort_of_evaluation(rhs, false);
    const double step = slowness.series * taylor_effort(cost.order, cost.product, order, components);
    return step < longer * explicit_step;
}

/// What a long run tries. Whether there is a power series is found out then. Where it has to be compiled, the
/// choice is left to the counts.
std::vector<Method> rivals_in(const RunOptions& request, const Derived& d, double tolerance, bool nystrom) {
    if (!request.tuning || !d.mechanism.unilateral.empty()) return {};
    std::vector<Method> rivals = {Method::dop853, Method::verner98};
    if (nystrom) rivals.insert(rivals.end(), {Method::rkn86, Method::rkn1210});
    if (tolerance < loosest_of_series && !needs_compiler_for_series(request)) rivals.push_back(Method::taylor);
    return rivals;
}

MethodChoice automatic(const RunOptions& request, const Derived& d, const Program& program, const Start& start) {
    const double step = request.step.value_or(start.step), duration = request.duration.value_or(start.duration);
    const double tolerance = request.tolerance.value_or(start.tolerance);
    if (asks_regularization(request, d.mechanism)) {
        if (step > 0)
            return {.method = inseparable(d) ? Method::gauss : Method::kahanli8,
                    .why = say("chosen for a fixed step in a time of its own")};
        return {.method = without_series(tolerance),
                .why = say("chosen for the tolerance {:g} of a regularized run", tolerance)};
    }
    if (step > 0) {
        const double steps = duration / step;
        if (steps >= many_steps && !inseparable(d))
            return {.method = Method::kahanli8,
                    .why = say("chosen for a fixed step: forces depend on positions alone, and in {:.0f} steps "
                               "the energy must "
                               "not drift",
                               steps)};
        return {.method = Method::rk4, .why = say("chosen for a fixed step")};
    }
    const bool linked = is_linked(d.mechanism);
    const Slowness slowness = request.tuning ? slowness_here() : Slowness{};
    const Strict& strict = needs_compiler_for_series(request) ? by_compiler : in_memory;
    const bool is_strict = tolerance < (linked ? strict.linked : strict.free);
    const bool linear = is_linear(program, d, request), nystrom = suits_nystrom(program, d);
    if (is_strict || linear)
        if (const auto products = products_of_series(program, d);
            products && *products <= most_products_of(request) &&
            (linear || is_series_faster(program, tolerance, cost_of_series(program, request), slowness, nystrom)))
            return {.method = Method::taylor,
                    .when_stiff = Method::radau,
                    .when_stuck = Method::dop853,
                    .rivals = rivals_in(request, d, tolerance, nystrom),
                    .slowness = slowness,
                    .why = say(
                        "chosen for the tolerance {:g} (the motion has a short power series; radau takes over if "
                        "the system turns out stiff)",
                        tolerance)};
    const bool may_find_series =
        tolerance < loosest_of_series && !needs_compiler_for_series(request) && d.mechanism.unilateral.empty();
    const double below = !linked                              ? verner98_below.free
                         : needs_compiler_for_series(request) ? by_compiler.linked
                                                              : verner98_below.linked;
    return {
        .method = nystrom ? of_positions(tolerance) : without_series(tolerance, below),
        .when_stiff = Method::radau,
        .when_cheaper = may_find_series ? std::optional(Method::taylor) : std::nullopt,
        .rivals = rivals_in(request, d, tolerance, nystrom),
        .slowness = slowness,
        .why = say("chosen for the tolerance {:g} (radau takes over if the system turns out stiff)", tolerance)};
}

std::string name_given(const RunOptions& request, const Derived& d) {
    return request.method.empty() ? d.mechanism.run.method : request.method;
}

}  // namespace

bool has_short_series(const Program& program, const Derived& derived) {
    const auto products = products_of_series(program, derived);
    return products && *products <= most_in_memory;
}

Method without_series(double tolerance, double loosest) {
    return tolerance > loosest ? Method::dop853 : Method::verner98;
}

Method of_positions(double tolerance) {
    return tolerance > loosest_of_verner98 ? Method::rkn86 : Method::rkn1210;
}

double effort_of(const Program& program) {
    // Fitted to 85 systems of up to 10 000 operations, from which it differs by 19 % (root mean square).
    constexpr double operation = 0.078, function = 1.6, chain = 0.106;
    const Cost cost = cost_of(program);
    return operation * cost.operations + function * cost.functions + chain * cost.chain;
}

std::optional<Method> given_method(const RunOptions& request, const Derived& d) {
    const std::string given = name_given(request, d);
    if (given == automatic_method) return std::nullopt;
    const auto known = method_named(given);
    if (is_sundials(given))
        throw ModelError(say("method '{}' is one of 'simulate' alone; take bdf or radau", given));
    if (!known && !method_meant(given).empty())
        throw ModelError(say("unknown method '{}'; did you mean '{}'?", given, method_meant(given)));
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
        if (request.step && !request.method.empty() && !has_fixed_step(*given))
            throw ModelError(
                say("a step of {:g} s was asked for, but {} chooses its own steps; give a tolerance, or a "
                    "method with fixed steps (rk4, gauss, kahanli8 …)",
                    *request.step, name));
        return {.method = *given};
    }
    return automatic(request, d, program, start);
}

MethodChoice after_trial(MethodChoice choice, const MethodTrial& trial) {
    std::vector<std::string_view> tried;
    for (const MethodAttempt& attempt : trial.attempts) tried.push_back(name(attempt.method));
    choice.rivals.clear();
    choice.why =
        say("chosen as the fastest of {}, timed here up to t = {:.3g} (radau takes over if the system turns "
            "out stiff)",
            fmt::join(tried, ", "), trial.until);
    choice.method = trial.fastest;
    const bool by_series = needs_series(choice.method);
    if (by_series) choice.when_cheaper = {};
    choice.when_stuck = by_series ? std::optional(Method::dop853) : std::nullopt;
    return choice;
}

double longest_step(const RunOptions& wishes, const Start& start) {
    return wishes.max_step.value_or(start.max_step);
}

Options options_of(const RunOptions& wishes, const MethodChoice& choice, const Start& start) {
    const bool fixed = has_fixed_step(choice.method) && choice.sundials.empty();
    if (fixed && wishes.max_step)
        throw ModelError(
            say("a longest step of {:g} s was asked for, but {} has a fixed step; methods that choose "
                "their steps (dop853, radau …) "
                "take a longest one",
                *wishes.max_step, name(choice.method)));
    if (fixed && wishes.tolerance)
        throw ModelError(say(
            "a tolerance of {:g} was asked for, but {} has a fixed step, and no error that chooses it; leave the "
            "tolerance out, or take a method that chooses its steps (dop853, radau …)",
            *wishes.tolerance, name(choice.method)));
    return {.method = choice.method,
            .start = start.t,
            .duration = wishes.duration.value_or(start.duration),
            .tolerance = wishes.tolerance.value_or(start.tolerance),
            .step = wishes.step.value_or(start.step),
            .longest_step = longest_step(wishes, start),
            .sample = wishes.sample.value_or(start.sample),
            .budget = wishes.budget,
            .when_stiff = choice.when_stiff,
            .when_stuck = choice.when_stuck,
            .when_cheaper = choice.when_cheaper};
}

}  // namespace alembert
