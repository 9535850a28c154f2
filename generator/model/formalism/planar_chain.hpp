// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Solves M w' = f for a planar chain of links, from both of its ends at once.
///
///     // f = Q − n; for trees that are one: is_planar_chain
///     const std::vector<double> wdot = from_both_ends(tree, f);
///
/// With rates from the ground and regrouped bodies (recursion.hpp), M_ij = r_i · h_j for i < j and M_jj = J_j: r_i
/// leads from link i's origin to the next one's, h_j is link j's first moment, J_j its polar second moment.
/// Eliminating the last link leaves a matrix of this kind,
///     h_b → c_b = h_b + X r_b,   J_b → D_b = J_b + r_b · X r_b,   X ← X − c_b c_bᵀ / D_b,
/// which is the recursion over articulated bodies. Eliminating the first link also leaves a matrix of this kind,
/// with r and h exchanged. Each half of the chain is eliminated from its own end, so that each waits for half as
/// many divisions. In the middle remain two equations with two unknowns,
///     p = Σ h_b w'_b over the outer half = p₀ + X r,   r = Σ r_a w'_a over the inner half = r₀ + Y p,
/// and then each half is solved outwards from there. The number of operations is that of elimination from one end.
/// (For tridiagonal matrices this is the twisted factorization: Meurant, SIAM J. Matrix Anal. Appl. 13 (1992) 707,
/// section 2.) J and D are positive because M is definite.

#include "model/formalism/body_tree.hpp"

namespace alembert {

/// One half of the chain: the eliminated links, and the quantities that remain.
template <typename S>
struct ChainHalf {
    struct Link {
        int index;
        std::array<S, 2> u, v;  ///< u couples it with the links that are eliminated after it, v with those before
        S J, f;
    };
    explicit ChainHalf(const std::vector<Link>& links) {
        for (const Link& link : links) {
            const auto& [xx, yy, xy] = Z;
            const auto& [a, b] = link.v;
            const std::array<S, 2> c{link.u[0] + xx * a + xy * b, link.u[1] + xy * a + yy * b};
            const S D = link.J + (a * a) * xx + (b * b) * yy + (a * b) * (xy + xy), inverse = S(1) / D;
            const S f = link.f - (a * w[0] + b * w[1]);
            Z = {xx - inverse * (c[0] * c[0]), yy - inverse * (c[1] * c[1]), xy - inverse * (c[0] * c[1])};
            const std::array<S, 2> over{c[0] * inverse, c[1] * inverse};
            w = {w[0] + over[0] * f, w[1] + over[1] * f};
            eliminated.push_back({link.index, over, link.v, inverse * f});
        }
    }
    /// w' of these links, if the other half contributes `s`.
    void solve(std::array<S, 2> s, std::vector<S>& result) const {
        for (auto link = eliminated.rbegin(); link != eliminated.rend(); ++link) {
            const S x = link->f - (link->over[0] * s[0] + link->over[1] * s[1]);
            result[link->index] = x;
            s = {s[0] + link->v[0] * x, s[1] + link->v[1] * x};
        }
    }
    struct Eliminated {
        int index;
        std::array<S, 2> over, v;
        S f;
    };
    std::vector<Eliminated> eliminated;
    std::array<S, 3> Z{S(0), S(0), S(0)};  ///< xx yy xy
    std::array<S, 2> w{S(0), S(0)};
};

/// `tree` must be regrouped, and f_j = Q_j − n_j.
template <typename S>
std::vector<S> from_both_ends(const BodyTree<S>& tree, const std::vector<S>& f) {
    const int n = tree.size();
    const int inner = n / 2 + n / 16;  // the inner half is longer, because its angles are sums of fewer terms
    std::vector<typename ChainHalf<S>::Link> from_ground, from_tip;
    for (int j = 0; j < n; ++j) {
        const RigidBody<S> b = tree.body(tree.links[j]);
        const Triple<S> r = j + 1 < n ? tree.arm(tree.links[j + 1]) : no_vector<S>();
        const std::array<S, 2> arm{r[0], r[1]}, moment{b.first[0], b.first[1]};
        if (j < inner)
            from_ground.push_back({j, arm, moment, b.polar, f[j]});
        else
            from_tip.insert(from_tip.begin(), {j, moment, arm, b.polar, f[j]});
    }
    const ChainHalf<S> first(from_ground), second(from_tip);
    const auto& [Xxx, Xyy, Xxy] = second.Z;
    const auto& [Yxx, Yyy, Yxy] = first.Z;
    // (1 − X Y) p = p₀ + X r₀
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
