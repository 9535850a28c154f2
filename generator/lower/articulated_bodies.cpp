// SPDX-License-Identifier: GPL-2.0-or-later
#include "lower/articulated_bodies.hpp"

#include "formalism/planar_chain.hpp"
#include "language/say.hpp"
#include "lower/link_frames.hpp"
#include "program/solve.hpp"

namespace alembert {

namespace {

/// The change between the joints' rates and those of the coordinates: for absolute rates by differences, for
/// relative rates by S.
class Change {
public:
    Change(Program& program, const JointTree& tree, LinkAxes axes)
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

}  // namespace

std::string RecursionForm::text() const {
    const std::string name = solve == Solve::matrix        ? to_say("composite bodies")
                             : solve == Solve::articulated ? to_say("articulated bodies")
                                                           : to_say("chain from both ends");
    return name + (axes == LinkAxes::still ? std::string(", ") + to_say("parallel axes") : "");
}

RecursionNodes recursion(Program& program, const JointTree& joints, Intermediates& z, const RecursionForm& form,
                         bool with_matrix, const std::function<int(const GiNaC::ex&)>& lowering) {
    const std::function<Symbolic(const GiNaC::ex&)> value = [&](const GiNaC::ex& e) {
        return Symbolic(program, lowering(e));
    };
    const BodyTree<Symbolic> tree = regrouped(reframed(program, dressed<Symbolic>(joints, form.axes, z, value)));
    const Change change(program, joints, form.axes);
    const auto nodes = [&](const std::vector<Symbolic>& list) {
        std::vector<int> result;
        for (const Symbolic& s : list) result.push_back(s.node(program));
        return result;
    };
    const auto symbols = [&](const std::vector<int>& list) {
        std::vector<Symbolic> result;
        for (const int node : list) result.emplace_back(program, node);
        return result;
    };
    std::vector<int> Q;
    for (const GiNaC::ex& force : joints.forces) Q.push_back(lowering(force));
    const Bias<Symbolic> bias(tree);
    const std::vector<int> n = nodes(joint_loads(tree, bias.wrenches));
    std::vector<int> lower;
    RecursionNodes result;
    if (with_matrix) {
        const std::vector<std::vector<Symbolic>> M = composite_bodies(tree);
        std::vector<std::vector<int>> full(M.size(), std::vector<int>(M.size(), program.number(0)));
        for (std::size_t j = 0; j < M.size(); ++j)
            for (std::size_t i = 0; i <= j; ++i) lower.push_back(full[j][i] = full[i][j] = M[j][i].node(program));
        result = {.mass = change.mass(full), .forcing = change.forces(n)};
        for (std::size_t a = 0; a < Q.size(); ++a)
            result.forcing[a] = program.sum(0, {{1, Q[a]}, {-1, result.forcing[a]}});
    }
    if (!change.determines()) return result;
    const std::vector<int> loads = change.loads(Q);
    if (form.solve == RecursionForm::Solve::articulated) {
        result.acceleration = change.accelerations(nodes(articulated_bodies(tree, bias.wrenches, symbols(loads))));
    } else {
        std::vector<int> f;
        for (std::size_t j = 0; j < n.size(); ++j) f.push_back(program.sum(0, {{1, loads[j]}, {-1, n[j]}}));
        if (form.solve == RecursionForm::Solve::both_ends)
            result.acceleration = change.accelerations(nodes(from_both_ends(tree, symbols(f))));
        else if (const auto rates = solve_symmetric(program, lower, f))
            result.acceleration = change.accelerations(*rates);
    }
    return result;
}

std::vector<int> inverse_recursion(Program& program, const JointTree& joints, Intermediates& z,
                                   const std::vector<GiNaC::symbol>& qddot,
                                   const std::function<int(const GiNaC::ex&)>& lowering) {
    const std::function<Symbolic(const GiNaC::ex&)> value = [&](const GiNaC::ex& e) {
        return Symbolic(program, lowering(e));
    };
    BodyTree<Symbolic> tree = regrouped(dressed<Symbolic>(joints, LinkAxes::own, z, value));
    for (std::size_t j = 0; j < joints.joints.size(); ++j) {
        GiNaC::ex w = joints.joints[j].drift;
        for (std::size_t a = 0; a < qddot.size(); ++a) w += joints.joints[j].row[a] * qddot[a];
        tree.links[j].drift = value(z.name(w));
    }
    std::vector<int> loads;
    for (const Symbolic& s : joint_loads(tree, Bias<Symbolic>(tree).wrenches)) loads.push_back(s.node(program));
    loads = Change(program, joints, LinkAxes::own).forces(loads);
    for (std::size_t a = 0; a < loads.size(); ++a)
        loads[a] = program.sum(0, {{1, loads[a]}, {-1, lowering(joints.forces[a])}});
    return loads;
}

}  // namespace alembert
