// SPDX-License-Identifier: GPL-2.0-or-later
// f(q) = 0 is solved by q ← q − J⁺ f, where J⁺ has no singular values below the tolerance: least squares in the
// directions that the rows determine (Golub & Van Loan, §5.5.5).
#include "analysis/state/nearly_redundant.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "alembert/base/tolerances.hpp"
#include "analysis/state/assemble.hpp"
#include "analysis/state/branch.hpp"
#include "analysis/state/redundancy.hpp"
#include "base/language/say.hpp"
#include "model/sample_functions.hpp"
#include "program/lower/lower.hpp"
#include "program/rounding.hpp"

namespace alembert {

namespace {

/// The rows at a state, divided by their scales.
struct ScaledRows {
    Eigen::MatrixXd A;
    Eigen::VectorXd position;  ///< f(q, t), 0 of rows that have none
};

class NearRows {
public:
    explicit NearRows(const Mechanism& m)
        : m_(m), program_(lower_constraints(m)), rows_(program_.nodes_of(Group::row)), start_(start_of(m)) {
        set_scales();
    }

    std::vector<std::pair<int, double>> found() {
        if (!settle()) return {};
        std::vector<int> candidates = dependent(start_.state(), candidates_of_joints());
        while (!candidates.empty()) {
            Mechanism kept = without_constraints(m_, candidates);
            kept.speeds.clear();
            const Program program = lower_constraints(kept);
            Start here = start_;
            here.speeds.clear();
            std::vector<State<double>> places;
            try {
                assemble(here, kept, program, {}, LeftOut(with_none_left_out(kept)), false);
                for (const Start& place :
                     places_on_branch(with_none_left_out(kept), program, here, places_looked_at, 1, false))
                    places.push_back(place.state());
            } catch (const std::runtime_error&) {
                return {};
            }
            places.push_back(here.state());
            std::vector<int> everywhere = candidates;
            for (const State<double>& place : places) everywhere = dependent(place, everywhere);
            if (everywhere == candidates) return with_sizes(candidates, places);
            candidates = std::move(everywhere);
        }
        return {};
    }

private:
    static constexpr int places_looked_at = 6;
    static constexpr double near = tolerance::nearly_dependent_row;

    static Mechanism with_none_left_out(Mechanism m) {
        m.redundant.clear();
        return m;
    }

    ScaledRows at(const State<double>& state) const {
        const std::vector<double> value = interpret(program_, state);
        const std::vector<int> positions = program_.nodes_of(Group::position);
        const auto m = static_cast<Eigen::Index>(positions.size()), n = static_cast<Eigen::Index>(m_.q.size());
        ScaledRows rows{.A = Eigen::MatrixXd(m, n), .position = Eigen::VectorXd(m)};
        for (Eigen::Index k = 0; k < m; ++k) {
            for (Eigen::Index i = 0; i < n; ++i) rows.A(k, i) = value[rows_[k * n + i]] / scale(k);
            rows.position[k] = value[positions[k]] / scale(k);
        }
        return rows;
    }

    double scale(Eigen::Index k) const { return scales_.empty() ? 1 : scales_[static_cast<std::size_t>(k)]; }

    void set_scales() {
        const ScaledRows rows = at(start_.state());
        const std::vector<double> sizes = sizes_of_terms(program_, start_.state());
        const std::vector<int> positions = program_.nodes_of(Group::position);
        const auto row = [&](int k) { return rows.A.row(k).norm(); };
        const auto terms = [&](int k) {
            return sizes[static_cast<std::size_t>(positions[static_cast<std::size_t>(k)])];
        };
        std::vector<double> scales;
        for (int k = 0; k < static_cast<int>(positions.size()); ++k)
            scales.push_back(scale_of_row(m_.constraints, k, row, terms));
        scales_ = std::move(scales);
    }

    /// Moves the guesses until the rows hold that are no rests.
    bool settle() {
        constexpr int most_rounds = 100;
        constexpr double small_step = 1e-12, longest_step = 1;
        std::vector<int> free;
        for (int i = 0; i < m_.size(); ++i)
            if (m_.q_is_guess[i]) free.push_back(i);
        for (int round = 0; round < most_rounds && !free.empty(); ++round) {
            const ScaledRows rows = at(start_.state());
            if (!rows.A.allFinite() || !rows.position.allFinite()) return false;
            Eigen::MatrixXd J(rows.A.rows(), static_cast<Eigen::Index>(free.size()));
            for (Eigen::Index j = 0; j < J.cols(); ++j) J.col(j) = rows.A.col(free[static_cast<std::size_t>(j)]);
            for (Eigen::Index k = 0; k < J.rows(); ++k)
                if (!m_.constraints[static_cast<std::size_t>(k)].position) J.row(k).setZero();
            Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
            svd.setThreshold(near);
            Eigen::VectorXd step = svd.solve(rows.position);
            const double length = step.lpNorm<Eigen::Infinity>();
            if (!std::isfinite(length)) return false;
            if (length > longest_step) step *= longest_step / length;
            for (Eigen::Index j = 0; j < J.cols(); ++j) start_.q[static_cast<std::size_t>(free[j])] -= step[j];
            if (length < small_step) break;
        }
        const ScaledRows rows = at(start_.state());
        return rows.A.allFinite() && rows.position.lpNorm<Eigen::Infinity>() < near;
    }

    std::vector<int> candidates_of_joints() const {
        std::vector<int> result;
        for (std::size_t k = 0; k < m_.constraints.size(); ++k)
            if (m_.constraints[k].joint) result.push_back(static_cast<int>(k));
        return result;
    }

    /// What the rows that are kept before each leave of it; those that are no candidates come first.
    std::vector<double> rests(const Eigen::MatrixXd& A, const std::vector<int>& candidates) const {
        std::vector<int> order;
        for (int k = 0; k < static_cast<int>(A.rows()); ++k)
            if (std::find(candidates.begin(), candidates.end(), k) == candidates.end()) order.push_back(k);
        order.insert(order.end(), candidates.begin(), candidates.end());
        return rests_of_rows(A, order, [](int, double rest) { return rest > near; });
    }

    /// Those of the candidates that are rests at this state. A row that follows but for rounding, and holds, is
    /// none.
    std::vector<int> dependent(const State<double>& state, const std::vector<int>& candidates) const {
        const ScaledRows rows = at(state);
        if (!rows.A.allFinite()) return candidates;
        const std::vector<double> rest = rests(rows.A, candidates);
        std::vector<int> result;
        for (const int k : candidates) {
            const double residual = std::abs(rows.position[k]), size = rows.A.row(k).norm();
            const bool follows = size > near &&
                                 rest[static_cast<std::size_t>(k)] <= tolerance::dependent_row * size &&
                                 residual <= tolerance::initial_values;
            if (rest[static_cast<std::size_t>(k)] <= near && residual <= near && !follows) result.push_back(k);
        }
        return result;
    }

    std::vector<std::pair<int, double>> with_sizes(const std::vector<int>& candidates,
                                                   const std::vector<State<double>>& places) const {
        std::vector<std::pair<int, double>> result;
        for (const int k : candidates) result.emplace_back(k, 0);
        for (const State<double>& place : places) {
            const ScaledRows rows = at(place);
            if (!rows.A.allFinite()) continue;
            const std::vector<double> rest = rests(rows.A, candidates);
            for (auto& [k, size] : result)
                size = std::max({size, rest[static_cast<std::size_t>(k)], std::abs(rows.position[k])});
        }
        return result;
    }

    const Mechanism& m_;
    Program program_;
    std::vector<int> rows_;
    Start start_;
    std::vector<double> scales_;
};

}  // namespace

double scale_of_row(const std::vector<Mechanism::Constraint>& constraints, int k,
                    const std::function<double(int)>& row, const std::function<double(int)>& terms) {
    const Mechanism::Constraint& one = constraints[static_cast<std::size_t>(k)];
    double size = one.between_axes ? 1 : 0, length = 0;
    for (int other = 0; other < static_cast<int>(constraints.size()); ++other) {
        const Mechanism::Constraint& c = constraints[static_cast<std::size_t>(other)];
        if (one.joint ? c.joint != one.joint || c.between_axes != one.between_axes : other != k) continue;
        size = std::max(size, row(other));
        length = std::max(length, terms(other));
    }
    if (one.joint && !(size > tolerance::nearly_dependent_row * length)) size = length;
    return size > 0 && std::isfinite(size) ? size : 1;
}

Mechanism without_nearly_redundant(Mechanism m) {
    if (std::none_of(m.constraints.begin(), m.constraints.end(),
                     [](const Mechanism::Constraint& c) { return c.joint.has_value(); }) ||
        constraints_are_open(m))
        return m;
    const std::vector<std::pair<int, double>> found = NearRows(m).found();
    if (found.empty()) return m;
    std::vector<int> positions;
    for (const auto& [k, size] : found) {
        m.constraints[static_cast<std::size_t>(k)].nearly = size;
        positions.push_back(k);
    }
    return without_constraints(std::move(m), positions);
}

std::vector<Diagnostic> warnings_of_nearly_redundant(const Mechanism& m) {
    std::vector<Diagnostic> found;
    for (std::size_t j = 0; j < m.joints.size(); ++j) {
        std::vector<std::string> names;
        double largest = 0;
        Place place;
        for (const Mechanism::Constraint& c : m.redundant) {
            if (!c.nearly || c.joint != static_cast<int>(j)) continue;
            names.push_back(c.name);
            largest = std::max(largest, *c.nearly);
            place = c.place;
        }
        if (names.empty()) continue;
        found.push_back({place,
                         say("joint '{}' closes a loop with rows that follow from the others but for {:.2g} of "
                             "their size ({}), as rounded numbers leave it; they are left out (rests up to {:g} "
                             "count as rounding)",
                             m.joints[j].name, largest, fmt::join(names, ", "), tolerance::nearly_dependent_row),
                         Severity::warning, "nearly_redundant", m.joints[j].name});
    }
    return found;
}

}  // namespace alembert
