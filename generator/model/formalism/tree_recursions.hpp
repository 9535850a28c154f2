// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Recursions from body to body along a tree (body_tree.hpp), written once for any scalar:
///
///     const Bias<double> bias(tree);                                    // Newton-Euler, outwards, at w' = 0
///     joint_loads(tree, bias.wrenches)                                  // … and inwards: n of M w' + n = Q
///     composite_bodies(tree)                                            // M: rows by joint, lower triangle
///
/// (Featherstone, Rigid Body Dynamics Algorithms (2008), chapters 5 and 6; Walker & Orin 1982; Luh, Walker & Paul
/// 1980.) With the moments m, h and P of a body about its link's origin, it needs the wrench
///     f = m a + Ω h,   n = h × a + vee(Ω P),   Ω = ε̃ + ω̃ ω̃,   vee(X) = (X₃₂ − X₂₃, X₁₃ − X₃₁, X₂₁ − X₁₂).

#include <vector>

#include "model/formalism/body_tree.hpp"

namespace alembert {

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

/// The motion of a link at w' = `bias`, from that of its parent and the parent's Ω.
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
        m.a = m.a + cross(m.w + m.w, ws) + link.bias * s + tree.along_axes(link, link.bend);
    } else if (link.absolute) {
        m.w[2] = link.rate;
        m.e[2] = link.bias;
    } else {
        m.e = {m.e[0] + m.w[1] * link.rate, m.e[1] - m.w[0] * link.rate, m.e[2] + link.bias};
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

/// The motion of every link at w' = `bias`, computed outwards, and the wrench that its body needs.
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

}  // namespace alembert
