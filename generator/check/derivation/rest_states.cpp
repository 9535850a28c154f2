// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/rest_states.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "analysis/state/assemble.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"
#include "program/lower/start.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr int most_sets = 24,  // of values of the parameters; a line is decided after 3 to 6 in most cases
    least_sets = 3,            // with fewer nothing is said
    starts = 10, most_steps = 40;
constexpr double longest = 20000;    // nodes of an expression, as in first_order.cpp
constexpr double settled = 1e-11;    // of Newton's method, in doubles
constexpr double alike = 1e-7;       // of values at such a state: √settled, as roots of even order are that near
constexpr double obeyed = 1e-5;      // of relations that lines have shown, with numbers of few digits in them
constexpr double small_term = 1e-3;  // what is smaller beside parameters and coordinates near 1 says nothing
constexpr double no_pivot = 1e-10;   // relative to the largest one

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// In [0, 1), the same in each run.
double fraction(int set, std::size_t k) {
    std::mt19937 random(static_cast<unsigned>(set) * 7919U + static_cast<unsigned>(k));
    random.discard(8);  // the first values of near seeds are alike
    return static_cast<double>(random()) / 4294967296.0;
}

bool are_finite(const std::vector<double>& list) {
    return std::all_of(list.begin(), list.end(), [](double x) { return std::isfinite(x); });
}

/// Whether a node is zero because terms of a sum are equal and opposite, and not because each is zero.
bool terms_cancel(const Program& program, int id, const std::vector<double>& value) {
    const Node& node = program[id];
    if (node.op == Op::sum && node.args.size() == 1 && node.number == Rational(0))
        return terms_cancel(program, node.args[0], value);
    if (node.op == Op::sum) return size_of_terms(program, id, value) > small_term;
    return node.op == Op::product && std::any_of(node.args.begin(), node.args.end(), [&](int arg) {
               return std::abs(value[static_cast<std::size_t>(arg)]) < alike && terms_cancel(program, arg, value);
           });
}

/// Coordinates on which neither inertia nor forces nor constraints depend.
std::vector<std::size_t> cyclic_coordinates(const DerivedSystem& system) {
    const Mechanism& m = system.mechanism();
    const Equations& e = system.equations();
    std::vector<ex> all;
    for (int i = 0; i < e.size(); ++i) {
        all.push_back(e.forcing(i));
        for (int j = 0; j < e.size(); ++j) all.push_back(e.M(i, j));
    }
    for (const auto& row : e.A) all.insert(all.end(), row.begin(), row.end());
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < m.q.size(); ++i)
        if (std::none_of(all.begin(), all.end(), [&](const ex& one) {
                return m.z->depends(one, {m.q[i]}) &&
                       !is_identically_zero(m.z->name(m.z->pull_back({{one, 1}}, {m.q[i]})[0]), m);
            }))
            result.push_back(i);
    return result;
}

/// Of Σ coefficient x^k, from the companion matrix.
Eigen::VectorXcd roots_of(const std::vector<double>& coefficients) {
    std::size_t degree = coefficients.size();
    while (degree > 0 && coefficients[degree - 1] == 0) --degree;
    if (degree < 2) return {};
    const auto n = static_cast<Eigen::Index>(degree - 1);
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
    companion.bottomLeftCorner(n - 1, n - 1).setIdentity();
    for (Eigen::Index k = 0; k < n; ++k)
        companion(k, n - 1) = -coefficients[static_cast<std::size_t>(k)] / coefficients[degree - 1];
    return Eigen::EigenSolver<Eigen::MatrixXd>(companion, false).eigenvalues();
}

/// By itself: Ω t may stand in it and go out.
bool changes_with_time(const ex& e, const Mechanism& m) {
    return m.z->depends(e, {m.t}) && !is_identically_zero(m.z->name(m.explicit_time_derivative({e})[0]), m);
}

}  // namespace

RestStates::RestStates(const DerivedSystem& system, Kind kind) : system_(system), kind_(std::move(kind)) {
    const Mechanism& m = system.mechanism();
    const Equations& e = system.equations();
    if (!e.speeds_are_rates()) return;
    inputs_ = system.inputs_in_time();
    if (kind_.steady) cyclic_ = cyclic_coordinates(system);
    if (kind_.steady && cyclic_.empty()) return;
    std::vector<GiNaC::symbol> unknown = m.q;
    for (const std::size_t i : cyclic_) unknown.push_back(m.qdot[i]);
    unknown.insert(unknown.end(), e.lambda.begin(), e.lambda.end());
    coordinates_ = static_cast<Eigen::Index>(m.q.size());
    multipliers_ = static_cast<Eigen::Index>(e.lambda.size());
    if (e.A.size() != e.lambda.size() || !m.undetermined().empty()) return;
    std::vector<ex> conditions, rows, momenta;  // what the coordinates obey, and the linearized constraints
    for (int i = 0; i < e.size(); ++i) conditions.push_back(m.z->name(e.forcing(i) + system.reaction(i)));
    for (const GiNaC::exmap& values : {kind_.special, inputs_, kind_.special})
        conditions = substitute(*m.z, conditions, values);
    std::vector<ex> forces = conditions;
    for (std::size_t k = 0; k < e.A.size(); ++k) {
        if (m.constraints[k].position) {
            conditions.push_back(*m.constraints[k].position);
            ++holonomic_;
        }
        rows.insert(rows.end(), e.A[k].begin(), e.A[k].end());
    }
    conditions_ = static_cast<Eigen::Index>(conditions.size());
    std::vector<ex> rest = conditions;
    for (const ex& condition : conditions) {
        if (m.z->tree_size(condition) > longest || changes_with_time(condition, m)) return;
        for (ex& slope : m.z->pull_back({{condition, 1}}, unknown)) rest.push_back(std::move(slope));
    }
    std::vector<ex> near;
    const auto add_slopes = [&](const std::vector<ex>& list, const std::vector<GiNaC::symbol>& by) {
        for (const ex& one : list)
            for (ex& slope : m.z->pull_back({{one, 1}}, by)) near.push_back(std::move(slope));
    };
    for (int i = 0; i < e.size(); ++i)
        for (int j = 0; j < e.size(); ++j) near.push_back(e.M(i, j));
    add_slopes(forces, m.qdot);
    add_slopes(forces, m.q);
    near.insert(near.end(), rows.begin(), rows.end());
    const std::vector<ex> all_momenta = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);
    const std::vector<ex> all_forces = system.forces(true);
    for (const std::size_t i : cyclic_)
        if (is_identically_zero(all_forces[i], m)) momenta.push_back(all_momenta[i]);  // none drives or brakes it
    kept_ = static_cast<Eigen::Index>(momenta.size());
    add_slopes(momenta, m.qdot);
    add_slopes(momenta, m.q);
    rest_ = lowered(rest, {});
    near_ = lowered(near, {});
    is_usable_ = true;
}

/// At rest or in steady motion, for the special values and with coordinates for the letters of their values.
RestStates::Nodes RestStates::lowered(const std::vector<ex>& list, const GiNaC::exmap& places) {
    const Mechanism& m = system_.mechanism();
    GiNaC::exmap there = places;
    for (std::size_t i = 0; i < m.q.size(); ++i) {
        there[m.qddot[i]] = 0;
        if (std::find(cyclic_.begin(), cyclic_.end(), i) == cyclic_.end()) there[m.qdot[i]] = 0;
    }
    std::vector<ex> all = list;
    for (const GiNaC::exmap& values : {kind_.special, inputs_, there, kind_.special})
        all = substitute(*m.z, all, values);  // the special ones again: inputs bring parameters
    Nodes nodes;
    nodes.roots = system_.lower(program_, all);
    nodes.needed = program_.needed(nodes.roots);
    return nodes;
}

std::vector<double> RestStates::values(const Nodes& nodes, const State<double>& at) const {
    const std::vector<double> all = interpret_nodes(program_, at, nodes.needed);
    std::vector<double> result;
    for (const int node : nodes.roots) result.push_back(all[static_cast<std::size_t>(node)]);
    return result;
}

/// Another value of a parameter: its own in the first set, then in turn near its own and near 1, so that states
/// that need small loads are met too.
double RestStates::drawn(double own, int set, std::size_t k) const {
    constexpr double smallest = 0.05, largest = 20, span = 3;
    if (own == 0) return set == 0 ? 0 : fraction(set, k) - 0.5;
    const double size = std::abs(own), factor = std::pow(span, 2 * fraction(set, k) - 1);
    const double middle = set % 2 == 1 || size < smallest || size > largest ? 1 : size;
    return std::copysign(set == 0 ? middle : middle * factor, own);
}

double& RestStates::unknown(State<double>& state, Eigen::Index k) const {
    const auto moving = static_cast<Eigen::Index>(cyclic_.size());
    if (k < coordinates_) return state.q[static_cast<std::size_t>(k)];
    if (k < coordinates_ + moving) return state.qdot[cyclic_[static_cast<std::size_t>(k - coordinates_)]];
    return state.unknown[static_cast<std::size_t>(k - coordinates_ - moving)];
}

std::optional<State<double>> RestStates::reached(State<double> from) const {
    const Eigen::Index columns = coordinates_ + static_cast<Eigen::Index>(cyclic_.size()) + multipliers_;
    for (int step = 0; step < most_steps; ++step) {
        const std::vector<double> here = values(rest_, from);
        if (!are_finite(here)) return std::nullopt;
        const Eigen::Map<const Eigen::VectorXd> left(here.data(), conditions_);
        const Eigen::Map<const RowMajor> slopes(here.data() + conditions_, conditions_, columns);
        Eigen::CompleteOrthogonalDecomposition<Matrix> solver;
        solver.setThreshold(no_pivot);
        solver.compute(slopes);
        const Eigen::VectorXd change = solver.solve(left);
        double size = 1;
        for (Eigen::Index k = 0; k < columns; ++k) {
            double& x = unknown(from, k);
            size = std::max(size, std::abs(x));
            x -= change[k];
        }
        const double scale = std::max(slopes.cwiseAbs().maxCoeff() * size, 1e-30);
        if (change.norm() < settled * size && left.norm() < settled * scale) return from;
    }
    return std::nullopt;
}

/// Where a search begins: the first is the scene's own.
State<double> RestStates::at_random(int set, int start) const {
    State<double> at = start_of(system_.mechanism()).state();
    at.unknown.assign(static_cast<std::size_t>(multipliers_), 0);
    for (std::size_t p = 0; p < at.parameters.size(); ++p) at.parameters[p] = drawn(at.parameters[p], set, p);
    std::fill_n(at.qdot.begin(), at.q.size(), 0);
    const auto random = [&](std::size_t i) { return 2 * fraction(1000 * start + set, 100 + i) - 1; };
    for (std::size_t i = 0; start > 0 && i < at.q.size(); ++i) at.q[i] = std::numbers::pi * random(i);
    for (const std::size_t i : cyclic_) at.qdot[i] = 2 * random(50 + i);
    return at;
}

/// Whether the equations near a state are the same at others.
bool RestStates::is_linear() {
    const std::vector<double> first = values(near_, at_random(0, 0));
    State<double> other = at_random(0, 1);
    const std::vector<double> second = values(near_, other);
    for (double& x : other.unknown) x = 1;
    const std::vector<double> third = values(near_, other);
    return are_finite(first) && first == second && first == third;
}

/// Those that are found for one set of values.
const std::vector<RestStates::Place>& RestStates::places(int set) {
    for (int k = static_cast<int>(sets_.size()); k <= set; ++k) {
        const State<double> at = at_random(k, 0);
        std::vector<Place> found;
        for (int start = 0; start < starts; ++start) {
            const std::optional<State<double>> state = reached(at_random(k, start));
            if (state && std::none_of(found.begin(), found.end(), [&](const Place& other) {
                    double most = 0;
                    for (std::size_t i = 0; i < state->q.size(); ++i)
                        most = std::max({most, std::abs(other.state.q[i] - state->q[i]),
                                         std::abs(other.state.qdot[i] - state->qdot[i])});
                    return most < alike;
                }))
                found.push_back({.state = *state});
        }
        const auto from_start = [&](const Place& place) {
            double sum = 0;
            for (std::size_t i = 0; i < at.q.size(); ++i) sum += std::pow(place.state.q[i] - at.q[i], 2);
            return sum;
        };
        const auto own = std::min_element(found.begin(), found.end(), [&](const Place& a, const Place& b) {
            return from_start(a) < from_start(b);
        });
        if (own != found.end()) own->is_own = true;
        sets_.push_back(std::move(found));
    }
    return sets_[static_cast<std::size_t>(set)];
}

std::optional<RestStates::Near> RestStates::near(const State<double>& at) const {
    const std::vector<double> all = values(near_, at);
    if (!are_finite(all)) return std::nullopt;
    const double* next = all.data();
    const auto take = [&](Eigen::Index rows) {
        const Matrix part = Eigen::Map<const RowMajor>(next, rows, coordinates_);
        next += rows * coordinates_;
        return part;
    };
    Near result;
    result.mass = take(coordinates_);
    result.by_rates = take(coordinates_);
    result.by_places = take(coordinates_);
    result.rows = take(multipliers_);
    result.momenta_by_rates = take(kept_);
    result.momenta_by_places = take(kept_);
    return result;
}

/// Of the equations of first order, in displacements that the constraints allow.
Eigen::VectorXcd RestStates::eigenvalues(const Near& near) {
    const Eigen::Index size = near.mass.rows();
    const Matrix free = near.rows.rows() == 0 ? Matrix(Matrix::Identity(size, size))
                                              : Matrix(Eigen::FullPivLU<Matrix>(near.rows).kernel());
    const Eigen::Index n = free.cols();
    const Matrix inverse = (free.transpose() * near.mass * free).completeOrthogonalDecomposition().pseudoInverse();
    Matrix all = Matrix::Zero(2 * n, 2 * n);
    all.topRightCorner(n, n) = Matrix::Identity(n, n);
    all.bottomLeftCorner(n, n) = inverse * (free.transpose() * near.by_places * free);
    all.bottomRightCorner(n, n) = inverse * (free.transpose() * near.by_rates * free);
    return Eigen::EigenSolver<Matrix>(all, false).eigenvalues();
}

/// Whether nothing grows near the state, as far as the equations of first order tell.
bool RestStates::is_stable(const State<double>& at) const {
    const std::optional<Near> there = near(at);
    if (!there) return false;
    const Eigen::VectorXcd values = eigenvalues(*there);
    return values.real().maxCoeff() < 1e-4 * (1 + values.cwiseAbs().maxCoeff());
}

/// √(k/m − γ²) of a damped oscillation: the imaginary part of an eigenvalue.
bool RestStates::oscillates(const Near& near, double square) {
    const Eigen::VectorXcd values = eigenvalues(near);
    return square > 0 && std::any_of(values.begin(), values.end(), [&](const std::complex<double>& s) {
               return std::abs(s.real()) > alike && std::abs(s.imag() * s.imag() - square) < alike * square;
           });
}

/// Whether what the derivation has found of the state holds there.
bool RestStates::obeys(const State<double>& at, const Nodes& relations) const {
    if (relations.roots.empty()) return true;
    const std::vector<double> all = interpret_nodes(program_, at, relations.needed);
    return std::all_of(relations.roots.begin(), relations.roots.end(), [&](int root) {
        const double value = all[static_cast<std::size_t>(root)];
        return std::abs(value) <= obeyed * std::max(size_of_terms(program_, root, all), small_term);
    });
}

/// A place where a line says little: a letter for an angle stands for 0 or π, one for a length for 0.
bool RestStates::is_trivial(const State<double>& at, const About& about) const {
    const Mechanism& m = system_.mechanism();
    for (const auto& [letter, coordinate] : about.places)
        for (std::size_t i = 0; i < m.q.size(); ++i)
            if (coordinate.is_equal(m.q[i]) && std::abs(std::sin(at.q[i])) < small_term) return true;
    return false;
}

RestStates::Found RestStates::weighed(const About& about, bool is_any,
                                      const std::function<std::optional<Seen>(const State<double>&)>& test) {
    if (!is_usable_) return Found::unknown;
    struct Count {
        int sets = 0, told = 0, elsewhere = 0;
        bool at_all = true;
        void add(const Count& set) {
            if (set.sets == 0) return;
            ++sets;
            at_all = at_all && set.at_all;
            told += set.told > 0 ? 1 : 0;
            elsewhere += set.elsewhere > 0 ? 1 : 0;
        }
    } all, telling;
    const Nodes relations = lowered(about.relations, about.places);
    const bool needs_telling = !about.places.empty() && !about.names_place;
    for (int k = 0; k < most_sets; ++k) {
        Count here, there;
        const std::vector<Place>& list = places(k);
        const bool own_is_unstable = std::none_of(
            list.begin(), list.end(), [&](const Place& place) { return place.is_own && is_stable(place.state); });
        for (const Place& place : list) {
            if (!obeys(place.state, relations)) continue;
            const std::optional<Seen> seen = test(place.state);
            if (!seen) continue;
            const bool tells = seen->holds && (seen->is_told || about.names_place);
            const bool is_meant =
                tells && (is_any || place.is_own || kind_.steady || (own_is_unstable && is_stable(place.state)));
            for (Count* count : {&here, &there}) {
                if (count == &there && is_trivial(place.state, about)) continue;
                ++count->sets;
                count->at_all = count->at_all && seen->holds;
                count->told += is_meant ? 1 : 0;
                count->elsewhere += tells ? 1 : 0;
            }
        }
        all.add(here);
        telling.add(there);
        if (telling.sets < least_sets && needs_telling) continue;
        const Count& count = telling.sets >= least_sets ? telling : all;
        if (count.sets >= least_sets && !count.at_all && count.told >= 2) break;
        if (count.sets >= 2 * least_sets && count.at_all) break;
    }
    const Count& count = telling.sets >= least_sets ? telling : all;
    if (count.sets < least_sets || (telling.sets < least_sets && needs_telling)) return Found::unknown;
    if (count.at_all && count.elsewhere == 0) return about.places.empty() ? Found::trivially : Found::unknown;
    if (count.at_all) return Found::everywhere;
    if (count.told >= 2) return Found::on_branch;
    if (count.elsewhere >= 2) return Found::elsewhere;
    return count.elsewhere == 0 ? Found::nowhere : Found::unknown;
}

RestStates::Found RestStates::vanishes(const ex& residual, const About& about) {
    if (!is_usable_ || system_.mechanism().z->tree_size(residual) > longest) return Found::unknown;
    const Nodes nodes = lowered({residual}, about.places);
    const int root = nodes.roots[0];
    return weighed(about, about.of_number, [&](const State<double>& at) -> std::optional<Seen> {
        const std::vector<double> all = interpret_nodes(program_, at, nodes.needed);
        const double value = all[static_cast<std::size_t>(root)], size = size_of_terms(program_, root, all);
        if (!std::isfinite(value)) return std::nullopt;
        return Seen{.holds = std::abs(value) <= alike * std::max(size, small_term),
                    .is_told = terms_cancel(program_, root, all)};
    });
}

/// Whether the slopes of the expression are a combination of those of the equations of motion, of the constraints
/// and of the momenta that are kept.
RestStates::Found RestStates::vanishes_near(const ex& residual, const About& given) {
    About about = given;
    about.names_place = false;
    const bool is_said = !about.places.empty() || !about.base.empty();  // which state the author means
    const Mechanism& m = system_.mechanism();
    if (!is_usable_ || m.z->tree_size(residual) > longest) return Found::unknown;
    std::vector<GiNaC::symbol> by = m.qddot;
    for (const auto* list : {&m.qdot, &m.q, &system_.equations().lambda})
        by.insert(by.end(), list->begin(), list->end());
    std::vector<ex> list = m.z->pull_back({{residual, 1}}, by);
    list.push_back(residual);
    for (const auto& [coordinate, value] : about.base) list.push_back(coordinate - value);
    const Nodes nodes = lowered(list, about.places);
    const Eigen::Index n = coordinates_, columns = 3 * n + multipliers_;
    return weighed(
        about, is_said && !about.relations.empty(), [&](const State<double>& at) -> std::optional<Seen> {
            const std::vector<double> all = interpret_nodes(program_, at, nodes.needed);
            std::vector<double> here;
            for (const int node : nodes.roots) here.push_back(all[static_cast<std::size_t>(node)]);
            const std::optional<Near> there = near(at);
            if (!there || !are_finite(here)) return std::nullopt;
            if (std::any_of(here.begin() + columns + 1, here.end(),
                            [](double away) { return std::abs(std::sin(away / 2)) > alike; }))
                return std::nullopt;
            const Eigen::Map<const Eigen::VectorXd> slopes(here.data(), columns);
            const double size = slopes.norm();
            if (size < alike) return std::nullopt;  // energies have no part of first order
            const double terms = size_of_terms(program_, nodes.roots[static_cast<std::size_t>(columns)], all);
            if (std::abs(here[static_cast<std::size_t>(columns)]) > alike * std::max(size, terms)) return Seen{};
            const Eigen::Index moving = there->momenta_by_rates.rows();
            Matrix rows = Matrix::Zero(n + 3 * multipliers_ + moving, columns);
            rows.topRows(n) << there->mass, -there->by_rates, -there->by_places, -there->rows.transpose();
            rows.block(n, 0, multipliers_, n) = there->rows;
            rows.block(n + multipliers_, n, multipliers_, n) = there->rows;
            if (holonomic_ == multipliers_) rows.block(n + 2 * multipliers_, 2 * n, multipliers_, n) = there->rows;
            rows.block(n + 3 * multipliers_, n, moving, n) = there->momenta_by_rates;
            rows.block(n + 3 * multipliers_, 2 * n, moving, n) = there->momenta_by_places;
            Eigen::CompleteOrthogonalDecomposition<Matrix> solver;
            solver.setThreshold(no_pivot);
            solver.compute(rows.transpose());
            const Eigen::VectorXd combined = rows.transpose() * solver.solve(slopes);
            return Seen{.holds = (combined - slopes).norm() <= alike * size};
        });
}

/// Whether there is a solution near the state that varies as e^{st} with s² = −square, and not for any s.
bool RestStates::solves(const Near& near, double square, bool resisting) {
    const Eigen::Index n = near.mass.rows(), bound = near.rows.rows();
    const Matrix damping = resisting ? near.by_rates : Matrix((near.by_rates - near.by_rates.transpose()) / 2);
    const auto smallest = [&](double of) {
        using Complex = std::complex<double>;
        const Complex s = std::sqrt(Complex(-of, 0));
        Eigen::MatrixXcd all = Eigen::MatrixXcd::Zero(n + bound, n + bound);
        all.topLeftCorner(n, n) =
            near.mass.cast<Complex>() * (s * s) - damping.cast<Complex>() * s - near.by_places.cast<Complex>();
        all.topRightCorner(n, bound) = -near.rows.transpose().cast<Complex>();
        all.bottomLeftCorner(bound, n) = near.rows.cast<Complex>();
        const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXcd>(all).singularValues();
        return values[values.size() - 1] / std::max(values[0], 1e-30);
    };
    const double here = smallest(square);
    return here < alike && here < 1e-3 * std::min(smallest(1.4 * square + 0.01), smallest(0.7 * square - 0.01));
}

RestStates::Found RestStates::is_characteristic(const std::vector<ex>& coefficients, const About& about) {
    using Complex = std::complex<double>;
    constexpr double rounding = 1e-6;  // of eigenvalues in doubles, double ones too
    if (!is_usable_) return Found::unknown;
    const Nodes nodes = lowered(coefficients, about.places);
    const auto test = [&](const State<double>& at) -> std::optional<Seen> {
        const std::vector<double> here = values(nodes, at);
        const std::optional<Near> there = near(at);
        if (!there || !are_finite(here)) return std::nullopt;
        const Eigen::VectorXcd all = eigenvalues(*there);
        const double largest = all.cwiseAbs().maxCoeff();
        if (largest < alike) return std::nullopt;
        const auto solves = [&](Complex x) {
            Complex sum = 0, power = 1;
            double size = 0;
            for (const double c : here) {
                sum += c * power;
                size += std::abs(c * power);
                power *= x;
            }
            return std::abs(sum) <= rounding * size;
        };
        const auto all_solve = [&](auto&& of) {
            return std::all_of(all.begin(), all.end(), [&](const Complex& s) {
                return std::abs(s) < std::sqrt(alike) * largest || solves(of(s));
            });
        };
        // or an equation for some of them, as of one mode: then all its roots are
        const Eigen::VectorXcd roots = roots_of(here);
        const auto all_are = [&](auto&& of) {
            return roots.size() > 0 && std::all_of(roots.begin(), roots.end(), [&](const Complex& x) {
                       const Complex s = of(x);
                       return (all.array() - s).abs().minCoeff() <= std::sqrt(alike) * largest;
                   });
        };
        const bool is_of_some = all_are([](Complex x) { return x; }) ||
                                all_are([](Complex x) { return Complex(0, 1) * x; }) ||
                                all_are([](Complex x) { return std::sqrt(-x); });
        return Seen{.holds = is_of_some || all_solve([](Complex s) { return std::sqrt(-s * s); }) ||
                             all_solve([](Complex s) { return -s * s; }) ||
                             all_solve([](Complex s) { return s; })};
    };
    return weighed(about, false, test);
}

RestStates::Found RestStates::is_frequency(const ex& square, const About& about) {
    if (!is_usable_ || system_.mechanism().z->tree_size(square) > longest) return Found::unknown;
    const Nodes nodes = lowered({square}, about.places);
    const auto test = [&](const State<double>& at) -> std::optional<Seen> {
        const double value = values(nodes, at)[0];
        const std::optional<Near> there = near(at);
        if (!there || !std::isfinite(value)) return std::nullopt;
        if (std::abs(value) < alike && !square.is_zero())
            return std::nullopt;  // what moves without resistance has that
        return Seen{.holds =
                        solves(*there, value, true) || solves(*there, value, false) || oscillates(*there, value)};
    };
    const Found found = weighed(about, !about.relations.empty(), test);
    if (found != Found::unknown || !about.places.empty() || !is_linear()) return found;
    int holding = 0;  // two rotors that a torque drives have no rest, and yet a frequency
    for (int k = 0; k < least_sets; ++k) {
        const std::optional<Seen> seen = test(at_random(k, 0));
        holding += seen && seen->holds ? 1 : 0;
    }
    return holding == least_sets ? Found::on_branch : holding == 0 ? Found::nowhere : Found::unknown;
}

}  // namespace alembert
