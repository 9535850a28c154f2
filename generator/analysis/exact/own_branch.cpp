// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/own_branch.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/exact/angle_variables.hpp"
#include "analysis/exact/solve_together.hpp"

namespace alembert {

using GiNaC::numeric;

namespace {

using Key = RealState::Key;

double* place_of(State<double>& state, const Key& key) {
    const auto i = static_cast<std::size_t>(key.second);
    switch (key.first) {
        case Variable::Kind::time:
            return &state.t;
        case Variable::Kind::coordinate:
            return i < state.q.size() ? &state.q[i] : nullptr;
        case Variable::Kind::parameter:
            return i < state.parameters.size() ? &state.parameters[i] : nullptr;
        default:
            return nullptr;
    }
}

}  // namespace

double value_at(const State<double>& place, const Key& key) {
    State<double> copy = place;
    const double* const value = place_of(copy, key);
    return value != nullptr ? *value : 0;
}

namespace {

/// Zeros for the variables that positions do not depend on.
void fill(State<double>& state, const Program& program) {
    for (int id = 0; id < program.size(); ++id) {
        if (program[id].op != Op::variable) continue;
        const Variable& variable = program[id].variable;
        auto* const list = variable.kind == Variable::Kind::rate           ? &state.qdot
                           : variable.kind == Variable::Kind::acceleration ? &state.qddot
                           : variable.kind == Variable::Kind::unknown      ? &state.unknown
                                                                           : nullptr;
        const auto size = static_cast<std::size_t>(variable.index) + 1;
        if (list != nullptr && list->size() < size) list->resize(size);
    }
}

/// The slopes of the nodes in one variable, by differences that are right to some 1e-10; nothing if it has no
/// value.
std::optional<std::vector<double>> slopes_in(const Program& program, State<double> state, const Key& key,
                                             const std::vector<int>& nodes) {
    double* const x = place_of(state, key);
    if (x == nullptr) return std::nullopt;
    fill(state, program);
    const double step = 1e-5 * (1 + std::abs(*x));
    *x += step;
    const std::vector<double> above = interpret(program, state);
    *x -= 2 * step;
    const std::vector<double> below = interpret(program, state);
    std::vector<double> result;
    for (const int id : nodes) {
        const auto node = static_cast<std::size_t>(id);
        result.push_back((above[node] - below[node]) / (2 * step));
    }
    return result;
}

}  // namespace

std::vector<Key> OwnSlopes::determined(const std::vector<int>& conditions, const State<double>& place) const {
    constexpr double least = 1e-6;
    std::vector<std::vector<double>> columns;
    for (std::size_t i = 0; i < place.q.size(); ++i)
        columns.push_back(
            *slopes_in(program_, place, {Variable::Kind::coordinate, static_cast<int>(i)}, conditions));
    std::vector<Key> result;
    std::vector<bool> used(conditions.size(), false);
    for (std::size_t k = 0; k < conditions.size(); ++k) {
        std::size_t row = 0, column = 0;
        double largest = least;
        for (std::size_t i = 0; i < columns.size(); ++i)
            for (std::size_t r = 0; r < conditions.size(); ++r)
                if (!used[r] && std::abs(columns[i][r]) > largest)
                    largest = std::abs(columns[i][r]), row = r, column = i;
        if (largest == least) break;
        used[row] = true;
        result.emplace_back(Variable::Kind::coordinate, static_cast<int>(column));
        // Columns take the place of columns minus multiples of this one, which then is zero in the row.
        const std::vector<double> pivot = columns[column];
        for (std::vector<double>& other : columns) {
            const double factor = other[row] / pivot[row];
            for (std::size_t r = 0; r < conditions.size(); ++r) other[r] -= factor * pivot[r];
        }
    }
    return result;
}

bool OwnSlopes::determine(const SolvedUnknown& one) const {
    constexpr double least = 1e-7;  // differences are right to some 1e-10
    return std::any_of(branch_.places.begin(), branch_.places.end(), [&](const State<double>& place) {
        const auto slope = slopes_in(program_, place, key_of(one), {one.node});
        return !slope || std::abs((*slope)[0]) > least;
    });
}

bool OwnSlopes::determine(const SolvedUnknown& one, const SolvedUnknown& other) const {
    constexpr double least = 1e-6;
    return std::any_of(branch_.places.begin(), branch_.places.end(), [&](const State<double>& place) {
        const auto a = slopes_in(program_, place, key_of(one), {one.node, other.node});
        const auto b = slopes_in(program_, place, key_of(other), {one.node, other.node});
        if (!a || !b) return true;
        const double size = (std::abs((*a)[0]) + std::abs((*b)[0])) * (std::abs((*a)[1]) + std::abs((*b)[1]));
        return std::abs((*a)[0] * (*b)[1] - (*b)[0] * (*a)[1]) > least * size;
    });
}

namespace {

/// log₂ of the size of the determinant of the slopes of the conditions in the solved variables, and its sign; zero
/// where the slopes have no values.
std::pair<double, int> determinant(const Program& program, const std::vector<int>& conditions,
                                   const std::vector<Key>& solved, const State<double>& at) {
    Eigen::MatrixXd slopes(static_cast<Eigen::Index>(conditions.size()), static_cast<Eigen::Index>(solved.size()));
    for (Eigen::Index i = 0; i < slopes.cols(); ++i) {
        const auto column = slopes_in(program, at, solved[static_cast<std::size_t>(i)], conditions);
        if (!column) return {0, 0};
        slopes.col(i) = Eigen::Map<const Eigen::VectorXd>(column->data(), slopes.rows());
    }
    const double value = slopes.determinant();
    return {std::log2(std::abs(value)), value > 0 ? 1 : value < 0 ? -1 : 0};
}

/// Whether branches may meet between the place and the state beside it: there the determinant of the conditions
/// vanishes.
bool may_have_crossed(const Program& program, const std::vector<int>& conditions, const std::vector<Key>& solved,
                      const State<double>& place, const RealState& state) {
    constexpr double most_changed = 0.6;  // for each condition, as log₂
    if (conditions.size() != solved.size()) return false;
    State<double> there = place;
    for (const auto& [key, value] : state.value)
        if (double* const x = place_of(there, key)) *x = value.to_double();
    const auto [before, sign_before] = determinant(program, conditions, solved, place);
    const auto [after, sign_after] = determinant(program, conditions, solved, there);
    return sign_before != sign_after ||
           (sign_before != 0 && std::abs(after - before) > most_changed * static_cast<double>(solved.size()));
}

/// Whether the solved variables have gone another way than their slopes at the place tell: where two branches meet
/// nearby, the state may be on the other one.
bool has_left_tangent(const Program& program, const std::vector<int>& conditions, const std::vector<Key>& solved,
                      const State<double>& place, const RealState& state) {
    constexpr double most = 0.5;  // of the change that the slopes tell, or of that of the free variables
    const auto n = static_cast<Eigen::Index>(solved.size());
    if (conditions.size() != solved.size()) return false;
    Eigen::MatrixXd by_solved(n, n);
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(n), actual(n);
    double largest = 0;
    for (const auto& [key, value] : state.value) {
        double change = value.to_double() - value_at(place, key);
        if (state.angle.contains(key)) change = std::remainder(change, 2 * std::numbers::pi);
        const auto column = slopes_in(program, place, key, conditions);
        if (!column) continue;
        const Eigen::VectorXd slope = Eigen::Map<const Eigen::VectorXd>(column->data(), n);
        const auto found = std::find(solved.begin(), solved.end(), key);
        if (found == solved.end()) {
            moved += change * slope;
            largest = std::max(largest, std::abs(change));
        } else {
            by_solved.col(found - solved.begin()) = slope;
            actual[found - solved.begin()] = change;
        }
    }
    const Eigen::VectorXd told = -by_solved.fullPivLu().solve(moved);
    if (!told.allFinite()) return true;
    return (actual - told).cwiseAbs().maxCoeff() > most * std::max(largest, told.cwiseAbs().maxCoeff());
}

}  // namespace

std::optional<RealState> state_beside(const Program& program, const std::vector<int>& conditions,
                                      const State<double>& place, const std::vector<Key>& solved, double reach,
                                      const PutFree& put) {
    constexpr double most_leverage = 30;  // how much more the solved variables may change than the others
    const FiftyDigits digits;
    std::set<Key> angles, plain;
    find_variables(program, conditions, angles, plain);
    angles.merge(plain);
    RealState state;
    for (const Key& key : angles)
        if (std::find(solved.begin(), solved.end(), key) == solved.end()) put(state, key, value_at(place, key));
    std::vector<numeric> x;
    for (const Key& key : solved) x.emplace_back(value_at(place, key));
    const std::vector<numeric> before = x;
    const auto at = [&](const std::vector<numeric>& values) {
        for (std::size_t i = 0; i < solved.size(); ++i) state.value[solved[i]] = values[i];
        return evaluate(program, state, conditions);
    };
    const auto found =
        solve_together(at, std::move(x), most_leverage * reach * static_cast<double>(1 + before.size()));
    if (!found) return std::nullopt;
    for (std::size_t i = 0; i < solved.size(); ++i) {
        const double was = before[i].to_double();
        if (std::abs((*found)[i].to_double() - was) > most_leverage * reach * (1 + std::abs(was)))
            return std::nullopt;
        state.value[solved[i]] = (*found)[i];
    }
    if (may_have_crossed(program, conditions, solved, place, state) ||
        has_left_tangent(program, conditions, solved, place, state))
        return std::nullopt;
    state.exact = false;
    return state;
}

}  // namespace alembert
