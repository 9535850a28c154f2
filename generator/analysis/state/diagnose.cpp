// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/diagnose.hpp"

#include <fmt/format.h>

#include <cln/integer.h>

#include <Eigen/Dense>
#include <cmath>

#include "alembert/base/dense.hpp"
#include "base/language/say.hpp"
#include "program/rounding.hpp"

namespace alembert {

namespace {

/// A in the n speeds.
Eigen::MatrixXd rows_of(const Program& program, Eigen::Index n, const std::vector<double>& value) {
    std::vector<int> entries = program.nodes_of(Group::speed_row);
    if (entries.empty()) entries = program.nodes_of(Group::row);
    Eigen::MatrixXd A(static_cast<Eigen::Index>(entries.size()) / n, n);
    for (Eigen::Index k = 0; k < A.rows(); ++k)
        for (Eigen::Index i = 0; i < n; ++i) A(k, i) = value[entries[k * n + i]];
    return A;
}

/// An orthonormal basis of the rates that the rows of A allow, which may depend on each other.
Eigen::MatrixXd allowed_by(Eigen::MatrixXd A) {
    constexpr double dependent = 1e-10;
    if (A.rows() == 0) return Eigen::MatrixXd::Identity(A.cols(), A.cols());
    for (Eigen::Index k = 0; k < A.rows(); ++k)
        if (const double size = A.row(k).norm(); size > 0) A.row(k) /= size;  // removes the units of the rows
    const SingularValues parts = singular_values(A.transpose());
    const Eigen::Index rank = (parts.values.array() > dependent * std::max(parts.values[0], 1e-300)).count();
    return parts.left.rightCols(A.cols() - rank);
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
    const auto n = static_cast<Eigen::Index>(names.size());
    Eigen::MatrixXd M(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j <= i; ++j) M(i, j) = M(j, i) = value[lower[i * (i + 1) / 2 + j]];
    if (n == 0 || !M.allFinite()) return std::nullopt;
    const Eigen::VectorXd scale = unit_scale(M);
    const Eigen::MatrixXd unit = scale.asDiagonal() * M * scale.asDiagonal();
    const double largest = unit.cwiseAbs().maxCoeff();
    const auto weakest_of = [](const Eigenpairs& pairs) {
        Eigen::Index weakest = 0;
        pairs.values.cwiseAbs().minCoeff(&weakest);
        return weakest;
    };
    const auto resists = [&](double value) { return std::abs(value) > 1e-13 * largest && largest > 0; };
    Eigenpairs eigen = eigenpairs(unit);
    if (resists(eigen.values[weakest_of(eigen)])) return std::nullopt;
    const Eigen::MatrixXd A = rows_of(program, n, value) * scale.asDiagonal();
    if (!A.allFinite()) return std::nullopt;
    const Eigen::MatrixXd Z = allowed_by(A);
    if (Z.cols() == 0) return std::nullopt;
    eigen = eigenpairs(Z.transpose() * unit * Z);
    const Eigen::Index weakest = weakest_of(eigen);
    if (resists(eigen.values[weakest])) return std::nullopt;

    Eigen::VectorXd direction = scale.asDiagonal() * (Z * eigen.vectors.col(weakest));
    Eigen::Index first = 0;
    const double size = direction.cwiseAbs().maxCoeff(&first);
    direction /= direction[first] < 0 ? -size : size;
    std::string text;
    for (Eigen::Index i = 0; i < n; ++i) {
        const double c = direction[i];
        if (std::abs(c) < 1e-9) continue;
        const std::string number = std::abs(std::abs(c) - 1) < 1e-9 ? "" : fmt::format("{:.4g}*", std::abs(c));
        text += text.empty() ? (c < 0 ? "-" : "") : (c < 0 ? " - " : " + ");
        text += number + names[static_cast<std::size_t>(i)];
    }
    return text;
}

namespace {

/// The rows of the constraints with a multiplier, of which only the first `rank` are independent where none is
/// lost.
struct RowsAt {
    Eigen::MatrixXd A;  ///< in units of the largest row, with 0 for what is only rounding, like sin π
    std::vector<std::string> names;
    Eigen::Index rank;

    RowsAt(const Program& program, const State<double>& state, const std::vector<int>& kept)
        : rank(static_cast<Eigen::Index>(kept.size())) {
        const std::vector<int> rows = program.nodes_of(Group::row), tied = program.nodes_of(Group::tied_row);
        const auto n = static_cast<Eigen::Index>(program.coordinates.size());
        if (kept.empty() || n == 0) return;
        const std::vector<double> value = interpret(program, state), rounded = rounding_errors(program, state);
        A.resize(rank + static_cast<Eigen::Index>(tied.size()) / n, n);
        for (Eigen::Index k = 0; k < A.rows(); ++k)
            for (Eigen::Index i = 0; i < n; ++i) {
                const int node = k < rank ? rows[kept[k] * n + i] : tied[(k - rank) * n + i];
                A(k, i) = std::abs(value[node]) <= rounded[node] ? 0 : value[node];
            }
        if (const double largest = A.rowwise().norm().maxCoeff(); largest > 0) A /= largest;
        std::vector<std::string> constraints, others;
        for (const Root& root : program.roots) {
            if (root.group == Group::position) constraints.push_back(root.name);
            if (root.group == Group::tied_gamma) others.push_back(root.name);
        }
        for (const int k : kept) names.push_back(constraints[k]);
        names.insert(names.end(), others.begin(), others.end());
    }
};

/// "x = 1, y = 0, …"
std::string pose_of(const Program& program, const State<double>& state) {
    constexpr std::size_t most = 6;
    std::string result;
    for (std::size_t i = 0; i < program.coordinates.size(); ++i) {
        if (i == most) return result + ", …";
        const double q = std::abs(state.q[i]) < 1e-12 ? 0 : state.q[i];
        result += fmt::format("{}{} = {:.6g}", i == 0 ? "" : ", ", program.coordinates[i].name, q);
    }
    return result;
}

}  // namespace

bool is_rank_rounding(const Program& program, const State<double>& state, const std::vector<int>& kept) {
    constexpr double rounding = 1e-12;
    const RowsAt rows(program, state, kept);
    if (rows.A.size() == 0 || !rows.A.allFinite()) return false;
    return (singular_values(rows.A).values.array() > rounding).count() < rows.rank;
}

std::optional<std::string> lost_rank(const Program& program, const State<double>& state,
                                     const std::vector<int>& kept) {
    const RowsAt rows(program, state, kept);
    if (rows.A.size() == 0 || !rows.A.allFinite()) return std::nullopt;
    const SingularValues decomposed = singular_values(rows.A);
    const Eigen::Index left = (decomposed.values.array() > 1e-7).count();
    if (left >= rows.rank) return std::nullopt;
    const Eigen::VectorXd among = decomposed.left.rightCols(rows.A.rows() - left).cwiseAbs().rowwise().sum();
    std::string names;
    int count = 0;
    for (Eigen::Index k = 0; k < rows.A.rows(); ++k) {
        if (among[k] < 1e-6) continue;
        names += fmt::format("{}'{}'", names.empty() ? "" : ", ", rows.names[static_cast<std::size_t>(k)]);
        ++count;
    }
    return say(
        "{} at {}, and the rank of the constraints drops from {} to {} there; start beside that pose, or with "
        "rates "
        "that lead through it (audit lists such poses, and simulate goes through most of them)",
        count == 1 ? say("constraint {} has no row left", names)
                   : say("the rows of constraints {} become dependent", names),
        pose_of(program, state), rows.rank, left);
}

std::optional<std::string> ended_table(const Program& program, const State<double>& state, Group group) {
    constexpr double close = 1e-6;  // relative to the points' range: the last step before has been cut short
    const std::vector<double> value = interpret(program, state);
    for (const int id : program.needed(program.nodes_of(group))) {
        const Node& node = program[id];
        const TabulatedFunction* const table = node.op == Op::unspecified ? program.table_of(node) : nullptr;
        if (table == nullptr || table->outside() != TabulatedFunction::Outside::error) continue;
        const Program::TableCall call = program.table_call(node);
        if (call.orders[0] >= TabulatedFunction::side_function) continue;
        for (std::size_t k = 0; k < call.arguments; ++k) {
            const TableAxis& axis = table->axes()[k];
            const double low = axis.at.front(), high = axis.at.back(), x = value[call.argument[k]],
                         far = close * (high - low);
            if (axis.period > 0 || !std::isfinite(x) || (x > low + far && x < high - far)) continue;
            return say(
                "an argument of the table '{}' is {:.6g}, and its points end at {:.6g}; give more points, or "
                "outside = \"hold\" or \"line\"",
                program.functions[program.function_of(node)], x, x <= low + far ? low : high);
        }
    }
    return std::nullopt;
}

std::optional<NotFinite> not_finite(const Program& program, const State<double>& state, Group group) {
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
        std::vector<std::string> parts;
        for (const int source : node.sources) {
            parts.push_back(program.source_labels[source]);
            where += (where.empty() ? " in " : ", ") + parts.back();
        }
        return NotFinite{.text = what + where, .is_division = node.is_reciprocal(), .parts = std::move(parts)};
    }
    return std::nullopt;
}

}  // namespace alembert
