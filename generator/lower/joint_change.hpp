// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "formalism/joint_tree.hpp"
#include "program/program.hpp"

namespace alembert {

/// The change between the joints' rates and those of the coordinates: for absolute rates by differences, for
/// relative rates by S.
class JointChange {
public:
    JointChange(Program& program, const JointTree& tree, LinkAxes axes)
        : p_(program), how_(dress(tree, axes)), n_(tree.coordinates) {
        // If S is a permutation with signs, records the coordinate and the sign of each joint.
        std::vector<char> taken(static_cast<std::size_t>(n_), 0);
        is_direct_ = static_cast<int>(tree.joints.size()) == n_;
        for (const TreeJoint& joint : tree.joints) {
            int count = 0, only = -1;
            rows_.emplace_back();
            for (int a = 0; a < n_; ++a)
                if (!joint.row[a].is_zero())
                    ++count, only = a, rows_.back().emplace_back(a, cln::the<cln::cl_RA>(joint.row[a].to_cl_N()));
            const bool plain = count == 1 && GiNaC::abs(joint.row[only]).is_equal(1) && taken[only]++ == 0;
            is_direct_ = is_direct_ && plain;
            of_.emplace_back(only, plain ? joint.row[only].to_int() : 0);
        }
        if (!is_direct_) direct_absolute(rate_rows(tree, axes));
    }

    /// Does this change determine the rates of the coordinates from those of the joints?
    bool determines() const { return is_direct_ || is_absolute_; }

    /// The loads along the joints that correspond to generalized forces.
    std::vector<int> loads(const std::vector<int>& Q) const {
        std::vector<int> result;
        for (const auto& [a, sign] : of_) result.push_back(scaled(Q[a], sign));
        if (is_absolute_) return result;
        const std::vector<int> relative = result;
        for (std::size_t j = 0; j < result.size(); ++j)
            if (const int base = base_of(j); base >= 0) result[base] = sum(result[base], -1, relative[j]);
        return result;
    }
    std::vector<int> accelerations(const std::vector<int>& rates) const {
        std::vector<int> result(static_cast<std::size_t>(n_));
        for (std::size_t j = 0; j < rates.size(); ++j) {
            const int base = is_absolute_ ? -1 : base_of(j);
            result[of_[j].first] = scaled(base < 0 ? rates[j] : sum(rates[j], -1, rates[base]), of_[j].second);
        }
        return result;
    }

    /// Sᵀ M S and Sᵀ n.
    std::vector<int> forces(std::vector<int> loads) const {
        to_relative([&](int base, std::size_t j) { loads[base] = sum(loads[base], 1, loads[j]); });
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
    /// Whether the absolute rates are themselves rates of coordinates.
    void direct_absolute(const std::vector<std::vector<GiNaC::numeric>>& rows) {
        std::vector<char> taken(static_cast<std::size_t>(n_), 0);
        is_absolute_ = static_cast<int>(rows.size()) == n_;
        for (std::size_t j = 0; j < rows.size() && is_absolute_; ++j) {
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
    int scaled(int node, int sign) const { return p_.sum(0, {{sign, node}}); }

    Program& p_;
    std::vector<std::vector<std::pair<int, Rational>>> rows_;  // the entries of S that are not 0
    std::vector<Dress> how_;
    int n_;
    bool is_direct_ = false, is_absolute_ = false;
    std::vector<std::pair<int, int>> of_;
};

}  // namespace alembert
