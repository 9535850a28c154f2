// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/start_derivatives.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "alembert/base/dense.hpp"
#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"
#include "program/partials.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Kind = StartName::Kind;

/// The derivatives of nodes by inputs at a state.
Eigen::MatrixXd slopes(Program program, const std::vector<int>& outputs, const std::vector<int>& inputs,
                       const State<double>& state) {
    constexpr long budget = std::numeric_limits<long>::max();
    const auto found = partials(program, outputs, inputs, EliminationOrder::least_fill, budget);
    const std::vector<double> value = interpret(program, state);
    Eigen::MatrixXd result =
        Eigen::MatrixXd::Zero(static_cast<Index>(outputs.size()), static_cast<Index>(inputs.size()));
    for (const Partial& one : *found) result(one.output, one.input) = value[static_cast<std::size_t>(one.node)];
    return result;
}

std::vector<int> variables(Program& program, Variable::Kind kind, Index count) {
    std::vector<int> result;
    for (int i = 0; i < count; ++i) result.push_back(program.variable({kind, i}));
    return result;
}

class Varied {
public:
    Varied(const Mechanism& m, const Equations& equations, const Start& start)
        : m_(m), start_(start), n_(m.size()), parameters_(static_cast<Index>(start.parameters.size())) {
        Program expressions;
        std::vector<GiNaC::ex> values = m.q_start;
        values.insert(values.end(), m.qdot_start.begin(), m.qdot_start.end());
        if (has_speeds())
            for (const Mechanism::Speed& speed : m.speeds) values.push_back(*speed.start);
        for (const Mechanism::State& z : m.states) values.push_back(z.start);
        const std::vector<int> nodes = lower_expressions(expressions, m, values);
        const std::vector<int> by = variables(expressions, Variable::Kind::parameter, parameters_);
        expressions_ = slopes(std::move(expressions), nodes, by,
                              {.parameters = start.parameters, .q = {}, .qdot = {}, .qddot = {}});

        Program kept = lower_constraints(m);
        std::vector<int> outputs;
        for (const Group group : {Group::position, Group::velocity, Group::speed}) {
            const std::vector<int> some = kept.nodes_of(group);
            outputs.insert(outputs.end(), some.begin(), some.end());
        }
        constraints_ = static_cast<Index>(kept.nodes_of(Group::velocity).size());
        const std::vector<int> inputs = state_and_parameters(kept);
        kept_ = slopes(std::move(kept), outputs, inputs, start.state());

        if (equations.speeds_are_rates()) return;
        Program form;
        const std::vector<int> speeds = lower_expressions(form, in_terms_of(equations, m), equations.form);
        form_ = slopes(form, speeds, state_and_parameters(form), start.state());
    }

    std::vector<double> column(const StartName& name) const {
        Eigen::VectorXd change = Eigen::VectorXd::Zero(2 * n_ + parameters_), speeds;
        const auto index = static_cast<Index>(name.index);
        Eigen::VectorXd states = Eigen::VectorXd::Zero(static_cast<Index>(m_.states.size()));
        if (has_speeds()) speeds = Eigen::VectorXd::Zero(static_cast<Index>(m_.speeds.size()));
        switch (name.kind) {
            case Kind::parameter:
                change.head(2 * n_) = expressions_.col(index).head(2 * n_);
                change[2 * n_ + index] = 1;
                speeds = expressions_.col(index).segment(2 * n_, speeds.size());
                states = expressions_.col(index).tail(states.size());
                break;
            case Kind::coordinate:
                change[index] = 1;
                break;
            case Kind::rate:
                change[n_ + index] = 1;
                break;
            case Kind::speed:
                speeds[index] = 1;
                break;
            case Kind::state:
                states[index] = 1;
                break;
        }
        follow(name, change, guesses(m_.q_is_guess, name, Kind::coordinate), 0,
               Eigen::VectorXd::Zero(constraints_));
        if (has_speeds()) {
            std::vector<Index> all(static_cast<std::size_t>(n_));
            std::iota(all.begin(), all.end(), n_);
            change.segment(n_, n_).setZero();
            Eigen::VectorXd wanted = Eigen::VectorXd::Zero(constraints_ + speeds.size());
            wanted.tail(speeds.size()) = speeds;
            follow(name, change, all, constraints_, wanted);
        } else {
            follow(name, change, guesses(m_.qdot_is_guess, name, Kind::rate), constraints_,
                   Eigen::VectorXd::Zero(constraints_));
        }
        std::vector<double> result(change.data(), change.data() + (form_ ? n_ : 2 * n_));
        if (form_) {
            const Eigen::VectorXd rates = *form_ * change;
            result.insert(result.end(), rates.data(), rates.data() + rates.size());
        }
        result.insert(result.end(), states.data(), states.data() + states.size());
        return result;
    }

private:
    bool has_speeds() const { return !start_.speeds.empty(); }

    std::vector<int> state_and_parameters(Program& program) const {
        std::vector<int> result = variables(program, Variable::Kind::coordinate, n_);
        for (const auto& [kind, count] :
             {std::pair(Variable::Kind::rate, n_), {Variable::Kind::parameter, parameters_}}) {
            const std::vector<int> some = variables(program, kind, count);
            result.insert(result.end(), some.begin(), some.end());
        }
        return result;
    }

    std::vector<Index> guesses(const std::vector<bool>& is_guess, const StartName& name, Kind kind) const {
        std::vector<Index> result;
        for (Index i = 0; i < n_; ++i)
            if (is_guess[static_cast<std::size_t>(i)] &&
                !(name.kind == kind && static_cast<Index>(name.index) == i))
                result.push_back(kind == Kind::coordinate ? i : n_ + i);
        return result;
    }

    /// Changes the free components so that the rows from `first` on change by `wanted`.
    void follow(const StartName& name, Eigen::VectorXd& change, const std::vector<Index>& free, Index first,
                const Eigen::VectorXd& wanted) const {
        if (wanted.size() == 0) return;
        const auto rows = kept_.middleRows(first, wanted.size());
        if (!free.empty()) {
            const LeastNorm step = least_norm(rows(Eigen::all, free), rows * change - wanted);
            if (step.rank < static_cast<Index>(free.size()))
                throw ModelError(
                    say("--sensitivity: the constraints determine {} of the {} values at the start that may move "
                        "when '{}' varies; give the others without 'guess'",
                        step.rank, free.size(), name.name));
            change(free) -= step.x.col(0);
        }
        const Eigen::VectorXd left = (rows * change - wanted).cwiseAbs(),
                              size = rows.cwiseAbs() * change.cwiseAbs() + wanted.cwiseAbs();
        for (Index k = 0; k < left.size(); ++k)
            if (!(left[k] <= 1e-9 * size[k]))
                throw ModelError(say(
                    "--sensitivity: '{}' cannot vary by itself at the start, because '{}' would be broken; let "
                    "other initial values follow: guess, rate_guess",
                    name.name, name_of(first + k)));
    }

    std::string name_of(Index row) const {
        const auto k = static_cast<std::size_t>(row < 2 * constraints_ ? row % std::max<Index>(constraints_, 1)
                                                                       : row - 2 * constraints_);
        return row < 2 * constraints_ ? m_.constraints[k].name : m_.speeds[k].u.get_name();
    }

    const Mechanism& m_;
    const Start& start_;
    Index n_, parameters_, constraints_ = 0;
    Eigen::MatrixXd expressions_;          ///< [q, q', speeds] as the scene writes them, by parameters
    Eigen::MatrixXd kept_;                 ///< [positions, velocities, the scene's speeds] by [q, q', parameters]
    std::optional<Eigen::MatrixXd> form_;  ///< the speeds of the equations by the same, if they are not the rates
};

}  // namespace

std::vector<std::vector<double>> start_derivatives(const Mechanism& mechanism, const Equations& equations,
                                                   const Start& start, const std::vector<StartName>& names) {
    const Varied varied(mechanism, equations, start);
    std::vector<std::vector<double>> columns;
    for (const StartName& name : names) columns.push_back(varied.column(name));
    return columns;
}

}  // namespace alembert
