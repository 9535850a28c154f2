// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The accelerations of a tree of bodies by articulated inertias, in a number of operations linear in bodies, for
/// any scalar:
///
///     articulated_bodies(tree, bias.wrenches, Q)     // w' of M w' = Q − n, n = joint_loads(tree, bias.wrenches)
///
/// (Featherstone, Rigid Body Dynamics Algorithms (2008), chapter 7.)

#include <vector>

#include "model/formalism/tree_recursions.hpp"

namespace alembert {

/// The articulated inertia of a body and all links that are attached to it: n = A ε + B a, f = Bᵀ ε + C a.
template <typename S>
struct Articulated {
    Symmetric<S> A = no_matrix<S>(), C = no_matrix<S>();
    Matrix<S> B{no_vector<S>(), no_vector<S>(), no_vector<S>()};
};

template <typename S>
Articulated<S> articulated(const RigidBody<S>& b) {
    const Symmetric<S>& P = b.second;
    const Triple<S>& h = b.first;
    return {.A = {P[1] + P[2], P[2] + P[0], b.polar, -P[3], -P[4], -P[5]},
            .C = {b.mass, b.mass, b.mass, S(0), S(0), S(0)},
            .B = {Triple<S>{S(0), -h[2], h[1]}, Triple<S>{h[2], S(0), -h[0]}, Triple<S>{-h[1], h[0], S(0)}}};
}

/// w' of M w' + joint_loads(wrenches) = Q. Inwards: U = I s, D = s·U; I − U Uᵀ/D and the wrench plus U (Q −
/// s·wrench)/D are passed to the parent. The inertia of a rotor is added to D. Outwards: w' = (Q − s·wrench −
/// U·acceleration)/D. A turning joint without a rotor passes Q and no inertia about its axis; these are set
/// exactly, not computed.
template <typename S>
struct ArticulatedBodies {
    ArticulatedBodies(const BodyTree<S>& tree, std::vector<Wrench<S>> wrenches, const std::vector<S>& Q);
    std::vector<S> accelerations() const;

    const BodyTree<S>& tree;
    /// What is passed inwards, before the shift, I − U Uᵀ/D; of a link on the ground I itself.
    std::vector<Articulated<S>> I = {};
    std::vector<Wrench<S>> U;       ///< U/D
    std::vector<S> inverses, free;  ///< 1/D, (Q − s·wrench)/D
    std::vector<Triple<S>> arms;
};

template <typename S>
ArticulatedBodies<S>::ArticulatedBodies(const BodyTree<S>& t, std::vector<Wrench<S>> wrenches,
                                        const std::vector<S>& Q)
    : tree(t), U(Q.size()), inverses(Q.size(), S(0)), free(Q.size(), S(0)), arms(Q.size(), no_vector<S>()) {
    const int n = tree.size();
    for (const TreeLink<S>& link : tree.links) I.push_back(articulated(tree.body(link)));
    for (int j = n - 1; j >= 0; --j) {
        const TreeLink<S>& link = tree.links[j];
        Articulated<S>& own = I[j];
        Wrench<S>& w = wrenches[j];
        Wrench<S> column;
        if (link.slides) {
            const Triple<S> s = tree.direction(link);
            column = {own.B * s, own.C * s};
        } else {
            column = {{own.A[5], own.A[4], own.A[2]}, own.B[2]};
        }
        const S u = Q[j] - along_joint(tree, link, w);
        const S own_inertia = along_joint(tree, link, column);
        const S inverse = inverses[j] = S(1) / (link.has_rotor ? own_inertia + link.rotor : own_inertia);
        free[j] = u * inverse;
        U[j] = {inverse * column.n, inverse * column.f};
        if (link.parent < 0) continue;
        // x y/D. In a chain of parallel axes the product does not wait for the division; elsewhere that would take
        // too many operations.
        const auto over = [&](const S& x, const S& x_D, const S& y) {
            return link.still ? (x * y) * inverse : x_D * y;
        };
        for (int i = 0; i < 3; ++i) {
            for (int k = i; k < 3; ++k) {
                S& a = own.A[place(i, k)];
                a = a - over(column.n[i], U[j].n[i], column.n[k]);
                S& c = own.C[place(i, k)];
                c = c - over(column.f[i], U[j].f[i], column.f[k]);
            }
            for (int k = 0; k < 3; ++k) own.B[i][k] = own.B[i][k] - over(column.n[i], U[j].n[i], column.f[k]);
        }
        w = {w.n + u * U[j].n, w.f + u * U[j].f};
        if (!link.slides && !link.has_rotor) {
            own.A[2] = own.A[4] = own.A[5] = own.B[2][0] = own.B[2][1] = own.B[2][2] = S(0);
            w.n[2] = Q[j];
        }
        const Wrench<S> on = passed(tree, link, w);
        Wrench<S>& parent_wrench = wrenches[link.parent];
        parent_wrench = {parent_wrench.n + on.n, parent_wrench.f + on.f};
        // Tᵀ I T of the shift by r: B + r̃ C, A + r̃ Bᵀ − (B + r̃ C) r̃
        Symmetric<S> A = tree.outward_to_parent(link, own.A), C = tree.outward_to_parent(link, own.C);
        Matrix<S> B = tree.outward_to_parent(link, own.B);
        const Triple<S> r = arms[j] = tree.arm(link);
        const Matrix<S> first = tilde_times(r, transposed(B));
        const Matrix<S> rC = tilde_times(r, full(C));
        for (int i = 0; i < 3; ++i) B[i] = B[i] + rC[i];
        const Matrix<S> second = tilde_times(r, transposed(B));  // −((B + r̃ C) r̃)ᵀ
        Articulated<S>& parent = I[link.parent];
        for (int i = 0; i < 3; ++i)
            for (int k = i; k < 3; ++k) {
                S& a = parent.A[place(i, k)];
                // The element about the axis is computed separately, without waiting for B, because first[2][2] is
                // 0.
                const bool direct = link.absolute && i == 2;
                const S shift = direct
                                    ? (r[0] * r[0]) * C[1] + (r[1] * r[1]) * C[0] - (r[0] * r[1]) * (C[3] + C[3])
                                    : first[i][k] + second[k][i];
                a = a + A[place(i, k)] + shift;
            }
        parent.C = parent.C + C;
        for (int i = 0; i < 3; ++i) parent.B[i] = parent.B[i] + B[i];
    }
}

template <typename S>
std::vector<S> ArticulatedBodies<S>::accelerations() const {
    std::vector<Triple<S>> e, a;
    std::vector<S> result;
    for (int j = 0; j < tree.size(); ++j) {
        const TreeLink<S>& link = tree.links[j];
        Triple<S> epsilon = no_vector<S>(), acceleration = no_vector<S>();
        if (link.parent >= 0) {
            epsilon = tree.from_parent(link, e[link.parent]);
            acceleration = tree.from_parent(link, a[link.parent] + cross(e[link.parent], arms[j]));
        }
        if (link.slides || link.has_rotor) {
            const S rate = free[j] - (dot(U[j].n, epsilon) + dot(U[j].f, acceleration));
            if (link.slides)
                acceleration = acceleration + rate * tree.direction(link);
            else
                epsilon[2] = epsilon[2] + rate;
            result.push_back(rate);
        } else {  // U_z/D = 1, so the result is the whole of ε_z
            const S whole =
                free[j] - (U[j].n[0] * epsilon[0] + U[j].n[1] * epsilon[1] + dot(U[j].f, acceleration));
            result.push_back(link.absolute ? whole : whole - epsilon[2]);
            epsilon[2] = whole;
        }
        e.push_back(epsilon);
        a.push_back(acceleration);
    }
    return result;
}

template <typename S>
std::vector<S> articulated_bodies(const BodyTree<S>& tree, std::vector<Wrench<S>> wrenches,
                                  const std::vector<S>& Q) {
    return ArticulatedBodies<S>(tree, std::move(wrenches), Q).accelerations();
}

}  // namespace alembert
