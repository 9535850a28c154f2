// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The accelerations of a planar chain of links, from both of its ends at once.
///
///     const std::vector<double> wdot = from_both_ends(tree, Q);      // for trees that are one: is_planar_chain
///
/// Rates count from the ground. Link j has the polar second moment J_j and the first moment h_j about its origin,
/// r_j leads from there to the origin of the next link, Ω_j r_j is the acceleration of r_j at w' = `bias`. Let
/// a_j be the acceleration of the origin less gravity, p_j the rate of momentum of all links from j on, and x = w'
/// − `bias`. If a, p and Ω r are turned back by a right angle, so that x_j r_j stands for ẑ × r_j x_j,
///
///     J_j x_j + h_j · a_j + r_j · p_{j+1} = Q_j − J_j drift_j,
///     a_{j+1} = a_j + Ω_j r_j + r_j x_j,     p_j = p_{j+1} + m_j a_j + Ω_j h_j + h_j x_j.
///
/// If the links from j + 1 on have been eliminated, p_{j+1} = w + X a_{j+1} with the articulated mass X. Then
///
///     c = h_j + X r_j,   D = J_j + r_j · X r_j,   x_j = (Q_j − J_j drift_j − r_j · (w + X Ω_j r_j) − c · a_j)/D,
///
/// and p_j has the articulated mass X + m_j − c cᵀ/D, which is positive: own masses and those of the links beyond
/// are added, so that nothing large cancels. This is the recursion over articulated bodies (Featherstone 2008,
/// chapter 7). The links of the inner half are eliminated from the ground instead, each with a_{j+1} = w + Y
/// p_{j+1}. This is the same recursion with r and h exchanged, if the m_j are 0; so there mass is assigned to the
/// parent, from the last link of the half on. In this half D is a difference of moments of all that the link
/// carries, and the larger these are, the more digits are lost. So the half carries its own mass and, at its end,
/// an eighth of the mass beyond, which is taken away from X again: without any, a light link at the end would be
/// shaken by forces that in truth move the heavy links beyond. In the middle remain
///
///     p = p₀ + X a,   a = a₀ + Y p,
///
/// and then each half is solved outwards from there. The number of operations is that of elimination from one end,
/// but each half waits for half as many divisions.
/// (For tridiagonal matrices this is the twisted factorization: Meurant, SIAM J. Matrix Anal. Appl. 13 (1992) 707,
/// section 2.)

#include "model/formalism/tree_recursions.hpp"

namespace alembert {

/// One half of the chain: the eliminated links, and the quantities that remain.
template <typename S>
struct ChainHalf {
    using Vector = std::array<S, 2>;
    struct Link {
        int index;
        Vector u, v;  ///< u couples it with the links that are eliminated after it, v with those before
        Vector swung_u, swung_v;  ///< Ω u, Ω v
        S mass, J, load;
    };
    ChainHalf(const std::vector<Link>& links, Vector start) : w(std::move(start)) {
        for (const Link& link : links) {
            const auto& [xx, yy, xy] = Z;
            const auto& [a, b] = link.v;
            const Vector c{link.u[0] + xx * a + xy * b, link.u[1] + xy * a + yy * b};
            const S D = link.J + (a * a) * xx + (b * b) * yy + (a * b) * (xy + xy), inverse = S(1) / D;
            w = plus(w,
                     {xx * link.swung_v[0] + xy * link.swung_v[1], xy * link.swung_v[0] + yy * link.swung_v[1]});
            const S f = link.load - (a * w[0] + b * w[1]);
            Z = {xx - inverse * (c[0] * c[0]) + link.mass, yy - inverse * (c[1] * c[1]) + link.mass,
                 xy - inverse * (c[0] * c[1])};
            const Vector over{c[0] * inverse, c[1] * inverse};
            w = plus({w[0] + over[0] * f, w[1] + over[1] * f}, link.swung_u);
            eliminated.push_back({link.index, over, link.v, link.swung_v, inverse * f});
        }
    }
    /// x of these links, if the other half contributes `s`.
    void solve(Vector s, std::vector<S>& result) const {
        for (auto link = eliminated.rbegin(); link != eliminated.rend(); ++link) {
            const S x = link->f - (link->over[0] * s[0] + link->over[1] * s[1]);
            result[link->index] = x;
            s = plus({s[0] + link->v[0] * x, s[1] + link->v[1] * x}, link->swung_v);
        }
    }
    static Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1]}; }

    struct Eliminated {
        int index;
        Vector over, v, swung_v;
        S f;
    };
    std::vector<Eliminated> eliminated;
    std::array<S, 3> Z{S(0), S(0), S(0)};  ///< xx yy xy
    Vector w;
};

/// w' − `bias`. The masses of the tree must be those of its links, not regrouped.
template <typename S>
std::vector<S> from_both_ends(const BodyTree<S>& tree, const std::vector<S>& Q) {
    const int n = tree.size();
    const int inner = n / 2 + n / 16;  // the inner half is longer, because its angles are sums of fewer terms
    S carried = S(0);                  // μ
    for (int j = inner; j < n; ++j) carried = carried + tree.links[j].body.mass;
    carried = (S(1) / S(8)) * carried;
    BodyTree<S> lean = tree;
    RigidBody<S>& last = lean.links[inner - 1].body;
    last = last + shifted(RigidBody<S>{.mass = carried}, lean.links[inner].p);
    lean = regrouped(std::move(lean), inner);
    const auto in_plane = [](const Triple<S>& v) { return std::array<S, 2>{v[0], v[1]}; };
    const auto turned_back = [](const Triple<S>& v) { return std::array<S, 2>{v[1], -v[0]}; };  // by a right angle
    std::vector<typename ChainHalf<S>::Link> from_ground, from_tip;
    for (int j = 0; j < n; ++j) {
        const TreeLink<S>& link = lean.links[j];
        const RigidBody<S> b = lean.body(link);
        const Triple<S> r = j + 1 < n ? lean.arm(lean.links[j + 1]) : no_vector<S>();
        const Matrix<S> O = LinkMotion<S>{.w = {S(0), S(0), link.rate}, .e = {S(0), S(0), link.bias}}.turning();
        const auto arm = in_plane(r), moment = in_plane(b.first);
        const auto swung_arm = turned_back(O * r), swung_moment = turned_back(O * b.first);
        const S load = Q[j] - b.polar * link.bias;
        if (j < inner)
            from_ground.push_back({j, arm, moment, swung_arm, swung_moment, S(0), b.polar, load});
        else
            from_tip.insert(from_tip.begin(), {j, moment, arm, swung_moment, swung_arm, b.mass, b.polar, load});
    }
    const ChainHalf<S> first(from_ground, turned_back(lean.from_parent(lean.links[0], -lean.gravity))),
        second(from_tip, {S(0), S(0)});
    const S Xxx = second.Z[0] - carried, Xyy = second.Z[1] - carried, Xxy = second.Z[2];
    const auto& [Yxx, Yyy, Yxy] = first.Z;
    // (1 − X Y) p = p₀ + X a₀
    const S a = S(1) - (Xxx * Yxx + Xxy * Yxy), b = -(Xxx * Yxy + Xxy * Yyy);
    const S c = -(Xxy * Yxx + Xyy * Yxy), d = S(1) - (Xxy * Yxy + Xyy * Yyy);
    const S inverse = S(1) / (a * d - b * c);
    const S left = second.w[0] + (Xxx * first.w[0] + Xxy * first.w[1]),
            right = second.w[1] + (Xxy * first.w[0] + Xyy * first.w[1]);
    const std::array<S, 2> p{(d * left - b * right) * inverse, (a * right - c * left) * inverse};
    const std::array<S, 2> r{first.w[0] + (Yxx * p[0] + Yxy * p[1]), first.w[1] + (Yxy * p[0] + Yyy * p[1])};
    std::vector<S> result(static_cast<std::size_t>(n), S(0));
    first.solve(p, result);
    second.solve(r, result);
    return result;
}

}  // namespace alembert
