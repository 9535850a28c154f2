// SPDX-License-Identifier: GPL-2.0-or-later
#include "lower/recursion.hpp"

#include "lower/solve.hpp"

namespace alembert {

namespace {

/// A node as a scalar; zeros and constants fold in the program.
class Symbolic {
public:
    Symbolic(int number = 0) : number_(number) {}
    Symbolic(Program& program, int node) : p_(&program), node_(node) {}

    int node(Program& program) const { return p_ != nullptr ? node_ : program.number(number_); }

    friend Symbolic operator+(const Symbolic& a, const Symbolic& b) { return sum(a, b, 1); }
    friend Symbolic operator-(const Symbolic& a, const Symbolic& b) { return sum(a, b, -1); }
    Symbolic operator-() const { return p_ == nullptr ? of(-number_) : Symbolic(*p_, p_->sum(0, {{-1, node_}})); }
    friend Symbolic operator*(const Symbolic& a, const Symbolic& b) {
        Program* p = either(a, b);
        if (p == nullptr) return of(a.number_ * b.number_);
        if (a.p_ == nullptr) return {*p, p->sum(0, {{a.number_, b.node_}})};
        if (b.p_ == nullptr) return {*p, p->sum(0, {{b.number_, a.node_}})};
        return {*p, p->product(1, {{a.node_, 1}, {b.node_, 1}})};
    }
    friend Symbolic operator/(const Symbolic& a, const Symbolic& b) {
        Program* p = either(a, b);
        if (p == nullptr) return of(a.number_ / b.number_);
        return {*p, p->product(1, {{a.node(*p), 1}, {b.node(*p), -1}})};
    }

private:
    static Symbolic of(const Rational& number) {
        Symbolic result;
        result.number_ = number;
        return result;
    }
    static Program* either(const Symbolic& a, const Symbolic& b) { return a.p_ != nullptr ? a.p_ : b.p_; }
    static Symbolic sum(const Symbolic& a, const Symbolic& b, int sign) {
        Program* p = either(a, b);
        if (p == nullptr) return of(a.number_ + sign * b.number_);
        return {*p, p->sum(0, {{1, a.node(*p)}, {sign, b.node(*p)}})};
    }

    Program* p_ = nullptr;
    int node_ = -1;
    Rational number_ = 0;
};

/// Links' axes chosen anew, turned about their joints' by constant angles, so that from a link to its (first) child there is one
/// turn only beside the joints' own: R = Rz(a) Rx(α) Rz(b), a given to the parent's joint angle and b to the child's (Denavit &
/// Hartenberg, J. Applied Mechanics 22 (1955) 215). Without this a generic constant rotation takes nine multiplications for every
/// vector, and with it four.
class Aligned {
public:
    Aligned(Program& program, BodyTree<Symbolic> tree) : p_(program), tree_(std::move(tree)), offset_(tree_.links.size(), Symbolic(0)) {
        std::vector<char> done(tree_.links.size(), 0);
        for (std::size_t j = 0; j < tree_.links.size(); ++j) {
            TreeLink<Symbolic>& link = tree_.links[j];
            if (link.slides || link.still || link.parent < 0 || !is_generic(link.R)) continue;
            const auto i = static_cast<std::size_t>(link.parent);
            const TreeLink<Symbolic>& parent = tree_.links[i];
            if (parent.slides || parent.still || done[i]++ != 0) continue;
            turn_axes(i, function(Op::atan2, link.R[0][2], -link.R[1][2]));
            const Symbolic c = link.R[2][2], s = -link.R[1][2];  // of α, where a is taken away
            turn_joint(j, function(Op::atan2, -link.R[0][1], link.R[0][0]));
            link.R = {Triple<Symbolic>{1, 0, 0}, Triple<Symbolic>{0, c, -s}, Triple<Symbolic>{0, s, c}};
        }
        for (std::size_t j = 0; j < tree_.links.size(); ++j) {
            TreeLink<Symbolic>& link = tree_.links[j];
            if (link.slides || offset_[j].node(p_) == p_.number(0)) continue;
            link.angle = link.angle + offset_[j];
            link.cosine = function(Op::cos, link.angle);
            link.sine = function(Op::sin, link.angle);
        }
    }
    BodyTree<Symbolic> tree() const { return tree_; }

private:
    /// Neither axes along axes nor a turn about one of them.
    bool is_generic(const Matrix<Symbolic>& R) const {
        int zeros = 0;
        for (const Triple<Symbolic>& row : R)
            for (const Symbolic& entry : row) zeros += p_.is_zero(entry.node(p_)) ? 1 : 0;
        return zeros < 3;
    }
    Symbolic function(Op op, const Symbolic& a) const { return {p_, p_.call(op, {a.node(p_)})}; }
    Symbolic function(Op op, const Symbolic& a, const Symbolic& b) const { return {p_, p_.call(op, {a.node(p_), b.node(p_)})}; }

    void turn_joint(std::size_t j, const Symbolic& by) { offset_[j] = offset_[j] + by; }
    /// The link's own axes, about its z by `a`; what stands along them changes.
    void turn_axes(std::size_t i, const Symbolic& a) {
        const Symbolic c = function(Op::cos, a), s = function(Op::sin, a);
        turn_joint(i, a);
        RigidBody<Symbolic>& body = tree_.links[i].body;
        body.first = turned_back(c, s, body.first);
        body.second = turned_about_z(c, -s, body.second);
        for (TreeLink<Symbolic>& child : tree_.links) {
            if (child.parent != static_cast<int>(i)) continue;
            child.p = turned_back(c, s, child.p);
            Matrix<Symbolic> columns = transposed(child.R);
            for (Triple<Symbolic>& column : columns) column = turned_back(c, s, column);
            child.R = transposed(columns);
        }
    }

    Program& p_;
    BodyTree<Symbolic> tree_;
    std::vector<Symbolic> offset_;
};

/// From joints' rates to the coordinates': the absolute ones by differences, the relative ones by S.
class Change {
public:
    Change(Program& program, const JointTree& tree, LinkAxes axes) : p_(program), how_(dress(tree, axes)), n_(tree.coordinates) {
        // S is a permutation, with signs: coordinate and sign of each joint.
        std::vector<char> taken(static_cast<std::size_t>(n_), 0);
        is_direct_ = static_cast<int>(tree.joints.size()) == n_;
        for (const TreeJoint& joint : tree.joints) {
            int count = 0, only = -1;
            rows_.emplace_back();
            for (int a = 0; a < n_; ++a)
                if (!joint.row[a].is_zero()) ++count, only = a, rows_.back().emplace_back(a, cln::the<cln::cl_RA>(joint.row[a].to_cl_N()));
            const bool plain = count == 1 && GiNaC::abs(joint.row[only]).is_equal(1) && taken[only]++ == 0;
            is_direct_ = is_direct_ && plain;
            of_.emplace_back(only, plain ? joint.row[only].to_int() : 0);
        }
        if (!is_direct_) direct_absolute(rate_rows(tree, axes));
    }

    /// Do the joints' rates determine the coordinates', by this change?
    bool determines() const { return is_direct_ || is_absolute_; }

    /// Loads along the joints of generalized forces.
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
    std::vector<int> mass(std::vector<std::vector<int>> M) const {  // full
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
    /// The absolute rates are coordinates' rates themselves.
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
    std::vector<std::vector<std::pair<int, Rational>>> rows_;  // of S, what is not 0
    std::vector<Dress> how_;
    int n_;
    bool is_direct_ = false, is_absolute_ = false;
    std::vector<std::pair<int, int>> of_;
};

}  // namespace

std::string RecursionForm::text() const {
    return std::string(articulated ? "articulated bodies" : "composite bodies") + (axes == LinkAxes::still ? ", parallel axes" : "");
}

RecursionNodes recursion(Program& program, const JointTree& joints, Intermediates& z, const RecursionForm& form,
                         const std::function<int(const GiNaC::ex&)>& lowering) {
    const std::function<Symbolic(const GiNaC::ex&)> value = [&](const GiNaC::ex& e) { return Symbolic(program, lowering(e)); };
    const BodyTree<Symbolic> tree = regrouped(Aligned(program, dressed<Symbolic>(joints, form.axes, z, value)).tree());
    const Change change(program, joints, form.axes);
    const auto nodes = [&](const std::vector<Symbolic>& list) {
        std::vector<int> result;
        for (const Symbolic& s : list) result.push_back(s.node(program));
        return result;
    };
    std::vector<int> Q;
    for (const GiNaC::ex& force : joints.forces) Q.push_back(lowering(force));
    const Bias<Symbolic> bias(tree);
    const std::vector<std::vector<Symbolic>> M = composite_bodies(tree);
    const std::vector<int> n = nodes(joint_loads(tree, bias.wrenches));

    std::vector<std::vector<int>> full(M.size(), std::vector<int>(M.size(), program.number(0)));
    std::vector<int> lower;
    for (std::size_t j = 0; j < M.size(); ++j)
        for (std::size_t i = 0; i <= j; ++i) lower.push_back(full[j][i] = full[i][j] = M[j][i].node(program));
    RecursionNodes result{.mass = change.mass(full), .forcing = change.forces(n)};
    for (std::size_t a = 0; a < Q.size(); ++a) result.forcing[a] = program.sum(0, {{1, Q[a]}, {-1, result.forcing[a]}});
    if (!change.determines()) return result;
    const std::vector<int> loads = change.loads(Q);
    if (form.articulated) {
        std::vector<Symbolic> list;
        for (const int node : loads) list.emplace_back(program, node);
        result.acceleration = change.accelerations(nodes(articulated_bodies(tree, bias.wrenches, list)));
    } else {
        std::vector<int> f;
        for (std::size_t j = 0; j < n.size(); ++j) f.push_back(program.sum(0, {{1, loads[j]}, {-1, n[j]}}));
        if (const auto rates = solve_symmetric(program, lower, f)) result.acceleration = change.accelerations(*rates);
    }
    return result;
}

std::vector<int> inverse_recursion(Program& program, const JointTree& joints, Intermediates& z, const std::vector<GiNaC::symbol>& qddot,
                                   const std::function<int(const GiNaC::ex&)>& lowering) {
    const std::function<Symbolic(const GiNaC::ex&)> value = [&](const GiNaC::ex& e) { return Symbolic(program, lowering(e)); };
    BodyTree<Symbolic> tree = regrouped(dressed<Symbolic>(joints, LinkAxes::own, z, value));
    for (std::size_t j = 0; j < joints.joints.size(); ++j) {
        GiNaC::ex w = joints.joints[j].drift;
        for (std::size_t a = 0; a < qddot.size(); ++a) w += joints.joints[j].row[a] * qddot[a];
        tree.links[j].drift = value(z.name(w));
    }
    std::vector<int> loads;
    for (const Symbolic& s : joint_loads(tree, Bias<Symbolic>(tree).wrenches)) loads.push_back(s.node(program));
    loads = Change(program, joints, LinkAxes::own).forces(loads);
    for (std::size_t a = 0; a < loads.size(); ++a) loads[a] = program.sum(0, {{1, loads[a]}, {-1, lowering(joints.forces[a])}});
    return loads;
}

}  // namespace alembert
