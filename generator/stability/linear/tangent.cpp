// SPDX-License-Identifier: GPL-2.0-or-later
// Notation of stability/linear/linearize.hpp; e stands for t and the inputs. Tangent directions of the
// constraints:
//   δq = Q δr + Qe δe,   Q_dep = −φ_dep⁻¹ φ_ind,   δu = S δr + U δw + Se δe,   U_dep = −ν_dep⁻¹ ν_ind.
// U spans the null space of A. With c, the u' that A u' = γ requires if w' = 0:
//   (UᵀMU) w' = Uᵀ(f − M c),   A_depᵀ λ = (M u' − f)_dep.
#include "stability/linear/tangent.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "alembert/base/error.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"
#include "stability/linear/dense_long.hpp"
#include "stability/linear/paths.hpp"

namespace alembert {

using GiNaC::ex;
using Index = Eigen::Index;

Residuals::Residuals(const Mechanism& m, const Equations& e, const std::vector<bool>& at_rest)
    : n(m.size()),
      s(e.size()),
      holonomic(0),
      kept(static_cast<int>(e.A.size())),
      rates_are_speeds(e.speeds_are_rates()) {
    Program all;
    all.source_labels = m.z->source_labels();
    std::vector<std::pair<GiNaC::symbol, int>> given;
    for (std::size_t i = 0; i < m.inputs.size(); ++i)
        for (int order = 0; order < 3; ++order)
            given.emplace_back(m.inputs[i].derivative[order],
                               all.variable({Variable::Kind::unknown, 3 * static_cast<int>(i) + order}));
    std::vector<std::pair<Group, ex>> inertia, forces, motion;
    for (int i = 0; i < s; ++i) {
        for (int j = 0; j <= i; ++j) inertia.emplace_back(Group::mass, e.M(i, j));
        forces.emplace_back(Group::forcing, e.forcing(i));
    }
    for (int k = 0; k < kept; ++k) {
        for (const ex& entry : e.A[k]) forces.emplace_back(Group::row, entry);
        forces.emplace_back(Group::gamma, e.gamma[k]);
    }
    const auto rate_of = [&](int i) { return e.h[i]; };
    for (int i = 0; i < n; ++i) motion.emplace_back(Group::rate, rate_of(i));
    for (const Mechanism::Constraint& c : m.constraints)
        if (c.position) {
            motion.emplace_back(Group::position, *c.position);
            ++holonomic;
        }
    for (const int k : e.kept(m)) {
        const Mechanism::Constraint& c = m.constraints[k];
        GiNaC::exvector terms{c.drift};
        for (int i = 0; i < n; ++i) terms.push_back(c.row[i] * rate_of(i));
        motion.emplace_back(Group::velocity, m.z->name(GiNaC::add(std::move(terms))));
    }
    const auto add = [&](const std::vector<std::pair<Group, ex>>& roots, const std::vector<bool>& is_zero) {
        std::vector<std::pair<GiNaC::symbol, int>> known = given;
        for (int i = 0; i < s; ++i)
            known.emplace_back(e.u[i], !is_zero.empty() && is_zero[static_cast<std::size_t>(i)]
                                           ? all.number(0)
                                           : all.variable({Variable::Kind::rate, i}));
        std::vector<ex> values;
        for (const auto& [group, value] : roots) values.push_back(value);
        const std::vector<int> nodes = lower_expressions(all, m, values, known);
        for (std::size_t i = 0; i < nodes.size(); ++i) all.roots.push_back({roots[i].first, "", nodes[i]});
    };
    add(forces, at_rest);
    add(motion, {});
    steady_needs_mass = std::any_of(all.roots.begin(), all.roots.end(), [&](const Root& root) {
        return root.group == Group::gamma && !(all[root.node].is_number() && cln::zerop(all[root.node].number));
    });
    if (at_rest.empty() || steady_needs_mass) add(inertia, at_rest);
    std::vector<ex> input_symbols;
    for (const Mechanism::Input& input : m.inputs)
        input_symbols.insert(input_symbols.end(), input.derivative.begin(), input.derivative.end());
    for (const int id : lower_expressions(all, m, input_symbols)) all.roots.push_back({Group::input, "", id});
    program = all.canonical();
    for (int id = 0; id < program.size(); ++id)
        if (program[id].op == Op::variable && program[id].variable.kind == Variable::Kind::unknown)
            inputs.push_back(program[id].variable.index);
    std::sort(inputs.begin(), inputs.end());
    for (const auto& [group, list] : {std::pair{Group::mass, &mass},
                                      {Group::forcing, &forcing},
                                      {Group::row, &row},
                                      {Group::gamma, &gamma},
                                      {Group::rate, &rate},
                                      {Group::position, &position},
                                      {Group::velocity, &velocity},
                                      {Group::input, &input_values}})
        *list = program.nodes_of(group);
    geometry = position;
    geometry.insert(geometry.end(), velocity.begin(), velocity.end());
    geometry = program.needed(geometry);
    steady = position;
    for (const std::vector<int>* list : {&velocity, &forcing, &row, &gamma, &rate})
        steady.insert(steady.end(), list->begin(), list->end());
    if (steady_needs_mass) steady.insert(steady.end(), mass.begin(), mass.end());
    steady = program.needed(steady);
}

template <typename Real>
Varied<Real>::Varied(const Residuals& r, const Instant<Real>& at, std::size_t unknowns) {
    for (const Real x : at.parameters) state.parameters.push_back(Jet<Real>(x));
    for (const Real x : at.q) state.q.push_back(next(x));
    for (const Real x : at.u) state.qdot.push_back(next(x));
    state.t = next(at.t);
    state.unknown.resize(unknowns);
    for (std::size_t k = 0; k < r.inputs.size(); ++k)
        state.unknown[static_cast<std::size_t>(r.inputs[k])] = next(at.inputs[k]);
}

template <typename Real>
Jet<Real> Varied<Real>::next(Real value) {
    std::vector<Real> d(++next_, Real(0));  // derivatives by later variables are zero
    d.back() = Real(1);
    return Jet<Real>(value, std::move(d));
}

template struct Varied<double>;
template struct Varied<long double>;

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
        const std::size_t unknowns = r.inputs.empty() ? 0 : static_cast<std::size_t>(r.inputs.back()) + 1;
        return Varied<Real>(r, at, unknowns).state;
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
        const std::vector<Germ> here = on_path(r_, point, VectorOf<long double>::Zero(columns));
        std::vector<int> broken;
        for (const Root& root : r_.program.roots)
            if (root.group != Group::input &&
                !critical_nodes(r_.program, std::vector<int>{root.node}, here).empty())
                broken.push_back(root.node);
        for (Index k = 0; k < columns; ++k) {
            const VectorOf<long double> d = VectorOf<long double>::Unit(columns, k);
            const std::vector<Germ> there = on_path(r_, point, d), back = on_path(r_, point, -d);
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
    for (int i = 0; i < r.s; ++i) {
        const bool follows =
            r.rates_are_speeds && std::binary_search(split.q_dependent.begin(), split.q_dependent.end(), i);
        order.push_back(follows ? 0 : preferred_u[i] ? 1 : 2);
    }
    split.u_dependent = pivots(value.jacobian(r.velocity).middleCols(r.n, r.s), order);
    if (static_cast<int>(split.u_dependent.size()) < r.kept)
        refuse(to_say("velocity"), split.u_dependent.size(), r.kept);
    split.u = others(split.u_dependent, r.s);
    return split;
}

template <typename Real>
Tangent<Real> tangent(const Residuals& r, const Split& split, const Instant<Real>& at, bool at_kink,
                      Undisturbed motion) {
    using Matrix = MatrixOf<Real>;
    using Vector = VectorOf<Real>;
    const bool is_forced = motion == Undisturbed::as_forced;
    const Values<Real> value = is_forced || at_kink ? Values<Real>(r, at, at_kink) : Values<Real>(r, at, r.steady);
    const Index n = r.n, s = r.s, extra = value.columns - n - s, nr = static_cast<Index>(split.q.size()),
                p = static_cast<Index>(split.u.size());
    Tangent<Real> result;

    // Directions: columns r, w, e.
    const Matrix phi = value.jacobian(r.position), nu = value.jacobian(r.velocity);
    Matrix along = Matrix::Zero(n + s + extra, nr + p + extra);
    for (Index j = 0; j < nr; ++j) along(split.q[j], j) = 1;
    for (Index j = 0; j < p; ++j) along(n + split.u[j], nr + j) = 1;
    along.bottomRightCorner(extra, extra).setIdentity();
    if (r.holonomic > 0) {
        const Matrix dependent = columns_of<Real>(phi.leftCols(n), split.q_dependent);
        along.topRows(n) +=
            spread<Real>(solution<Real>(dependent, -product<Real>(phi, along)), split.q_dependent, n);
    }
    const Matrix A = nu.middleCols(n, s);
    const Matrix dependent = columns_of<Real>(A, split.u_dependent);
    const auto particular = [&](const Matrix& right) -> Matrix {  // A x = right, independent ones 0
        if (r.kept == 0) return Matrix::Zero(s, right.cols());
        return spread<Real>(solution<Real>(dependent, right), split.u_dependent, s);
    };
    along.middleRows(n, s) += particular(-product<Real>(nu, along));
    const Matrix U = along.block(n, nr, s, p), onto = U.transpose();

    // u' and λ of the undisturbed motion.
    Matrix M = Matrix::Zero(s, s);
    const bool has_mass = is_forced || r.steady_needs_mass;
    for (Index i = 0, next = 0; has_mass && i < s; ++i)
        for (Index j = 0; j <= i; ++j) M(i, j) = M(j, i) = value[r.mass[next++]].value;
    const Vector f = value.vector(r.forcing), gamma = value.vector(r.gamma);
    Vector udot = particular(gamma).col(0);
    result.mass = product<Real>(product<Real>(onto, M), U);
    const Vector unbalanced = f - M * udot;
    result.balance = onto * unbalanced;
    if (is_forced) {
        result.speed_rates = p > 0 ? Vector(solution<Real>(result.mass, result.balance)) : Vector(0);
        udot += U * result.speed_rates;
    }
    Vector lambda(r.kept);
    if (r.kept > 0) {
        const Vector reaction = M * udot - f;
        Vector on_dependent(r.kept);
        for (Index k = 0; k < r.kept; ++k) on_dependent[k] = reaction[split.u_dependent[k]];
        lambda = solution<Real>(dependent.transpose(), on_dependent);
    }

    // The derivatives of the residuals with constant u' and λ.
    const Matrix df = value.jacobian(r.forcing), dgamma = value.jacobian(r.gamma);
    Matrix R = -df, Gamma = -dgamma;
    for (Index i = 0, next = 0; has_mass && i < s; ++i)
        for (Index j = 0; j <= i; ++j) {
            const Jet<Real>& entry = value[r.mass[next++]];
            for (Index k = 0; k < value.columns; ++k) {
                const Real d = entry.derivative(static_cast<std::size_t>(k));
                R(i, k) += d * udot[j];
                if (i != j) R(j, k) += d * udot[i];
            }
        }
    for (Index k = 0; k < r.kept; ++k)
        for (Index i = 0; i < s; ++i) {
            const Jet<Real>& entry = value[r.row[k * s + i]];
            for (Index c = 0; c < value.columns; ++c) {
                const Real d = entry.derivative(static_cast<std::size_t>(c));
                R(i, c) -= d * lambda[k];
                Gamma(k, c) += d * udot[i];
            }
        }
    const Matrix forced = particular(-product<Real>(Gamma, along));
    result.force = product<Real>(onto, product<Real>(R, along) + product<Real>(M, forced));
    if (is_forced)
        result.speed_rates_by =
            p > 0 ? Matrix(-solution<Real>(result.mass, result.force)) : Matrix(0, along.cols());

    if (is_forced) {
        result.udot_by = forced + product<Real>(U, result.speed_rates_by);
        const Matrix excess = product<Real>(R, along) + product<Real>(M, result.udot_by);  // = Aᵀ δλ
        Matrix on_dependent(r.kept, along.cols());
        for (Index k = 0; k < r.kept; ++k) on_dependent.row(k) = excess.row(split.u_dependent[k]);
        result.lambda_by = r.kept > 0 ? solution<Real>(dependent.transpose(), on_dependent) : on_dependent;
    }

    result.along = along;
    result.udot = udot;
    result.lambda = lambda;
    const Vector rates = value.vector(r.rate);
    const Matrix rates_by = product<Real>(value.jacobian(r.rate), along);
    result.rates.resize(nr);
    result.rates_by.resize(nr, along.cols());
    for (Index j = 0; j < nr; ++j) {
        result.rates[j] = rates[split.q[j]];
        result.rates_by.row(j) = rates_by.row(split.q[j]);
    }
    return result;
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
    only.unknown.resize(r.inputs.empty() ? 0 : r.inputs.back() + 1);
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
