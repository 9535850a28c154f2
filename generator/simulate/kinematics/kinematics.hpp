// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The verb `kinematics`: how frames, bodies and points move, in symbols and at a state (Zhang & Qin (2004),
/// chapter 2).
///
///     const SceneKinematics k = kinematics(read_scene("scenes/textbook/heavy_top.toml"), {.of = {"top"}});
///     k.frames[0].omega.own[2].formula;           // phi'*cos(theta) + psi'
///     k.frames[0].omega.own[2].value;             // rad/s, at the state
///
/// Velocities and accelerations are those against N. Turn by turn, and from a frame P to a frame F that turns
/// against it (Zhang & Qin, chapter 2; Kane & Levinson, Dynamics (1985), chapter 2):
///     ω_F = ω_P + Σ_k φ_k' a_k,     α_F = α_P + Σ_k (φ_k'' a_k + ω_k × φ_k' a_k),
/// a_k being the axis of turn k and ω_k the angular velocity of the frame that the turns before it have reached.
/// From a point Q to a point P at ρ along a frame F:
///     v_P = v_Q + ω × ρ + ρ',       a_P = a_Q + α × ρ + ω × (ω × ρ) + 2 ω × ρ' + ρ''.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "alembert/base/rotation.hpp"
#include "algebra/notation/phrase.hpp"
#include "analysis/state/prepared.hpp"
#include "program/lower/start.hpp"

namespace alembert {

struct KinematicsOptions {
    std::vector<std::string> of = {};  ///< frames, bodies, points, particles; empty: all of the scene
    Overrides at = {};                 ///< as `--at`; accelerations ("theta''") too
    bool steps = false;                ///< how velocities and accelerations are composed
    bool jacobian = false;             ///< Jacobians of the points, the mass centre and the momentum, as numbers
};

/// A component of a vector.
struct KinematicEntry {
    GiNaC::ex expression = 0;            ///< in the mechanism's symbols
    std::optional<Phrase> formula = {};  ///< where it is short
    double value = 0;  ///< at the state; not a number where it has accelerations and there are none
};
using KinematicVector = std::array<KinematicEntry, 3>;

/// The same vector along N and along another frame.
struct TwofoldVector {
    KinematicVector along_N, own;
};

/// A turn of a frame against its parent; vectors are along the parent.
struct TurnStep {
    std::optional<Phrase> angle = {};  ///< nothing for a quaternion
    KinematicVector axis = {};
    KinematicVector omega = {};    ///< what it adds: φ' a
    KinematicVector alpha = {};    ///< φ'' a
    KinematicVector turning = {};  ///< ω × φ' a, ω being that of the turns before it against the parent
};

/// A frame or a body.
struct FrameKinematics {
    std::string name;
    std::string parent = "N";  ///< what `turns` lead from
    std::string same_as = {};  ///< of a body: the frame whose axes it has
    bool is_body = false;
    bool is_simple = false;                    ///< one turn, about an axis that stands still in N
    std::array<KinematicVector, 3> axes = {};  ///< unit axes along N: the columns of the direction cosines
    TwofoldVector omega = {}, alpha = {};
    std::optional<Turn<double>> turn = {};  ///< from N, at the state
    std::vector<TurnStep> turns = {};       ///< those that are not constant
    /// With `steps`, where the parent moves: along the parent, ω and α of the parent and ω_P × ω of the turns.
    std::optional<std::array<KinematicVector, 3>> carried = {};
};

/// A step from one point to another; vectors are along the frame.
struct PlaceStep {
    std::string frame;   ///< empty where it has no name: the axes of a joint
    bool turns = false;  ///< the frame turns against N
    KinematicVector offset = {};
    KinematicVector relative_velocity = {}, turning_velocity = {};  ///< ρ', ω × ρ
    KinematicVector relative = {}, tangential = {}, centripetal = {}, coriolis = {};
};

/// A point, a particle or a mass centre.
struct PointKinematics {
    std::string name;
    std::string from = "O";
    std::string along = {};  ///< the frame of the second components; empty where that is N
    TwofoldVector position = {}, velocity = {}, acceleration = {};
    std::vector<PlaceStep> places = {};  ///< with `steps`: from `from` to the point
};

/// The motion of a point and of the axes that SceneMotion::spot gives it, along N: linear rows first.
struct PointJacobian {
    std::vector<std::vector<double>> jacobian = {};  ///< 6 × n
    std::vector<double> bias = {};                   ///< (a, α) at q'' = 0: J' q'
};

/// The mass centre, its Jacobian (3 × n), the momentum, and the angular momentum about the mass centre, along N.
struct MassCentreMotion {
    std::vector<double> position = {};
    std::vector<std::vector<double>> jacobian = {};
    std::vector<double> linear_momentum = {}, angular_momentum = {};
};

struct SceneKinematics : Prepared {
    double time = 0;
    std::vector<std::string> coordinates = {};
    std::vector<double> q = {}, rates = {};
    std::vector<double> accelerations = {};  ///< empty where there are none
    std::string no_accelerations = {};       ///< why
    std::vector<std::string> adjusted = {};  ///< in words, what was moved so that the constraints hold
    bool has_masses =
        true;  ///< accelerations are those of the motion but for those given; else the least possible
    std::vector<FrameKinematics> frames = {};
    std::vector<PointKinematics> points = {};
    std::vector<std::pair<std::string, PointJacobian>> jacobians = {};  ///< with `jacobian`
    std::optional<MassCentreMotion> mass_centre = {};  ///< with `jacobian`, where masses are known
};

/// Throws what `prepared` and `assemble` throw; ModelError for names that the scene does not have, and for
/// accelerations that the constraints do not allow.
SceneKinematics kinematics(Scene scene, const KinematicsOptions& options = {});

}  // namespace alembert
