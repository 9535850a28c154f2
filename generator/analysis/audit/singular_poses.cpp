// SPDX-License-Identifier: GPL-2.0-or-later
// r(q, v) = (f, Aᵀ v, (|v|² − 1)/2) = 0 by Levenberg's and Marquardt's steps (JᵀJ + μ) δ = −Jᵀ r (Nocedal &
// Wright, Numerical Optimization (2006), §10.3).
#include "analysis/audit/singular_poses.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "alembert/base/dense.hpp"
#include "alembert/base/random.hpp"
#include "alembert/base/tolerances.hpp"
#include "program/lower/lower.hpp"

namespace alembert {

namespace {

constexpr int starts = 48, most_rounds = 60;
constexpr int largest = 30000;  // the most entries of the derivatives of A

class Search {
public:
    Search(const Mechanism& m, State<double> state, const std::vector<State<double>>& states)
        : m_(m),
          state_(std::move(state)),
          usual_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(m.constraints.size()))) {
        std::vector<GiNaC::ex> rows, positions;
        for (const Mechanism::Constraint& c : m.constraints) {
            rows.insert(rows.end(), c.row.begin(), c.row.end());
            positions.push_back(c.position.value_or(0));
        }
        std::vector<GiNaC::ex> all = rows;
        all.insert(all.end(), positions.begin(), positions.end());
        for (const Mechanism::Constraint& c : m.redundant)
            if (c.tie) all.insert(all.end(), c.row.begin(), c.row.end());
        for (int i = 0; i < m.size(); ++i)
            if (std::any_of(all.begin(), all.end(), [&](const GiNaC::ex& e) { return m.z->depends(e, {m.q[i]}); }))
                moving_.push_back(i);
        nodes_ = lower_expressions(program_, m, all);
        searchable_ = rows.size() * moving_.size() <= largest;
        std::vector<GiNaC::ex> derivatives;
        for (const int i : moving_) {
            if (!searchable_) break;
            const std::vector<GiNaC::ex> slopes = m.z->push_forward(rows, {{m.q[i], 1}});
            derivatives.insert(derivatives.end(), slopes.begin(), slopes.end());
        }
        slope_nodes_ = lower_expressions(slope_program_, m, derivatives);
        Eigen::VectorXd size = usual_;
        for (const State<double>& s : states) {
            look(s.q);
            size = size.cwiseMax(A_.rowwise().norm());
        }
        for (Eigen::Index k = 0; k < size.size(); ++k)
            usual_[k] = size[k] > 0 && std::isfinite(size[k]) ? size[k] : 1;
    }

    std::vector<SingularPose> go(std::size_t most) {
        std::vector<SingularPose> found;
        const auto add = [&](const std::vector<double>& q, bool given) {
            auto pose = singular(q);
            if (!pose) return;
            pose->given = given;
            const auto same = [&](const SingularPose& other) {
                for (std::size_t i = 0; i < q.size(); ++i)
                    if (std::abs(other.q[i] - pose->q[i]) > 1e-5 * (1 + std::abs(other.q[i]))) return false;
                return true;
            };
            if (std::none_of(found.begin(), found.end(), same)) found.push_back(*pose);
        };
        add(state_.q, true);
        std::vector<double> zero = state_.q;
        for (const int i : moving_) zero[i] = 0;
        add(zero, false);
        std::mt19937_64 random(1);
        const UniformReal<> away(-std::numbers::pi, std::numbers::pi);
        for (int k = 0; k < starts && searchable_ && !moving_.empty(); ++k) {
            std::vector<double> q = state_.q;
            for (const int i : moving_) q[i] += away(random) * std::max(1.0, std::abs(q[i]) / 2);
            if (!descend(q, random)) continue;
            q = simplified(q);
            if (near(q)) add(q, false);
        }
        // If there are many poses, simple ones come first, and of those that differ by signs alone, that with the
        // plus.
        const auto plain = [&](const SingularPose& pose) {
            int count = 0;
            for (const int i : moving_) {
                const double quarter = pose.q[i] / (std::numbers::pi / 2);
                count += pose.q[i] == state_.q[i] || std::abs(quarter - std::round(quarter)) < 1e-9;
            }
            return count;
        };
        // In steps of 10⁻⁶, so that roundings decide nothing.
        const auto far = [&](const SingularPose& pose) {
            double sum = 0;
            for (std::size_t i = 0; i < pose.q.size(); ++i) sum += std::pow(pose.q[i] - state_.q[i], 2);
            return std::round(1e6 * sum);
        };
        std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
            if (a.given != b.given) return a.given;
            if (plain(a) != plain(b)) return plain(a) > plain(b);
            if (const double d = far(a), e = far(b); d != e) return d < e;
            return std::lexicographical_compare(b.q.begin(), b.q.end(), a.q.begin(), a.q.end());
        });
        if (found.size() > most) found.resize(most);
        return found;
    }

private:
    /// Computes A and f at q, rows in units of their usual sizes.
    void look(const std::vector<double>& q) {
        State<double> state = state_;
        state.q = q;
        const std::vector<double> value = interpret(program_, state);
        const auto m = usual_.size();
        const Eigen::Index n = m_.size();
        A_.resize(m, n);
        f_.resize(m);
        for (Eigen::Index k = 0; k < m; ++k) {
            const double unit = usual_[k] > 0 ? usual_[k] : 1;
            for (Eigen::Index i = 0; i < n; ++i) A_(k, i) = value[nodes_[k * n + i]] / unit;
            f_[k] = value[nodes_[m * n + k]] / unit;
        }
        const Eigen::Index before = m * (n + 1);
        tied_.resize((static_cast<Eigen::Index>(nodes_.size()) - before) / n, n);
        for (Eigen::Index k = 0; k < tied_.rows(); ++k)
            for (Eigen::Index i = 0; i < n; ++i) tied_(k, i) = value[nodes_[before + k * n + i]];
    }

    /// The rank of A with the rows that are tied to it.
    int whole_rank() const {
        Eigen::MatrixXd whole(A_.rows() + tied_.rows(), A_.cols());
        whole << A_, tied_ / std::max(tied_.norm(), 1e-300);
        const SingularValues svd = singular_values(whole);
        return static_cast<int>((svd.values.array() > tolerance::dependent_row).count());
    }

    /// Computes the derivatives of A at q.
    void look_at_slopes(const std::vector<double>& q) {
        State<double> state = state_;
        state.q = q;
        slope_ = interpret(slope_program_, state);
    }

    double slope(Eigen::Index j, Eigen::Index k, Eigen::Index i) const {
        const Eigen::Index m = usual_.size(), n = m_.size();
        return slope_[slope_nodes_[j * m * n + k * n + i]] / usual_[k];
    }

    std::optional<SingularPose> singular(const std::vector<double>& q) {
        look(q);
        if (!A_.allFinite() || !f_.allFinite()) return std::nullopt;
        double size = 1;
        for (const double x : q) size = std::max(size, std::abs(x));
        if (f_.lpNorm<Eigen::Infinity>() > tolerance::dependent_row * size) return std::nullopt;
        const SingularValues svd = singular_values(A_);
        SingularPose pose{.q = q, .rank = 0, .among = {}};
        for (const double sigma : svd.values) pose.rank += sigma > tolerance::dependent_row;
        if (pose.rank == A_.rows() || (tied_.rows() > 0 && whole_rank() >= A_.rows())) return std::nullopt;
        const Eigen::MatrixXd null = svd.left.rightCols(A_.rows() - pose.rank);
        for (Eigen::Index k = 0; k < A_.rows(); ++k)
            if (null.row(k).norm() > 1e-6) pose.among.push_back(static_cast<int>(k));
        return pose;
    }

    Eigen::VectorXd residual(const Eigen::VectorXd& v) const {
        Eigen::VectorXd r(f_.size() + A_.cols() + 1);
        r << f_, A_.transpose() * v, (v.squaredNorm() - 1) / 2;
        return r;
    }

    Eigen::MatrixXd jacobian(const Eigen::VectorXd& v) const {
        const Eigen::Index m = usual_.size(), n = m_.size(), p = static_cast<Eigen::Index>(moving_.size());
        Eigen::MatrixXd J = Eigen::MatrixXd::Zero(m + n + 1, p + m);
        for (Eigen::Index j = 0; j < p; ++j)
            for (Eigen::Index k = 0; k < m; ++k) {
                if (m_.constraints[k].position) J(k, j) = A_(k, moving_[j]);
                for (Eigen::Index i = 0; i < n; ++i) J(m + i, j) += v[k] * slope(j, k, i);
            }
        J.block(m, p, n, m) = A_.transpose();
        J.block(m + n, p, 1, m) = v.transpose();
        return J;
    }

    /// A singular value that tends to zero at infinity gives no singular pose.
    bool near(const std::vector<double>& q) const {
        return std::all_of(moving_.begin(), moving_.end(), [&](int i) {
            return std::abs(q[i] - state_.q[i]) <= 4 * std::numbers::pi * std::max(1.0, std::abs(state_.q[i]));
        });
    }

    bool descend(std::vector<double>& q, std::mt19937_64& random) {
        NormalReal normal;
        Eigen::VectorXd v(usual_.size());
        for (double& c : v) c = normal(random);
        v.normalize();
        look(q);
        double damping = 1e-2;
        Eigen::VectorXd r = residual(v);
        const Eigen::Index p = static_cast<Eigen::Index>(moving_.size());
        look_at_slopes(q);
        for (int round = 0; round < most_rounds; ++round) {
            if (!r.allFinite()) return false;
            if (r.norm() < 1e-14) return true;
            const Eigen::MatrixXd J = jacobian(v);
            Eigen::MatrixXd N = J.transpose() * J;
            N.diagonal().array() += damping;
            const Eigen::VectorXd step = -solve_symmetric(N, J.transpose() * r);
            std::vector<double> next = q;
            for (Eigen::Index j = 0; j < p; ++j) next[moving_[j]] += step[j];
            const Eigen::VectorXd turned = v + step.tail(v.size());
            const Eigen::MatrixXd A = A_;
            const Eigen::VectorXd f = f_;
            look(next);
            const Eigen::VectorXd after = residual(turned);
            if (after.norm() < r.norm()) {
                q = next;
                v = turned;
                r = after;
                damping = std::max(damping / 10, 1e-3 * r.squaredNorm());
                look_at_slopes(q);
            } else {
                damping *= 10;
                A_ = A;
                f_ = f;
                if (damping > 1e8) break;
            }
        }
        return r.norm() < 1e-9;
    }

    /// The same pose with simpler numbers, if it is singular there too.
    std::vector<double> simplified(std::vector<double> q) {
        constexpr double right_angle = std::numbers::pi / 2;
        for (const int i : moving_)
            for (double other :
                 {0.0, state_.q[i], right_angle * std::round(std::remainder(q[i], 4 * right_angle) / right_angle),
                  std::remainder(q[i], 2 * std::numbers::pi)}) {
                if (std::abs(other + std::numbers::pi) < 1e-6) other += 2 * std::numbers::pi;
                std::vector<double> trial = q;
                trial[i] = other;
                if (!singular(trial)) continue;
                q = trial;
                break;
            }
        return q;
    }

    const Mechanism& m_;
    State<double> state_;
    Program program_, slope_program_;
    std::vector<int> nodes_, slope_nodes_, moving_;
    bool searchable_ = true;
    std::vector<double> slope_;
    Eigen::VectorXd usual_, f_;
    Eigen::MatrixXd A_, tied_;  ///< and the rows of redundant constraints that are tied to those of A
};

}  // namespace

std::vector<SingularPose> singular_poses(const Mechanism& mechanism, const State<double>& state,
                                         const std::vector<State<double>>& states, std::size_t most) {
    if (mechanism.constraints.empty()) return {};
    return Search(mechanism, state, states).go(most);
}

}  // namespace alembert
