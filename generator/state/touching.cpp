// SPDX-License-Identifier: GPL-2.0-or-later
#include "state/touching.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "alembert/dense.hpp"
#include "formalism/elements.hpp"
#include "language/say.hpp"
#include "lower/lower.hpp"
#include "model/sample_functions.hpp"
#include "state/assemble.hpp"
#include "state/contradiction.hpp"

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
            for (Eigen::Index i = 0; i < n_; ++i)
                A(r, i) = value[static_cast<std::size_t>(
                    nodes_[static_cast<std::size_t>(positions_[static_cast<std::size_t>(r)] * n_ + i)])];
        return A;
    }
    const Program& program() const { return program_; }

private:
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

/// The combination λ of the rows (not of unit rows) that is nearest to zero; nothing if they are independent.
std::optional<Eigen::VectorXd> dependence(const Eigen::MatrixXd& A) {
    if (!A.allFinite() || A.rows() == 0) return std::nullopt;
    const SingularValues parts = singular_values(with_unit_rows(A));
    const bool dependent = A.rows() > A.cols() || parts.values.tail(1)[0] < nearly_dependent;
    if (!dependent) return std::nullopt;
    Eigen::VectorXd lambda = parts.left.rightCols(1);
    for (Eigen::Index r = 0; r < A.rows(); ++r)
        if (A.row(r).norm() > 0) lambda[r] /= A.row(r).norm();
    return lambda;
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
    const double nothing = 1e-3 * size, least = values[0], most = values[values.size() - 1];
    return (most > nothing && least > -nothing) || (least < -nothing && most < nothing);
}

}  // namespace

std::vector<int> touching_constraints(const Mechanism& given) {
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
    const std::optional<Eigen::VectorXd> lambda = dependence(rows.at(first));
    if (!lambda || !has_one_sign(rows, first, *lambda)) return {};
    for (const State<double>& other : states_that_obey(m, start, states_looked_at)) {
        const std::optional<Eigen::VectorXd> there = dependence(rows.at(other));
        if (!there || !has_one_sign(rows, other, *there)) return {};
    }
    std::vector<int> result;
    const Eigen::VectorXd shares = lambda->cwiseProduct(rows.at(first).rowwise().norm()).cwiseAbs();
    for (Eigen::Index r = 0; r < shares.size(); ++r)
        if (shares[r] > nearly_dependent) result.push_back(rows.positions()[static_cast<std::size_t>(r)]);
    return result;
}

void refuse_touching(const Mechanism& m) {
    const std::vector<int> touching = touching_constraints(m);
    if (touching.empty()) return;
    std::string names;
    for (const int k : touching)
        names += fmt::format("{}'{}'", names.empty() ? "" : ", ", m.constraints[static_cast<std::size_t>(k)].name);
    throw ModelError(say(
        "the constraints {} only touch: wherever they all hold their rows depend on each other, and a direction "
        "is held by their second derivatives alone, so that a load along it has no finite reactions. The "
        "description fails there, not the mechanism: for three points on a line give, in place of one of three "
        "distances, that line itself (the cross product of two of the vectors between them is 0), or place one "
        "point on the line of the others",
        names));
}

}  // namespace alembert
