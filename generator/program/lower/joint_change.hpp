// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>

#include "model/formalism/joint_tree.hpp"
#include "program/program.hpp"

namespace alembert {

/// The change between the joints' rates and those of the coordinates: for absolute rates by differences, for
/// relative rates by S, for a ball joint by its quaternion (model/formalism/ball_joint.hpp).
class JointChange {
public:
    /// `lowering` gives the node of an expression.
    JointChange(Program& program, const JointTree& tree, LinkAxes axes,
                const std::function<int(const GiNaC::ex&)>& lowering)
        : p_(program), how_(dress(tree, axes)), n_(tree.coordinates) {
        for (const BallJoint& ball : tree.balls) balls_.emplace_back(ball, lowering);
        // If S is a permutation with signs, records the coordinate and the sign of each joint.
        std::vector<char> taken(static_cast<std::size_t>(n_), 0);
        is_direct_ = static_cast<int>(tree.joints.size() + tree.balls.size()) == n_;
        for (const TreeJoint& joint : tree.joints) {
            if (joint.link.of_ball) {
                rows_.emplace_back();
                of_.emplace_back(-1, 0);
                continue;
            }
            int count = 0, only = -1;
            rows_.emplace_back();
            for (int a = 0; a < n_; ++a)
                if (!joint.row[a].is_zero())
                    ++count, only = a, rows_.back().emplace_back(a, cln::the<cln::cl_RA>(joint.row[a].to_cl_N()));
            const bool plain = count == 1 && GiNaC::abs(joint.row[only]).is_equal(1) && taken[only]++ == 0;
            is_direct_ = is_direct_ && plain;
            of_.emplace_back(only, plain ? joint.row[only].to_int() : 0);
        }
        if (!is_direct_) direct_absolute(tree, rate_rows(tree, axes));
        // Behind the joints, the four coordinates of each quaternion.
        for (const Ball& ball : balls_)
            for (std::size_t i = 0; i < 4; ++i)
                rows_.push_back({{ball.joint.coordinate[i], Rational(ball.joint.sign[i])}});
    }

    int coordinates() const { return n_; }

    /// Does this change determine the rates of the coordinates from those of the joints?
    bool determines() const { return is_direct_ || is_absolute_; }

    /// The loads along the joints that correspond to generalized forces.
    std::vector<int> loads(const std::vector<int>& Q) const {
        std::vector<int> result;
        for (const auto& [a, sign] : of_) result.push_back(a < 0 ? p_.number(0) : scaled(Q[a], sign));
        for (const Ball& ball : balls_) {
            const std::array<int, 4> own = ball.of_coordinates(Q, p_);
            for (std::size_t k = 0; k < 3; ++k)
                result[ball.joint.first + k] = scaled(p_.sum(0, products(ball.G[k], own)), Rational(1) / 2);
        }
        if (is_absolute_) return result;
        const std::vector<int> relative = result;
        for (std::size_t j = 0; j < result.size(); ++j)
            if (const int base = base_of(j); base >= 0) result[base] = sum(result[base], -1, relative[j]);
        return result;
    }
    std::vector<int> accelerations(const std::vector<int>& rates) const {
        std::vector<int> result(static_cast<std::size_t>(n_));
        for (const Ball& ball : balls_)
            for (std::size_t i = 0; i < 4; ++i)
                result[ball.joint.coordinate[i]] =
                    scaled(p_.sum(0, second_rate(ball, i, rates)), ball.joint.sign[i]);
        add_plain_accelerations(rates, result);
        return result;
    }
    /// Values whose derivatives are those of q'': from the accelerations of the joints, which count as constant,
    /// and from values whose derivatives are theirs. `held` gives what stands for a node that counts as constant.
    std::vector<int> changed_accelerations(const std::vector<int>& constant, const std::vector<int>& changes,
                                           const std::function<int(int)>& held) const {
        std::vector<int> result(static_cast<std::size_t>(n_));
        for (const Ball& ball : balls_)
            for (std::size_t i = 0; i < 4; ++i) {
                std::vector<Program::Term> terms = second_rate(ball, i, constant);
                for (std::size_t k = 0; k < 3; ++k)
                    terms.emplace_back(Rational(1) / 2, p_.product(1, {{held(ball.G[k][i]), 1},
                                                                       {changes[ball.joint.first + k], 1}}));
                result[ball.joint.coordinate[i]] = scaled(p_.sum(0, terms), ball.joint.sign[i]);
            }
        add_plain_accelerations(changes, result);
        return result;
    }

    /// Of each ball joint, the joints with J q'' of these accelerations.
    std::vector<std::pair<std::size_t, int>> ball_accelerations(const std::vector<int>& qddot) const {
        std::vector<std::pair<std::size_t, int>> result;
        for (const Ball& ball : balls_)
            for (std::size_t k = 0; k < 3; ++k)
                result.emplace_back(
                    ball.joint.first + k,
                    p_.product(2, {{ball.inverse, 1},
                                   {p_.sum(0, products(ball.G[k], ball.of_coordinates(qddot, p_))), 1}}));
        return result;
    }
    /// λ of e·e = 1 for each ball joint.
    std::vector<int> multipliers(const std::vector<int>& Q) const {
        std::vector<int> result;
        for (const Ball& ball : balls_)
            result.push_back(
                p_.product(Rational(-1) / 2,
                           {{ball.inverse, 1}, {p_.sum(0, products(ball.e, ball.of_coordinates(Q, p_))), 1}}));
        return result;
    }

    /// Sᵀ M S and Sᵀ n.
    std::vector<int> forces(std::vector<int> loads) const {
        to_relative([&](int base, std::size_t j) { loads[base] = sum(loads[base], 1, loads[j]); });
        add_quaternions(loads);
        std::vector<std::vector<Program::Term>> terms(static_cast<std::size_t>(n_));
        for (std::size_t j = 0; j < loads.size(); ++j)
            for (const auto& [a, s] : rows_[j]) terms[a].emplace_back(s, loads[j]);
        std::vector<int> result;
        for (const auto& list : terms) result.push_back(p_.sum(0, list));
        return result;
    }
    std::vector<int> mass(std::vector<std::vector<int>> M) const {  // the full matrix
        to_relative([&](int base, std::size_t j) {
            for (std::vector<int>& row : M) row[base] = sum(row[base], 1, row[j]);
            for (std::size_t i = 0; i < M.size(); ++i) M[base][i] = sum(M[base][i], 1, M[j][i]);
        });
        for (std::vector<int>& row : M) add_quaternions(row);
        if (!balls_.empty()) {
            std::vector<std::vector<int>> columns(M.front().size());
            for (const std::vector<int>& row : M)
                for (std::size_t i = 0; i < row.size(); ++i) columns[i].push_back(row[i]);
            for (std::vector<int>& column : columns) add_quaternions(column);
            M = std::move(columns);
        }
        std::vector<std::vector<Program::Term>> terms(static_cast<std::size_t>(n_) * n_);
        for (std::size_t j = 0; j < M.size(); ++j)
            for (const auto& [a, s] : rows_[j])
                for (std::size_t i = 0; i < M.size(); ++i)
                    for (const auto& [b, t] : rows_[i])
                        if (b <= a) terms[a * n_ + b].emplace_back(s * t, M[j][i]);
        std::vector<int> result;
        for (int a = 0; a < n_; ++a)
            for (int b = 0; b <= a; ++b) result.push_back(p_.sum(0, terms[a * n_ + b]));
        return result;
    }

private:
    /// A ball joint in nodes.
    struct Ball {
        Ball(const BallJoint& ball, const std::function<int(const GiNaC::ex&)>& lowering) : joint(ball) {
            const auto rows = rows_of_turn(ball.e);
            for (std::size_t i = 0; i < 4; ++i) {
                e[i] = lowering(ball.e[i]);
                for (std::size_t k = 0; k < 3; ++k) G[k][i] = lowering(rows[k][i]);
            }
            inverse = lowering(ball.inverse);
            spin = lowering(ball.spin);
        }
        /// Values that belong to the coordinates, as those of e.
        std::array<int, 4> of_coordinates(const std::vector<int>& values, Program& p) const {
            std::array<int, 4> result{};
            for (std::size_t i = 0; i < 4; ++i)
                result[i] = p.sum(0, {{joint.sign[i], values[joint.coordinate[i]]}});
            return result;
        }
        BallJoint joint;
        std::array<int, 4> e{};
        std::array<std::array<int, 4>, 3> G{};
        int inverse = -1, spin = -1;
    };

    std::vector<Program::Term> products(const std::array<int, 4>& a, const std::array<int, 4>& b) const {
        std::vector<Program::Term> terms;
        for (std::size_t i = 0; i < 4; ++i) terms.emplace_back(1, p_.product(1, {{a[i], 1}, {b[i], 1}}));
        return terms;
    }
    /// ½ Gᵀ a − (e'·e'/e·e) e, component i.
    std::vector<Program::Term> second_rate(const Ball& ball, std::size_t i, const std::vector<int>& a) const {
        std::vector<Program::Term> terms{{-1, p_.product(1, {{ball.spin, 1}, {ball.e[i], 1}})}};
        for (std::size_t k = 0; k < 3; ++k)
            terms.emplace_back(Rational(1) / 2, p_.product(1, {{ball.G[k][i], 1}, {a[ball.joint.first + k], 1}}));
        return terms;
    }
    void add_plain_accelerations(const std::vector<int>& rates, std::vector<int>& result) const {
        for (std::size_t j = 0; j < rates.size(); ++j) {
            if (of_[j].first < 0) continue;
            const int base = is_absolute_ ? -1 : base_of(j);
            result[of_[j].first] = scaled(base < 0 ? rates[j] : sum(rates[j], -1, rates[base]), of_[j].second);
        }
    }
    /// Adds Jᵀ τ of each ball joint to a list with an element for each joint.
    void add_quaternions(std::vector<int>& loads) const {
        for (const Ball& ball : balls_) {
            std::array<int, 3> torque{};
            for (std::size_t k = 0; k < 3; ++k)
                torque[k] = p_.product(2, {{ball.inverse, 1}, {loads[ball.joint.first + k], 1}});
            for (std::size_t i = 0; i < 4; ++i) {
                std::vector<Program::Term> terms;
                for (std::size_t k = 0; k < 3; ++k)
                    terms.emplace_back(1, p_.product(1, {{ball.G[k][i], 1}, {torque[k], 1}}));
                loads.push_back(p_.sum(0, terms));
            }
        }
    }

    /// Whether the absolute rates are themselves rates of coordinates.
    void direct_absolute(const JointTree& tree, const std::vector<std::vector<GiNaC::numeric>>& rows) {
        std::vector<char> taken(static_cast<std::size_t>(n_), 0);
        is_absolute_ = static_cast<int>(rows.size() + tree.balls.size()) == n_;
        for (std::size_t j = 0; j < rows.size() && is_absolute_; ++j) {
            if (tree.joints[j].link.of_ball) continue;
            int count = 0, only = -1;
            for (int a = 0; a < n_; ++a)
                if (!rows[j][a].is_zero()) ++count, only = a;
            is_absolute_ = count == 1 && GiNaC::abs(rows[j][only]).is_equal(1) && taken[only]++ == 0;
            if (is_absolute_) of_[j] = {only, rows[j][only].to_int()};
        }
    }
    int base_of(std::size_t j) const { return how_[j].absolute ? how_[j].base : -1; }
    template <typename Visit>
    void to_relative(const Visit& visit) const {
        for (std::size_t j = how_.size(); j-- > 0;)
            if (const int base = base_of(j); base >= 0) visit(base, j);
    }
    int sum(int a, int sign, int b) const { return p_.sum(0, {{1, a}, {sign, b}}); }
    int scaled(int node, const Rational& factor) const { return p_.sum(0, {{factor, node}}); }

    Program& p_;
    std::vector<Ball> balls_;
    std::vector<std::vector<std::pair<int, Rational>>> rows_;  // the entries of S that are not 0
    std::vector<Dress> how_;
    int n_;
    bool is_direct_ = false, is_absolute_ = false;
    std::vector<std::pair<int, int>> of_;
};

}  // namespace alembert
