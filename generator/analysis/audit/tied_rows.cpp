// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/audit/tied_rows.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

#include "alembert/base/dense.hpp"
#include "analysis/audit/singular_poses.hpp"
#include "analysis/state/contradiction.hpp"
#include "analysis/state/redundancy.hpp"
#include "model/sample_functions.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

constexpr std::size_t most_rows = 8, most_poses = 64;
constexpr int places_looked_at = 8;
constexpr double dependent = 1e-7;  // of the usual size of a row; poses are found to 1e-9

/// Rows that depend on each other, those that are left out last.
struct Dependent {
    std::vector<int> rows;  ///< positions among all constraints
    Eigen::Index rank;      ///< the number of those that are kept
};

class Rows {
public:
    Rows(const Mechanism& all, const std::vector<State<double>>& places)
        : program_(lower_constraints(all)),
          nodes_(program_.nodes_of(Group::row)),
          n_(all.size()),
          usual_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(all.constraints.size()))) {
        for (const State<double>& place : places)
            if (const Eigen::MatrixXd A = at(place); A.allFinite()) usual_ = usual_.cwiseMax(A.rowwise().norm());
    }

    /// The rank of the first `count` of these rows.
    Eigen::Index rank(const State<double>& state, const std::vector<int>& rows, Eigen::Index count) const {
        const Eigen::MatrixXd A = at(state);
        Eigen::MatrixXd own(count, n_);
        for (Eigen::Index k = 0; k < count; ++k) {
            const int row = rows[static_cast<std::size_t>(k)];
            own.row(k) = A.row(row) / (usual_[row] > 0 ? usual_[row] : 1);
        }
        return own.allFinite() ? (singular_values(own).values.array() > dependent).count() : 0;
    }

private:
    Eigen::MatrixXd at(const State<double>& state) const {
        const std::vector<double> value = interpret(program_, state);
        Eigen::MatrixXd A(usual_.size(), n_);
        for (Eigen::Index k = 0; k < A.rows(); ++k)
            for (Eigen::Index i = 0; i < n_; ++i)
                A(k, i) = value[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(k * n_ + i)])];
        return A;
    }

    Program program_;
    std::vector<int> nodes_;
    Eigen::Index n_;
    Eigen::VectorXd usual_;
};

/// The groups of rows that depend on each other with factors that change with the pose. `all` has the rows that
/// are left out last, at the positions `extra`.
std::vector<Dependent> dependent_rows(const Mechanism& all, const std::vector<int>& extra,
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
    std::vector<Dependent> result;
    for (int g = 0; g < static_cast<int>(group.size()); ++g) {
        Dependent one{.rows = {}, .rank = 0};
        bool any = false;
        for (int k = 0; k < static_cast<int>(group.size()); ++k) {
            if (group[static_cast<std::size_t>(k)] != g) continue;
            one.rows.push_back(k);
            one.rank += k < extra.front();
            any = any || changes[static_cast<std::size_t>(k)];
        }
        if (any && one.rows.size() <= most_rows) result.push_back(std::move(one));
    }
    return result;
}

}  // namespace

Mechanism with_tied_rows(Mechanism m) {
    if (m.redundant.empty()) return m;
    const Mechanism kept = with_sample_functions(m);
    Mechanism all = kept;
    std::vector<int> extra;
    for (const Mechanism::Constraint& c : kept.redundant) {
        extra.push_back(static_cast<int>(all.constraints.size()));
        all.constraints.push_back(c);
    }
    all.redundant.clear();
    const std::vector<State<double>> places = states_that_obey(kept, start_of(kept), places_looked_at);
    if (places.empty()) return m;
    const std::vector<Dependent> groups = dependent_rows(all, extra, places);
    if (groups.empty()) return m;
    const Rows rows(all, places);
    int ties = 0;
    const std::vector<SingularPose> poses = singular_poses(kept, places.front(), places, most_poses);
    for (const Dependent& group : groups) {
        const bool loses = std::any_of(poses.begin(), poses.end(), [&](const SingularPose& pose) {
            State<double> state = places.front();
            state.q = pose.q;
            const Eigen::Index together =
                rows.rank(state, group.rows, static_cast<Eigen::Index>(group.rows.size()));
            return rows.rank(state, group.rows, group.rank) < together && together <= group.rank;
        });
        if (!loses) continue;
        for (const int k : group.rows)
            (k < extra.front() ? m.constraints[static_cast<std::size_t>(k)]
                               : m.redundant[static_cast<std::size_t>(k - extra.front())])
                .tie = ties;
        ++ties;
    }
    return m;
}

}  // namespace alembert
