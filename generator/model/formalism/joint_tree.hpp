// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A mechanism as a tree of links with one joint each, found from how its frames and points are connected.
///
///     const JointTree tree = joint_tree(mechanism);
///     const BodyTree<Named> still = dressed<Named>(tree, LinkAxes::still, value);
///
/// A link consists of everything that is fixed to a turning frame or to a shifted point. Each turn with a variable
/// angle and each coordinate in an offset is a joint. Where the scene's frames and points make no tree,
/// or one with more joints than coordinates, the links that stand in positions are taken (model/links.hpp), if
/// these are fewer; there a point may slide along a curve. The rates of joints are w = S q' + w₀ with rational S:
/// a frame whose angle θ₂ counts from N, on a body that turns by θ₁, has w = θ₂' − θ₁'. In a chain of parallel
/// axes that begins at the ground, angles and rates relative to the ground may be used instead
/// (`LinkAxes::still`), except where rotors turn with joints. A turn by a quaternion is three joints, whose rates
/// S does not give (ball_joint.hpp).

#include <functional>

#include "model/formalism/ball_joint.hpp"
#include "model/formalism/body_tree.hpp"
#include "model/formalism/link_axes.hpp"
#include "model/formalism/named.hpp"
#include "model/formalism/obstacle.hpp"
#include "model/mechanism.hpp"

namespace alembert {

struct TreeJoint {
    TreeLink<Named> link;             ///< without the values that depend on the state
    GiNaC::ex position, rate, bias;   ///< angle or shift, w, w' at q'' = 0
    std::vector<GiNaC::numeric> row;  ///< the joint's row of S; zeros if it is of a ball joint
    GiNaC::ex rotor = 0;              ///< the inertia that w alone drives: J/s² for a rotor of q with w = s q'
    bool parallel = false;            ///< whether its axes differ from those of the parent by a turn about z only
};

/// What a scene does not say, but shows.
struct TreeFindings {
    bool in_positions = false;  ///< whether joints come from positions of masses alone (model/links.hpp)
    std::vector<std::string> merged = {};   ///< masses at the point of another one, with which they count
    std::vector<std::string> at_rest = {};  ///< masses that never move, which are left out
};

struct JointTree {
    std::vector<TreeJoint> joints;
    Triple<Named> gravity;
    int coordinates = 0;
    std::vector<BallJoint> balls = {};
    std::vector<Rotor> rotors = {};
    TreeFindings findings = {};
    std::vector<GiNaC::ex> forces =
        {};  ///< generalized forces without gravity and inertia, if the formalism has set them
};

/// The tree, or the obstacle if the scene is no such tree: what is missing, and where.
Possible<JointTree> joint_tree(const Mechanism& mechanism);

/// The position in Mechanism::constraints of e·e = 1 of each ball joint; nothing if there are other constraints.
std::optional<std::vector<int>> norms_alone(const JointTree& tree, const Mechanism& mechanism);

/// S for these `axes`, one row for each joint.
std::vector<std::vector<GiNaC::numeric>> rate_rows(const JointTree& tree, LinkAxes axes);

/// Whether the angle of a link counts from the ground, and along which axes its components are taken.
struct Dress {
    bool still = false, continues = false, absolute = false;
    int base = -1;  ///< where axes continue, the link to whose turn this one's is added; −1 if there is none
};
std::vector<Dress> dress(const JointTree& tree, LinkAxes axes);
/// Is there a chain of parallel axes?
bool has_parallel_axes(const JointTree& tree);
/// Is the whole tree such a chain, each link attached to the one before (planar_chain.hpp)?
bool is_planar_chain(const JointTree& tree);

/// Do all links move in parallel planes that are not those of x and y?
bool is_planar_in_space(const JointTree& tree);

/// The tree over another scalar; `value` converts an expression to it.
template <typename S>
BodyTree<S> dressed(const JointTree& joints, LinkAxes axes, Intermediates& z,
                    const std::function<S(const GiNaC::ex&)>& value) {
    const std::vector<Dress> how = dress(joints, axes);
    const auto vector = [&](const Triple<Named>& v) {
        return Triple<S>{value(v[0].e), value(v[1].e), value(v[2].e)};
    };
    BodyTree<S> tree{.links = {}, .gravity = vector(joints.gravity)};
    std::vector<GiNaC::ex> angle, rate, bias;
    for (std::size_t j = 0; j < joints.joints.size(); ++j) {
        const TreeJoint& joint = joints.joints[j];
        const TreeLink<Named>& l = joint.link;
        TreeLink<S> link{.parent = l.parent,
                         .slides = l.slides,
                         .of_ball = l.of_ball,
                         .p = vector(l.p),
                         .slide = vector(l.slide),
                         .way = vector(l.way),
                         .bend = vector(l.bend)};
        for (int i = 0; i < 3; ++i) link.R[i] = vector(l.R[i]);
        link.has_rotor = !joint.rotor.is_zero();
        if (link.has_rotor) link.rotor = value(joint.rotor);
        link.body.mass = value(l.body.mass.e);
        link.body.first = vector(l.body.first);
        for (int i = 0; i < 6; ++i) link.body.second[i] = value(l.body.second[i].e);
        link.still = how[j].still;
        link.continues = how[j].continues;
        link.absolute = how[j].absolute;
        const int base = how[j].continues ? l.parent : -1;
        angle.push_back(l.slides ? GiNaC::ex(0) : joint.position);
        rate.push_back(joint.rate);
        bias.push_back(joint.bias);
        if (base >= 0) angle[j] = z.name(angle[base] + angle[j]);
        if (how[j].absolute && how[j].base >= 0) {
            rate[j] = z.name(rate[how[j].base] + rate[j]);
            bias[j] = z.name(bias[how[j].base] + bias[j]);
        }
        if (!l.slides || link.still) {
            link.angle = value(angle[j]);
            link.cosine = value(z.name(cos(angle[j])));
            link.sine = value(z.name(sin(angle[j])));
        }
        if (l.slides) link.shift = value(joint.position);
        link.rate = value(rate[j]);
        link.bias = value(bias[j]);
        tree.links.push_back(link);
    }
    return tree;
}

}  // namespace alembert
