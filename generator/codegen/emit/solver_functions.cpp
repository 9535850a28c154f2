// SPDX-License-Identifier: GPL-2.0-or-later
#include "codegen/emit/solver_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "codegen/emit/layout.hpp"
#include "program/motion_system.hpp"

namespace alembert {

namespace {

const FunctionArgument t{"const Real&", "t"}, state{"const Real*", "state"}, rate{"const Real*", "rate"},
    par{"const Real*", "par"};

FunctionArgument to(const char* name) {
    return {"Real*", name};
}

bool has_speeds(const Program& p) {
    return !p.speeds.empty();
}

void add_goals(std::vector<Goal>& goals, const Program& p, Group group, const std::string& section) {
    for (const Root& root : p.roots)
        if (root.group == group) goals.push_back({section, root.name, root.node});
}

/// Adds results for array[first], array[first + 1] …; gives the place behind the last.
std::size_t add_results(std::vector<FunctionResult>& results, const Program& p, Group group,
                        const std::string& array, std::size_t first = 0) {
    for (const int node : p.nodes_of(group)) results.push_back({array, {first++}, node});
    return first;
}

std::vector<Goal> unnamed(const std::string& section, const std::vector<FunctionResult>& results) {
    std::vector<Goal> goals;
    for (const FunctionResult& result : results) goals.push_back({section, "", result.node});
    return goals;
}

/// Prepares an entry of M or f: the solution uses it as it is, or with the opposite sign, or it is shown to
/// readers only.
Goal as_taken(const Program& p, Goal goal, const std::set<int>& needed) {
    goal.is_noted = true;
    const Node& node = p[goal.node];
    if (needed.contains(goal.node) && !node.is_constant()) return goal;
    if (node.is_scaled() && cln::equal(node.coefficients[0], -1) && needed.contains(node.args[0]) &&
        !p[node.args[0]].is_constant()) {
        goal.node = node.args[0];
        goal.is_negative = true;
    } else {
        goal.is_computed = false;
    }
    return goal;
}

SparseTask sparse(FunctionTask task, const Program& p, const std::vector<std::pair<Group, std::size_t>>& blocks,
                  std::size_t columns) {
    SparseTask result{.task = std::move(task), .rows = {}, .columns = {}};
    for (const auto& [group, first] : blocks)
        for (std::size_t k = 0; const int node : p.nodes_of(group)) {
            const std::size_t entry = k++;
            if (p.is_zero(node)) continue;
            result.rows.push_back(static_cast<int>(first + entry / columns));
            result.columns.push_back(static_cast<int>(entry % columns));
            result.task.results.push_back({"values", {result.task.results.size()}, node});
        }
    result.task.goals = unnamed("Derivatives", result.task.results);
    return result;
}

}  // namespace

FunctionTask right_hand_side(const Program& p, const Vocabulary& words) {
    const bool is_free = p.nodes_of(Group::gamma).empty(), own_speeds = has_speeds(p);
    const std::size_t n = p.coordinates.size();
    const std::string unknown = own_speeds ? "u'" : "q''", rows = fmt::format("Constraints A {} = gamma", unknown);
    const std::string solve = is_free ? fmt::format("Solve M {} = f with M = L D L^T", unknown)
                                      : fmt::format("Solve M {0} = f + A^T lambda, A {0} = gamma", unknown);
    FunctionTask task{.name = "rhs",
                      .about = own_speeds ? "rate = (q', u') at t and state = (q, u)."
                                          : "rate = (q', q'') at t and state = (q, q').",
                      .arguments = {t, state, par, to("rate")},
                      .goals = {},
                      .results = {}};
    const std::vector<int> rhs = p.right_hand_side(), list = p.needed(rhs);
    const std::set<int> needed(list.begin(), list.end());
    std::vector<Goal> kinematics, dynamics, constraints, solution;
    add_goals(kinematics, p, Group::rate, "Kinematics q' = h(q, u, t)");
    for (Goal& goal : kinematics) goal.name = ascii_identifier(goal.name) + "_dot";
    add_goals(dynamics, p, Group::mass, "Mass matrix M(q), lower triangle");
    add_goals(dynamics, p, Group::forcing, "Forcing f");
    for (Goal& goal : dynamics) goal = as_taken(p, goal, needed);
    if (!is_free) {
        add_goals(constraints, p, own_speeds ? Group::speed_row : Group::row, rows);
        add_goals(constraints, p, Group::gamma, rows);
        std::erase_if(constraints, [&](const Goal& goal) {
            return !needed.contains(goal.node) || (own_speeds && p.is_zero(goal.node));
        });
    }
    add_goals(solution, p, Group::acceleration, solve);
    for (std::size_t i = 0; i < solution.size(); ++i) {
        solution[i].name = words.a()[i];
        solution[i].own_name = true;
    }
    for (const auto* part : {&kinematics, &dynamics, &constraints, &solution})
        task.goals.insert(task.goals.end(), part->begin(), part->end());
    add_results(task.results, p, Group::rate, "rate");
    add_results(task.results, p, Group::acceleration, "rate", n);
    for (std::size_t i = 0; i < n && !own_speeds; ++i)
        task.copies.push_back({.from = static_cast<int>(n + i), .to = static_cast<int>(i)});
    return task;
}

namespace {

const char* about_mass_forcing(const Program& p) {
    if (p.has_norm_terms)
        return "M + c A^T A (row-major) and f + c A^T gamma, with a c for the norm of each quaternion.";
    return has_speeds(p) ? "M (s by s, row-major) and f of M u' = f."
                         : "M (n by n, row-major) and f of M q'' = f.";
}

}  // namespace

FunctionTask mass_forcing(const Program& p) {
    FunctionTask task{.name = "mass_forcing",
                      .about = about_mass_forcing(p),
                      .arguments = {t, state, par, to("mass"), to("forcing")},
                      .goals = {},
                      .results = {}};
    add_goals(task.goals, p, Group::mass, "Mass matrix M(q), lower triangle");
    if (task.goals.empty()) return task;
    add_goals(task.goals, p, Group::forcing, "Forcing f");
    const std::size_t s = speeds_of(p);
    for (std::size_t i = 0, k = 0; i < s; ++i)
        for (std::size_t j = 0; j <= i; ++j, ++k) {
            std::vector<std::size_t> places{i * s + j};
            if (i != j) places.insert(places.begin(), j * s + i);
            task.results.push_back({"mass", std::move(places), task.goals[k].node});
        }
    add_results(task.results, p, Group::forcing, "forcing");
    return task;
}

FunctionTask energy(const Program& p) {
    FunctionTask task{.name = "energy",
                      .about = "T, V, E and the power dE/dt of loads and prescribed motions; Jacobi's integral.",
                      .arguments = {t, state, rate, par, to("energy"), to("jacobi")},
                      .goals = {},
                      .results = {}};
    for (const Group group : {Group::kinetic, Group::potential, Group::energy, Group::power, Group::jacobi})
        add_goals(task.goals, p, group, "Energy");
    for (std::size_t i = 0; const Group group : {Group::kinetic, Group::potential, Group::energy, Group::power})
        add_results(task.results, p, group, "energy", i++);
    add_results(task.results, p, Group::jacobi, "jacobi");
    return task;
}

FunctionTask outputs_at(const Program& p) {
    FunctionTask task{.name = "outputs_at",
                      .about = "The scene's outputs.",
                      .arguments = {t, state, rate, par, to("out")},
                      .goals = {},
                      .results = {}};
    add_goals(task.goals, p, Group::output, "Outputs");
    add_goals(task.goals, p, Group::speed, "Generalized speeds");
    add_results(task.results, p, Group::output, "out");
    add_results(task.results, p, Group::speed, "out", task.results.size());
    return task;
}

FunctionTask events_at(const Program& p) {
    FunctionTask task{.name = "events_at",
                      .about = "The scene's event functions.",
                      .arguments = {t, state, rate, par, to("out")},
                      .goals = {},
                      .results = {}};
    add_goals(task.goals, p, Group::event, "Event functions");
    add_results(task.results, p, Group::event, "out");
    return task;
}

FunctionTask constraints_at(const Program& p) {
    FunctionTask task{.name = "constraints_at",
                      .about = "f(q,t) of holonomic constraints, A q' + b of all, and A.",
                      .arguments = {t, state, par, to("position"), to("velocity"), to("rows")},
                      .goals = {},
                      .results = {}};
    const auto add = [&](const char* array, std::initializer_list<Group> groups) {
        std::size_t place = 0;
        for (const Group group : groups) place = add_results(task.results, p, group, array, place);
    };
    add("position", {Group::position, Group::redundant_position});
    add("velocity", {Group::velocity, Group::redundant_velocity});
    add("rows", {Group::row, Group::redundant_row, Group::speed_row, Group::redundant_speed_row});
    task.goals = unnamed("Constraints", task.results);
    return task;
}

std::size_t constraints_of(const Program& p) {
    return p.nodes_of(Group::velocity).size() + p.nodes_of(Group::redundant_velocity).size();
}

FunctionTask multipliers_at(const Program& p) {
    FunctionTask task{.name = "multipliers_at",
                      .about = "The multipliers lambda of M q'' = f + A^T lambda.",
                      .arguments = {t, state, par, to("lambda")},
                      .goals = {},
                      .results = {}};
    add_goals(task.goals, p, Group::multiplier, "Multipliers");
    add_results(task.results, p, Group::multiplier, "lambda");
    return task;
}

FunctionTask project(const Program& p) {
    FunctionTask task{.name = "project",
                      .about =
                          "One step of Newton's method to the constraints; f(q, t) before it, and what the "
                          "eliminations divide by.",
                      .arguments = {t, state, par, to("out"), to("position"), to("pivots")},
                      .goals = {},
                      .results = {}};
    if (p.nodes_of(Group::projected).empty()) return task;
    add_results(task.results, p, Group::projected, "out");
    add_results(task.results, p, Group::position, "position");
    add_results(task.results, p, Group::pivot, "pivots");
    task.goals = unnamed("Projection", task.results);
    return task;
}

FunctionTask gamma_at(const Program& p) {
    FunctionTask task{.name = "gamma_at",
                      .about = has_speeds(p) ? "gamma of A u' = gamma." : "gamma of A q'' = gamma.",
                      .arguments = {t, state, par, to("out")},
                      .goals = {},
                      .results = {}};
    if (p.nodes_of(Group::projected).empty()) return task;
    add_goals(task.goals, p, Group::gamma, "Constraints");
    const std::vector<int> kept = p.kept_constraints();
    for (std::size_t k = 0; k < kept.size(); ++k)
        task.results.push_back({"out", {static_cast<std::size_t>(kept[k])}, task.goals[k].node});
    task.size = constraints_of(p);
    return task;
}

bool has_projection(const Program& p) {
    const std::vector<int> position = p.nodes_of(Group::position);
    const bool is_needed =
        !p.nodes_of(Group::gamma).empty() ||
        std::any_of(position.begin(), position.end(), [&](int node) { return !p.is_zero(node); });
    return !position.empty() && is_needed == !p.nodes_of(Group::projected).empty();
}

FunctionTask impulses_at(const Program& p) {
    FunctionTask task{.name = "impulses_at",
                      .about = "The generalized impulses of each event that has some, of the rates before.",
                      .arguments = {t, state, par, to("out")},
                      .goals = {},
                      .results = {}};
    add_results(task.results, p, Group::event_impulse, "out");
    task.goals = unnamed("Impulses", task.results);
    return task;
}

FunctionTask named_function(const Program&, const NamedFunction& function) {
    FunctionTask task{.name = function.name,
                      .about = fmt::format("{} {}.", function.about, described(function)),
                      .arguments = {t, state, rate, par, to("out")},
                      .goals = {},
                      .results = {}};
    for (std::size_t k = 0; k < function.nodes.size(); ++k)
        task.results.push_back({"out", {k}, function.nodes[k]});
    task.goals = unnamed("Values", task.results);
    return task;
}

SparseTask jacobian(const Program& p) {
    const std::size_t width = p.coordinates.size() + speeds_of(p);
    return sparse({.name = "jacobian",
                   .about = "d rate / d state where it is not zero at every state; row n + s: of the power.",
                   .arguments = {t, state, par, to("values")},
                   .goals = {},
                   .results = {}},
                  p, {{Group::jacobian, 0}, {Group::power_gradient, width}}, width);
}

SparseTask parameter_jacobian(const Program& p) {
    return sparse({.name = "parameter_jacobian",
                   .about = "d rate / d parameter where it is not zero at every state; row n + s: of the power.",
                   .arguments = {t, state, par, to("values")},
                   .goals = {},
                   .results = {}},
                  p, {{Group::parameter_jacobian, 0}}, p.parameters.size());
}

FunctionTask jacobian_tangent(const std::vector<int>& nodes) {
    FunctionTask task{
        .name = "jacobian_tangent",
        .about = "The change of the entries of jacobian, then of parameter_jacobian, along a direction.",
        .arguments = {t, state, par, {"const Real*", "direction"}, to("change")},
        .goals = {},
        .results = {}};
    for (std::size_t k = 0; k < nodes.size(); ++k) task.results.push_back({"change", {k}, nodes[k]});
    task.goals = unnamed("Derivatives", task.results);
    return task;
}

FunctionTask tangent(const Program& p) {
    FunctionTask task{
        .name = "tangent",
        .about = "The change of rate, then of T, V, E, the power and the outputs, along a direction.",
        .arguments = {t, state, rate, par, {"const Real*", "direction"}, to("change")},
        .goals = {},
        .results = {}};
    add_results(task.results, p, Group::tangent, "change");
    task.goals = unnamed("Derivatives", task.results);
    return task;
}

}  // namespace alembert
