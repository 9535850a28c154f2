// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene as the file says it: plain names, numbers and expression trees with their places; no symbols.
///
///     const Scene scene = read_scene("scenes/textbook/double_pendulum.toml");
///
/// Everything stands in the order of the file. The names in the result of `read_scene` are consistent: every name
/// is declared, no definitions form a circle, and every frame's and point's ancestors exist. Mistakes that take
/// algebra to find (a negative mass at the scene's values, a singular system) are found by the model.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "alembert/base/tabulated_function.hpp"
#include "scene/expression.hpp"
#include "scene/unit_text.hpp"

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

/// How the scene gives the numbers of a name whose unit is not of the SI (scene/units.hpp).
struct Shown {
    std::string unit;   ///< "mm"; empty where numbers are as given
    double size = 1;    ///< of this unit in that of the SI: 0.001
    std::string exact;  ///< the same as an expression
    std::string value;  ///< of the name, as typed
};

struct Parameter {
    Name name;
    Expression value;  ///< a number, or an expression in other parameters
    std::string unit, about;
    Place unit_place = {};
    Shown shown = {};
};

struct Input {
    Name name;
    Expression value;  ///< in t, parameters (and other inputs); a number if it comes from outside
    std::string unit, about;
    Place unit_place = {};
    Shown shown = {};
    /// Whether who runs the equations gives it, and holds it constant between calls; else it has `value`.
    bool from_outside = false;
};

struct Coordinate {
    Name name;
    Expression initial, rate;  ///< in parameters; never null after reading (0 if missing)
    bool initial_is_guess = false,
         rate_is_guess = false;            ///< the value may be changed so that the constraints hold at the start
    std::optional<Place> rate_given = {};  ///< the place where the scene gives `rate` or `rate_guess`
    std::string unit, about;
    Place unit_place = {};
    Shown shown = {};
};

struct Definition {
    Name name;
    Expression value;
    /// Whether this prescribes a joint's coordinate; then it depends on t, inputs and parameters only.
    bool is_motion = false;
    bool has_components =
        false;  ///< whether it was given as [x, y, z]; `value` is then x*ex(N) + y*ey(N) + z*ez(N)
};

/// A function that the scene leaves open, V(r), or gives by points.
struct UnspecifiedFunction {
    Name name;
    std::vector<Name> arguments;                          ///< only their number counts
    std::shared_ptr<const TabulatedFunction> table = {};  ///< in SI units; null if the function is open
    std::string unit = {}, about = {};                    ///< of its values
    std::vector<std::string> units = {};                  ///< of its arguments
    Place unit_place = {};
    std::string usage() const;  ///< "V(r)"
};

/// A generalized speed, which is linear in the rates.
struct Speed {
    Name name;
    Expression form;
    Expression initial;  ///< in parameters; null if missing
    std::string unit, about;
    Place unit_place = {};
    Shown shown = {};
};

/// A first-order state z, whose rate z' is given.
struct FirstOrderState {
    Name name;
    Expression rate;     ///< in coordinates, rates, states, inputs, parameters and t; null if events alone set it
    Expression initial;  ///< in parameters; the number 0 when missing
    std::string unit, about;
    Place unit_place = {};
    Shown shown = {};
};

/// One simple rotation about an axis of the frame reached so far.
struct Rotation {
    char letter = 0;  ///< 'x', 'y' or 'z'; 0 if the axis is a vector
    Vector axis;      ///< three expressions in parameters, not normalized; empty if a letter is given
    Expression angle;
};

struct Frame {
    Name name;
    Name parent{"N", {}};
    std::vector<Rotation> rotations;
    std::vector<Name> quaternion = {};  ///< four coordinates, scalar first; if given, there are no rotations
};

/// A position: the point `from`, plus the `offset` along `axes`. (`at = "P"` is P with a zero offset.)
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
    /// The velocity, relative to the particle and along the axes `along`, of what leaves it while its mass falls,
    /// or joins it while it grows.
    std::optional<Vector> leaves = {};
    Name along{"N", {}};
};

struct Inertia {
    std::optional<Expression> planar;  ///< the moment about the z axis; if given, the tensor is empty
    std::array<Expression, 6> tensor;  ///< xx, yy, zz, xy, yz, zx elements; missing ones are the number 0
    Place place;
    bool is_diagonal = false;  ///< whether it was given as [Ixx, Iyy, Izz]
};

struct Body {
    Name name;
    Expression mass;
    Name frame{"N", {}};
    Position position;  ///< the position of the mass centre
    std::optional<Inertia> inertia;
    std::optional<Name> about;
    bool has_position = true;          ///< whether the scene gives 'at' or 'position'
    std::optional<std::size_t> joint;  ///< the joint that places it; its frame then has the body's name
    Name centre = {};                  ///< the name of its mass centre among the points, if not that of the body

    const Name& point() const { return centre.text.empty() ? name : centre; }
};

/// Holds two bodies together. `rotate` gives the joint's axes in each body; the two sets of axes coincide when all
/// coordinates of the joint are 0.
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
    Rotation axis;     ///< with a null angle
    Expression pitch;  ///< null unless the joint is a screw
    std::string angles;
    std::vector<Name> coordinates;     ///< in the order of the type, including those with a prescribed motion
    bool is_whole = true;              ///< whether its table was free of mistakes
    std::optional<bool> places_child;  ///< true if it places the child, false if the parent, nothing if neither
    bool closes_loop = false;
};

struct Force {
    Place place;
    Name at;
    Vector vector;
    Name axes{"N", {}};
    std::optional<Name> reaction;
    std::optional<Name> on;  ///< the body, or frame, whose point there it pushes
};

/// An impulse ∫F dt at a point that acts at the start.
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
    Expression along;     ///< null if `between` is given
    Expression constant;  ///< stiffness or damping
    Expression length;    ///< unstretched (springs), the number 0 when missing
};

struct GeneralizedForce {
    Name coordinate;
    Expression value;
};

/// The inertia J of a rotor that turns with a coordinate of a joint: T contains J q'²/2.
struct Armature {
    Name coordinate;
    Expression inertia;  ///< in parameters
};

/// lhs − rhs = 0
struct ConstraintRule {
    Name name;
    bool holonomic = true;
    Equality equation;               ///< rhs is the number 0 if there is no `=`
    std::optional<Name> multiplier;  ///< lambda_<name> when missing
};

/// gap ≥ 0
struct UnilateralRule {
    Name name;
    Expression gap;
    Expression restitution;  ///< the number 0 when missing
};

/// Dry friction −coefficient·N·sign(slip), or −coefficient·N·v/|v| for v = (slip, across).
struct FrictionRule {
    Name name;
    Expression coefficient;
    Expression resting;           ///< the static coefficient; null if it is the same
    Expression sliding_velocity;  ///< linear in the rates
    Expression across;            ///< its second component, if it is a vector in a plane; null if not
    std::optional<Name> on;       ///< the constraint or contact whose reaction is N
    Expression normal;            ///< N; null if `on` is given
    Expression restitution;       ///< of the sliding velocity in an impact, in parameters; null if it is 0
};

/// The point of `body` at the mass centre + `contact` has the same velocity as the point of `on` at that place.
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
    int direction = 0;  ///< +1: only where `when` grows; −1: only where it falls; 0: both
    std::vector<GeneralizedForce> impulses = {};  ///< act at each zero, and may depend on the rates before it
    /// The values of states and rates after each zero, in the state before it.
    std::vector<GeneralizedForce> set = {}, rates = {};
    std::vector<Name> record = {};  ///< the columns of a run whose values at each zero are told
    std::optional<int> count = {};  ///< the run stops at the zero of this number
};

/// [polynomial]: a characteristic polynomial without a mechanism, highest power first.
struct PolynomialRule {
    Place place;
    std::vector<Expression> coefficients;
};

struct Simulation {
    Expression start, duration, tolerance, step, max_step, sample,
        period;  ///< null if missing, except that start is then 0
    std::optional<Name> method;
    bool regularize = false;
};

/// What is told of a scene that is not wrong.
struct Warning {
    std::string text;  ///< for people: lines, each with its line break
    std::vector<Diagnostic> parts;
};

struct Claim {
    Place place;
    Equality equation;
    std::string source;
    std::vector<Name> unknowns, constants;
    /// Of what it speaks: any motion, states of rest, impulses, one motion in closed form, motions near a state,
    /// motions while friction sticks, or motions while contacts are closed.
    enum class At : unsigned char { motion, rest, impact, solution, near, sticking, closed };
    At at = At::motion;
    std::vector<std::string> sticking = {};  ///< at `sticking`: the frictions that do; all if there are none here
    std::vector<std::string> closed = {};    ///< at `closed`: the contacts that are; all if there are none here
    std::vector<Inequality> where = {};      ///< what it assumes besides
    /// Where it holds to first order: coordinates, and rates as "x'", with their values in parameters.
    std::vector<std::pair<Name, Expression>> near = {};
};

/// A letter of hand derivations and the name that it stands for here: "\\ell" for l.
struct WrittenLetter {
    Name written, name;
};

struct Scene {
    // Defined in one file: inline, every file that holds one would compile the copies of all its parts.
    Scene();
    Scene(const Scene&);
    Scene(Scene&&) noexcept;
    Scene& operator=(const Scene&);
    Scene& operator=(Scene&&) noexcept;
    ~Scene();

    std::string file;  ///< the name of the file as the user gave it
    std::string text;  ///< the whole file, for messages that show its lines
    /// The same of the scene itself where these are those of a file of claims; warnings are about it.
    std::string own_file = {}, own_text = {};
    std::string title, source, notes;
    std::optional<Vector> gravity;
    OwnUnits units = {};  ///< of its own, from [units]
    std::vector<Parameter> parameters;
    std::vector<Input> inputs;
    std::vector<Coordinate> coordinates;
    std::vector<Speed> speeds;
    std::vector<FirstOrderState> states;
    std::vector<Definition> definitions;
    std::vector<UnspecifiedFunction> functions;
    std::vector<Frame> frames;
    std::vector<Point> points;
    std::vector<Particle> particles;
    std::vector<Body> bodies;
    std::vector<Joint> joints;
    std::vector<Force> forces;
    std::vector<Torque> torques;
    std::vector<Link> springs, dampers;
    Expression kinetic, potential, lagrangian;  ///< from [energy]; null if missing
    Expression rayleigh;
    std::vector<GeneralizedForce> generalized_forces;  ///< [forces], and the drives of joints
    std::vector<Armature> armatures;
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
    std::vector<WrittenLetter> letters;
    std::vector<Diagnostic> warnings;
    std::vector<std::string> allowed;  ///< kinds of warnings that are not told: `allow` of the scene
    /// Called with each warning of the reader and of all later stages as soon as it is found, so that it is not
    /// lost if an error follows. If it is empty, warnings are kept with the results.
    std::function<void(const Warning&)> on_warning = {};
};

/// Reads and checks a scene. Throws SceneError with every mistake found, or if the file cannot be read.
Scene read_scene(const std::string& file);

/// The same from a text in memory; `file` is only the name that messages give it.
Scene parse_scene(std::string text, std::string file);

/// Throws SceneError for mistakes that were found after reading (by the model), in the same form and ordered by
/// place.
[[noreturn]] void fail(const Scene& scene, std::vector<Diagnostic> diagnostics);

/// `file:line:column: message`, the line and a caret, for each diagnostic.
std::string describe(const Scene& scene, const std::vector<Diagnostic>& diagnostics);

/// The word of `known` that is nearest to `word` in edit distance, if it is near enough to be meant; otherwise
/// empty.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

}  // namespace alembert
