// SPDX-License-Identifier: MIT
// bench_step_costs SCENE...: what steps take here, beside what cost_model.hpp and taylor.hpp predict. For each
// scene a line of JSON: its counts, the ns of an evaluation with its part of a step by dop853 and verner98, and of
// a series with its step by taylor at three tolerances, each the least of many runs. Constraints are not enforced,
// since their projection is no part of these laws. Scenes without such methods, as those with contacts, are left
// out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "alembert/ode/cost_model.hpp"
#include "alembert/ode/integrate.hpp"
#include "alembert/ode/taylor.hpp"
#include "analysis/derive/derived.hpp"
#include "codegen/machine/memory_series.hpp"
#include "codegen/machine/memory_solver.hpp"
#include "program/cost.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/start.hpp"
#include "program/recurrence.hpp"
#include "program/switches.hpp"
#include "simulate/loaded_modes.hpp"
#include "simulate/method.hpp"
#include "simulate/step_times.hpp"

namespace {

using namespace alembert;

void tell(const std::string& file) {
    const Derived derived = alembert::derived(read_scene(file), {.use = Use::run});
    const Mechanism& m = derived.mechanism;
    const Program program = lowered(derived).program;
    if (has_jumps(m) || !m.frictions.empty() || switched(program) || program.singular) return;
    const auto solver = memory_solver(program);
    if (!solver || obstacle_to_recurrences(program) || recurrences(program).products() > 300) return;
    const auto series = memory_series(program);
    const Start start = start_of(m);
    std::vector<double> state = start.q;
    const State<double> first = start.state();
    state.insert(state.end(), first.qdot.begin(), first.qdot.end());
    Rhs rhs = make_rhs(solver->module, start.parameters);
    if (!series || static_cast<int>(state.size()) != rhs.dimension) return;
    rhs.series = make_series(series->module, start.parameters);
    rhs.effort = effort_of(program);
    const Cost cost = cost_of(program);
    const alembert_series_table& table = *series->module;
    fmt::print(
        "{{\"scene\": \"{}\", \"components\": {}, \"operations\": {}, \"functions\": {}, \"chain\": {}, "
        "\"order_cost\": {}, \"product_cost\": {}",
        program.name, rhs.dimension, cost.operations, cost.functions, cost.chain, table.order_cost,
        table.product_cost);
    const auto usual = [](const Statistics& done) { return done.evaluations; };
    const auto steps = [](const Statistics& done) { return done.steps + done.rejected; };
    Options options{.start = start.t, .duration = start.duration, .budget = 20000};
    for (const Method method : {Method::dop853, Method::verner98}) {
        options.method = method;
        options.tolerance = 1e-9;
        if (const auto ns = least_time(rhs, state, options, usual, 0.04))
            fmt::print(", \"{}\": {{\"ns\": {:.5g}, \"predicted\": {:.5g}}}", name(method), *ns,
                       effort_of_evaluation(rhs, false));
    }
    fmt::print(", \"taylor\": [");
    options.method = Method::taylor;
    options.budget = 1'000'000;
    const char* between = "";
    for (const double tolerance : {1e-5, 1e-9, 1e-13}) {
        options.tolerance = tolerance;
        const int order = taylor_order(tolerance, table.order_cost, table.product_cost);
        const double predicted = taylor_effort(table.order_cost, table.product_cost, order, rhs.dimension);
        if (const auto ns = least_time(rhs, state, options, steps, 0.04))
            fmt::print("{}{{\"order\": {}, \"ns\": {:.5g}, \"predicted\": {:.5g}}}", std::exchange(between, ", "),
                       order, *ns, predicted);
    }
    fmt::print("]}}\n");
}

}  // namespace

int main(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) try {
            tell(argv[i]);
        } catch (const std::exception& error) {
            fmt::print(stderr, "{}: {}\n", argv[i], error.what());
        }
}
