// SPDX-License-Identifier: GPL-2.0-or-later
// Notation of stability/linear/tangent.cpp. Momenta p_c = ∂L/∂q'_c of cyclic coordinates that no load moves are
// constants of the motion: with M_cc δw_c + M_co δw_o + B_c δr = 0 the rates of cyclic coordinates, and with them
// their zero eigenvalues, are eliminated.
#include "stability/local.hpp"

#include <algorithm>
#include <cmath>

#include "base/language/say.hpp"
#include "model/energy.hpp"
#include "model/formalism/elements.hpp"
#include "program/lower/lower.hpp"
#include "stability/exact_field.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double left_over = 1e-28, found_to = 1e-26;

int position_in(const std::vector<int>& list, int what) {
    const auto found = std::find(list.begin(), list.end(), what);
    return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

std::vector<int> up_to(int n, int from = 0) {
    std::vector<int> result;
    for (int i = from; i < n; ++i) result.push_back(i);
    return result;
}

template <typename F>
RealBallMatrix filled(int rows, int columns, const F& value) {
    RealBallMatrix result(rows, columns);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) result(i, j) = value(i, j);
    return result;
}

RealBallMatrix solved(const RealBallMatrix& A, const RealBallMatrix& B, const std::string& what) {
    if (A.rows == 0) return B;
    auto result = solution(A, B);
    if (!result) throw NotAnalytic(say("{} is not surely regular", what));
    return *std::move(result);
}

/// The member, and those of all sets that are joined to it by common members.
std::vector<int> joined_by(const std::vector<std::vector<int>>& sets, int member) {
    std::vector<int> result{member};
    const auto is_in = [&](int i) { return position_in(result, i) >= 0; };
    for (std::size_t size = 0; size < result.size();) {
        size = result.size();
        for (const std::vector<int>& set : sets) {
            if (std::none_of(set.begin(), set.end(), is_in)) continue;
            for (const int i : set)
                if (!is_in(i)) result.push_back(i);
        }
    }
    return result;
}

RealBallMatrix column(const RealBallVector& v) {
    return filled(static_cast<int>(v.size()), 1, [&](int i, int) { return v[i]; });
}

}  // namespace

std::vector<ex> Local::in_speeds(const std::vector<ex>& of) const {
    if (residuals.rates_are_speeds) return of;
    GiNaC::exmap rates;
    for (int i = 0; i < mechanism.size(); ++i) rates[mechanism.qdot[i]] = equations.h[i];
    return substitute(*mechanism.z, of, rates);
}

std::vector<Expansion> Local::series(const std::vector<ex>& of, const Monomials& monomials,
                                     const std::vector<int>& variables) const {
    return series(of, state_at(point, &monomials, variables));
}

std::vector<Expansion> Local::series(const std::vector<ex>& of, const State<Expansion>& state) const {
    const std::vector<ex> wanted = in_speeds(of);
    Program program = begun(mechanism);
    std::vector<std::pair<GiNaC::symbol, int>> given;
    for (int i = 0; i < residuals.s; ++i)
        given.emplace_back(equations.u[i], program.variable({Variable::Kind::rate, i}));
    for (const int k : residuals.inputs)
        given.emplace_back(mechanism.inputs[k / 3].derivative[k % 3],
                           program.variable({Variable::Kind::unknown, k}));
    const std::vector<int> nodes = lower_expressions(program, mechanism, wanted, given);
    const std::vector<Expansion> value = interpret(program, state);
    std::vector<Expansion> result;
    for (const int node : nodes) result.push_back(value[node]);
    return result;
}

/// For unconstrained equations in rates: do they not depend on the coordinate?
bool Local::is_left_out_of_equations(int coordinate) const {
    const Mechanism& m = mechanism;
    std::vector<ex> values;
    for (int i = 0; i < residuals.s; ++i) {
        values.push_back(m.z->name(equations.forcing(i)));
        for (int j = 0; j <= i; ++j) values.push_back(m.z->name(equations.M(i, j)));
    }
    if (!m.z->depends(GiNaC::add(GiNaC::exvector(values.begin(), values.end())), {m.q[coordinate]})) return true;
    for (const ex& slope : m.z->push_forward(values, {{m.q[coordinate], 1}}))
        if (!is_identically_zero(slope, m)) return false;
    return true;
}

/// For each holonomic constraint the coordinates on which it depends.
std::vector<std::vector<int>> Local::ties() const {
    std::vector<std::vector<int>> result;
    for (const Mechanism::Constraint& c : mechanism.constraints) {
        if (!c.position) continue;
        result.emplace_back();
        for (int i = 0; i < residuals.n; ++i)
            if (!is_identically_zero(c.row[i], mechanism)) result.back().push_back(i);
    }
    return result;
}

/// `linearize` finds cyclic coordinates at a few states nearby; here it is proved that nothing depends on them,
/// and a coordinate of which it is not counts as essential.
void Local::find_essential() {
    std::vector<int> left;  // positions in split.q
    for (std::size_t r = 0; r < split.q.size(); ++r) {
        const std::vector<std::string>& known = near.matrices.cyclic;
        if (std::find(known.begin(), known.end(), mechanism.q[split.q[r]].get_name()) != known.end())
            left.push_back(static_cast<int>(r));
    }
    if (mechanism.constraints.empty() && residuals.rates_are_speeds) {
        std::erase_if(left, [&](int r) { return !is_left_out_of_equations(split.q[r]); });
    } else if (!left.empty()) {
        const ExactField field(residuals, split);
        const std::vector<std::vector<int>> constraints = ties();
        const auto tied_to = [&](int coordinate) { return joined_by(constraints, coordinate); };
        std::vector<int> all;
        for (const int r : left)
            for (const int i : tied_to(split.q[r])) all.push_back(i);
        if (!field.is_independent_of(all, left)) {
            const std::vector<int> candidates = left;
            std::erase_if(left, [&](int r) { return !field.is_independent_of(tied_to(split.q[r]), candidates); });
            if (left.size() < candidates.size()) {
                all.clear();
                for (const int r : left)
                    for (const int i : tied_to(split.q[r])) all.push_back(i);
                if (!field.is_independent_of(all, left)) left.clear();
            }
        }
    }
    for (std::size_t r = 0; r < split.q.size(); ++r)
        if (position_in(left, static_cast<int>(r)) < 0) essential.push_back(static_cast<int>(r));
}

std::vector<int> Local::cyclic() const {
    std::vector<int> result;
    for (std::size_t r = 0; r < split.q.size(); ++r)
        if (position_in(essential, static_cast<int>(r)) < 0) result.push_back(static_cast<int>(r));
    return result;
}

bool Local::is_essential(int coordinate) const {
    const int r = position_in(split.q, coordinate);
    return r < 0 || position_in(essential, r) >= 0;
}

Local::Local(const LinearizedScene& of, const ExactOverrides& exact_at)
    : near(of), mechanism(of.mechanism), equations(of.equations), residuals(mechanism, equations) {
    const Linearization& known = near.matrices;
    const auto contains = [](const std::vector<std::string>& list, const std::string& name) {
        return std::find(list.begin(), list.end(), name) != list.end();
    };
    for (int i = 0; i < residuals.n; ++i)
        (contains(known.coordinates, mechanism.q[i].get_name()) ? split.q : split.q_dependent).push_back(i);
    for (int i = 0; i < residuals.s; ++i)
        (contains(known.speeds, equations.u[i].get_name()) ? split.u : split.u_dependent).push_back(i);
    find_essential();
    find_point(exact_at);
    settle();
    find_momenta();
    prove_state();
    reduce();
}

void Local::find_point(const ExactOverrides& exact_at) {
    const Mechanism& m = mechanism;
    const ExactStart start = exact_start(m, near.start, exact_at);
    point.parameters = start.parameters;
    point.t = start.t;
    point.q = start.q;
    point.u = start.qdot;
    if (!residuals.rates_are_speeds) {
        const State<double> in_use = state_of(near.start, m, equations);
        point.u.insert(point.u.end(), start.states.begin(), start.states.end());
        Program forms = begun(m);
        const std::vector<int> nodes = lower_expressions(forms, m, equations.form);
        const std::vector<Expansion> in_rates = interpret(forms, state_at(point, nullptr, {}));
        point.u.clear();
        for (int i = 0; i < residuals.s; ++i) {
            RealBall exact = in_rates[nodes[i]].value();
            for (std::size_t k = 0; k < m.speeds.size(); ++k)
                if (m.speeds[k].start && equations.u[i].is_equal(m.speeds[k].u)) exact = start.speeds[k];
            point.u.push_back(exact_or(exact, in_use.qdot[i]));
        }
    }
    if (residuals.inputs.empty()) return;
    point.inputs.assign(residuals.input_places(), RealBall(0));
    State<Expansion> at_start = state_at(point, nullptr, {});
    const std::vector<Expansion> all = interpret(residuals.program, at_start);
    for (const int k : residuals.inputs) point.inputs[k] = all[residuals.input_values[k]].value();
}

State<Expansion> Local::state_at(const RealBallPoint& at, const Monomials* monomials,
                                 const std::vector<int>& variables) const {
    const auto entry = [&](const RealBall& value, std::size_t which) {
        return monomials && variables[which] >= 0 ? Expansion::variable(*monomials, variables[which], value)
                                                  : Expansion(value);
    };
    State<Expansion> state = state_of(at);
    for (std::size_t i = 0; i < at.q.size(); ++i) state.q[i] = entry(at.q[i], i);
    for (std::size_t i = 0; i < at.u.size(); ++i) state.qdot[i] = entry(at.u[i], at.q.size() + i);
    return state;
}

namespace {

/// The algebra of stability/linear/tangent.cpp in numbers with bounds.
class RealBallAlgebra {
public:
    RealBallAlgebra(const Residuals& r, const Split& split, std::vector<Expansion> value)
        : r_(r),
          split_(split),
          value_(std::move(value)),
          n_(r.n),
          s_(r.s),
          nr_(static_cast<int>(split.q.size())),
          p_(static_cast<int>(split.u.size())) {}

    RealBallTangent run() {
        result_.position = values(r_.position);
        result_.velocity = values(r_.velocity);
        add_directions();
        add_motion();
        add_derivatives();
        result_.coordinate_rates = values(r_.rate);
        result_.rates = (jacobian(r_.rate) * result_.along).part(split_.q, up_to(nr_ + p_));
        return std::move(result_);
    }

private:
    RealBallVector values(const std::vector<int>& nodes) const {
        RealBallVector result;
        for (const int node : nodes) result.push_back(value_[node].value());
        return result;
    }
    RealBallMatrix jacobian(const std::vector<int>& nodes) const {
        return filled(static_cast<int>(nodes.size()), n_ + s_,
                      [&](int i, int k) { return value_[nodes[i]].coefficient(k + 1); });
    }
    /// A x = right, with independent ones 0.
    RealBallMatrix particular(const RealBallMatrix& right) const {
        RealBallMatrix spread(s_, right.columns);
        const RealBallMatrix x = solved(nu_dependent_, right, say("the velocity constraints"));
        for (std::size_t k = 0; k < split_.u_dependent.size(); ++k)
            for (int j = 0; j < right.columns; ++j) spread(split_.u_dependent[k], j) = x(static_cast<int>(k), j);
        return spread;
    }

    /// The columns r, w of `along`, U, and Newton's steps.
    void add_directions() {
        RealBallMatrix& along = result_.along;
        along = filled(n_ + s_, nr_ + p_, [&](int i, int j) {
            return RealBall(j < nr_ ? i == split_.q[j] : i == n_ + split_.u[j - nr_] ? 1 : 0);
        });
        const RealBallMatrix phi = jacobian(r_.position), nu = jacobian(r_.velocity);
        const RealBallMatrix phi_dependent = phi.part(up_to(r_.holonomic), split_.q_dependent);
        const RealBallMatrix follow = solved(phi_dependent, RealBall(-1) * (phi * along), say("the constraints"));
        for (std::size_t k = 0; k < split_.q_dependent.size(); ++k)
            for (int j = 0; j < nr_ + p_; ++j) along(split_.q_dependent[k], j) += follow(static_cast<int>(k), j);
        std::vector<int> speeds_dependent;
        for (const int k : split_.u_dependent) speeds_dependent.push_back(n_ + k);
        nu_dependent_ = nu.part(up_to(r_.kept), speeds_dependent);
        const RealBallMatrix more = particular(RealBall(-1) * (nu * along));
        for (int i = 0; i < s_; ++i)
            for (int j = 0; j < nr_ + p_; ++j) along(n_ + i, j) += more(i, j);
        result_.to_position =
            solved(phi_dependent, RealBall(-1) * column(result_.position), say("the constraints")).entries;
        result_.to_velocity =
            solved(nu_dependent_, RealBall(-1) * column(result_.velocity), say("the constraints")).entries;
        U_ = along.part(up_to(n_ + s_, n_), up_to(nr_ + p_, nr_));
        for (int j = p_ - r_.states; j < p_; ++j)
            for (int i = 0; i < s_; ++i) U_(i, j) = RealBall(i == split_.u[j] ? 1 : 0);
        Ut_ = transposed(U_);
    }

    /// u' and λ of the undisturbed motion.
    void add_motion() {
        M_ = RealBallMatrix(s_, s_);
        for (int i = 0, next = 0; i < s_; ++i)
            for (int j = 0; j <= i; ++j) M_(i, j) = M_(j, i) = value_[r_.mass[next++]].value();
        const RealBallMatrix f = column(values(r_.forcing));
        udot_ = particular(column(values(r_.gamma)));
        result_.mass = Ut_ * M_ * U_;
        const RealBallMatrix wdot =
            solved(result_.mass, Ut_ * (f + RealBall(-1) * (M_ * udot_)), say("the mass matrix"));
        udot_ = udot_ + U_ * wdot;
        result_.speed_rates = wdot.entries;
        RealBallMatrix reaction = M_ * udot_ + RealBall(-1) * f, on_dependent(r_.kept, 1);
        for (int k = 0; k < r_.kept; ++k) on_dependent(k, 0) = reaction(split_.u_dependent[k], 0);
        lambda_ = solved(transposed(nu_dependent_), on_dependent, say("the velocity constraints"));
    }

    /// From the derivatives of the residuals with constant u' and λ.
    void add_derivatives() {
        RealBallMatrix R = RealBall(-1) * jacobian(r_.forcing), Gamma = RealBall(-1) * jacobian(r_.gamma);
        for (int i = 0, next = 0; i < s_; ++i)
            for (int j = 0; j <= i; ++j, ++next)
                for (int k = 0; k < n_ + s_; ++k) {
                    const RealBall d = value_[r_.mass[next]].coefficient(k + 1);
                    if (d.is_zero()) continue;
                    R(i, k) += d * udot_(j, 0);
                    if (i != j) R(j, k) += d * udot_(i, 0);
                }
        for (int k = 0; k < r_.kept; ++k)
            for (int i = 0; i < s_; ++i)
                for (int c = 0; c < n_ + s_; ++c) {
                    const RealBall d = value_[r_.row[k * s_ + i]].coefficient(c + 1);
                    if (d.is_zero()) continue;
                    R(i, c) -= d * lambda_(k, 0);
                    Gamma(k, c) += d * udot_(i, 0);
                }
        const RealBallMatrix forced = particular(RealBall(-1) * (Gamma * result_.along));
        const RealBallMatrix force = Ut_ * (R * result_.along + M_ * forced);
        result_.stiffness = force.part(up_to(p_), up_to(nr_));
        result_.damping = force.part(up_to(p_), up_to(nr_ + p_, nr_));
    }

    const Residuals& r_;
    const Split& split_;
    const std::vector<Expansion> value_;
    const int n_, s_, nr_, p_;
    RealBallMatrix nu_dependent_, U_, Ut_, M_, udot_, lambda_;
    RealBallTangent result_;
};

}  // namespace

RealBallTangent Local::tangent_at(const RealBallPoint& at) const {
    const int variables = residuals.n + residuals.s;
    const Monomials linear(variables, 1);
    return RealBallAlgebra(residuals, split, interpret(residuals.program, state_at(at, &linear, up_to(variables))))
        .run();
}

/// Newton's method for the constraints and for w' = 0, for values that are not exact.
void Local::settle() {
    for (int step = 0; step < 12; ++step) {
        tangent = tangent_at(point);
        double largest = 0;
        bool is_exact = true;
        const auto note = [&](const RealBall& x) {
            largest = std::max(largest, std::abs(x.number()));
            is_exact = is_exact && x.is_zero();
        };
        for (const RealBallVector* list : {&tangent.position, &tangent.velocity, &tangent.speed_rates})
            for (const RealBall& x : *list) note(x);
        bool sharp = true;
        for (const RealBallVector* list : {&point.q, &point.u})
            for (const RealBall& x : *list)
                sharp = sharp && x.radius() < 1e-20 * std::max(1.0, std::abs(x.number()));
        if (is_exact || (largest < left_over && sharp)) return;

        // It starts from the middles; coordinates on which something depends are moved as little as possible.
        RealBallPoint middle = point;
        for (RealBallVector* list : {&middle.q, &middle.u})
            for (RealBall& x : *list)
                if (!x.is_exact()) x = RealBall::about(x.middle(), 0);
        const RealBallTangent here = tangent_at(middle);
        const RealBallMatrix by = here.stiffness.part(up_to(here.stiffness.rows), essential);
        const RealBallMatrix normal = transposed(by) * by;
        const RealBallMatrix right = transposed(by) * (here.mass * column(here.speed_rates));
        const auto move = solution(normal, right);
        double longest = 0;
        const auto shift = [&](RealBall& x, const RealBall& by_much) {
            longest = std::max(longest, std::abs(by_much.number()));
            x = RealBall::about(x.middle() + by_much.middle(), 0);
        };
        bool residual = false;
        for (const RealBall& x : here.speed_rates) residual = residual || std::abs(x.number()) > left_over;
        for (std::size_t k = 0; residual && move && k < essential.size(); ++k)
            shift(middle.q[split.q[essential[k]]], move->entries[k]);
        for (std::size_t k = 0; k < split.q_dependent.size(); ++k)
            if (!here.to_position[k].is_zero()) shift(middle.q[split.q_dependent[k]], here.to_position[k]);
        for (std::size_t k = 0; k < split.u_dependent.size(); ++k)
            if (!here.to_velocity[k].is_zero()) shift(middle.u[split.u_dependent[k]], here.to_velocity[k]);
        const auto widened = [&](double radius) {
            for (RealBallVector* list : {&middle.q, &middle.u})
                for (RealBall& x : *list)
                    if (!x.is_exact()) x = RealBall::about(x.middle(), radius);
        };
        if (longest < left_over) {
            if (residual) break;  // no step, and no equilibrium to the last digit
            widened(found_to);
            point = middle;
            tangent = tangent_at(point);
            return;
        }
        if (longest > 1e-3) break;
        point = middle;
    }
    throw NotAnalytic(say("the equilibrium is not found to the last digits"));
}

/// Cyclic coordinates whose momentum is constant: L does not contain them, and no load acts along them.
void Local::find_momenta() {
    const Mechanism& m = mechanism;
    if (!m.constraints.empty() || !residuals.rates_are_speeds) return;
    const std::vector<ex> slope = m.z->pull_back({{m.lagrangian(), 1}}, m.q);
    const std::vector<ex> of_dampers = m.generalized_forces(true), of_others = m.generalized_forces(false);
    for (std::size_t j = 0; j < split.u.size(); ++j) {
        const int i = split.u[j];
        if (is_essential(i)) continue;
        if (is_identically_zero(slope[i] + of_dampers[i] + of_others[i], m))
            cyclic_momenta.push_back(static_cast<int>(j));
    }
}

/// Of a state whose residuals are zero in exact numbers there is nothing to prove.
void Local::prove_state() {
    const auto are_zero = [](const RealBallVector& list) {
        return std::all_of(list.begin(), list.end(), [](const RealBall& x) { return x.is_zero(); });
    };
    if (are_zero(tangent.position) && are_zero(tangent.velocity) && are_zero(tangent.speed_rates)) return;
    known = disc_around(residuals, split, essential, cyclic_momenta, point, found_to);
}

void Local::reduce() {
    const int nr = static_cast<int>(split.q.size()), p = static_cast<int>(split.u.size());
    // δw = T (δr_essential, δw_others)
    const int ne = static_cast<int>(essential.size());
    std::vector<int> others;
    for (int j = 0; j < p; ++j)
        if (position_in(cyclic_momenta, j) < 0) others.push_back(j);
    const int size = ne + static_cast<int>(others.size());
    RealBallMatrix T(p, size);
    for (std::size_t k = 0; k < others.size(); ++k) T(others[k], ne + static_cast<int>(k)) = 1;
    if (!cyclic_momenta.empty()) {
        const Mechanism& m = mechanism;
        const std::vector<ex> momenta = m.z->pull_back({{m.lagrangian(), 1}}, m.qdot);
        std::vector<ex> wanted;
        for (const int j : cyclic_momenta) wanted.push_back(momenta[split.u[j]]);
        const Monomials linear(residuals.n + residuals.s, 1);
        const std::vector<Expansion> value = series(wanted, linear, up_to(residuals.n + residuals.s));
        const RealBallMatrix dp = filled(static_cast<int>(value.size()), residuals.n + residuals.s,
                                         [&](int i, int k) { return value[i].coefficient(k + 1); }) *
                                  tangent.along;
        std::vector<int> own, rest, columns;
        for (const int j : cyclic_momenta) own.push_back(nr + j);
        for (const int r : essential) rest.push_back(r);
        for (const int j : others) rest.push_back(nr + j);
        const std::vector<int> rows = up_to(static_cast<int>(value.size()));
        const RealBallMatrix x =
            solved(dp.part(rows, own), RealBall(-1) * dp.part(rows, rest), say("the inertia"));
        for (std::size_t k = 0; k < cyclic_momenta.size(); ++k)
            for (int c = 0; c < size; ++c) T(cyclic_momenta[k], c) = x(static_cast<int>(k), c);
    }
    RealBallMatrix whole(nr + p, size);
    for (int k = 0; k < ne; ++k) whole(essential[k], k) = 1;
    for (int j = 0; j < p; ++j)
        for (int c = 0; c < size; ++c) whole(nr + j, c) = T(j, c);
    std::vector<int> r_columns = up_to(nr), w_columns = up_to(nr + p, nr);
    const RealBallMatrix in_w = whole.part(w_columns, up_to(size)), in_r = whole.part(r_columns, up_to(size));
    const RealBallMatrix wdot = solved(
        tangent.mass, RealBall(-1) * (tangent.damping * in_w + tangent.stiffness * in_r), say("the mass matrix"));
    const RealBallMatrix rdot = tangent.rates * whole;
    A = RealBallMatrix(size, size);
    for (int k = 0; k < ne; ++k)
        for (int c = 0; c < size; ++c) A(k, c) = rdot(essential[k], c);
    for (std::size_t k = 0; k < others.size(); ++k)
        for (int c = 0; c < size; ++c) A(ne + static_cast<int>(k), c) = wdot(others[k], c);
    for (const int r : essential) states.push_back(mechanism.q[split.q[r]].get_name());
    for (const int j : others) states.push_back(equations.u[split.u[j]].get_name());
}

}  // namespace alembert
