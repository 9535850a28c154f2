// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/speeds.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "alembert/base/random.hpp"
#include "alembert/base/tolerances.hpp"
#include "base/language/say.hpp"
#include "model/formalism/kinematics.hpp"
#include "model/sample_functions.hpp"
#include "program/lower/lower.hpp"
#include "program/lower/start.hpp"

namespace alembert {

namespace {

constexpr int most_states = 8;
/// The first row that is a combination of those before it, or −1 (Gram-Schmidt, twice).
int first_dependent(const Eigen::MatrixXd& rows) {
    std::vector<Eigen::RowVectorXd> basis;
    for (Eigen::Index k = 0; k < rows.rows(); ++k) {
        Eigen::RowVectorXd row = rows.row(k);
        for (int round = 0; round < 2; ++round)
            for (const Eigen::RowVectorXd& b : basis) row -= row.dot(b) * b;
        if (!(row.norm() > tolerance::dependent_row * rows.row(k).norm())) return static_cast<int>(k);
        basis.push_back(row.normalized());
    }
    return -1;
}

}  // namespace

std::optional<Diagnostic> mistake_in_speeds(const Mechanism& m) {
    if (constraints_are_open(m)) return mistake_in_speeds(with_sample_functions(m));
    if (m.speeds.empty()) return std::nullopt;
    const int n = m.size(), count = static_cast<int>(m.speeds.size());
    const std::vector<int> allowed = allowed_speeds(m);
    if (std::find(allowed.begin(), allowed.end(), count) == allowed.end()) {
        std::string numbers;
        for (std::size_t k = 0; k < allowed.size(); ++k)
            numbers += fmt::format("{}{}", k == 0 ? "" : k + 1 == allowed.size() ? " or " : ", ", allowed[k]);
        const int rows = static_cast<int>(m.constraints.size());
        return Diagnostic{m.speeds.back().place,
                          say("there {} {} generalized speed{}, and {} coordinate{} with {} independent "
                              "constraint{}; expected {}",
                              count == 1 ? "is" : "are", count, count == 1 ? "" : "s", n, n == 1 ? "" : "s", rows,
                              rows == 1 ? "" : "s", numbers)};
    }
    std::vector<int> left_out;
    const bool all = count == n - static_cast<int>(m.constraints.size());
    for (int k = 0; k < static_cast<int>(m.constraints.size()) && count < n; ++k)
        if (!m.constraints[k].holonomic || all) left_out.push_back(k);
    if (count + static_cast<int>(left_out.size()) != n) left_out.clear();

    const Program program = lower_constraints(m);
    const std::vector<int> forms = program.nodes_of(Group::form_row), rows = program.nodes_of(Group::row);
    const auto size = static_cast<Eigen::Index>(n), speeds = static_cast<Eigen::Index>(count);
    std::optional<int> dependent;  // the last such row over all states
    std::mt19937_64 random(1);
    const UniformReal<> away(-0.7, 0.7);
    for (int k = 0; k <= most_states; ++k) {
        Start start = start_of(m);
        for (double& q : start.q) q += k == 0 ? 0 : away(random) * (1 + std::abs(q));
        const std::vector<double> value = interpret(program, start.state());
        Eigen::MatrixXd S(speeds + static_cast<Eigen::Index>(left_out.size()), size);
        for (Eigen::Index r = 0; r < S.rows(); ++r)
            for (Eigen::Index i = 0; i < size; ++i)
                S(r, i) = value[r < speeds ? forms[r * size + i] : rows[left_out[r - speeds] * size + i]];
        if (!S.allFinite()) continue;
        dependent = std::max(dependent.value_or(-2), first_dependent(S));
        if (first_dependent(S) < 0) return std::nullopt;
    }
    if (!dependent) return std::nullopt;  // there is no state without a pole; the run will report that
    if (*dependent < count)
        return Diagnostic{m.speeds[*dependent].place,
                          say("speed '{}' is a combination of the speeds before it; expected independent forms",
                              m.speeds[*dependent].u.get_name())};
    const std::string& constraint = m.constraints[left_out[*dependent - count]].name;
    return Diagnostic{
        m.speeds.back().place,
        say("the speeds and the constraints do not determine the rates: constraint '{}' fixes a combination "
            "of the speeds; expected forms that it leaves free",
            constraint)};
}

}  // namespace alembert
