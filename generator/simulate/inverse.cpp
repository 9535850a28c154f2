// SPDX-License-Identifier: GPL-2.0-or-later
#include "simulate/inverse.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "alembert/base/dense.hpp"
#include "alembert/base/error.hpp"
#include "alembert/base/tolerances.hpp"
#include "analysis/state/assemble.hpp"
#include "base/language/say.hpp"
#include "model/friction.hpp"
#include "program/lower/inverse.hpp"
#include "program/lower/lower.hpp"
#include "simulate/given_accelerations.hpp"
#include "simulate/inverse_friction.hpp"
#include "simulate/inverse_speeds.hpp"

namespace alembert {

namespace {

struct Loads {
    Eigen::VectorXd acceleration, load, multiplier;
};

/// M q'' = f + Aᵀλ + τ, A q'' = γ, where the loads are affine in q'': τ + Aᵀλ = M q'' − f.
struct Affine {
    Eigen::MatrixXd M, A;
    Eigen::VectorXd minus_f, gamma;
};

Affine affine(const Program& program, State<double> state) {
    const auto n = static_cast<Eigen::Index>(state.q.size());
    const auto vector = [&](Group group) {
        const std::vector<double> value = interpret(program, state);
        const std::vector<int> nodes = program.nodes_of(group);
        Eigen::VectorXd v(static_cast<Eigen::Index>(nodes.size()));
        for (std::size_t i = 0; i < nodes.size(); ++i) v[static_cast<Eigen::Index>(i)] = value[nodes[i]];
        return v;
    };
    state.qddot.assign(state.q.size(), 0);
    Affine result{
        .M = Eigen::MatrixXd(n, n), .A = {}, .minus_f = vector(Group::load), .gamma = vector(Group::gamma)};
    const Eigen::VectorXd rows = vector(Group::row);
    result.A =
        Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(rows.data(), result.gamma.size(), n);
    for (Eigen::Index j = 0; j < n; ++j) {
        std::fill(state.qddot.begin(), state.qddot.end(), 0);
        state.qddot[static_cast<std::size_t>(j)] = 1;
        result.M.col(j) = vector(Group::load) - result.minus_f;
    }
    return result;
}

/// The case in which at most as many accelerations are given as there are degrees of freedom. The loads act along
/// these coordinates, and the other accelerations follow. Rows of A may follow from others; `rank` of them do not.
Loads partly_given(const Affine& s, Eigen::Index rank, const std::vector<std::optional<double>>& given, double t,
                   const std::vector<double>& q) {
    const Eigen::Index n = s.M.rows(), m = s.A.rows();
    // The coefficients of (τ or q'' for each coordinate, λ).
    Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n + m, n + m);
    Eigen::VectorXd right(n + m);
    right << -s.minus_f, s.gamma;
    for (Eigen::Index j = 0; j < n; ++j) {
        Eigen::VectorXd column(n + m);
        column << s.M.col(j), s.A.col(j);
        if (const auto& a = given[static_cast<std::size_t>(j)]) {
            S(j, j) = -1;
            right -= *a * column;
        } else {
            S.col(j) = column;
        }
    }
    S.topRightCorner(n, m) = -s.A.transpose();
    const LeastNorm solution = least_norm(S, right);
    if (solution.rank < n + rank)
        throw IntegrationError(say("loads along the coordinates whose accelerations are given do not determine "
                                   "the motion at this pose; "
                                   "give the accelerations of others, or of all"),
                               t, q);
    const Eigen::VectorXd x = solution.x;
    Loads result{x.head(n), Eigen::VectorXd::Zero(n), x.tail(m)};
    for (Eigen::Index j = 0; j < n; ++j)
        if (const auto& a = given[static_cast<std::size_t>(j)]) result.load[j] = x[j], result.acceleration[j] = *a;
    return result;
}

/// The case in which all accelerations are known: the loads of least norm that produce them together with the
/// constraint forces.
Loads all_given(const Affine& s, Eigen::Index rank, const Eigen::VectorXd& a,
                const std::vector<std::string>& constraints) {
    for (Eigen::Index k = 0; k < s.A.rows(); ++k) {
        const double size = std::abs(s.gamma[k]) + s.A.row(k).cwiseAbs().dot(a.cwiseAbs()),
                     off = s.A.row(k).dot(a) - s.gamma[k];
        if (std::abs(off) > tolerance::balanced_load * std::max(1.0, size))
            throw ModelError(
                say("the accelerations given break constraint '{}', by {:.3g}; give those of as many "
                    "coordinates as there are degrees of freedom, {}, and the others follow",
                    constraints[static_cast<std::size_t>(k)], off, s.M.rows() - rank));
    }
    const Eigen::VectorXd whole = s.M * a + s.minus_f;
    const Eigen::VectorXd lambda =
        s.A.rows() > 0 ? Eigen::VectorXd(least_norm(s.A.transpose(), whole).x) : Eigen::VectorXd();
    return {a, s.A.rows() > 0 ? Eigen::VectorXd(whole - s.A.transpose() * lambda) : whole, lambda};
}

/// `constraints` are those of the rows of A, of which `rank` do not follow from others.
Loads loads_for(const Affine& s, std::size_t rank, const std::vector<std::optional<double>>& given,
                const std::vector<std::string>& constraints, const Start& start) {
    const auto n = given.size(), count = static_cast<std::size_t>(std::count_if(
                                     given.begin(), given.end(), [](const auto&a) { return a.has_value(); }));
    const std::size_t freedom = n - rank;
    if (!constraints.empty() && count > 0 && count <= freedom && count < n)
        return partly_given(s, static_cast<Eigen::Index>(rank), given, start.t, start.q);
    if (!constraints.empty() && count > 0 && count < n)
        throw ModelError(
            say("the accelerations of {} coordinates are given; expected those of {} or fewer, the "
                "degrees of freedom, or of all {}",
                count, freedom, n));
    Eigen::VectorXd a = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n));
    if (count == 0 && !constraints.empty())
        a = least_norm(s.A, s.gamma).x;  // the accelerations of least norm that the constraints allow
    for (std::size_t j = 0; j < n; ++j)
        if (given[j]) a[static_cast<Eigen::Index>(j)] = *given[j];
    return all_given(s, static_cast<Eigen::Index>(rank), a, constraints);
}

std::vector<std::string> names_of_constraints(const Mechanism& m) {
    std::vector<std::string> names;
    for (const Mechanism::Constraint& c : m.constraints) names.push_back(c.name);
    return names;
}

bool is_any_given(const std::vector<std::optional<double>>& given) {
    return std::any_of(given.begin(), given.end(), [](const auto& a) { return a.has_value(); });
}

/// The rates of speeds and the loads along them, then both along coordinates: q'' = H u' + h, Q = Hᵀ τ, τ = Wᵀ Q.
Loads loads_in_speeds(const Affine& s, const SpeedsAt& speeds, const std::vector<std::optional<double>>& given,
                      const Mechanism& m, const Start& start) {
    const auto kept = static_cast<Eigen::Index>(speeds.kept.size());
    Affine own{.M = speeds.H.transpose() * s.M * speeds.H,
               .A = Eigen::MatrixXd(kept, speeds.H.cols()),
               .minus_f = speeds.H.transpose() * (s.M * speeds.h + s.minus_f),
               .gamma = Eigen::VectorXd(kept)};
    std::vector<std::string> names;
    for (Eigen::Index k = 0; k < kept; ++k) {
        const Eigen::Index constraint = speeds.kept[static_cast<std::size_t>(k)];
        own.A.row(k) = s.A.row(constraint) * speeds.H;
        own.gamma[k] = s.gamma[constraint] - s.A.row(constraint).dot(speeds.h);
        names.push_back(m.constraints[static_cast<std::size_t>(constraint)].name);
    }
    const Loads along = loads_for(own, names.size(), given, names, start);
    Loads result{speeds.H * along.acceleration + speeds.h, speeds.W.transpose() * along.load, {}};
    if (s.A.rows() > 0)
        result.multiplier = least_norm(s.A.transpose(), s.M * result.acceleration + s.minus_f - result.load).x;
    return result;
}

/// With the constraints that are tied to those that are kept (Mechanism::Constraint::tie), each of which is needed
/// at some pose. Speeds eliminate those that are kept.
Mechanism with_tied_ones(Mechanism m) {
    for (const Mechanism::Constraint& c : m.redundant)
        if (c.tie && m.speeds.empty()) m.constraints.push_back(c);
    return m;
}

/// The multipliers of least norm that give these forces, those of redundant constraints too.
Eigen::VectorXd least_multipliers(const Mechanism& m, const State<double>& state, const Eigen::VectorXd& force) {
    Mechanism all = m;
    all.speeds.clear();
    all.constraints.insert(all.constraints.end(), m.redundant.begin(), m.redundant.end());
    const Program program = lower_constraints(all);
    const std::vector<double> value = interpret(program, state);
    const std::vector<int> rows = program.nodes_of(Group::row);
    const Eigen::Index n = force.size();
    Eigen::MatrixXd across(n, static_cast<Eigen::Index>(all.constraints.size()));
    for (Eigen::Index k = 0; k < across.cols(); ++k)
        for (Eigen::Index i = 0; i < n; ++i)
            across(i, k) = value[static_cast<std::size_t>(rows[static_cast<std::size_t>(k * n + i)])];
    return Orthogonal(across, tolerance::dependent_row).solve(force);
}

void add_multipliers(InverseLoads& result, const Eigen::VectorXd& multipliers) {
    Eigen::Index next = 0;
    for (const auto* list : {&result.mechanism.constraints, &result.mechanism.redundant})
        for (const Mechanism::Constraint& c : *list)
            if (next < multipliers.size())
                result.multipliers.emplace_back(c.multiplier.get_name(), multipliers[next++]);
}

/// The loads at a state where friction, contacts or both may be at rest, with a warning for what they bear.
Loads with_friction(InverseLoads& result, Affine s, const State<double>& state,
                    const std::function<Loads(const Affine&)>& solved) {
    const Mechanism& m = result.mechanism;
    const FrictionAtState friction(m, state);
    const Eigen::VectorXd without = s.minus_f;
    Loads loads = solved(s);
    FrictionAtState::Against against = friction.against(loads.acceleration);
    constexpr int most_rounds = 20;
    for (int round = 0;; ++round) {
        s.minus_f = without + against.load;
        loads = solved(s);
        FrictionAtState::Against next = friction.against(loads.acceleration);
        const bool is_same =
            next.directions == against.directions && (next.load - against.load).norm() <= 1e-12 * next.load.norm();
        against = std::move(next);
        if (is_same) break;
        if (round == most_rounds)
            throw IntegrationError(say("which way friction acts is not determined at t = {:.6g}: give the "
                                       "accelerations of all coordinates",
                                       state.t),
                                   state.t, state.q);
    }
    for (const std::size_t k : against.stuck)
        result.warn(
            "left_out",
            say("warning: friction '{}' does not slide here: it bears any force up to {:.6g}, and the loads "
                "are those without it\n",
                friction.name(k), friction.bound(k)));
    for (const std::string& name : contacts_not_opened(m, state, loads.acceleration))
        result.warn("left_out", say("warning: contact '{}' is closed here, and what it bears is not determined by "
                                    "accelerations: the loads are those without it\n",
                                    name));
    return loads;
}

void add_speeds(InverseLoads& result, const SpeedsAt& speeds, const Loads& loads, const Mechanism& m) {
    for (const Mechanism::Speed& speed : m.speeds) result.speeds.push_back(speed.u.get_name());
    const Eigen::VectorXd rates = speeds.W * loads.acceleration + speeds.rest;
    result.speed_values.assign(speeds.value.begin(), speeds.value.end());
    result.speed_rates.assign(rates.begin(), rates.end());
    if (!speeds.determine()) return;
    const Eigen::VectorXd along = speeds.H.transpose() * loads.load;
    result.speed_loads.assign(along.begin(), along.end());
}

}  // namespace

InverseLoads inverse(Scene scene, const InverseOptions& options) {
    Overrides at = options.at;
    const std::vector<std::optional<double>> given_speeds = take_speed_rates(at, scene);
    const bool in_speeds = is_any_given(given_speeds);
    at = without_accelerations(std::move(at));
    InverseLoads result{derived(std::move(scene), {.by = options.by, .use = Use::asked, .at = at})};
    const Mechanism& m = result.mechanism;
    if (m.size() == 0)
        throw ModelError(say(
            "inverse dynamics asks for the loads along coordinates; this scene has states alone, whose rates it "
            "gives: `eval` evaluates them"));
    const std::vector<std::optional<double>> given = given_accelerations(options.at, m);
    Start start = start_of(m, at);
    assemble(start, m, lower_constraints(m), at);
    const Mechanism whole = with_tied_ones(m);
    const Affine s = affine(lower_inverse(without_plane_friction(whole)), start.state());
    std::optional<SpeedsAt> speeds;
    if (!m.speeds.empty()) speeds = speeds_at(m, start.state(), s.A, s.gamma);
    if (in_speeds && is_any_given(given))
        throw ModelError(
            say("accelerations of coordinates and rates of speeds are given; expected those of one kind"));
    if (in_speeds && !speeds->determine())
        throw IntegrationError(say("the speeds do not determine the rates at these coordinates; give the "
                                   "accelerations of coordinates"),
                               start.t, start.q);
    const Loads loads = with_friction(result, s, start.state(), [&](const Affine& at_friction) {
        return in_speeds ? loads_in_speeds(at_friction, *speeds, given_speeds, m, start)
                         : loads_for(at_friction, m.constraints.size(), given, names_of_constraints(whole), start);
    });
    if (!loads.load.allFinite() || !loads.acceleration.allFinite())
        throw IntegrationError(say("there are no finite loads at t = {:.6g}", start.t), start.t, start.q);
    result.time = start.t;
    for (const GiNaC::symbol& q : m.q) result.coordinates.push_back(q.get_name());
    result.q = start.q;
    result.rates = start.qdot;
    result.accelerations.assign(loads.acceleration.begin(), loads.acceleration.end());
    result.loads.assign(loads.load.begin(), loads.load.end());
    add_multipliers(result, m.redundant.empty()
                                ? loads.multiplier
                                : least_multipliers(m, start.state(), s.A.transpose() * loads.multiplier));
    result.given_in_speeds = in_speeds;
    if (speeds) add_speeds(result, *speeds, loads, m);
    return result;
}

}  // namespace alembert
