// SPDX-License-Identifier: GPL-2.0-or-later
// −μ N e along v, with e the direction of v; where v = 0, that of v' = J q'' + (v' at q'' = 0).
#include "simulate/inverse_friction.hpp"

#include <algorithm>
#include <cmath>

#include "alembert/base/error.hpp"
#include "alembert/base/tolerances.hpp"
#include "base/language/say.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

constexpr double rounded_off = 1e-12;  // of the sum of the sizes of its terms

std::vector<double> values_of(const Mechanism& m, const std::vector<ex>& wanted, const State<double>& state) {
    Program program = begun(m);
    std::vector<double> result;
    const std::vector<int> nodes = lower_expressions(program, m, wanted);
    const std::vector<double> value = interpret(program, state);
    for (const int node : nodes) result.push_back(value[static_cast<std::size_t>(node)]);
    return result;
}

}  // namespace

FrictionAtState::FrictionAtState(const Mechanism& m, const State<double>& at) {
    State<double> state = at;
    state.qddot.assign(state.q.size(), 0);
    const auto n = static_cast<Eigen::Index>(state.q.size());
    const Eigen::Map<const Eigen::VectorXd> u(state.qdot.data(), n);
    for (const Mechanism::Friction& f : m.frictions) {
        std::vector<ex> sliding_velocities{f.sliding_velocity};
        if (f.across) sliding_velocities.push_back(*f.across);
        const auto rows = static_cast<Eigen::Index>(sliding_velocities.size());
        std::vector<ex> wanted{f.coefficient * f.normal, f.resting * f.normal};
        for (const ex& sliding_velocity : sliding_velocities) {
            wanted.push_back(sliding_velocity);
            wanted.push_back(m.time_derivative({sliding_velocity})[0]);
            for (const ex& entry : m.z->pull_back({{sliding_velocity, 1}}, m.qdot)) wanted.push_back(entry);
        }
        for (ex& one : wanted) one = m.z->name(one);
        const std::vector<double> value = values_of(m, wanted, state);
        One one{.name = f.name,
                .is_plane = f.across.has_value(),
                .force = value[0],
                .bound = value[1],
                .v = Eigen::VectorXd(rows),
                .rest = Eigen::VectorXd(rows),
                .J = Eigen::MatrixXd(rows, n)};
        for (Eigen::Index r = 0; r < rows; ++r) {
            const double* const row = &value[static_cast<std::size_t>(2 + r * (n + 2))];
            one.v[r] = row[0];
            one.rest[r] = row[1];
            for (Eigen::Index i = 0; i < n; ++i) one.J(r, i) = row[2 + i];
            const double size =
                std::abs(one.v[r] - one.J.row(r).dot(u)) + one.J.row(r).cwiseAbs().dot(u.cwiseAbs());
            one.slides = one.slides || std::abs(one.v[r]) > rounded_off * size;
        }
        list_.push_back(std::move(one));
    }
}

FrictionAtState::Against FrictionAtState::against(const Eigen::VectorXd& a) const {
    Against result{.load = Eigen::VectorXd::Zero(a.size()), .directions = {}, .stuck = {}};
    for (std::size_t k = 0; k < list_.size(); ++k) {
        const One& one = list_[k];
        if (one.slides && !one.is_plane) continue;
        Eigen::VectorXd way = one.v;
        if (!one.slides) {
            way = one.J * a + one.rest;
            const Eigen::VectorXd size = one.J.cwiseAbs() * a.cwiseAbs() + one.rest.cwiseAbs();
            for (Eigen::Index r = 0; r < way.size(); ++r)
                if (std::abs(way[r]) <= rounded_off * size[r]) way[r] = 0;
        }
        for (const double x : way) result.directions.push_back((x > 0) - (x < 0));
        if (way.isZero(0)) {
            result.stuck.push_back(k);
            continue;
        }
        // The sign of a velocity that is rounding counts already.
        const double counted = one.is_plane ? 0 : (one.v[0] > 0) - (one.v[0] < 0);
        const Eigen::VectorXd e = way.normalized() - Eigen::VectorXd::Constant(way.size(), counted);
        result.load += one.force * one.J.transpose() * e;
    }
    return result;
}

std::vector<std::string> contacts_not_opened(const Mechanism& m, State<double> state, const Eigen::VectorXd& a) {
    state.qddot.assign(a.begin(), a.end());
    std::vector<std::string> names;
    for (const Mechanism::Unilateral& contact : m.unilateral) {
        if (!contact.gap.position) continue;
        const ex gap = *contact.gap.position, rate = m.time_derivative({gap})[0];
        std::vector<ex> wanted{m.z->name(gap), m.z->name(rate), m.z->name(m.time_derivative({rate})[0])};
        wanted.insert(wanted.end(), contact.gap.row.begin(), contact.gap.row.end());
        const std::vector<double> value = values_of(m, wanted, state);
        double place = std::abs(value[0]), speed = std::abs(value[1]), push = std::abs(value[2]);
        for (std::size_t i = 0; i < state.q.size(); ++i) {
            place += std::abs(value[3 + i] * state.q[i]);
            speed += std::abs(value[3 + i] * state.qdot[i]);
            push += std::abs(value[3 + i] * state.qddot[i]);
        }
        const bool rests = std::abs(value[1]) <= rounded_off * speed;
        const bool opens = rests ? value[2] > rounded_off * push : value[1] > 0;
        if (value[0] > tolerance::closed_gap * place || opens) continue;
        if (rests && value[2] < -rounded_off * push)
            throw ModelError(
                say("these accelerations go into contact '{}', which is closed: its gap would have the second "
                    "derivative {:.6g}, and none below 0 is possible",
                    contact.gap.name, value[2]));
        names.push_back(contact.gap.name);
    }
    return names;
}

}  // namespace alembert
