// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/audit/tied_rows.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "alembert/base/dense.hpp"
#include "analysis/audit/singular_poses.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/contradiction.hpp"
#include "analysis/state/redundancy.hpp"
#include "model/sample_functions.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_poses = 64;
constexpr double most_work = 20000;  // products in the powers of a matrix of the rows (program/tie.hpp)
constexpr int places_looked_at = 8;
// Of the usual size of a row. Poses are found to 1e-9; of one near a pose where all rows lose rank, nothing is
// said.
constexpr double dependent = 1e-7, held = 1e-3;

/// Rows that depend on each other, those that are left out last.
struct DependentGroup {
    std::vector<int> rows;  ///< positions among all constraints
    Eigen::Index rank;      ///< the number of those that are kept
};

/// A in the rates; the program is lower_constraints of a mechanism of n coordinates.
Eigen::MatrixXd rows_at(const Program& program, const State<double>& state, Eigen::Index n) {
    const std::vector<double> value = interpret(program, state);
    const std::vector<int> nodes = program.nodes_of(Group::row);
    Eigen::MatrixXd A(static_cast<Eigen::Index>(nodes.size()) / n, n);
    for (Eigen::Index k = 0; k < A.rows(); ++k)
        for (Eigen::Index i = 0; i < n; ++i)
            A(k, i) = value[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k * n + i)])];
    return A;
}

class RanksAtPoses {
public:
    RanksAtPoses(const Mechanism& all, const std::vector<State<double>>& places)
        : program_(lower_constraints(all)),
          n_(all.size()),
          usual_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(all.constraints.size()))) {
        for (const State<double>& place : places)
            if (const Eigen::MatrixXd A = rows_at(program_, place, n_); A.allFinite())
                usual_ = usual_.cwiseMax(A.rowwise().norm());
    }

    /// The rank of the first `count` of these rows; of singular values below `least` nothing is seen.
    Eigen::Index rank(const State<double>& state, const std::vector<int>& rows, Eigen::Index count,
                      double least = dependent) const {
        const Eigen::MatrixXd A = rows_at(program_, state, n_);
        Eigen::MatrixXd own(count, n_);
        for (Eigen::Index k = 0; k < count; ++k) {
            const int row = rows[static_cast<std::size_t>(k)];
            own.row(k) = A.row(row) / (usual_[row] > 0 ? usual_[row] : 1);
        }
        return own.allFinite() ? (singular_values(own).values.array() > least).count() : 0;
    }

private:
    Program program_;
    Eigen::Index n_;
    Eigen::VectorXd usual_;
};

/// The groups of rows that depend on each other with factors that change with the pose. `all` has the rows that
/// are left out last, at the positions `extra`.
std::vector<DependentGroup> dependent_rows(const Mechanism& all, const std::vector<int>& extra,
                                           const std::vector<State<double>>& places) {
    std::vector<int> group(all.constraints.size());
    std::iota(group.begin(), group.end(), 0);
    std::vector<bool> changes(group.size(), false);
    const auto join = [&](int a, int b) {
        const int kept = group[static_cast<std::size_t>(a)], gone = group[static_cast<std::size_t>(b)];
        for (int& one : group)
            if (one == gone) one = kept;
    };
    for (const int k : extra) {
        for (const int other : follows_from(all, k, extra, places)) join(k, other);
        changes[static_cast<std::size_t>(k)] = factors_change(all, k, extra, places);
    }
    std::vector<DependentGroup> result;
    for (int g = 0; g < static_cast<int>(group.size()); ++g) {
        DependentGroup one{.rows = {}, .rank = 0};
        bool any = false;
        for (int k = 0; k < static_cast<int>(group.size()); ++k) {
            if (group[static_cast<std::size_t>(k)] != g) continue;
            one.rows.push_back(k);
            one.rank += k < extra.front();
            any = any || changes[static_cast<std::size_t>(k)];
        }
        const double size = static_cast<double>(one.rows.size());
        if (any && static_cast<double>(one.rank) * size * size * size <= most_work)
            result.push_back(std::move(one));
    }
    return result;
}

/// Whether a walk of short steps from the initial state towards a pose gets there on the positions of the
/// constraints. Poses of other branches are no poses of the scene.
class WalkOnPositions {
public:
    explicit WalkOnPositions(Mechanism m) : m_(std::move(m)), from_(start_of(m_)) {
        std::erase_if(m_.constraints, [](const Mechanism::Constraint& c) { return !c.position; });
        m_.redundant.clear();
        m_.speeds.clear();
        m_.q_is_guess.assign(m_.q.size(), true);
        m_.qdot_is_guess.assign(m_.q.size(), true);
        program_ = lower_constraints(m_);
        from_.speeds.clear();
        step_onto(from_);
    }

    /// Branches meet where all rows together lose rank: nothing is said of what lies behind such poses.
    bool reaches(const std::vector<double>& pose, const RanksAtPoses& ranks, const DependentGroup& group) {
        constexpr int most_steps = 300;
        constexpr double longest = 0.1, near = 1e-2, aside = 1e-2, clear = 0.05;
        if (m_.constraints.empty()) return true;
        Start here = from_;
        const Eigen::Map<const Eigen::VectorXd> goal(pose.data(), m_.size());
        for (int k = 0; k < most_steps; ++k) {
            Eigen::Map<Eigen::VectorXd> q(here.q.data(), m_.size());
            const Eigen::VectorXd gap = goal - q;
            if (gap.norm() < near) return true;
            const Eigen::MatrixXd A = rows_at(program_, here.state(), m_.size());
            const Eigen::VectorXd along = gap - least_norm(A, A * gap).x;
            if (!(along.norm() > aside * gap.norm())) return false;
            q += std::min(1.0, longest / along.norm()) * along;
            if (!step_onto(here)) return false;
            if (ranks.rank(here.state(), group.rows, static_cast<Eigen::Index>(group.rows.size()), clear) <
                group.rank)
                return false;
        }
        return false;
    }

private:
    bool step_onto(Start& start) const {
        try {
            assemble(start, m_, program_, {}, false);
            return true;
        } catch (const std::runtime_error&) {
            return false;
        }
    }

    Mechanism m_;
    Start from_;
    Program program_;
};

}  // namespace

Mechanism with_tied_rows(Mechanism m) {
    if (m.redundant.empty()) return m;
    const Mechanism kept = with_sample_functions(m);
    Mechanism all = kept;
    std::vector<int> extra;
    std::vector<std::size_t> from;  // the position in `redundant` of each of these
    for (std::size_t k = 0; k < kept.redundant.size(); ++k) {
        if (kept.redundant[k].nearly) continue;
        extra.push_back(static_cast<int>(all.constraints.size()));
        from.push_back(k);
        all.constraints.push_back(kept.redundant[k]);
    }
    if (extra.empty()) return m;
    all.redundant.clear();
    const std::vector<State<double>> places = states_that_obey(kept, start_of(kept), places_looked_at);
    if (places.empty()) return m;
    const std::vector<DependentGroup> groups = dependent_rows(all, extra, places);
    if (groups.empty()) return m;
    const RanksAtPoses ranks(all, places);
    WalkOnPositions walk(kept);
    int ties = 0;
    const std::vector<SingularPose> poses = singular_poses(kept, places.front(), places, most_poses);
    for (const DependentGroup& group : groups) {
        const bool loses = std::any_of(poses.begin(), poses.end(), [&](const SingularPose& pose) {
            State<double> state = places.front();
            state.q = pose.q;
            const Eigen::Index together =
                ranks.rank(state, group.rows, static_cast<Eigen::Index>(group.rows.size()), held);
            return ranks.rank(state, group.rows, group.rank) < group.rank && together == group.rank &&
                   walk.reaches(pose.q, ranks, group);
        });
        if (!loses) continue;
        for (const int k : group.rows)
            (k < extra.front() ? m.constraints[static_cast<std::size_t>(k)]
                               : m.redundant[from[static_cast<std::size_t>(k - extra.front())]])
                .tie = ties;
        ++ties;
    }
    return m;
}

}  // namespace alembert
