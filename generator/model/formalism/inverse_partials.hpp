// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The derivatives of inverse dynamics by the angles or shifts q and the rates w of a tree's joints, in closed
/// form, for any scalar:
///
///     const InversePartials<double> by(moving, -1);      // `bias` is w', as for Bias
///     by.position[i][j];                                 // ∂τ_i/∂q_j at constant w and w'
///     by.rate[i][j];                                     // ∂τ_i/∂w_j
///
/// With the twist S_j of joint j, ψ'_j = v_j × S_j and ψ''_j = a_j × S_j + v_j × ψ'_j, and with the inertia I, the
/// matrix B and the wrench f of link i and all that it carries, for each joint j from the ground to i
///
///     ∂τ_i/∂q_j = S_i·(2B ψ'_j + I ψ''_j),               ∂τ_i/∂w_j = S_i·(2B S_j + 2I ψ'_j),
///     ∂τ_j/∂q_i = S_j·(2B ψ'_i + I ψ''_i + S_i ×* f),    ∂τ_j/∂w_i = S_j·(2B S_i + 2I ψ'_i)
///
/// (Singh, Russell & Wensing, IEEE Robotics and Automation Letters 7 (2022) 1776; Carpentier & Mansard, Robotics:
/// Science and Systems 2018). For a twist (σ, s), the velocities s + σ × r, and bodies whose parts move with u,
/// 2B (σ, s) is the wrench of the forces 2σ × u dm. Hence it needs σ alone, and of the motion l = ∫ 2u dm and X =
/// ∫ 2u rᵀ dm alone. These are found along the axes of each link, where S_i is a unit, with u relative to the
/// link's origin; what two joints have in common is a product of vectors along the axes of one link for all.
///
/// Links on curves, ball joints and axes that do not turn with the links are left out.

#include "model/formalism/tree_recursions.hpp"

namespace alembert {

template <typename S>
class InversePartials {
public:
    /// `common` is the link along whose axes joints meet; −1: the ground.
    InversePartials(const BodyTree<S>& tree, int common)
        : position(square(tree.links.size())),
          rate(position),
          tree_(tree),
          bias_(tree),
          wrenches_(carried_wrenches(tree, bias_.wrenches)) {
        outwards();
        inwards();
        place(common);
        for (int i = 0; i < tree.size(); ++i) meet(i);
    }

    std::vector<std::vector<S>> position, rate;  ///< a row for each load

private:
    using Vector = Triple<S>;
    using Link = TreeLink<S>;

    /// A link with all that it carries: the body, and l and X of its motion relative to the link's origin.
    struct Whole {
        RigidBody<S> body;
        Vector l;
        Matrix<S> X;
    };
    struct Twist {
        Vector sigma = no_vector<S>(), s = no_vector<S>();
    };
    /// S, ψ', 2ψ' and ψ'' of a joint, where velocities count from that of the link's origin.
    struct Ways {
        Twist own, first, twice, second;
    };
    /// The axes and the origin of a link, along the common axes.
    struct Place {
        Matrix<S> axes{Vector{S(1), S(0), S(0)}, Vector{S(0), S(1), S(0)}, Vector{S(0), S(0), S(1)}};
        Vector origin = no_vector<S>();

        Twist of(const Twist& t) const {
            const Vector sigma = axes * t.sigma;
            return {sigma, axes * t.s + cross(origin, sigma)};
        }
        Wrench<S> of(const Wrench<S>& w) const {
            const Vector f = axes * w.f;
            return {axes * w.n + cross(origin, f), f};
        }
    };

    static std::vector<std::vector<S>> square(std::size_t n) {
        return std::vector<std::vector<S>>(n, std::vector<S>(n, S(0)));
    }

    /// R A Rᵀ of a turn about axis k. With a = s (A_ii − A_jj) + c (A_ij + A_ji) the elements of i and j are A_ii
    /// − s a, A_jj + s a, c a − A_ji, c a − A_ij.
    static Matrix<S> turned(int k, const S& c, const S& s, const Matrix<S>& A) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const S a = s * (A[i][i] - A[j][j]) + c * (A[i][j] + A[j][i]), sa = s * a, ca = c * a;
        Matrix<S> T = A;
        T[i][i] = A[i][i] - sa;
        T[j][j] = A[j][j] + sa;
        T[i][j] = ca - A[j][i];
        T[j][i] = ca - A[i][j];
        T[i][k] = c * A[i][k] - s * A[j][k];
        T[j][k] = s * A[i][k] + c * A[j][k];
        T[k][i] = c * A[k][i] - s * A[k][j];
        T[k][j] = s * A[k][i] + c * A[k][j];
        return T;
    }
    static Matrix<S> to_parent(const Link& link, const Matrix<S>& A) {
        const Matrix<S> T = link.slides ? A : turned(2, link.cosine, link.sine, A);
        return link.about_x ? turned(0, link.R[1][1], link.R[2][1], T) : congruent(link.R, T);
    }
    /// tr(X) v − X v
    static Vector rest_of_trace(const Matrix<S>& X, const Vector& v) {
        Vector result;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            result[i] = (X[j][j] + X[k][k]) * v[i] - X[i][j] * v[j] - X[i][k] * v[k];
        }
        return result;
    }
    /// The wrench of the forces a dm, a = s + σ × r.
    static Wrench<S> inertial(const RigidBody<S>& b, const Twist& a) {
        return {rest_of_trace(full(b.second), a.sigma) + cross(b.first, a.s),
                b.mass * a.s + cross(a.sigma, b.first)};
    }
    /// The wrench of the forces σ × 2u dm.
    static Wrench<S> turning(const Whole& whole, const Vector& sigma) {
        return {rest_of_trace(whole.X, sigma), cross(sigma, whole.l)};
    }
    static Wrench<S> sum(const Wrench<S>& a, const Wrench<S>& b) { return {a.n + b.n, a.f + b.f}; }
    static S product(const Wrench<S>& w, const Twist& t) { return dot(t.sigma, w.n) + dot(t.s, w.f); }

    /// Twice the velocities of each link's origin, from the ground and from the parent's origin, and what its own
    /// body has.
    void outwards() {
        for (int j = 0; j < tree_.size(); ++j) {
            const Link& link = tree_.links[j];
            arms_.push_back(tree_.arm(link));
            twice_w_.push_back(bias_.motions[j].w + bias_.motions[j].w);
            Vector step = link.parent < 0 ? no_vector<S>() : cross(twice_w_[link.parent], arms_[j]);
            if (link.slides) step = step + S(2) * (link.R * (link.rate * link.slide));
            steps_.push_back(step);
            twice_v_.push_back(tree_.from_parent(link, link.parent < 0 ? step : twice_v_[link.parent] + step));
            const RigidBody<S> body = tree_.body(link);
            wholes_.push_back({body, cross(twice_w_[j], body.first), tilde_times(twice_w_[j], full(body.second))});
        }
    }

    void inwards() {
        for (int j = tree_.size() - 1; j >= 0; --j) {
            const Link& link = tree_.links[j];
            if (link.parent < 0) continue;
            const auto& [body, l, X] = wholes_[j];
            Whole& parent = wholes_[link.parent];
            RigidBody<S> up{.mass = body.mass,
                            .first = tree_.outward_to_parent(link, body.first),
                            .second = tree_.outward_to_parent(link, body.second)};
            up = shifted(up, arms_[j]);
            parent.body = parent.body + up;
            const Vector turned_l = tree_.outward_to_parent(link, l);
            const Matrix<S> turned_X = to_parent(link, X);
            for (int i = 0; i < 3; ++i)
                parent.X[i] = parent.X[i] + turned_X[i] + turned_l[i] * arms_[j] + steps_[j][i] * up.first;
            parent.l = parent.l + turned_l + up.mass * steps_[j];
        }
    }

    /// From the common link to the ground, and from there outwards. Other trees on the ground meet along its axes.
    void place(int common) {
        places_.resize(wholes_.size());
        std::vector<char> known(wholes_.size(), 0);
        for (int j = common; j >= 0; j = tree_.links[j].parent) {
            known[j] = 1;
            const Link& link = tree_.links[j];
            if (link.parent < 0) break;
            Place& parent = places_[link.parent];
            parent.axes = places_[j].axes;
            if (!link.slides)
                for (Vector& row : parent.axes) row = turned_about_z(link.cosine, link.sine, row);
            parent.axes = parent.axes * transposed(link.R);
            parent.origin = places_[j].origin - parent.axes * arms_[j];
        }
        for (int j = 0; j < tree_.size(); ++j) {
            if (known[j]) continue;
            const Link& link = tree_.links[j];
            const Place parent = link.parent < 0 ? Place{} : places_[link.parent];
            places_[j] = {parent.axes * link.R, parent.origin + parent.axes * arms_[j]};
            if (!link.slides)
                for (Vector& row : places_[j].axes) row = turned_back(link.cosine, link.sine, row);
        }
    }

    Ways ways_of(int i) const {
        const Link& link = tree_.links[i];
        const LinkMotion<S>& m = bias_.motions[i];
        Ways ways;
        if (link.slides) {
            const Vector s = tree_.direction(link);
            ways.own.s = s;
            ways.first.s = cross(m.w, s);
            ways.twice.s = cross(twice_w_[i], s);
            ways.second.s = m.turning() * s;
        } else {
            const Vector z{S(0), S(0), S(1)};
            ways.own.sigma = z;
            ways.first.sigma = cross(m.w, z);
            ways.twice.sigma = cross(twice_w_[i], z);
            ways.second = {m.turning() * z, cross(m.a, z)};
        }
        return ways;
    }

    /// The entries of joint i with itself and with those between it and the ground.
    void meet(int i) {
        const Link& link = tree_.links[i];
        const Place& at = places_[i];
        const Whole& whole = wholes_[i];
        const Ways ways = ways_of(i);
        const Vector &v = twice_v_[i], &sigma = ways.own.sigma, &s = ways.own.s;
        const Wrench<S>& f = wrenches_[i];
        const Wrench<S> u = inertial(whole.body, ways.own),
                        by_rate = sum(inertial(whole.body, ways.twice), turning(whole, sigma)),
                        by_position = sum(sum(inertial(whole.body, ways.second), turning(whole, ways.first.sigma)),
                                          {cross(sigma, f.n) + cross(s, f.f), cross(sigma, f.f)});
        position[i][i] = along_joint(tree_, link, by_position);
        rate[i][i] = along_joint(tree_, link, by_rate);
        // From here on velocities count from the ground.
        ways_.push_back({at.of(ways.own),
                         {at.axes * ways.first.sigma, no_vector<S>()},
                         at.of(Twist{ways.twice.sigma, ways.twice.s + cross(v, sigma)}),
                         at.of(Twist{ways.second.sigma, ways.second.s + cross(v, ways.first.sigma)})});
        if (link.parent < 0) return;
        const Vector r = at.axes * (rest_of_trace(transposed(whole.X), sigma) + cross(whole.l, s) + cross(v, u.f));
        const Wrench<S> row = at.of(u), position_column = at.of(by_position), rate_column = at.of(by_rate);
        for (int j = link.parent; j >= 0; j = tree_.links[j].parent) {
            const Ways& other = ways_[j];
            position[i][j] = dot(r, other.first.sigma) + product(row, other.second);
            rate[i][j] = dot(r, other.own.sigma) + product(row, other.twice);
            position[j][i] = product(position_column, other.own);
            rate[j][i] = product(rate_column, other.own);
        }
    }

    const BodyTree<S>& tree_;
    Bias<S> bias_;
    std::vector<Wrench<S>> wrenches_;
    std::vector<Vector> arms_, twice_w_, twice_v_, steps_;
    std::vector<Whole> wholes_;
    std::vector<Place> places_;
    std::vector<Ways> ways_;  // along the common axes
};

}  // namespace alembert
