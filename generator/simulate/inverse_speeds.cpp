// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/inverse_speeds.hpp"

#include <algorithm>

#include "alembert/base/argument.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using Eigen::Index;

namespace {

/// u, W and w at a state.
void evaluate_forms(SpeedsAt& at, const Mechanism& m, const State<double>& state) {
    std::vector<GiNaC::ex> wanted;
    for (const Mechanism::Speed& speed : m.speeds) {
        wanted.push_back(speed.form);
        wanted.push_back(m.time_derivative_without_acceleration({speed.form})[0]);
        wanted.insert(wanted.end(), speed.row.begin(), speed.row.end());
    }
    Program program = begun(m);
    const std::vector<int> nodes = lower_expressions(program, m, wanted);
    const std::vector<double> value = interpret(program, state);
    const auto k = static_cast<Index>(m.speeds.size()), n = static_cast<Index>(m.size());
    at.value.resize(k), at.rest.resize(k), at.W.resize(k, n);
    std::size_t next = 0;
    const auto take = [&] { return value[static_cast<std::size_t>(nodes[next++])]; };
    for (Index i = 0; i < k; ++i) {
        at.value[i] = take();
        at.rest[i] = take();
        for (Index j = 0; j < n; ++j) at.W(i, j) = take();
    }
}

/// Positions of the constraints that are eliminated: all, the nonholonomic ones, or none.
std::vector<Index> eliminated(const Mechanism& m) {
    std::vector<Index> all, nonholonomic;
    for (Index c = 0; c < static_cast<Index>(m.constraints.size()); ++c) {
        all.push_back(c);
        if (!m.constraints[static_cast<std::size_t>(c)].holonomic) nonholonomic.push_back(c);
    }
    const std::size_t missing = m.q.size() - m.speeds.size();
    return missing == 0 ? std::vector<Index>() : missing == all.size() ? all : nonholonomic;
}

}  // namespace

SpeedsAt speeds_at(const Mechanism& m, const State<double>& state, const Eigen::MatrixXd& A,
                   const Eigen::VectorXd& gamma) {
    SpeedsAt at;
    evaluate_forms(at, m, state);
    const std::vector<Index> gone = eliminated(m);
    for (Index c = 0; c < A.rows(); ++c)
        if (std::find(gone.begin(), gone.end(), c) == gone.end()) at.kept.push_back(c);
    const Index n = at.W.cols(), k = at.W.rows(), rows = k + static_cast<Index>(gone.size());
    if (rows != n) return at;
    Eigen::MatrixXd whole(n, n);
    Eigen::VectorXd right(n);
    whole.topRows(k) = at.W;
    right.head(k) = -at.rest;
    for (std::size_t c = 0; c < gone.size(); ++c) {
        whole.row(k + static_cast<Index>(c)) = A.row(gone[c]);
        right[k + static_cast<Index>(c)] = gamma[gone[c]];
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> solver(whole);
    if (!solver.isInvertible()) return at;
    at.H = solver.solve(Eigen::MatrixXd::Identity(n, k));
    at.h = solver.solve(right);
    return at;
}

std::vector<std::optional<double>> take_speed_rates(Overrides& at, const Scene& scene) {
    std::vector<std::optional<double>> given(scene.speeds.size());
    std::erase_if(at, [&](const std::pair<std::string, double>& item) {
        for (std::size_t k = 0; k < given.size(); ++k) {
            if (item.first != scene.speeds[k].name.text + "'") continue;
            argument::need_finite(item.first, item.second);
            given[k] = item.second;
            return true;
        }
        return false;
    });
    return given;
}

}  // namespace alembert
