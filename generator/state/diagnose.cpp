// SPDX-License-Identifier: GPL-2.0-or-later
#include "state/diagnose.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "alembert/dense.hpp"
#include "language/say.hpp"

namespace alembert {

namespace {

/// The coordinates (or speeds) that have kinetic energy. If the constraints do not determine the rates of those
/// that have none from the rates of the others (their columns of A are dependent), all n of them.
std::vector<Eigen::Index> to_be_resisted(const Program& program, int n, const std::vector<double>& value) {
    const std::vector<int> mass = program.nodes_of(Group::mass), rows = program.nodes_of(Group::row);
    std::vector<Eigen::Index> heavy, massless, all;
    for (int i = 0; i < n; ++i) {
        bool any = false;
        for (int j = 0; j < n; ++j)
            any = any || !program.is_zero(mass[std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j)]);
        (any ? heavy : massless).push_back(i);
        all.push_back(i);
    }
    if (massless.empty() || rows.empty()) return all;
    Eigen::MatrixXd A(rows.size() / n, massless.size());
    for (Eigen::Index k = 0; k < A.rows(); ++k)
        for (Eigen::Index i = 0; i < A.cols(); ++i) A(k, i) = value[rows[k * n + massless[i]]];
    for (Eigen::Index i = 0; i < A.cols(); ++i) A.col(i).normalize();  // removes the units of the columns
    return least_norm(A, Eigen::VectorXd::Zero(A.rows())).rank == A.cols() ? heavy : all;
}

}  // namespace

std::optional<std::string> massless_combination(const Program& program, const State<double>& state) {
    const std::vector<int> lower = program.nodes_of(Group::mass);
    // For a tree without M, the inertia of each joint is tested separately.
    if (lower.empty()) return std::nullopt;
    const std::vector<double> value = interpret(program, state);
    std::vector<std::string> names;
    for (const Quantity& speed : program.speeds) names.push_back(speed.name);
    for (const Quantity& q : program.coordinates)
        if (program.speeds.empty()) names.push_back(q.name + "'");
    const std::vector<Eigen::Index> of = to_be_resisted(program, static_cast<int>(names.size()), value);
    const auto n = static_cast<Eigen::Index>(of.size());
    Eigen::MatrixXd M(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j <= i; ++j) M(i, j) = M(j, i) = value[lower[of[i] * (of[i] + 1) / 2 + of[j]]];
    if (n == 0 || !M.allFinite()) return std::nullopt;
    // The size of an entry depends on its units. Therefore it is compared with its row and its column.
    Eigen::VectorXd scale(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double size = M.row(i).cwiseAbs().maxCoeff();
        scale[i] = M(i, i) > 0 ? 1 / std::sqrt(M(i, i)) : size > 0 ? 1 / std::sqrt(size) : 1;
    }
    const Eigen::MatrixXd unit = scale.asDiagonal() * M * scale.asDiagonal();
    const Eigenpairs eigen = eigenpairs(unit);
    Eigen::Index weakest = 0;
    eigen.values.cwiseAbs().minCoeff(&weakest);
    const double largest = eigen.values.cwiseAbs().maxCoeff();
    if (std::abs(eigen.values[weakest]) > 1e-13 * largest && largest > 0) return std::nullopt;

    Eigen::VectorXd direction = scale.asDiagonal() * eigen.vectors.col(weakest);
    Eigen::Index first = 0;
    const double size = direction.cwiseAbs().maxCoeff(&first);
    direction /= direction[first] < 0 ? -size : size;
    std::string text;
    for (Eigen::Index i = 0; i < n; ++i) {
        const double c = direction[i];
        if (std::abs(c) < 1e-9) continue;
        const std::string number = std::abs(std::abs(c) - 1) < 1e-9 ? "" : fmt::format("{:.4g}*", std::abs(c));
        text += text.empty() ? (c < 0 ? "-" : "") : (c < 0 ? " - " : " + ");
        text += number + names[of[i]];
    }
    return text;
}

std::optional<std::string> lost_rank(const Program& program, const State<double>& state,
                                     const std::vector<int>& kept) {
    const std::vector<int> rows = program.nodes_of(Group::row);
    const auto n = static_cast<Eigen::Index>(program.coordinates.size()),
               m = static_cast<Eigen::Index>(kept.size());
    if (kept.empty() || n == 0) return std::nullopt;
    const std::vector<double> value = interpret(program, state);
    Eigen::MatrixXd A(m, n);
    for (Eigen::Index k = 0; k < m; ++k)
        for (Eigen::Index i = 0; i < n; ++i) A(k, i) = value[rows[kept[k] * n + i]];
    const double largest = A.rowwise().norm().maxCoeff();
    if (!A.allFinite()) return std::nullopt;
    if (largest > 0) A /= largest;
    const SingularValues decomposed = singular_values(A);
    const Eigen::Index left = (decomposed.values.array() > 1e-7).count();
    if (left == m) return std::nullopt;
    const Eigen::VectorXd among = decomposed.left.rightCols(m - left).cwiseAbs().rowwise().sum();
    std::vector<std::string> constraints;
    for (const Root& root : program.roots)
        if (root.group == Group::position) constraints.push_back(root.name);
    std::string names;
    int count = 0;
    for (Eigen::Index k = 0; k < m; ++k) {
        if (among[k] < 1e-6) continue;
        names += fmt::format("{}'{}'", names.empty() ? "" : ", ", constraints[kept[k]]);
        ++count;
    }
    return say(
        "{} in this pose, and the rank of the constraints drops from {} to {}; start beside it "
        "(audit lists such poses; dop853 goes through one where every coordinate has inertia)",
        count == 1 ? say("constraint {} has no row left", names)
                   : say("the rows of constraints {} become dependent", names),
        m, left);
}

std::optional<std::string> not_finite(const Program& program, const State<double>& state, Group group) {
    const std::vector<double> value = interpret(program, state);
    for (const int id : program.needed(program.nodes_of(group))) {
        if (std::isfinite(value[id])) continue;
        const Node& node = program[id];
        std::string what =
            fmt::format("{}({:.6g})", name_of(node.op), node.args.empty() ? 0.0 : value[node.args[0]]);
        if (node.op == Op::variable)
            what = say("a value of the state");
        else if (node.is_reciprocal())
            what = say("a division by zero");
        else if (node.op == Op::sum || node.op == Op::product)
            what = say("a number too large for double precision");
        std::string where;
        for (const int source : node.sources)
            where += (where.empty() ? " in " : ", ") + program.source_labels[source];
        return what + where;
    }
    return std::nullopt;
}

}  // namespace alembert
