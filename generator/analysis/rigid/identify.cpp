// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/rigid/identify.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "alembert/base/dense.hpp"
#include "alembert/base/error.hpp"
#include "alembert/base/random.hpp"
#include "analysis/rigid/coefficient_texts.hpp"
#include "base/language/say.hpp"
#include "program/interpret.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/start.hpp"

namespace alembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd matrix(const std::vector<double>& values, const std::vector<int>& nodes, Index columns) {
    MatrixXd result(static_cast<Index>(nodes.size()) / columns, columns);
    for (std::size_t k = 0; k < nodes.size(); ++k)
        result(static_cast<Index>(k) / columns, static_cast<Index>(k) % columns) =
            values[static_cast<std::size_t>(nodes[k])];
    return result;
}

/// Brings a state to the constraints by Newton's method, with rates and accelerations that obey them too. Returns
/// a basis of the motions that they allow; nothing if the method does not converge.
std::optional<MatrixXd> constrained(State<double>& state, const RegressorColumns::Constraints& c) {
    const auto n = static_cast<Index>(state.q.size());
    if (c.offset.empty()) return MatrixXd::Identity(n, n);
    const auto map = [](std::vector<double>& v) {
        return Eigen::Map<VectorXd>(v.data(), static_cast<Index>(v.size()));
    };
    constexpr int most_steps = 40;
    std::vector<double> value;
    for (int step = 0; step < most_steps; ++step) {
        value = interpret(c.program, state);
        MatrixXd slope(static_cast<Index>(c.positions.size()), n);
        for (Index k = 0; k < slope.rows(); ++k) slope.row(k) = matrix(value, c.rows, n).row(c.row_of[k]);
        const VectorXd f = matrix(value, c.positions, 1);
        if (f.size() == 0 || f.cwiseAbs().maxCoeff() < 1e-13) break;
        if (step + 1 == most_steps) return std::nullopt;
        map(state.q) -= VectorXd(least_norm(slope, f).x);
    }
    const MatrixXd A = matrix(value, c.rows, n);
    const MatrixXd to_obey = least_norm(A, MatrixXd::Identity(A.rows(), A.rows())).x,
                   allowed = MatrixXd::Identity(n, n) - to_obey * A;
    const VectorXd rates = map(state.qdot), accelerations = map(state.qddot), offset = matrix(value, c.offset, 1);
    map(state.qdot) = allowed * rates - to_obey * offset;
    value = interpret(c.program, state);
    const VectorXd gamma = matrix(value, c.gamma, 1);
    map(state.qddot) = allowed * accelerations + to_obey * gamma;
    return allowed;
}

/// Least squares over random states: the columns by those of the pivots, a row for each pivot.
MatrixXd coefficients_in_doubles(const Regressor& y, const std::vector<std::size_t>& order,
                                 const ColumnDependence& d, const RegressorColumns::Constraints& constraints,
                                 const State<double>& start) {
    const Program& p = y.function.program;
    const std::vector<int> nodes = p.nodes_of(Group::function);
    const auto width = static_cast<Index>(order.size()), each = static_cast<Index>(y.function.rows),
               free = std::max<Index>(1, each - static_cast<Index>(constraints.offset.size())),
               states = 3 * width / free + 4;
    MatrixXd W = MatrixXd::Zero(states * each, width);
    std::mt19937_64 random(1);
    const UniformReal<> any(-3, 3);
    for (Index s = 0, tries = 0; s < states && tries < 20 * states; ++tries) {
        State<double> state = start;
        state.qddot.resize(state.q.size());
        for (auto* list : {&state.q, &state.qdot, &state.qddot})
            for (double& x : *list) x = any(random);
        const std::optional<MatrixXd> motions = constrained(state, constraints);
        if (!motions) continue;
        const MatrixXd Y = motions->transpose() * matrix(interpret(p, state), nodes, width);
        for (Index k = 0; k < width; ++k)
            W.col(k).segment(s * each, each) = Y.col(static_cast<Index>(order[static_cast<std::size_t>(k)]));
        ++s;
    }
    MatrixXd kept(W.rows(), static_cast<Index>(d.pivots.size()));
    for (std::size_t r = 0; r < d.pivots.size(); ++r)
        kept.col(static_cast<Index>(r)) = W.col(static_cast<Index>(d.pivots[r]));
    return least_norm(kept, W).x;
}

/// Second moments, then first moments, then masses, then rotors.
std::vector<std::size_t> order_of(const std::vector<InertialParameter>& columns) {
    std::vector<std::size_t> order(columns.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto kind = [&](std::size_t k) {
        const int which = columns[k].which;
        return which == InertialParameter::rotor ? 3 : which == 0 ? 2 : which < 4 ? 1 : 0;
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return kind(a) < kind(b); });
    return order;
}

/// The exact values of the parameters; random ones where they are not rational.
std::vector<Prime> exact_values(const Mechanism& m) {
    std::vector<Prime> values;
    for (const Mechanism::Parameter& p : m.parameters) {
        if (!p.independent) continue;
        std::optional<Prime> value;
        if (GiNaC::is_a<GiNaC::numeric>(p.value) && p.value.info(GiNaC::info_flags::rational))
            value = Prime::from(cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(p.value).to_cl_N()));
        values.push_back(value.value_or(
            ModularPoint{.seed = 3}.variable({Variable::Kind::parameter, static_cast<int>(values.size())})));
    }
    return values;
}

/// The scene's values of parameters of bodies and their mass centres.
std::vector<double> values_of(const Regressor& y, const Mechanism& mechanism, const State<double>& state,
                              std::vector<Identification::Body>& bodies) {
    Mechanism m = mechanism;
    m.z = y.z;
    std::vector<GiNaC::ex> list = y.values;
    for (const auto& [name, centre] : y.centres) list.insert(list.end(), centre.begin(), centre.end());
    Program program;
    const std::vector<int> nodes = lower_expressions(program, m, list);
    const std::vector<double> at = interpret(program, state);
    std::vector<double> values;
    for (const int node : nodes) values.push_back(at[static_cast<std::size_t>(node)]);
    for (std::size_t k = 0, next = y.values.size(); k < y.centres.size(); ++k, next += 3)
        bodies.push_back({y.centres[k].first, {values[next], values[next + 1], values[next + 2]}});
    values.resize(y.values.size());
    return values;
}

}  // namespace

Identification identify(Scene scene) {
    Identification result{prepared(std::move(scene))};
    const Mechanism& m = result.mechanism;
    const Regressor y = regressor(result.scene, m, false);
    if (y.columns.empty())
        throw ModelError(
            say("the scene has no masses, of which motion could show sums; expected a particle or a body"));
    const std::vector<std::size_t> order = order_of(y.columns);
    const RegressorColumns columns(y, order, m);
    const std::vector<Prime> exact = exact_values(m);
    const std::optional<ColumnDependence> found = columns.dependence(exact);
    if (!found)
        throw ModelError(
            say("the regressor has square roots or angles that have no exact values at random states"));
    const State<double> start = start_of(m).state();
    const std::vector<double> values = values_of(y, m, start, result.bodies);
    for (const InertialParameter& column : y.columns) result.parameters.push_back(column.name());
    const std::vector<DependentEntry> entries = entries_of(*found);
    const std::vector<std::string> texts =
        polynomials(columns, *found, entries, exact, y.function.program.parameters);
    const Eigen::MatrixXd numbers = coefficients_in_doubles(y, order, *found, columns.constraints(), start);

    std::vector<char> shows(order.size(), 0);
    for (const std::size_t pivot : found->pivots) {
        const std::size_t column = order[pivot];
        shows[column] = 1;
        result.base.push_back({.terms = {{result.parameters[column], "1", 1}}, .value = values[column]});
    }
    for (std::size_t e = 0; e < entries.size(); ++e) {
        const std::size_t column = order[entries[e].column];
        shows[column] = 1;
        const double fitted = numbers(static_cast<Index>(entries[e].row), static_cast<Index>(entries[e].column));
        const std::optional<Rational> fraction = short_fraction(found->rows[entries[e].row][entries[e].column]);
        constexpr double agreement = 1e-6;  // of least squares
        const bool is_short =
            fraction && std::abs(cln::double_approx(*fraction) - fitted) < agreement * (1 + std::abs(fitted));
        const double number = is_short ? cln::double_approx(*fraction) : fitted;
        const std::string text = !texts[e].empty() ? texts[e]
                                 : is_short        ? coefficient_text(*fraction)
                                                   : fmt::format("{:.10g}", number);
        BaseParameter& base = result.base[entries[e].row];
        base.terms.push_back({result.parameters[column], text, number});
        base.value += number * values[column];
    }
    for (std::size_t k = 0; k < shows.size(); ++k)
        if (shows[k] == 0) result.without_influence.push_back(result.parameters[k]);
    return result;
}

}  // namespace alembert
