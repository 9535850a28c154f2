// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/state/irregular_constraints.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "alembert/base/dense.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/contradiction.hpp"
#include "analysis/state/sum_of_squares.hpp"
#include "base/language/say.hpp"
#include "model/constraint.hpp"
#include "model/formalism/elements.hpp"
#include "model/sample_functions.hpp"
#include "program/lower/lower.hpp"
#include "program/rounding.hpp"

namespace alembert {

namespace {

constexpr int states_looked_at = 4;
constexpr double nearly_dependent = 1e-3;  // positions on a double root are known to √ε times the size of a scene

/// The rows of the holonomic constraints.
class HolonomicRows {
public:
    explicit HolonomicRows(const Mechanism& m)
        : program_(lower_constraints(m)), nodes_(program_.nodes_of(Group::row)), n_(m.size()) {
        for (int k = 0; k < static_cast<int>(m.constraints.size()); ++k)
            if (m.constraints[static_cast<std::size_t>(k)].position) positions_.push_back(k);
    }

    const std::vector<int>& positions() const { return positions_; }
    Eigen::MatrixXd at(const State<double>& state) const {
        const std::vector<double> value = interpret(program_, state);
        Eigen::MatrixXd A(positions_.size(), n_);
        for (Eigen::Index r = 0; r < A.rows(); ++r)
            for (Eigen::Index i = 0; i < n_; ++i) A(r, i) = value[node(r, i)];
        return A;
    }
    /// The largest rounding error in each row.
    Eigen::VectorXd roundings_at(const State<double>& state) const {
        const std::vector<double> error = rounding_errors(program_, state);
        Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(positions_.size()));
        for (Eigen::Index r = 0; r < result.size(); ++r)
            for (Eigen::Index i = 0; i < n_; ++i) result[r] = std::max(result[r], error[node(r, i)]);
        return result;
    }
    const Program& program() const { return program_; }

private:
    std::size_t node(Eigen::Index row, Eigen::Index column) const {
        return static_cast<std::size_t>(
            nodes_[static_cast<std::size_t>(positions_[static_cast<std::size_t>(row)] * n_ + column)]);
    }

    Program program_;
    std::vector<int> nodes_;
    Eigen::Index n_;
    std::vector<int> positions_;
};

Eigen::MatrixXd with_unit_rows(Eigen::MatrixXd A) {
    for (Eigen::Index r = 0; r < A.rows(); ++r)
        if (A.row(r).norm() > 0) A.row(r).normalize();
    return A;
}

/// Combinations λ of the rows (not of unit rows) that are zero, as many as are independent, each of as few rows as
/// the others allow: one for each row that depends on those of a basis.
std::vector<Eigen::VectorXd> dependences(const Eigen::MatrixXd& A) {
    if (!A.allFinite() || A.rows() == 0) return {};
    const SingularValues parts = singular_values(with_unit_rows(A));
    Eigen::Index rank = 0;
    while (rank < parts.values.size() && parts.values[rank] >= nearly_dependent) ++rank;
    if (rank == A.rows()) return {};
    Eigen::MatrixXd N = parts.left.rightCols(A.rows() - rank);
    for (Eigen::Index r = 0; r < A.rows(); ++r)
        if (A.row(r).norm() > 0) N.row(r) /= A.row(r).norm();
    std::vector<Eigen::VectorXd> result;
    std::vector<Eigen::Index> taken;
    for (Eigen::Index c = 0; c < N.cols(); ++c) {
        Eigen::Index row = 0, column = 0;
        Eigen::MatrixXd left = N.rightCols(N.cols() - c).cwiseAbs();
        for (const Eigen::Index r : taken) left.row(r).setZero();
        left.maxCoeff(&row, &column);
        N.col(c).swap(N.col(c + column));
        N.col(c) /= N(row, c);
        for (Eigen::Index other = 0; other < N.cols(); ++other)
            if (other != c) N.col(other) -= N(row, other) * N.col(c);
        taken.push_back(row);
    }
    for (Eigen::Index c = 0; c < N.cols(); ++c) result.emplace_back(N.col(c));
    return result;
}

/// Orthonormal directions v with A v = 0.
Eigen::MatrixXd free_directions(const Eigen::MatrixXd& A) {
    const Eigen::MatrixXd unit = with_unit_rows(A);
    const Eigenpairs pairs = eigenpairs(unit.transpose() * unit);
    Eigen::Index count = 0;
    while (count < pairs.values.size() && pairs.values[count] < nearly_dependent * nearly_dependent) ++count;
    return pairs.vectors.leftCols(count);
}

/// Is Q = Σ λ_i ∂²f_i/∂q² of one sign, and not zero, on the directions that the rows leave free?
bool has_one_sign(const HolonomicRows& rows, const State<double>& state, const Eigen::VectorXd& lambda) {
    const Eigen::MatrixXd A = rows.at(state), free = free_directions(A);
    if (free.cols() == 0) return false;
    const double step = 1e-5;
    Eigen::MatrixXd Q(free.cols(), free.cols());
    double size = 0;
    for (Eigen::Index c = 0; c < free.cols(); ++c) {
        State<double> ahead = state, behind = state;
        for (Eigen::Index i = 0; i < free.rows(); ++i) {
            ahead.q[static_cast<std::size_t>(i)] += step * free(i, c);
            behind.q[static_cast<std::size_t>(i)] -= step * free(i, c);
        }
        const Eigen::MatrixXd bending = (rows.at(ahead) - rows.at(behind)) * free / (2 * step);
        Q.row(c) = lambda.transpose() * bending;
        size = std::max(size, (lambda.asDiagonal() * bending).cwiseAbs().maxCoeff());
    }
    if (!Q.allFinite()) return false;
    const Eigen::VectorXd values = eigenpairs((Q + Q.transpose()) / 2).values;
    // Where all terms vanish, as for two points that move in parallel, there is only rounding.
    const double rounded = lambda.cwiseAbs().dot(rows.roundings_at(state)) / step;
    const double nothing = std::max(1e-3 * size, 4 * rounded), least = values[0], most = values[values.size() - 1];
    return (most > nothing && least > -nothing) || (least < -nothing && most < nothing);
}

/// The rows with a share in λᵀA.
std::vector<Eigen::Index> rows_in(const Eigen::VectorXd& lambda, const Eigen::MatrixXd& A) {
    std::vector<Eigen::Index> result;
    const Eigen::VectorXd shares = lambda.cwiseProduct(A.rowwise().norm()).cwiseAbs();
    for (Eigen::Index r = 0; r < shares.size(); ++r)
        if (shares[r] > nearly_dependent * shares.maxCoeff()) result.push_back(r);
    return result;
}

/// Are these rows dependent at a state, with a Q of one sign?
bool touch_at(const HolonomicRows& rows, const State<double>& state, const std::vector<Eigen::Index>& which) {
    const Eigen::MatrixXd A = rows.at(state);
    const std::vector<Eigen::VectorXd> there = dependences(A(which, Eigen::all));
    if (there.empty()) return false;
    Eigen::VectorXd lambda = Eigen::VectorXd::Zero(A.rows());
    lambda(which) = there.front();
    return has_one_sign(rows, state, lambda);
}

std::string names_of(const Mechanism& m, const std::vector<int>& which) {
    std::string names;
    for (const int k : which)
        names += fmt::format("{}'{}'", names.empty() ? "" : ", ", m.constraints[static_cast<std::size_t>(k)].name);
    return names;
}

/// The name of row `number` of those that a group of constraints gives, which no other has: ab_bc_ac_1.
std::string name_of_row(const Mechanism& m, const std::vector<int>& which, int number) {
    std::string name;
    for (const int k : which) name += m.constraints[static_cast<std::size_t>(k)].name + "_";
    name += std::to_string(number);
    const auto& symbols = m.symbols->all();
    while (std::any_of(symbols.begin(), symbols.end(),
                       [&](const GiNaC::symbol& s) { return s.get_name() == "lambda_" + name; }))
        name += "_";
    return name;
}

}  // namespace

std::vector<IrregularConstraints> irregular_constraints(const Mechanism& given) {
    if (given.constraints.size() < 2) return {};
    const Mechanism m = constraints_are_open(given) ? with_sample_functions(given) : given;
    const HolonomicRows rows(m);
    if (rows.positions().size() < 2) return {};
    Start start = start_of(m);
    try {
        assemble(start, m, rows.program(), {});
    } catch (const std::runtime_error&) {
        return {};  // the command reports this, with the reason
    }
    const State<double> first = start.state();
    const Eigen::MatrixXd A = rows.at(first);
    std::vector<IrregularConstraints> result;
    std::optional<std::vector<State<double>>> others;
    for (const Eigen::VectorXd& lambda : dependences(A)) {
        if (!has_one_sign(rows, first, lambda)) continue;
        const std::vector<Eigen::Index> which = rows_in(lambda, A);
        if (!others) others = states_that_obey(m, start, states_looked_at);
        if (!std::all_of(others->begin(), others->end(),
                         [&](const State<double>& other) { return touch_at(rows, other, which); }))
            continue;
        IrregularConstraints irregular{.constraints = {}, .lambda = lambda(which)};
        for (const Eigen::Index r : which)
            irregular.constraints.push_back(rows.positions()[static_cast<std::size_t>(r)]);
        result.push_back(std::move(irregular));
    }
    return result;
}

Mechanism with_regular_constraints(Mechanism m) {
    std::vector<Mechanism::Constraint> added;
    for (const IrregularConstraints& irregular : irregular_constraints(m)) {
        const auto squares = sum_of_squares(m, irregular.constraints, irregular.lambda);
        if (!squares) continue;
        const SourceScope source(*m.z, say("constraints {}", names_of(m, irregular.constraints)));
        int number = 0;
        for (const GiNaC::ex& square : *squares) {
            const std::string name = name_of_row(m, irregular.constraints, ++number);
            const Place place = m.constraints[static_cast<std::size_t>(irregular.constraints.front())].place;
            added.push_back(constraint_of(
                {.name = name,
                 .value = square,
                 .multiplier =
                     m.symbols->declare("lambda_" + name, SymbolInfo::Kind::other, static_cast<int>(added.size())),
                 .place = place,
                 .at = place},
                m));
            added.back().squared_in = names_of(m, irregular.constraints);
        }
    }
    // Of rows that depend on each other the first are kept, and these are regular.
    m.constraints.insert(m.constraints.begin(), added.begin(), added.end());
    return m;
}

void refuse_irregular_constraints(const Mechanism& m) {
    const std::vector<IrregularConstraints> irregular = irregular_constraints(m);
    if (irregular.empty()) return;
    throw ModelError(say(
        "the constraints {} only touch: wherever they all hold their rows depend on each other, and a direction "
        "is held by their second derivatives alone, so that a load along it has no finite reactions. The "
        "description fails there, not the mechanism: for three points on a line give, in place of one of three "
        "distances, that line itself (the cross product of two of the vectors between them is 0), or place one "
        "point on the line of the others",
        names_of(m, irregular.front().constraints)));
}

}  // namespace alembert
