// SPDX-License-Identifier: GPL-2.0-or-later
// A step q + d with A d = 0 leaves the positions by O(|d|²), and the search of least change that follows comes
// back by as much. A change of another size is a jump to somewhere else, and the step is halved.
#include "analysis/state/branch.hpp"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>

#include "alembert/base/dense.hpp"
#include "alembert/base/random.hpp"
#include "analysis/state/assemble.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

constexpr int steps = 3, most_halvings = 8;
constexpr double step_length = 0.1;  // of 1 + |q|
constexpr double most_corrected = 0.2;
constexpr double most_turned =
    0.4;  // a sine; where two branches come near each other, a step may land on the other one
constexpr double search_reach = 0.3;  // of 1 + |q|

/// The rows of the holonomic constraints.
Eigen::MatrixXd rows_of_positions(const Mechanism& m, const Program& p, const Start& here) {
    const std::vector<double> value = interpret(p, here.state());
    const std::vector<int> rows = p.nodes_of(Group::row);
    const auto n = static_cast<Eigen::Index>(m.q.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(m.constraints.size()), n);
    Eigen::Index count = 0;
    for (std::size_t k = 0; k < m.constraints.size(); ++k) {
        if (!m.constraints[k].position) continue;
        for (Eigen::Index i = 0; i < n; ++i)
            A(count, i) = value[static_cast<std::size_t>(rows[k * m.q.size() + static_cast<std::size_t>(i)])];
        ++count;
    }
    return A.topRows(count);
}

class Walk {
public:
    Walk(const Mechanism& m, const Program& p, bool rates_must_obey, unsigned seed)
        : m_(m),
          p_(p),
          left_out_(m),
          rates_must_obey_(rates_must_obey),
          n_(static_cast<Eigen::Index>(m.q.size())),
          random_(seed) {
        m_.q_is_guess.assign(m.q.size(), true);
        m_.qdot_is_guess.assign(m.q.size(), true);
    }

    bool assembles(Start& start) const {
        try {
            assemble(start, m_, p_, {}, left_out_, rates_must_obey_);
            return true;
        } catch (const std::runtime_error&) {
            return false;
        }
    }

    /// The end of a walk from here; nothing if its first step is impossible.
    std::optional<Start> from(const Start& start, bool forwards) {
        Start here = start;
        for (int k = 0; k < steps; ++k) {
            const auto next = step(here, k == 0 ? along_rates(here, forwards) : by_chance(here));
            if (!next && k == 0) return {};
            if (next) here = *next;
        }
        return here;
    }

    /// Places along a walk that keeps its direction, as long as `may_go_on`.
    std::vector<Start> along(const Start& start, bool forwards,
                             const std::function<bool(const Start&)>& may_go_on) {
        constexpr int most_steps = 60, between = 6;
        const double length =
            step_length * (1 + Eigen::Map<const Eigen::VectorXd>(start.q.data(), n_).lpNorm<Eigen::Infinity>());
        std::vector<Start> result;
        Start here = start;
        Eigen::VectorXd change = along_rates(here, forwards);
        for (int k = 1; k <= most_steps; ++k) {
            const auto next = step(here, change);
            if (!next || !may_go_on(*next)) break;
            const Eigen::Map<const Eigen::VectorXd> from(here.q.data(), n_), to(next->q.data(), n_);
            change = to - from;
            change *= length / change.lpNorm<Eigen::Infinity>();
            here = *next;
            if (k % between == 0) result.push_back(here);
        }
        return result;
    }

    Start beside(Start start) {
        const UniformReal<> away(-search_reach, search_reach);
        for (double& q : start.q) q += away(random_) * (1 + std::abs(q));
        return start;
    }

private:
    Eigen::VectorXd by_chance(const Start& here) {
        const UniformReal<> away(-step_length, step_length);
        Eigen::VectorXd result(n_);
        for (Eigen::Index i = 0; i < n_; ++i)
            result[i] = away(random_) * (1 + std::abs(here.q[static_cast<std::size_t>(i)]));
        return result;
    }

    Eigen::VectorXd along_rates(const Start& here, bool forwards) {
        double fastest = 0;
        for (std::size_t i = 0; i < here.q.size(); ++i)
            fastest = std::max(fastest, std::abs(here.qdot[i]) / (1 + std::abs(here.q[i])));
        if (!(fastest > 0) || !std::isfinite(fastest)) return by_chance(here);
        const Eigen::Map<const Eigen::VectorXd> rates(here.qdot.data(), n_);
        return (forwards ? 1 : -1) * step_length / fastest * rates;
    }

    std::optional<Start> step(const Start& here, Eigen::VectorXd change) const {
        const Eigen::MatrixXd A = rows_of_positions(m_, p_, here);
        if (A.rows() > 0) change -= least_norm(A, A * change).x;
        if (!change.allFinite()) return {};
        const Eigen::Map<const Eigen::VectorXd> q(here.q.data(), n_);
        const double nothing = 1e-6 * step_length * (1 + q.lpNorm<Eigen::Infinity>());
        for (int k = 0; k < most_halvings; ++k, change /= 2) {
            const double length = change.lpNorm<Eigen::Infinity>();
            if (!(length > nothing)) return {};
            Start there = here;
            for (Eigen::Index i = 0; i < n_; ++i) there.q[static_cast<std::size_t>(i)] += change[i];
            if (!assembles(there)) continue;
            const Eigen::Map<const Eigen::VectorXd> reached(there.q.data(), n_);
            if ((reached - q - change).lpNorm<Eigen::Infinity>() > most_corrected * length) continue;
            if (turned(A, rows_of_positions(m_, p_, there)) <= most_turned) return there;
        }
        return {};
    }

    /// By how much the normals of the one rows lie outside those of the other: on one branch they turn little at
    /// one step. Nothing is said of rows that have lost rank, as where branches meet.
    static double turned(const Eigen::MatrixXd& from, const Eigen::MatrixXd& to) {
        if (from.rows() == 0) return 0;
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> a(from.transpose()), b(to.transpose());
        if (a.rank() != b.rank()) return 0;
        const auto normals = [&](const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr) -> Eigen::MatrixXd {
            return qr.householderQ() * Eigen::MatrixXd::Identity(from.cols(), qr.rank());
        };
        const Eigen::MatrixXd here = normals(a), there = normals(b);
        return (there - here * (here.transpose() * there)).norm();
    }

    Mechanism m_;
    const Program& p_;
    LeftOut left_out_;
    bool rates_must_obey_;
    Eigen::Index n_;
    std::mt19937_64 random_;
};

}  // namespace

std::vector<Start> places_on_branch(const Mechanism& mechanism, const Program& program, const Start& start,
                                    int wanted, unsigned seed, bool rates_must_obey) {
    Walk walk(mechanism, program, rates_must_obey, seed);
    std::vector<Start> result;
    if (Start first = start; walk.assembles(first))
        for (int k = 0; k < wanted; ++k)
            if (auto place = walk.from(first, k % 2 == 0)) result.push_back(*std::move(place));
    if (!result.empty()) return result;
    for (int k = 0; k < wanted; ++k)
        if (Start place = walk.beside(start); walk.assembles(place)) result.push_back(std::move(place));
    return result;
}

std::optional<OwnBranch> own_branch(const Mechanism& mechanism) try {
    constexpr int wanted = 4;
    const auto positions = std::count_if(mechanism.constraints.begin(), mechanism.constraints.end(),
                                         [](const Mechanism::Constraint& c) { return c.position.has_value(); });
    if (positions == 0) return std::nullopt;
    const Program program = lower_constraints(mechanism);
    Start start = start_of(mechanism);
    assemble(start, mechanism, program, {});
    const bool rests = std::all_of(start.qdot.begin(), start.qdot.end(), [](double rate) { return rate == 0; });
    const auto rank = [&](const Start& at) {
        Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(rows_of_positions(mechanism, program, at));
        factors.setThreshold(1e-7);
        return factors.rank();
    };
    if (rests && rank(start) < positions) return std::nullopt;
    // Where branches meet the rows depend on each other; near such a pose a small change may lead to the other
    // branch.
    constexpr double near_a_meeting = 0.2;            // of the largest among the places
    const auto independence = [&](const Start& at) {  // the last pivot
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(rows_of_positions(mechanism, program, at));
        return std::abs(factors.matrixR()(positions - 1, positions - 1));
    };
    OwnBranch branch;
    std::vector<std::pair<double, Start>> places;
    double largest = 0;
    for (Start& place : places_on_branch(mechanism, program, start, wanted, 1))
        if (rank(place) == positions) {
            places.emplace_back(independence(place), std::move(place));
            largest = std::max(largest, places.back().first);
        }
    for (const auto& [size, place] : places)
        if (size >= near_a_meeting * largest) branch.places.push_back(place.state());
    if (branch.places.empty()) return std::nullopt;
    constexpr int most_coordinates = 8;
    constexpr double largest_value = 10;  // of an angle far from zero the steps would be whole turns
    const auto is_alone = [&](const Start& at) { return independence(at) >= near_a_meeting * largest; };
    const bool is_near_zero =
        std::all_of(start.q.begin(), start.q.end(), [](double q) { return std::abs(q) <= largest_value; });
    if (mechanism.size() <= most_coordinates && is_near_zero && is_alone(start)) {
        Walk walk(mechanism, program, true, 1);
        for (const bool forwards : {true, false})
            for (const Start& place : walk.along(start, forwards, is_alone))
                branch.farther.push_back(place.state());
    }
    return branch;
} catch (const std::runtime_error&) {
    return std::nullopt;
}

}  // namespace alembert
