// SPDX-License-Identifier: GPL-2.0-or-later
#include "program/differentiate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "alembert/base/random.hpp"
#include "program/interpret.hpp"
#include "program/motion_system.hpp"
#include "program/partials.hpp"
#include "program/solve.hpp"

namespace alembert {

namespace {

using Matrix = std::vector<std::vector<int>>;  ///< a matrix of nodes, row by row

/// Substitutes nodes for other nodes.
class Substitution {
public:
    Substitution(Program& program, std::map<int, int> values) : p_(program), known_(std::move(values)) {}

    int operator()(int root) {
        std::vector<int> roots{root};
        (*this)(roots);
        return roots[0];
    }
    void operator()(std::vector<int>& roots) {
        for (const int id : p_.needed(roots)) rebuild(id);
        for (int& root : roots) root = at(root);
    }

private:
    int at(int id) const {
        const auto found = known_.find(id);
        return found == known_.end() ? id : found->second;
    }

    void rebuild(int id) {
        const Node node = p_[id];
        if (known_.contains(id)) return;
        if (std::none_of(node.args.begin(), node.args.end(), [&](int arg) { return known_.contains(arg); }))
            return;
        if (node.op == Op::sum) {
            std::vector<Program::Term> terms;
            for (std::size_t k = 0; k < node.args.size(); ++k)
                terms.emplace_back(node.coefficients[k], at(node.args[k]));
            known_[id] = p_.sum(node.number, terms);
        } else if (node.op == Op::product) {
            std::vector<Program::Factor> factors;
            for (std::size_t k = 0; k < node.args.size(); ++k)
                factors.emplace_back(at(node.args[k]), node.exponents[k]);
            known_[id] = p_.product(1, factors);
        } else {
            std::vector<int> args;
            for (const int arg : node.args) args.push_back(at(arg));
            known_[id] = p_.call(node.op, std::move(args));
        }
    }

    Program& p_;
    std::map<int, int> known_;
};

class Differentiation {
public:
    Differentiation(const Program& program, long budget)
        : p_(program),
          n_(static_cast<int>(program.coordinates.size())),
          s_(static_cast<int>(speeds_of(program))),
          budget_(budget) {
        for (int i = 0; i < n_; ++i) state_.push_back(p_.variable({Variable::Kind::coordinate, i}));
        for (int i = 0; i < s_; ++i) state_.push_back(p_.variable({Variable::Kind::rate, i}));
        for (int id = 0; id < p_.size(); ++id)
            if (p_[id].op == Op::variable && p_[id].variable.kind == Variable::Kind::unknown)
                first_unknown_ = std::max(first_unknown_, p_[id].variable.index + 1);
    }

    const std::vector<int>& state() const { return state_; }
    std::vector<int> parameters() {
        std::vector<int> list;
        for (std::size_t i = 0; i < p_.parameters.size(); ++i)
            list.push_back(p_.variable({Variable::Kind::parameter, static_cast<int>(i)}));
        return list;
    }

    /// ∂(q', u')/∂inputs by way of R, with M u' from M or from T.
    std::optional<Matrix> implicit(const std::vector<int>& inputs, EliminationOrder order, bool by_energy) {
        MotionSystem system = motion_system(p_);
        const std::optional<Matrix> x = solve_for_sides(p_, system.K, {system.b}, system.speeds);
        if (!x) return std::nullopt;
        std::map<int, int> solved;
        std::vector<int> unknown, residuals;
        for (int i = 0; i < system.size(); ++i) {
            unknown.push_back(p_.variable({Variable::Kind::unknown, first_unknown_ + i}));
            solved[unknown.back()] = (*x)[0][static_cast<std::size_t>(i)];
        }
        std::optional<std::vector<int>> inertia;
        if (by_energy) {
            inertia = inertia_by_energy(system, {unknown.begin(), unknown.begin() + s_});
            if (!inertia) return std::nullopt;
        }
        for (int i = 0; i < system.size(); ++i) {
            std::vector<Program::Term> terms{{1, system.b[static_cast<std::size_t>(i)]}};
            if (inertia && i < s_) {
                terms.emplace_back(-1, (*inertia)[static_cast<std::size_t>(i)]);
                for (int j = s_; j < system.size(); ++j)
                    terms.emplace_back(
                        -1, p_.product(1, {{system.entry(i, j), 1}, {unknown[static_cast<std::size_t>(j)], 1}}));
            } else {
                terms.emplace_back(-1, row_times(p_, system, i, unknown));
            }
            residuals.push_back(p_.sum(0, terms));
        }
        const auto parts = partials(p_, residuals, inputs, order, budget_);
        if (!parts) return std::nullopt;
        Matrix columns(inputs.size(), std::vector<int>(residuals.size(), p_.number(0)));
        Substitution with_solution(p_, std::move(solved));
        for (const Partial& part : *parts)
            columns[static_cast<std::size_t>(part.input)][static_cast<std::size_t>(part.output)] =
                with_solution(part.node);
        const std::optional<Matrix> derivative = solve_for_sides(p_, system.K, columns, system.speeds);
        if (!derivative) return std::nullopt;
        std::optional<Matrix> result = rates(inputs, order);
        for (int i = 0; result && i < s_; ++i) {
            result->emplace_back();
            for (const std::vector<int>& column : *derivative)
                result->back().push_back(column[static_cast<std::size_t>(i)]);
        }
        return result;
    }

    /// The same from equations in their place, whose program is that of this object.
    std::optional<Matrix> of_changes(const std::vector<int>& inputs, const Perturbed& equations) {
        std::optional<Matrix> result = rates(inputs, EliminationOrder::least_fill);
        if (!result) return result;
        auto below = of(equations.outputs, inputs, EliminationOrder::least_fill, equations.stages);
        if (!below) return std::nullopt;
        Substitution at_motion(p_, equations.held);
        for (std::vector<int>& row : *below) {
            at_motion(row);
            result->push_back(std::move(row));
        }
        return result;
    }

    /// The same directly from the accelerations.
    std::optional<Matrix> direct(const std::vector<int>& inputs, EliminationOrder order) {
        std::optional<Matrix> result = rates(inputs, order);
        if (!result) return result;
        const auto below = of(p_.nodes_of(Group::acceleration), inputs, order);
        if (!below) return std::nullopt;
        result->insert(result->end(), below->begin(), below->end());
        return result;
    }

    /// d(dE/dt)/d by, given the Jacobian by the same: the power is a function of state, parameters, u' and
    /// multipliers.
    std::optional<std::vector<int>> power_gradient(const std::vector<int>& by, const Matrix& jacobian) {
        const std::vector<int> power = p_.nodes_of(Group::power), acceleration = p_.nodes_of(Group::acceleration);
        std::vector<int> inputs = by;
        std::map<int, int> row_of;  // node: row of the Jacobian that holds its derivative
        for (int i = 0; i < s_; ++i) {
            row_of.emplace(acceleration[static_cast<std::size_t>(i)], n_ + i);
            row_of.emplace(p_.variable({Variable::Kind::acceleration, i}), n_ + i);
        }
        for (const std::vector<int>& known : {state_, by})
            for (const int id : known) row_of.erase(id);
        for (const auto& [id, row] : row_of)
            if (!p_[id].is_number()) inputs.push_back(id);
        const auto parts = partials(p_, power, inputs, EliminationOrder::reverse, budget_);
        if (!parts) return std::nullopt;
        std::vector<std::vector<Program::Term>> sums(by.size());
        for (const Partial& part : *parts) {
            const auto k = static_cast<std::size_t>(part.input);
            if (k < by.size()) {
                sums[k].emplace_back(1, part.node);
                continue;
            }
            const std::vector<int>& row = jacobian[static_cast<std::size_t>(row_of.at(inputs[k]))];
            for (std::size_t j = 0; j < sums.size(); ++j)
                sums[j].emplace_back(1, p_.product(1, {{part.node, 1}, {row[j], 1}}));
        }
        std::map<int, int> own;  // the u' in the power, as functions of the state
        for (int i = 0; i < s_; ++i)
            own.emplace(p_.variable({Variable::Kind::acceleration, i}), acceleration[static_cast<std::size_t>(i)]);
        Substitution at_state(p_, std::move(own));
        std::vector<int> gradient;
        for (const auto& terms : sums) gradient.push_back(at_state(p_.sum(0, terms)));
        return gradient;
    }

    /// The rows of Group::value_gradient.
    std::optional<Matrix> value_gradient() {
        std::vector<int> values;
        for (const Group group :
             {Group::kinetic, Group::potential, Group::energy, Group::power, Group::output, Group::speed})
            for (const int node : p_.nodes_of(group)) values.push_back(node);
        const std::vector<int> acceleration = p_.nodes_of(Group::acceleration), by_parameters = parameters();
        std::vector<int> inputs = state_;
        std::map<int, std::size_t> column;  // node: column
        for (std::size_t i = 0; i < state_.size(); ++i) column.emplace(state_[i], i);
        for (std::size_t i = 0; i < by_parameters.size(); ++i)
            column.emplace(by_parameters[i], state_.size() + static_cast<std::size_t>(s_) + i);
        inputs.insert(inputs.end(), by_parameters.begin(), by_parameters.end());
        for (int i = 0; i < s_; ++i)
            for (const int node : {p_.variable({Variable::Kind::acceleration, i}), acceleration[i]})
                if (!p_[node].is_number() && column.emplace(node, state_.size() + i).second)
                    inputs.push_back(node);
        const auto parts = partials(p_, values, inputs, EliminationOrder::reverse, budget_);
        if (!parts) return std::nullopt;
        const std::size_t width = state_.size() + static_cast<std::size_t>(s_) + by_parameters.size();
        std::vector<std::vector<std::vector<Program::Term>>> sums(values.size(),
                                                                  std::vector<std::vector<Program::Term>>(width));
        for (const Partial& part : *parts)
            sums[static_cast<std::size_t>(part.output)][column.at(inputs[static_cast<std::size_t>(part.input)])]
                .emplace_back(1, part.node);
        Matrix result;
        for (const auto& row : sums) {
            result.emplace_back();
            for (const auto& terms : row) result.back().push_back(p_.sum(0, terms));
        }
        return result;
    }

    Operations cost(const Matrix& m) const {
        std::vector<int> nodes;
        for (const auto& row : m) nodes.insert(nodes.end(), row.begin(), row.end());
        return p_.count(nodes);
    }

    void keep(Group group, const std::string& letter, const Matrix& m) {
        for (std::size_t i = 0; i < m.size(); ++i)
            for (std::size_t j = 0; j < m[i].size(); ++j)
                p_.roots.push_back({group, fmt::format("{}{}_{}", letter, i, j), m[i][j]});
    }

    Program finished() && { return p_.canonical(); }

private:
    std::vector<int> speeds() const { return {state_.begin() + n_, state_.end()}; }

    /// M z as the change of momentum along z, ∂(∂T/∂u)/∂u · z; nothing if numbers show that T has another M.
    std::optional<std::vector<int>> inertia_by_energy(const MotionSystem& system, const std::vector<int>& z) {
        const int epsilon = p_.variable({Variable::Kind::unknown, first_unknown_ + system.size()});
        const auto momenta = of(p_.nodes_of(Group::kinetic), speeds(), EliminationOrder::reverse);
        if (!momenta) return std::nullopt;
        std::map<int, int> moved;
        for (std::size_t i = 0; i < z.size(); ++i)
            moved[speeds()[i]] = p_.sum(0, {{1, speeds()[i]}, {1, p_.product(1, {{epsilon, 1}, {z[i], 1}})}});
        Substitution at_moved(p_, std::move(moved));
        std::vector<int> there;
        for (const int node : (*momenta)[0]) there.push_back(at_moved(node));
        const auto slope = of(there, {epsilon}, EliminationOrder::forward);
        if (!slope) return std::nullopt;
        Substitution at_zero(p_, {{epsilon, p_.number(0)}});
        std::vector<int> result;
        for (const std::vector<int>& row : *slope) result.push_back(at_zero(row[0]));

        std::vector<int> by_matrix;
        for (int i = 0; i < s_; ++i) by_matrix.push_back(row_times(p_, system, i, z));
        std::mt19937_64 random(1);
        const UniformReal<> unit(0.1, 0.9);
        for (int trial = 0; trial < 3; ++trial) {
            State<double> s{.parameters = {}, .t = unit(random), .q = {}, .qdot = {}, .qddot = {}};
            const auto fill = [&](std::vector<double>& list, int size) {
                for (int i = 0; i < size; ++i) list.push_back(unit(random));
            };
            fill(s.parameters, static_cast<int>(p_.parameters.size()));
            fill(s.q, n_);
            fill(s.qdot, s_);
            fill(s.unknown, first_unknown_ + system.size() + 1);
            const std::vector<double> value = interpret(p_, s);
            double largest = 0, difference = 0;
            for (std::size_t i = 0; i < result.size(); ++i) {
                const double a = value[static_cast<std::size_t>(result[i])],
                             b = value[static_cast<std::size_t>(by_matrix[i])];
                largest = std::max(largest, std::abs(b));
                difference = std::max(difference, std::isfinite(a - b) ? std::abs(a - b) : HUGE_VAL);
            }
            if (!(difference <= 1e-9 * largest)) return std::nullopt;
        }
        return result;
    }

    std::optional<Matrix> of(const std::vector<int>& outputs, const std::vector<int>& inputs,
                             EliminationOrder order, const std::vector<int>& stages = {}) {
        const auto parts = partials(p_, outputs, inputs, order, budget_, stages);
        if (!parts) return std::nullopt;
        Matrix result(outputs.size(), std::vector<int>(inputs.size(), p_.number(0)));
        for (const Partial& part : *parts)
            result[static_cast<std::size_t>(part.output)][static_cast<std::size_t>(part.input)] = part.node;
        return result;
    }

    /// ∂q'/∂inputs.
    std::optional<Matrix> rates(const std::vector<int>& inputs, EliminationOrder order) {
        if (!p_.speeds.empty()) return of(p_.nodes_of(Group::rate), inputs, order);
        Matrix result(static_cast<std::size_t>(n_), std::vector<int>(inputs.size(), p_.number(0)));
        for (int i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < inputs.size(); ++j)
                if (inputs[j] == state_[static_cast<std::size_t>(n_ + i)])
                    result[static_cast<std::size_t>(i)][j] = p_.number(1);
        return result;
    }

    Program p_;
    int n_, s_;
    int first_unknown_ = 0;  ///< the first index after the scene's own
    long budget_;
    std::vector<int> state_;
};

struct Route {
    const char* name;
    enum { by_energy, by_matrix, direct, of_changes } through;
    EliminationOrder order;
    const Perturbed* equations = nullptr;  ///< for of_changes
};

constexpr Route routes[] = {
    {"implicit with M u' from T, reverse", Route::by_energy, EliminationOrder::reverse},
    {"implicit with M u' from T, least fill", Route::by_energy, EliminationOrder::least_fill},
    {"implicit, reverse", Route::by_matrix, EliminationOrder::reverse},
    {"implicit, least fill", Route::by_matrix, EliminationOrder::least_fill},
    {"implicit, forward", Route::by_matrix, EliminationOrder::forward},
    {"direct, least fill", Route::direct, EliminationOrder::least_fill},
    {"direct, forward", Route::direct, EliminationOrder::forward}};
constexpr int few_operations =
    2000;  ///< up to this size all routes are tried; for larger systems, only those that are shortest there

/// The routes that are worth a trial.
std::vector<Route> candidates(const Program& program, const DerivativeWishes& wishes) {
    std::vector<Route> result;
    const bool is_large = program.count(program.right_hand_side()).total() > few_operations;
    for (const Perturbed& equations : wishes.perturbed)
        result.push_back({"articulated bodies", Route::of_changes, EliminationOrder::least_fill, &equations});
    if (program.nodes_of(Group::mass).empty() || (is_large && !result.empty())) return result;
    for (const Route& route : routes)
        if (!is_large || (route.through != Route::direct && route.order == EliminationOrder::reverse))
            result.push_back(route);
    return result;
}

Differentiation begun(const Route& route, const Program& program, const DerivativeWishes& wishes) {
    return {route.equations != nullptr ? route.equations->program : program, wishes.budget};
}

std::optional<Matrix> jacobian_by(const Route& route, Differentiation& d, const std::vector<int>& inputs) {
    return route.through == Route::of_changes ? d.of_changes(inputs, *route.equations)
           : route.through == Route::direct   ? d.direct(inputs, route.order)
                                              : d.implicit(inputs, route.order, route.through == Route::by_energy);
}

}  // namespace

std::optional<Differentiated> differentiated(const Program& program, const DerivativeWishes& wishes) {
    if (program.singular) return std::nullopt;
    struct Trial {
        Route route;
        Differentiation program;
        Matrix jacobian;
    };
    std::optional<Trial> best;
    Operations fewest;
    for (const Route& route : candidates(program, wishes)) {
        Differentiation trial = begun(route, program, wishes);
        auto jacobian = jacobian_by(route, trial, trial.state());
        if (!jacobian) continue;
        const Operations cost = trial.cost(*jacobian);
        if (best && cost.total() >= fewest.total()) continue;
        best.emplace(Trial{route, std::move(trial), *std::move(jacobian)});
        fewest = cost;
    }
    if (!best) return std::nullopt;

    auto& [route, chosen, jacobian] = *best;
    chosen.keep(Group::jacobian, "J", jacobian);
    if (wishes.parameters && !program.parameters.empty()) {
        auto by_parameters = jacobian_by(route, chosen, chosen.parameters());
        if (!by_parameters) return std::nullopt;
        if (wishes.power) {
            auto gradient = chosen.power_gradient(chosen.parameters(), *by_parameters);
            if (!gradient) return std::nullopt;
            by_parameters->push_back(*std::move(gradient));
        }
        chosen.keep(Group::parameter_jacobian, "P", *by_parameters);
    }
    if (wishes.power) {
        const auto gradient = chosen.power_gradient(chosen.state(), jacobian);
        if (!gradient) return std::nullopt;
        chosen.keep(Group::power_gradient, "W", {*gradient});
    }
    if (wishes.values) {
        const auto gradient = chosen.value_gradient();
        if (!gradient) return std::nullopt;
        chosen.keep(Group::value_gradient, "G", *gradient);
    }
    return Differentiated{.program = std::move(chosen).finished(), .operations = fewest, .route = route.name};
}

}  // namespace alembert
