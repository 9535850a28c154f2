// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A tree of bodies for any scalar (spatial.hpp), with components passed from link to link.
///
///     const BodyTree<double> tree = regrouped(bare_tree);
///     tree.outward_to_parent(tree.links[2], v);                 // along the axes of its parent
///
/// A joint has one rate w: it turns about the z axis of its link, or shifts along `slide`, on a line or on a
/// curve. A joint with more freedom becomes several joints, with massless links between them. All vectors are
/// physical vectors, and accelerations are those of points. Therefore components may be taken along any axes:
/// along axes that turn with the link or, in a chain of parallel axes, along axes that do not turn (`still`). In
/// the latter case a transformation is only a shift, and the chain's angles add up. The gravity field is an
/// acceleration −g of the ground.
///
/// A body is described by its mass m, first moment h = m c and second moments P = ∫ r rᵀ dm about the link's
/// origin. A shift by r changes h to h + m r and P to P + r kᵀ + k rᵀ, with k = h + m r/2.

#include <type_traits>
#include <vector>

#include "model/formalism/spatial.hpp"

namespace alembert {

template <typename S>
struct RigidBody {
    S mass = S(0);
    Triple<S> first = no_vector<S>();
    Symmetric<S> second = no_matrix<S>();
    S polar = S(0);  ///< xx + yy of `second`, which is invariant under turns about z
};

template <typename S>
struct TreeLink {
    int parent = -1;  ///< −1: the ground
    bool slides = false;
    bool of_ball = false;  ///< whether it is one of three joints of a ball joint; R of the first changes with time
    Matrix<S> R{Triple<S>{S(1), S(0), S(0)}, Triple<S>{S(0), S(1), S(0)}, Triple<S>{S(0), S(0), S(1)}};
    Triple<S> p = no_vector<S>();  ///< R, p: the link's axes and origin in the parent's own axes when the joint is
                                   ///< at 0; constant
    Triple<S> slide = no_vector<S>();  ///< the direction of a sliding link, in its own axes; constant on a line
    bool has_rotor = false;
    S rotor = S(0);       ///< the inertia about or along the joint of what moves with w alone; a motor
    RigidBody<S> body{};  ///< along the link's own axes; constant

    bool about_x = false;  ///< whether R is a turn about x
    S angle = S(0), cosine = S(1),
      sine = S(0);                ///< of the joint's angle, or of the sum of angles if `still`
    S shift = S(0), rate = S(0);  ///< displacement of the joint, in units of `slide`; w
    S bias = S(0);                ///< w' at q'' = 0
    /// Of a link that slides along a curve, in its own axes: its displacement, whose derivative is `slide`, and
    /// the second time derivative of the displacement at w' = 0.
    Triple<S> way = no_vector<S>(), bend = no_vector<S>();
    bool still = false;      ///< whether components are along axes that do not turn with the link,
    bool continues = false;  ///< … and whether these axes are also the parent's
    /// Whether w counts from the ground, so that neighbours exchange nothing about turns about z.
    bool absolute = false;
};

template <typename S>
struct Wrench {
    Triple<S> n = no_vector<S>(), f = no_vector<S>();  ///< about the link's origin
};

template <typename S>
struct BodyTree {
    std::vector<TreeLink<S>> links;      ///< parents come first
    Triple<S> gravity = no_vector<S>();  ///< along the ground's axes

    int size() const { return static_cast<int>(links.size()); }
    bool parent_is_still(const TreeLink<S>& link) const { return link.parent >= 0 && links[link.parent].still; }

    /// Converts components along the link's axes to components along its parent's.
    template <typename V>
    V outward_to_parent(const TreeLink<S>& link, V v) const {
        if (!link.still && !link.slides) v = turned_about_z(link.cosine, link.sine, v);
        if (link.continues) return v;
        if constexpr (std::is_same_v<V, Triple<S>>)
            v = link.R * v;
        else
            v = turned_by_constant(link, v);
        if (parent_is_still(link)) v = turned_about_z(links[link.parent].cosine, links[link.parent].sine, v);
        return v;
    }
    static Symmetric<S> turned_by_constant(const TreeLink<S>& link, const Symmetric<S>& A) {
        return link.about_x ? turned_about_x(link.R[1][1], link.R[2][1], A) : congruent(link.R, A);
    }
    static Matrix<S> turned_by_constant(const TreeLink<S>& link, const Matrix<S>& A) {
        return congruent(link.R, A);
    }
    Triple<S> from_parent(const TreeLink<S>& link, Triple<S> v) const {
        if (!link.continues) {
            if (parent_is_still(link)) v = turned_back(links[link.parent].cosine, links[link.parent].sine, v);
            v = transposed(link.R) * v;
        }
        return link.still || link.slides ? v : turned_back(link.cosine, link.sine, v);
    }
    /// The vector from the parent's origin to the link's, along the parent's axes.
    Triple<S> arm(const TreeLink<S>& link) const {
        const Triple<S> r = link.slides ? link.p + link.R * (link.shift * link.slide + link.way) : link.p;
        return parent_is_still(link) ? turned_about_z(links[link.parent].cosine, links[link.parent].sine, r) : r;
    }
    /// Converts components along the link's own axes to components along the axes that are used for it.
    template <typename V>
    V along_axes(const TreeLink<S>& link, const V& v) const {
        return link.still ? turned_about_z(link.cosine, link.sine, v) : v;
    }
    Triple<S> direction(const TreeLink<S>& link) const { return along_axes(link, link.slide); }
    RigidBody<S> body(const TreeLink<S>& link) const {
        RigidBody<S> b = link.body;
        b.polar = b.second[0] + b.second[1];
        b.first = along_axes(link, b.first);
        b.second = along_axes(link, b.second);
        return b;
    }
};

template <typename S>
RigidBody<S> shifted(RigidBody<S> b, const Triple<S>& r) {
    const Triple<S> mr = b.mass * r, k = b.first + (S(1) / S(2)) * mr;
    for (int i = 0; i < 3; ++i) {
        const S both = r[i] * k[i];
        b.second[i] = b.second[i] + (both + both);
        const int j = (i + 1) % 3;
        b.second[place(i, j)] = b.second[place(i, j)] + (r[i] * k[j] + k[i] * r[j]);
    }
    const S inplane = r[0] * k[0] + r[1] * k[1];
    b.polar = b.polar + (inplane + inplane);
    b.first = b.first + mr;
    return b;
}

template <typename S>
RigidBody<S> operator+(const RigidBody<S>& a, const RigidBody<S>& b) {
    return {a.mass + b.mass, a.first + b.first, a.second + b.second, a.polar + b.polar};
}

/// A tree with the same motion but fewer inertia parameters: mass on the axis of a turning joint can be assigned
/// to the parent, and so can all second moments of a sliding body, because turning (sliding) does not move them
/// relative to the parent (Gautier & Khalil, IEEE Trans. Robotics and Automation 6 (1990) 368: base parameters).
/// There remain xx yy xy yz zx of P, and the components of h perpendicular to the axis. Only the links before
/// `end` are changed.
template <typename S>
BodyTree<S> regrouped(BodyTree<S> tree, int end) {
    for (int j = end - 1; j >= 0; --j) {
        TreeLink<S>& link = tree.links[j];
        RigidBody<S> moved;
        if (link.slides) {
            moved.second = link.body.second;
            link.body.second = no_matrix<S>();
        } else if (link.of_ball) {
            moved.mass = link.body.mass;
            link.body.mass = S(0);
        } else {
            moved.mass = link.body.mass;
            moved.first[2] = link.body.first[2];
            moved.second[2] = link.body.second[2];
            link.body.mass = link.body.first[2] = link.body.second[2] = S(0);
        }
        if (link.parent < 0) continue;
        moved.first = link.R * moved.first;
        moved.second = congruent(link.R, moved.second);
        if (!link.slides) moved = shifted(moved, link.p);
        RigidBody<S>& parent = tree.links[link.parent].body;
        parent = parent + moved;
    }
    return tree;
}
template <typename S>
BodyTree<S> regrouped(const BodyTree<S>& tree) {
    return regrouped(tree, tree.size());
}

}  // namespace alembert
