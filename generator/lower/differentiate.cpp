// SPDX-License-Identifier: GPL-2.0-or-later
#include "lower/differentiate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "lower/partials.hpp"
#include "lower/solve.hpp"

namespace alembert {

namespace {

using Matrix = std::vector<std::vector<int>>;  ///< of nodes, row by row

/// K (lower triangle) and b of K (u', −λ) = b.
struct System {
    std::vector<int> K, b;
    int speeds = 0;
    int size() const { return static_cast<int>(b.size()); }
    int entry(int i, int j) const { return i < j ? entry(j, i) : K[static_cast<std::size_t>(i * (i + 1) / 2 + j)]; }
};

System system_of(Program& p) {
    System s{.K = p.nodes_of("mass"), .b = p.nodes_of("forcing")};
    s.speeds = s.size();
    const std::vector<int> rows = p.nodes_of(p.speeds.empty() ? "row" : "speed_row");
    int kept = 0;
    for (const Root& root : std::vector<Root>(p.roots)) {
        if (root.group != "gamma") continue;
        const int c = std::stoi(root.name.substr(5));  // "gamma2": of the third constraint
        for (int i = 0; i < s.speeds; ++i) s.K.push_back(rows[static_cast<std::size_t>(c * s.speeds + i)]);
        for (int j = 0; j <= kept; ++j) s.K.push_back(p.number(0));
        s.b.push_back(root.node);
        ++kept;
    }
    return s;
}

/// The nodes with `values` in the place of the unknowns that stand for them.
class Substitution {
public:
    Substitution(Program& program, std::map<int, int> values) : p_(program), known_(std::move(values)) {}

    int operator()(int root) {
        for (const int id : p_.needed(std::vector<int>{root})) rebuild(id);
        return at(root);
    }

private:
    static constexpr unsigned unknown = 1U << static_cast<unsigned>(Variable::Kind::unknown);

    int at(int id) const {
        const auto found = known_.find(id);
        return found == known_.end() ? id : found->second;
    }

    void rebuild(int id) {
        const Node node = p_[id];
        if ((node.depends & unknown) == 0 || known_.contains(id)) return;
        if (node.op == Op::variable) return;
        if (node.op == Op::sum) {
            std::vector<Program::Term> terms;
            for (std::size_t k = 0; k < node.args.size(); ++k) terms.emplace_back(node.coefficients[k], at(node.args[k]));
            known_[id] = p_.sum(node.number, terms);
        } else if (node.op == Op::product) {
            std::vector<Program::Factor> factors;
            for (std::size_t k = 0; k < node.args.size(); ++k) factors.emplace_back(at(node.args[k]), node.exponents[k]);
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
        : p_(program), n_(static_cast<int>(program.coordinates.size())),
          s_(program.speeds.empty() ? n_ : static_cast<int>(program.speeds.size())), budget_(budget) {
        for (int i = 0; i < n_; ++i) state_.push_back(p_.variable({Variable::Kind::coordinate, i}));
        for (int i = 0; i < s_; ++i) state_.push_back(p_.variable({Variable::Kind::rate, i}));
    }

    const std::vector<int>& state() const { return state_; }
    std::vector<int> parameters() {
        std::vector<int> list;
        for (std::size_t i = 0; i < p_.parameters.size(); ++i)
            list.push_back(p_.variable({Variable::Kind::parameter, static_cast<int>(i)}));
        return list;
    }

    /// ∂(q', u')/∂inputs through R.
    std::optional<Matrix> implicit(const std::vector<int>& inputs, Elimination order) {
        System system = system_of(p_);
        const std::optional<Matrix> x = solve_for_sides(p_, system.K, {system.b}, system.speeds);
        if (!x) return std::nullopt;
        std::map<int, int> solved;
        std::vector<int> unknown, residuals;
        for (int i = 0; i < system.size(); ++i) {
            unknown.push_back(p_.variable({Variable::Kind::unknown, first_unknown + i}));
            solved[unknown.back()] = (*x)[0][static_cast<std::size_t>(i)];
        }
        for (int i = 0; i < system.size(); ++i) {
            std::vector<Program::Term> terms{{1, system.b[static_cast<std::size_t>(i)]}};
            for (int j = 0; j < system.size(); ++j)
                terms.emplace_back(-1, p_.product(1, {{system.entry(i, j), 1}, {unknown[static_cast<std::size_t>(j)], 1}}));
            residuals.push_back(p_.sum(0, terms));
        }
        const auto parts = partials(p_, residuals, inputs, order, budget_);
        if (!parts) return std::nullopt;
        Matrix columns(inputs.size(), std::vector<int>(residuals.size(), p_.number(0)));
        Substitution with_solution(p_, std::move(solved));
        for (const Partial& part : *parts)
            columns[static_cast<std::size_t>(part.input)][static_cast<std::size_t>(part.output)] = with_solution(part.node);
        const std::optional<Matrix> derivative = solve_for_sides(p_, system.K, columns, system.speeds);
        if (!derivative) return std::nullopt;
        std::optional<Matrix> result = rates(inputs, order);
        for (int i = 0; result && i < s_; ++i) {
            result->emplace_back();
            for (const std::vector<int>& column : *derivative) result->back().push_back(column[static_cast<std::size_t>(i)]);
        }
        return result;
    }

    /// The same straight through the accelerations.
    std::optional<Matrix> direct(const std::vector<int>& inputs, Elimination order) {
        std::optional<Matrix> result = rates(inputs, order);
        if (!result) return result;
        const auto below = of(p_.nodes_of("acceleration"), inputs, order);
        if (!below) return std::nullopt;
        result->insert(result->end(), below->begin(), below->end());
        return result;
    }

    /// d(dE/dt)/d state, given the Jacobian: the power is a function of state, u' and multipliers.
    std::optional<std::vector<int>> power_gradient(const Matrix& jacobian) {
        const std::vector<int> power = p_.nodes_of("power"), acceleration = p_.nodes_of("acceleration");
        std::vector<int> inputs = state_;
        std::map<int, int> row_of;  // node: row of the Jacobian that holds its derivative
        for (int i = 0; i < s_; ++i) {
            row_of.emplace(acceleration[static_cast<std::size_t>(i)], n_ + i);
            row_of.emplace(p_.variable({Variable::Kind::acceleration, i}), n_ + i);
        }
        for (const int id : state_) row_of.erase(id);
        for (const auto& [id, row] : row_of)
            if (!p_[id].is_number()) inputs.push_back(id);
        const auto parts = partials(p_, power, inputs, Elimination::reverse, budget_);
        if (!parts) return std::nullopt;
        std::vector<std::vector<Program::Term>> sums(state_.size());
        for (const Partial& part : *parts) {
            const auto k = static_cast<std::size_t>(part.input);
            if (k < state_.size()) {
                sums[k].emplace_back(1, part.node);
                continue;
            }
            const std::vector<int>& row = jacobian[static_cast<std::size_t>(row_of.at(inputs[k]))];
            for (std::size_t j = 0; j < sums.size(); ++j)
                sums[j].emplace_back(1, p_.product(1, {{part.node, 1}, {row[j], 1}}));
        }
        std::vector<int> gradient;
        for (const auto& terms : sums) gradient.push_back(p_.sum(0, terms));
        return gradient;
    }

    Operations cost(const Matrix& m) const {
        std::vector<int> nodes;
        for (const auto& row : m) nodes.insert(nodes.end(), row.begin(), row.end());
        return p_.count(nodes);
    }

    void keep(const std::string& group, const std::string& letter, const Matrix& m) {
        for (std::size_t i = 0; i < m.size(); ++i)
            for (std::size_t j = 0; j < m[i].size(); ++j) p_.roots.push_back({group, fmt::format("{}{}_{}", letter, i, j), m[i][j]});
    }

    Program finished() && { return p_.canonical(); }

private:
    static constexpr int first_unknown = 1 << 20;  ///< beyond those that a scene may have

    std::optional<Matrix> of(const std::vector<int>& outputs, const std::vector<int>& inputs, Elimination order) {
        const auto parts = partials(p_, outputs, inputs, order, budget_);
        if (!parts) return std::nullopt;
        Matrix result(outputs.size(), std::vector<int>(inputs.size(), p_.number(0)));
        for (const Partial& part : *parts)
            result[static_cast<std::size_t>(part.output)][static_cast<std::size_t>(part.input)] = part.node;
        return result;
    }

    /// ∂q'/∂inputs.
    std::optional<Matrix> rates(const std::vector<int>& inputs, Elimination order) {
        if (!p_.speeds.empty()) return of(p_.nodes_of("rate"), inputs, order);
        Matrix result(static_cast<std::size_t>(n_), std::vector<int>(inputs.size(), p_.number(0)));
        for (int i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < inputs.size(); ++j)
                if (inputs[j] == state_[static_cast<std::size_t>(n_ + i)]) result[static_cast<std::size_t>(i)][j] = p_.number(1);
        return result;
    }

    Program p_;
    int n_, s_;
    long budget_;
    std::vector<int> state_;
};

struct Route {
    const char* name;
    bool implicit;
    Elimination order;
};

constexpr Route routes[] = {{"implicit, least fill", true, Elimination::least_fill},
                            {"implicit, reverse", true, Elimination::reverse},
                            {"implicit, forward", true, Elimination::forward},
                            {"direct, least fill", false, Elimination::least_fill},
                            {"direct, forward", false, Elimination::forward}};

}  // namespace

std::optional<Differentiated> differentiated(const Program& program, const DerivativeWishes& wishes) {
    if (program.singular) return std::nullopt;
    const Route* best = nullptr;
    Operations fewest;
    for (const Route& route : routes) {
        Differentiation trial(program, wishes.budget);
        const auto jacobian = route.implicit ? trial.implicit(trial.state(), route.order) : trial.direct(trial.state(), route.order);
        if (!jacobian) continue;
        const Operations cost = trial.cost(*jacobian);
        if (getenv("DERIV_TRACE")) fmt::print(stderr, "{}: {} (rhs {})\n", route.name, cost.total(), program.count(program.right_hand_side()).total());
        if (best == nullptr || cost.total() < fewest.total()) best = &route, fewest = cost;
    }
    if (best == nullptr) return std::nullopt;

    Differentiation chosen(program, wishes.budget);
    const auto by = [&](const std::vector<int>& inputs) {
        return best->implicit ? chosen.implicit(inputs, best->order) : chosen.direct(inputs, best->order);
    };
    const Matrix jacobian = *by(chosen.state());
    chosen.keep("jacobian", "J", jacobian);
    if (wishes.parameters) {
        const auto by_parameters = by(chosen.parameters());
        if (!by_parameters) return std::nullopt;
        chosen.keep("parameter_jacobian", "P", *by_parameters);
    }
    if (wishes.power) {
        const auto gradient = chosen.power_gradient(jacobian);
        if (!gradient) return std::nullopt;
        chosen.keep("power_gradient", "W", {*gradient});
    }
    return Differentiated{.program = std::move(chosen).finished(), .operations = fewest, .route = best->name};
}

}  // namespace alembert
