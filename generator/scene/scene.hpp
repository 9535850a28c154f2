// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene as the file says it: plain names, numbers and expression trees with their places; no symbols.
///
///     const Scene scene = read_scene("scenes/textbook/double_pendulum.toml");
///
/// Everything stands in the order of the file. What `read_scene` returns is consistent as far as names go: every
/// name is declared, no definitions go in a circle, every frame's and point's ancestors exist. What it cannot
/// know without algebra (a negative mass at the scene's values, a singular system) is the model's to say.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/expression.hpp"

namespace alembert {

struct Name {
    std::string text;
    Place place;
};

/// Three components (a missing third is the number 0) along the axes of some frame.
struct Vector {
    std::array<Expression, 3> component;
    Place place;
};

struct Parameter {
    Name name;
    Expression value;  ///< a number, or an expression in other parameters
    std::string unit, about;
};

struct Input {
    Name name;
    Expression value;  ///< in t, parameters (and other inputs)
    std::string unit, about;
};

struct Coordinate {
    Name name;
    Expression initial, rate;  ///< in parameters; never null after reading (missing: 0)
    bool initial_is_guess = false, rate_is_guess = false;  ///< may move so that the constraints hold at the start
    std::optional<Place> rate_given = {};                  ///< where the scene says `rate` or `rate_guess`
    std::string unit, about;
};

struct Definition {
    Name name;
    Expression value;
    bool is_motion = false;  ///< in place of a joint's coordinate: in t, inputs and parameters alone
};

/// A generalized speed: a form in the rates, linear in them.
struct Speed {
    Name name;
    Expression form;
    Expression initial;  ///< in parameters; null where missing
    std::string unit, about;
};

/// One simple rotation about an axis of the frame reached so far.
struct Rotation {
    char letter = 0;  ///< 'x', 'y' or 'z'; 0 where the axis is a vector
    Vector axis;      ///< three expressions in parameters, not normalized; empty where a letter is given
    Expression angle;
};

struct Frame {
    Name name;
    Name parent{"N", {}};
    std::vector<Rotation> rotations;
    std::vector<Name> quaternion = {};  ///< four coordinates, scalar first; then there are no rotations
};

/// Where something is: `from` the point, by the `offset` along `axes`. (`at = "P"` is P with a zero offset.)
struct Position {
    Name from{"O", {}};
    Vector offset;
    Name axes{"N", {}};
};

struct Point {
    Name name;
    Position position;
};

struct Particle {
    Name name;
    Expression mass;
    Position position;
};

struct Inertia {
    std::optional<Expression> planar;  ///< about the z axis; then the tensor is empty
    std::array<Expression, 6> tensor;  ///< xx, yy, zz, xy, yz, zx elements; missing ones are the number 0
    Place place;
    bool is_diagonal = false;  ///< was given as [Ixx, Iyy, Izz]
};

struct Body {
    Name name;
    Expression mass;
    Name frame{"N", {}};
    Position position;  ///< of the mass centre
    std::optional<Inertia> inertia;
    std::optional<Name> about;
    bool has_position = true;          ///< the scene gives 'at' or 'position'
    std::optional<std::size_t> joint;  ///< which one places it; its frame then bears its own name
};

/// Holds two bodies together. The joint's axes stand in each body as `rotate` says, and come together where all
/// its coordinates are 0.
struct Joint {
    enum class Type { fixed, revolute, prismatic, cylindrical, universal, spherical, planar, screw, free };
    struct Side {
        Name body{"N", {}};
        Vector point;  ///< from the mass centre, along the body's frame
        std::vector<Rotation> rotate;
    };
    Name name;
    Type type = Type::fixed;
    Side parent, child;
    Rotation axis;     ///< its angle is null
    Expression pitch;  ///< null but for a screw
    std::string angles;
    std::vector<Name> coordinates;     ///< those with a prescribed motion among them, in the order of the type
    bool is_whole = true;              ///< nothing was wrong with its table
    std::optional<bool> places_child;  ///< or the parent; nothing where it places none
    bool closes_loop = false;
};

struct Force {
    Place place;
    Name at;
    Vector vector;
    Name axes{"N", {}};
    std::optional<Name> reaction;
};

/// What acts in no time at the start: ∫F dt at a point.
struct Impulse {
    Place place;
    Name at;
    Vector vector;
    Name axes{"N", {}};
};

struct Torque {
    Place place;
    Name on;
    Vector vector;
    Name axes{"N", {}};
    std::optional<Name> reaction;
};

/// A spring or a damper: between two points or along an expression.
struct Link {
    Place place;
    std::optional<std::pair<Name, Name>> between;
    Expression along;     ///< null where `between` is given
    Expression constant;  ///< stiffness or damping
    Expression length;    ///< unstretched (springs), the number 0 when missing
};

struct GeneralizedForce {
    Name coordinate;
    Expression value;
};

/// lhs − rhs = 0
struct ConstraintRule {
    Name name;
    bool holonomic = true;
    Equality equation;               ///< rhs is the number 0 where there is no `=`
    std::optional<Name> multiplier;  ///< lambda_<name> when missing
};

/// gap ≥ 0
struct UnilateralRule {
    Name name;
    Expression gap;
    Expression restitution;  ///< the number 0 when missing
};

/// Dry friction −coefficient·N·sign(slip).
struct FrictionRule {
    Name name;
    Expression coefficient;
    Expression resting;      ///< the static coefficient; null where it is the same
    Expression slip;         ///< the sliding velocity, linear in the rates
    std::optional<Name> on;  ///< whose multiplier's size is N
    Expression normal;       ///< N; null where `on` is given
};

/// The point of `body` at the mass centre + `contact` has the velocity of the point of `on` there.
struct RollingRule {
    Name name;
    Name body;
    Vector contact;
    Name axes{"N", {}};
    Name on{"N", {}};  ///< the ground
};

/// "lambda_wheel_x" …: the multipliers of a rolling's rows along the axes of N.
std::array<Name, 3> multipliers_of(const RollingRule& rule);

struct Output {
    Name name;
    Expression value;
};

struct EventRule {
    Name name;
    Expression when;
    bool stop = false;
    int direction = 0;                            ///< +1: only where `when` grows, −1: falls, 0: both
    std::vector<GeneralizedForce> impulses = {};  ///< at each zero; of the rates before
};

/// [polynomial]: a characteristic polynomial without a mechanism, highest power first.
struct PolynomialRule {
    Place place;
    std::vector<Expression> coefficients;
};

struct Simulation {
    Expression start, duration, tolerance, step, max_step, sample, period;  ///< null where missing, but start: 0
    std::optional<Name> method;
};

struct Claim {
    Place place;
    Equality equation;
    std::string source;
    std::vector<Name> unknowns, constants;
    std::string at = "motion";  ///< motion, rest or impact
};

struct Scene {
    std::string file;  ///< as given by the user
    std::string text;  ///< the whole file, for messages that show its lines
    std::string title, source, notes;
    std::optional<Vector> gravity;
    std::vector<Parameter> parameters;
    std::vector<Input> inputs;
    std::vector<Coordinate> coordinates;
    std::vector<Speed> speeds;
    std::vector<Definition> definitions;
    std::vector<Frame> frames;
    std::vector<Point> points;
    std::vector<Particle> particles;
    std::vector<Body> bodies;
    std::vector<Joint> joints;
    std::vector<Force> forces;
    std::vector<Torque> torques;
    std::vector<Link> springs, dampers;
    Expression kinetic, potential, lagrangian;  ///< [energy]; null where missing
    Expression rayleigh;
    std::vector<GeneralizedForce> generalized_forces;
    std::vector<Impulse> impulses;
    std::vector<GeneralizedForce> generalized_impulses;
    std::vector<ConstraintRule> constraints;
    std::vector<RollingRule> rolling;
    std::vector<UnilateralRule> unilateral;
    std::vector<FrictionRule> frictions;
    std::vector<Output> outputs;
    std::vector<EventRule> events;
    std::optional<PolynomialRule> polynomial;
    Simulation simulation;
    std::vector<Claim> claims;
    std::vector<Diagnostic> warnings;
    /// Told each warning, of the reader and of all later stages, as soon as it is found: it is not lost where an
    /// error follows. Where it is empty, warnings are kept with the results.
    std::function<void(const std::string&)> on_warning = {};
};

/// Reads and checks a scene. Throws SceneError with every mistake found, or if the file cannot be read.
Scene read_scene(const std::string& file);

/// The same from a text already in memory; `file` is only what messages call it.
Scene parse_scene(std::string text, std::string file);

/// Throws SceneError for mistakes found after reading (by the model), in the same form and order of place.
[[noreturn]] void fail(const Scene& scene, std::vector<Diagnostic> diagnostics);

/// `file:line:column: message`, the line and a caret, for each diagnostic.
std::string describe(const Scene& scene, const std::vector<Diagnostic>& diagnostics);

/// The nearest of `known` to `word` if near enough to be meant (edit distance), else empty.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

}  // namespace alembert
