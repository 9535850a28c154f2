// SPDX-License-Identifier: GPL-2.0-or-later
// Notation of stability/linear/linearize.hpp; e stands for t and the inputs. Tangent directions of the
// constraints:
//   δq = Q δr + Qe δe,   Q_dep = −φ_dep⁻¹ φ_ind,   δu = S δr + U δw + Se δe,   U_dep = −ν_dep⁻¹ ν_ind.
// U spans the null space of A, in which a first-order state of the scene moves alone: constraints that change with
// it are not obeyed by virtual displacements, at which it is constant. With c, the u' that A u' = γ requires if w'
// = 0:
//   (UᵀMU) w' = Uᵀ(f − M c),   A_depᵀ λ = (M u' − f)_dep.
#include "stability/linear/tangent.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "alembert/base/error.hpp"
#include "alembert/base/interrupt.hpp"
#include "base/language/say.hpp"
#include "stability/linear/dense_long.hpp"
#include "stability/linear/paths.hpp"

namespace alembert {

using Index = Eigen::Index;

namespace {

/// Values and derivatives of all nodes; columns: q, u, t, inputs.
template <typename Real>
struct Values {
    Values(const Residuals& r, const Instant<Real>& at, bool at_kink = false)
        : columns(columns_of(r, at)), r_(r), value_(interpret(r.program, varied(r, at))) {
        if (at_kink) repair(at);
    }
    /// Only those of `nodes`, which hold all arguments of each.
    Values(const Residuals& r, const Instant<Real>& at, const std::vector<int>& nodes)
        : columns(columns_of(r, at)), r_(r), value_(interpret_nodes(r.program, varied(r, at), nodes)) {}
    VectorOf<Real> vector(const std::vector<int>& nodes) const {
        VectorOf<Real> result(static_cast<Index>(nodes.size()));
        for (std::size_t i = 0; i < nodes.size(); ++i) result[static_cast<Index>(i)] = value_[nodes[i]].value;
        return result;
    }
    MatrixOf<Real> jacobian(const std::vector<int>& nodes) const {
        MatrixOf<Real> result(static_cast<Index>(nodes.size()), columns);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (Index k = 0; k < columns; ++k)
                result(static_cast<Index>(i), k) = value_[nodes[i]].derivative(static_cast<std::size_t>(k));
        return result;
    }
    const Jet<Real>& operator[](int node) const { return value_[node]; }
    const Index columns;

private:
    static Index columns_of(const Residuals& r, const Instant<Real>& at) {
        return static_cast<Index>(at.q.size() + at.u.size() + 1 + r.inputs.size());
    }
    static State<Jet<Real>> varied(const Residuals& r, const Instant<Real>& at) {
        return Varied<Real>(r, at, r.input_places()).state;
    }

    /// If a root needs a function at a critical point, the chain rule node by node gives 0·∞ or a mixture of
    /// sides. The derivatives are then those of the root itself, in each direction in which both of its sides
    /// agree.
    void repair(const Instant<Real>& at) {
        const Instant<long double> point{.parameters = {at.parameters.begin(), at.parameters.end()},
                                         .q = {at.q.begin(), at.q.end()},
                                         .u = {at.u.begin(), at.u.end()},
                                         .inputs = {at.inputs.begin(), at.inputs.end()},
                                         .t = static_cast<long double>(at.t)};
        const std::vector<PuiseuxSeries> here = on_path(r_, point, VectorOf<long double>::Zero(columns));
        std::vector<int> broken;
        for (const Root& root : r_.program.roots)
            if (root.group != Group::input &&
                !critical_nodes(r_.program, std::vector<int>{root.node}, here).empty())
                broken.push_back(root.node);
        for (Index k = 0; k < columns; ++k) {
            const VectorOf<long double> d = VectorOf<long double>::Unit(columns, k);
            const std::vector<PuiseuxSeries> there = on_path(r_, point, d), back = on_path(r_, point, -d);
            for (const int node : broken)
                if (const auto found = slope(there[node], back[node])) {
                    value_[node].d.resize(static_cast<std::size_t>(columns), Real(0));
                    value_[node].d[static_cast<std::size_t>(k)] = static_cast<Real>(*found);
                }
        }
    }

    const Residuals& r_;
    std::vector<Jet<Real>> value_;
};

/// The columns of pivots of an elimination of `rows`, from the first class with a sufficient pivot; fewer than
/// rows if none is left.
std::vector<int> pivots(MatrixOf<long double> rows, const std::vector<int>& order_class) {
    constexpr long double good = 1e-6L, some = 1e-12L;  // relative to the row at the start
    std::vector<int> result;
    std::vector<long double> size;
    for (Index r = 0; r < rows.rows(); ++r)
        size.push_back(rows.row(r).size() > 0 ? rows.row(r).cwiseAbs().maxCoeff() : 0);
    std::vector<bool> done(rows.rows(), false);
    const int classes = order_class.empty() ? 0 : *std::max_element(order_class.begin(), order_class.end()) + 1;
    for (Index step = 0; step < rows.rows(); ++step) {
        std::tuple<long double, Index, int> best{0, 0, 0};
        for (int c = 0; c <= classes && std::get<0>(best) < good; ++c)  // in the last round any pivot is taken
            for (Index r = 0; r < rows.rows(); ++r)
                for (Index j = 0; j < rows.cols(); ++j) {
                    if (done[r] || size[r] == 0 || (c < classes && order_class[j] != c)) continue;
                    const long double pivot = std::abs(rows(r, j)) / size[r];
                    if (pivot > std::get<0>(best) * (1 + 1e-9L)) best = {pivot, r, static_cast<int>(j)};
                }
        const auto [pivot, r, j] = best;
        if (!(pivot > some)) break;
        done[r] = true;
        result.push_back(j);
        for (Index other = 0; other < rows.rows(); ++other)
            if (!done[other]) {
                rows.row(other) -= rows(other, j) / rows(r, j) * rows.row(r);
                rows(other, j) = 0;
            }
    }
    std::sort(result.begin(), result.end());
    return result;
}

std::vector<int> others(const std::vector<int>& chosen, int n) {
    std::vector<int> result;
    for (int i = 0; i < n; ++i)
        if (!std::binary_search(chosen.begin(), chosen.end(), i)) result.push_back(i);
    return result;
}

template <typename Real>
MatrixOf<Real> columns_of(const MatrixOf<Real>& from, const std::vector<int>& which) {
    MatrixOf<Real> result(from.rows(), static_cast<Index>(which.size()));
    for (std::size_t j = 0; j < which.size(); ++j) result.col(static_cast<Index>(j)) = from.col(which[j]);
    return result;
}

/// A B, for expressions too; each kind of product takes Eigen a second to compile.
template <typename Real>
MatrixOf<Real> product(const MatrixOf<Real>& A, const MatrixOf<Real>& B) {
    ask_whether_wanted();
    return A * B;
}

/// A x = b, for expressions too.
template <typename Real>
MatrixOf<Real> solution(const MatrixOf<Real>& A, const MatrixOf<Real>& b) {
    return solve(A, b);
}

/// The solution of dependent·x = right, with zeros for the independent ones, as rows of all.
template <typename Real>
MatrixOf<Real> spread(const MatrixOf<Real>& solution, const std::vector<int>& rows, Index n) {
    MatrixOf<Real> result = MatrixOf<Real>::Zero(n, solution.cols());
    for (std::size_t k = 0; k < rows.size(); ++k) result.row(rows[k]) = solution.row(static_cast<Index>(k));
    return result;
}

/// The step of the dependent variables, whose columns begin at `first`, that makes the nodes zero to first order.
template <typename Real>
VectorOf<Real> newton_step(const Values<Real>& value, const std::vector<int>& nodes,
                           const std::vector<int>& dependent, Index first) {
    if (dependent.empty()) return VectorOf<Real>(0);
    const MatrixOf<Real> by = value.jacobian(nodes).rightCols(value.columns - first);
    return solution<Real>(columns_of<Real>(by, dependent), -value.vector(nodes));
}

}  // namespace

Split split_of(const Residuals& r, const Instant<long double>& at, const std::vector<bool>& preferred_q,
               const std::vector<bool>& preferred_u) {
    const Values<long double> value(r, at, r.geometry);
    const auto refuse = [&](const char* which, std::size_t rank, int rows) {
        throw IntegrationError(
            say("the {} constraints depend on each other at this state: rank {} of {}; choose a state off the "
                "singular pose",
                translated(which), rank, rows),
            static_cast<double>(at.t), {at.q.begin(), at.q.end()});
    };
    Split split;
    std::vector<int> order;
    for (int i = 0; i < r.n; ++i) order.push_back(preferred_q[i] ? 0 : 1);
    split.q_dependent = pivots(value.jacobian(r.position).leftCols(r.n), order);
    if (static_cast<int>(split.q_dependent.size()) < r.holonomic)
        refuse(to_say("holonomic"), split.q_dependent.size(), r.holonomic);
    split.q = others(split.q_dependent, r.n);
    order.clear();
    for (int i = 0; i < r.s - r.states; ++i) {
        const bool follows =
            r.rates_are_speeds && std::binary_search(split.q_dependent.begin(), split.q_dependent.end(), i);
        order.push_back(follows ? 0 : preferred_u[i] ? 1 : 2);
    }
    split.u_dependent = pivots(value.jacobian(r.velocity).middleCols(r.n, r.s - r.states), order);
    if (static_cast<int>(split.u_dependent.size()) < r.kept)
        refuse(to_say("velocity"), split.u_dependent.size(), r.kept);
    split.u = others(split.u_dependent, r.s);
    return split;
}

namespace {

/// The algebra of `tangent` at one instant, in the order of the equations at the top of this file.
template <typename Real>
class TangentAlgebra {
    using Matrix = MatrixOf<Real>;
    using Vector = VectorOf<Real>;

public:
    TangentAlgebra(const Residuals& r, const Split& split, const Instant<Real>& at, bool at_kink, bool is_forced)
        : r_(r),
          split_(split),
          is_forced_(is_forced),
          has_mass_(is_forced || r.steady_needs_mass),
          value_(is_forced || at_kink ? Values<Real>(r, at, at_kink) : Values<Real>(r, at, r.steady)),
          n_(r.n),
          s_(r.s),
          nr_(static_cast<Index>(split.q.size())),
          p_(static_cast<Index>(split.u.size())) {}

    Tangent<Real> run() {
        add_directions();
        add_motion();
        add_derivatives();
        add_rates();
        return std::move(result_);
    }

private:
    /// A x = right, with independent ones 0.
    Matrix particular(const Matrix& right) const {
        if (r_.kept == 0) return Matrix::Zero(s_, right.cols());
        return spread<Real>(solution<Real>(dependent_, right), split_.u_dependent, s_);
    }

    /// The columns r, w, e of `along`, and U.
    void add_directions() {
        const Index extra = value_.columns - n_ - s_;
        const Matrix phi = value_.jacobian(r_.position), nu = value_.jacobian(r_.velocity);
        Matrix& along = result_.along;
        along = Matrix::Zero(n_ + s_ + extra, nr_ + p_ + extra);
        for (Index j = 0; j < nr_; ++j) along(split_.q[j], j) = 1;
        for (Index j = 0; j < p_; ++j) along(n_ + split_.u[j], nr_ + j) = 1;
        along.bottomRightCorner(extra, extra).setIdentity();
        if (r_.holonomic > 0) {
            const Matrix dependent = columns_of<Real>(phi.leftCols(n_), split_.q_dependent);
            along.topRows(n_) +=
                spread<Real>(solution<Real>(dependent, -product<Real>(phi, along)), split_.q_dependent, n_);
        }
        dependent_ = columns_of<Real>(nu.middleCols(n_, s_), split_.u_dependent);
        along.middleRows(n_, s_) += particular(-product<Real>(nu, along));
        U_ = along.block(n_, nr_, s_, p_);
        for (Index j = p_ - r_.states; j < p_; ++j) U_.col(j) = Vector::Unit(s_, split_.u[j]);
        onto_ = U_.transpose();
    }

    /// u' and λ of the undisturbed motion.
    void add_motion() {
        M_ = Matrix::Zero(s_, s_);
        for (Index i = 0, next = 0; has_mass_ && i < s_; ++i)
            for (Index j = 0; j <= i; ++j) M_(i, j) = M_(j, i) = value_[r_.mass[next++]].value;
        const Vector f = value_.vector(r_.forcing), gamma = value_.vector(r_.gamma);
        result_.udot = particular(gamma).col(0);
        result_.mass = product<Real>(product<Real>(onto_, M_), U_);
        const Vector unbalanced = f - M_ * result_.udot;
        result_.balance = onto_ * unbalanced;
        if (is_forced_) {
            result_.speed_rates = p_ > 0 ? Vector(solution<Real>(result_.mass, result_.balance)) : Vector(0);
            result_.udot += U_ * result_.speed_rates;
        }
        result_.lambda.resize(r_.kept);
        if (r_.kept == 0) return;
        const Vector reaction = M_ * result_.udot - f;
        Vector on_dependent(r_.kept);
        for (Index k = 0; k < r_.kept; ++k) on_dependent[k] = reaction[split_.u_dependent[k]];
        result_.lambda = solution<Real>(dependent_.transpose(), on_dependent);
    }

    /// The derivatives of M u' − f − Aᵀλ and of A u' − γ with constant u' and λ.
    std::pair<Matrix, Matrix> residuals_by() const {
        const Vector &udot = result_.udot, &lambda = result_.lambda;
        Matrix R = -value_.jacobian(r_.forcing), Gamma = -value_.jacobian(r_.gamma);
        for (Index i = 0, next = 0; has_mass_ && i < s_; ++i)
            for (Index j = 0; j <= i; ++j) {
                const Jet<Real>& entry = value_[r_.mass[next++]];
                for (Index k = 0; k < value_.columns; ++k) {
                    const Real d = entry.derivative(static_cast<std::size_t>(k));
                    R(i, k) += d * udot[j];
                    if (i != j) R(j, k) += d * udot[i];
                }
            }
        for (Index k = 0; k < r_.kept; ++k)
            for (Index i = 0; i < s_; ++i) {
                const Jet<Real>& entry = value_[r_.row[k * s_ + i]];
                for (Index c = 0; c < value_.columns; ++c) {
                    const Real d = entry.derivative(static_cast<std::size_t>(c));
                    R(i, c) -= d * lambda[k];
                    Gamma(k, c) += d * udot[i];
                }
            }
        return {std::move(R), std::move(Gamma)};
    }

    void add_derivatives() {
        const Matrix& along = result_.along;
        const auto [R, Gamma] = residuals_by();
        const Matrix forced = particular(-product<Real>(Gamma, along));
        result_.force = product<Real>(onto_, product<Real>(R, along) + product<Real>(M_, forced));
        if (!is_forced_) return;
        result_.speed_rates_by =
            p_ > 0 ? Matrix(-solution<Real>(result_.mass, result_.force)) : Matrix(0, along.cols());
        result_.udot_by = forced + product<Real>(U_, result_.speed_rates_by);
        const Matrix excess = product<Real>(R, along) + product<Real>(M_, result_.udot_by);  // = Aᵀ δλ
        Matrix on_dependent(r_.kept, along.cols());
        for (Index k = 0; k < r_.kept; ++k) on_dependent.row(k) = excess.row(split_.u_dependent[k]);
        result_.lambda_by = r_.kept > 0 ? solution<Real>(dependent_.transpose(), on_dependent) : on_dependent;
    }

    /// r' and δr'.
    void add_rates() {
        const Vector rates = value_.vector(r_.rate);
        const Matrix rates_by = product<Real>(value_.jacobian(r_.rate), result_.along);
        result_.rates.resize(nr_);
        result_.rates_by.resize(nr_, result_.along.cols());
        for (Index j = 0; j < nr_; ++j) {
            result_.rates[j] = rates[split_.q[j]];
            result_.rates_by.row(j) = rates_by.row(split_.q[j]);
        }
    }

    const Residuals& r_;
    const Split& split_;
    const bool is_forced_, has_mass_;
    const Values<Real> value_;
    const Index n_, s_, nr_, p_;
    Matrix dependent_;  ///< A_dep
    Matrix U_, onto_;   ///< U, Uᵀ
    Matrix M_;
    Tangent<Real> result_;
};

}  // namespace

template <typename Real>
Tangent<Real> tangent(const Residuals& r, const Split& split, const Instant<Real>& at, bool at_kink,
                      Undisturbed motion) {
    ask_whether_wanted();
    return TangentAlgebra<Real>(r, split, at, at_kink, motion == Undisturbed::as_forced).run();
}

template <typename Real>
bool settle(const Residuals& r, const Split& split, Instant<Real>& at) {
    const auto size = [](const auto& v) { return v.size() == 0 ? Real(0) : v.cwiseAbs().maxCoeff(); };
    for (int step = 0; step < 30; ++step) {
        const Values<Real> value(r, at, r.geometry);
        const VectorOf<Real> to_position = newton_step(value, r.position, split.q_dependent, 0),
                             to_velocity = newton_step(value, r.velocity, split.u_dependent, r.n);
        const Real move_q = size(to_position), move_u = size(to_velocity);
        if (!std::isfinite(move_q) || !std::isfinite(move_u)) return false;
        for (std::size_t k = 0; k < split.q_dependent.size(); ++k)
            at.q[split.q_dependent[k]] += to_position[static_cast<Index>(k)];
        for (std::size_t k = 0; k < split.u_dependent.size(); ++k)
            at.u[split.u_dependent[k]] += to_velocity[static_cast<Index>(k)];
        if (move_q < Real(1e-14) && move_u < Real(1e-14)) return true;
    }
    return split.q_dependent.empty() && split.u_dependent.empty();
}

template <typename Real>
Instant<Real> instant_of(const Residuals& r, const State<double>& state) {
    Instant<Real> at{.parameters = {state.parameters.begin(), state.parameters.end()},
                     .q = {state.q.begin(), state.q.end()},
                     .u = {state.qdot.begin(), state.qdot.end()},
                     .inputs = {},
                     .t = state.t};
    State<Real> only{.parameters = at.parameters, .t = at.t, .q = at.q, .qdot = at.u, .qddot = {}};
    only.unknown.resize(r.input_places());
    const std::vector<Real> value = interpret(r.program, only);
    for (const int k : r.inputs) at.inputs.push_back(value[r.input_values[k]]);
    return at;
}

template Tangent<double> tangent(const Residuals&, const Split&, const Instant<double>&, bool, Undisturbed);
template Tangent<long double> tangent(const Residuals&, const Split&, const Instant<long double>&, bool,
                                      Undisturbed);
template Instant<long double> instant_of(const Residuals&, const State<double>&);
template bool settle(const Residuals&, const Split&, Instant<long double>&);

}  // namespace alembert
