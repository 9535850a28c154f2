// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Recursions from body to body along a tree, written once for any scalar (spatial.hpp):
///
///     const BodyTree<double> tree = regrouped(bare_tree);
///     const Bias<double> bias(tree);                                    // Newton-Euler, outwards, at w' = 0
///     const auto n = joint_loads(tree, bias.wrenches);                  // … and inwards: M w' + n = Q
///     const auto M = composite_bodies(tree);                            // rows by joint, lower triangle
///     // M w' = Q − n in a number of operations linear in bodies
///     const auto wdot = articulated_bodies(tree, bias.wrenches, Q);
///
/// (Featherstone, Rigid Body Dynamics Algorithms (2008), chapters 5 to 7; Walker & Orin 1982; Luh, Walker & Paul
/// 1980.) A joint has one rate w: it turns about the z axis of its link, or shifts along `slide`. A joint with
/// more freedom becomes several joints, with massless links between them. All vectors are physical vectors, and
/// accelerations are those of points. Therefore components may be taken along any axes: along axes that turn with
/// the link or, in a chain of parallel axes, along axes that do not turn (`still`). In the latter case a
/// transformation is only a shift, and the chain's angles add up. The gravity field is an acceleration −g of the
/// ground.
///
/// A body is described by its mass m, first moment h = m c and second moments P = ∫ r rᵀ dm about the link's
/// origin, so that
///     f = m a + Ω h,   n = h × a + vee(Ω P),   Ω = ε̃ + ω̃ ω̃,   vee(X) = (X₃₂ − X₂₃, X₁₃ − X₃₁, X₂₁ − X₁₂),
/// and a shift by r changes h to h + m r and P to P + r kᵀ + k rᵀ, with k = h + m r/2.

#include <type_traits>
#include <vector>

#include "formalism/spatial.hpp"

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
    Triple<S> slide = no_vector<S>();  ///< the direction of a sliding link, in its own axes; constant
    bool has_rotor = false;
    S rotor = S(0);       ///< the inertia about or along the joint of what moves with w alone; a motor
    RigidBody<S> body{};  ///< along the link's own axes; constant

    bool about_x = false;  ///< whether R is a turn about x
    S angle = S(0), cosine = S(1),
      sine = S(0);                ///< of the joint's angle, or of the sum of angles if `still`
    S shift = S(0), rate = S(0);  ///< displacement of the joint, in units of `slide`; w
    S drift = S(0);               ///< w' at q'' = 0
    bool still = false;           ///< whether components are along axes that do not turn with the link,
    bool continues = false;       ///< … and whether these axes are also the parent's
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
        const Triple<S> r = link.slides ? link.p + link.R * (link.shift * link.slide) : link.p;
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
/// There remain xx yy xy yz zx of P, and the components of h perpendicular to the axis.
template <typename S>
BodyTree<S> regrouped(BodyTree<S> tree) {
    for (int j = tree.size() - 1; j >= 0; --j) {
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

/// How a link moves: ω, ε and the acceleration of its origin.
template <typename S>
struct LinkMotion {
    Triple<S> w = no_vector<S>(), e = no_vector<S>(), a = no_vector<S>();

    /// Ω = ε̃ + ω̃ ω̃
    Matrix<S> turning() const {
        const S xx = w[0] * w[0], yy = w[1] * w[1], zz = w[2] * w[2];
        const S xy = w[0] * w[1], yz = w[1] * w[2], zx = w[2] * w[0];
        return {Triple<S>{-(yy + zz), xy - e[2], zx + e[1]}, Triple<S>{xy + e[2], -(zz + xx), yz - e[0]},
                Triple<S>{zx - e[1], yz + e[0], -(xx + yy)}};
    }
};

/// The motion of a link at w' = `drift`, from that of its parent and the parent's Ω.
///     ω_j = ω_i + w z,   ε_j = ε_i + ω_i × w z + w'₀ z,   a_j = a_i + Ω_i r;   sliding: a_j + 2 ω × w s + w'₀ s
template <typename S>
LinkMotion<S> motion_of(const BodyTree<S>& tree, const TreeLink<S>& link, const LinkMotion<S>* parent,
                        const Matrix<S>* turning) {
    LinkMotion<S> m{.a = -tree.gravity};
    if (parent != nullptr)
        m = {tree.from_parent(link, parent->w), tree.from_parent(link, parent->e),
             parent->a + *turning * tree.arm(link)};
    m.a = tree.from_parent(link, m.a);
    if (link.slides) {
        const Triple<S> s = tree.direction(link), ws = link.rate * s;
        m.a = m.a + cross(m.w + m.w, ws) + link.drift * s;
    } else if (link.absolute) {
        m.w[2] = link.rate;
        m.e[2] = link.drift;
    } else {
        m.e = {m.e[0] + m.w[1] * link.rate, m.e[1] - m.w[0] * link.rate, m.e[2] + link.drift};
        m.w[2] = m.w[2] + link.rate;
    }
    return m;
}

/// The wrench that a body needs for its motion, about the link's origin.
template <typename S>
Wrench<S> needed_wrench(const RigidBody<S>& b, const Matrix<S>& O, const Triple<S>& acceleration) {
    const Symmetric<S>& P = b.second;
    Wrench<S> force{.n = cross(b.first, acceleration), .f = b.mass * acceleration + O * b.first};
    for (int i = 0; i < 3; ++i) {  // X_kj − X_jk of X = Ω P, k and j after i
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        force.n[i] = force.n[i] + (O[k][j] * P[j] - O[j][k] * P[k] + (O[k][k] - O[j][j]) * P[place(j, k)]) +
                     (O[k][i] * P[place(i, j)] - O[j][i] * P[place(i, k)]);
    }
    return force;
}

/// The motion of every link at w' = `drift`, computed outwards, and the wrench that its body needs.
template <typename S>
struct Bias {
    explicit Bias(const BodyTree<S>& tree) {
        std::vector<Matrix<S>> turning;  // Ω
        for (const TreeLink<S>& link : tree.links) {
            const bool rooted = link.parent < 0;
            motions.push_back(motion_of(tree, link, rooted ? nullptr : &motions[link.parent],
                                        rooted ? nullptr : &turning[link.parent]));
            turning.push_back(motions.back().turning());
            wrenches.push_back(needed_wrench(tree.body(link), turning.back(), motions.back().a));
        }
    }
    std::vector<LinkMotion<S>> motions;
    std::vector<Wrench<S>> wrenches;
};

/// A wrench on the link, about its origin, converted to one on the parent.
template <typename S>
Wrench<S> passed(const BodyTree<S>& tree, const TreeLink<S>& link, const Wrench<S>& on) {
    Wrench<S> result{.n = tree.outward_to_parent(link, on.n), .f = tree.outward_to_parent(link, on.f)};
    const Triple<S> lever = cross(tree.arm(link), result.f);
    if (link.absolute) result.n[2] = S(0);
    result.n = result.n + lever;
    return result;
}

template <typename S>
S along_joint(const BodyTree<S>& tree, const TreeLink<S>& link, const Wrench<S>& w) {
    return link.slides ? dot(tree.direction(link), w.f) : w.n[2];
}

/// The wrenches that the joints must apply for these wrenches on the bodies: each with those of the links that it
/// carries.
template <typename S>
std::vector<Wrench<S>> carried_wrenches(const BodyTree<S>& tree, std::vector<Wrench<S>> wrenches) {
    for (int j = tree.size() - 1; j >= 0; --j) {
        const TreeLink<S>& link = tree.links[j];
        if (link.parent < 0) continue;
        const Wrench<S> on = passed(tree, link, wrenches[j]);
        Wrench<S>& parent = wrenches[link.parent];
        parent = {parent.n + on.n, parent.f + on.f};
    }
    return wrenches;
}

/// Their components along the joints.
template <typename S>
std::vector<S> joint_loads(const BodyTree<S>& tree, std::vector<Wrench<S>> wrenches) {
    wrenches = carried_wrenches(tree, std::move(wrenches));
    std::vector<S> loads;
    for (int j = 0; j < tree.size(); ++j) loads.push_back(along_joint(tree, tree.links[j], wrenches[j]));
    return loads;
}

/// The loads that hold the tree at rest against gravity, from the mass and the first moment h of each link with
/// all links that it carries: (h × −g)·z about an axis, −m g·s along a slide. It takes fewer operations than the
/// forces of `Bias`, because the arms are multiplied by constant masses only.
template <typename S>
std::vector<S> gravity_loads(const BodyTree<S>& tree) {
    std::vector<RigidBody<S>> whole;
    std::vector<Triple<S>> lift;  // −g along the link's axes
    for (const TreeLink<S>& link : tree.links) {
        whole.push_back(tree.body(link));
        lift.push_back(tree.from_parent(link, link.parent < 0 ? -tree.gravity : lift[link.parent]));
    }
    std::vector<S> loads(whole.size(), S(0));
    for (int j = tree.size() - 1; j >= 0; --j) {
        const TreeLink<S>& link = tree.links[j];
        const RigidBody<S>& b = whole[j];
        loads[j] = link.slides ? b.mass * dot(tree.direction(link), lift[j])
                               : b.first[0] * lift[j][1] - b.first[1] * lift[j][0];
        if (link.parent < 0) continue;
        RigidBody<S>& parent = whole[link.parent];
        // Turning the parent does not turn a link whose rate counts from the ground.
        if (!link.absolute) parent.first = parent.first + tree.outward_to_parent(link, b.first);
        parent.first = parent.first + b.mass * tree.arm(link);
        parent.mass = parent.mass + b.mass;
    }
    return loads;
}

/// For elements of M of a chain, columns can be passed inwards and the rates of the first joints outwards. This is
/// the link where it is best that the two meet: the middle of the chain, or −1 (no such link) if passing costs
/// little because axes are at right angles.
template <typename S>
int middle_of(const BodyTree<S>& tree) {
    int oblique = 0;
    for (int j = 0; j < tree.size(); ++j) {
        if (tree.links[j].parent != j - 1 || tree.links[j].still) return -1;
        oblique += tree.links[j].about_x ? 1 : 0;
    }
    return tree.size() > 4 && 2 * oblique > tree.size() ? (tree.size() - 1) / 2 : -1;
}

/// The angular velocity, and the velocity of the origin, that w_i = 1 gives each link k from link i to `last`, as
/// (n, f) at [k][i].
template <typename S>
std::vector<std::vector<Wrench<S>>> twists_to(const BodyTree<S>& tree, int last) {
    std::vector<std::vector<Wrench<S>>> twists;
    for (int k = 0; k <= last; ++k) {
        const TreeLink<S>& link = tree.links[k];
        twists.emplace_back();
        for (int i = 0; i < k; ++i) {
            const Wrench<S>& before = twists[k - 1][i];
            twists[k].push_back({tree.from_parent(link, before.n),
                                 tree.from_parent(link, before.f + cross(before.n, tree.arm(link)))});
        }
        if (link.slides)
            twists[k].push_back({no_vector<S>(), tree.direction(link)});
        else
            twists[k].push_back({{S(0), S(0), S(1)}, no_vector<S>()});
    }
    return twists;
}

/// M of M w' + n = Q: entry (j, i) for every i on the path from j to the ground, zeros elsewhere.
template <typename S>
std::vector<std::vector<S>> composite_bodies(const BodyTree<S>& tree) {
    std::vector<RigidBody<S>> whole;
    for (const TreeLink<S>& link : tree.links) whole.push_back(tree.body(link));
    std::vector<std::vector<S>> M;
    for (int j = 0; j < tree.size(); ++j) M.emplace_back(j + 1, S(0));
    const int middle = middle_of(tree);
    const std::vector<std::vector<Wrench<S>>> twists = twists_to(tree, middle);
    for (int j = tree.size() - 1; j >= 0; --j) {
        const TreeLink<S>* link = &tree.links[j];
        const RigidBody<S>& b = whole[j];
        Wrench<S> on;
        if (link->slides) {
            const Triple<S> s = tree.direction(*link);
            on = {cross(b.first, s), b.mass * s};
        } else {
            on = {{-b.second[5], -b.second[4], link->still ? b.polar : b.second[0] + b.second[1]},
                  {-b.first[1], b.first[0], S(0)}};
        }
        M[j][j] = along_joint(tree, *link, on);
        if (link->has_rotor) M[j][j] = M[j][j] + link->rotor;
        for (int i = j; link->parent >= 0; link = &tree.links[i]) {
            if (i <= middle) {
                for (int a = 0; a < i; ++a) M[j][a] = dot(twists[i][a].n, on.n) + dot(twists[i][a].f, on.f);
                break;
            }
            on = passed(tree, *link, on);
            i = link->parent;
            M[j][i] = along_joint(tree, tree.links[i], on);
        }
        link = &tree.links[j];
        if (link->parent < 0) continue;
        RigidBody<S> up{.mass = b.mass,
                        .first = tree.outward_to_parent(*link, b.first),
                        .second = tree.outward_to_parent(*link, b.second),
                        .polar = b.polar};
        if (!link->continues) up.polar = up.second[0] + up.second[1];
        if (link->absolute) up = {.mass = b.mass};  // turning the parent does not turn this link
        const Triple<S> r = tree.arm(*link);
        up = shifted(up, r);
        RigidBody<S>& parent = whole[link->parent];
        parent = parent + up;
    }
    return M;
}

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
