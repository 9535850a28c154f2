// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A mechanical system in symbols, from which every formalism starts.
///
///     const Mechanism mechanism = build(read_scene("pendulum.toml"));
///     const ex T = mechanism.kinetic_energy();
///
/// All expressions are in the symbols of `symbols`; every expression that is more than an atom is an intermediate
/// symbol of `z`. Vectors have three components along the axes of the inertial frame N.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/origin.hpp"
#include "model/skeleton.hpp"
#include "scene/scene.hpp"

namespace alembert {

/// One body's share of T, one spring's of V …
struct Part {
    Origin origin;
    GiNaC::ex value;
};

/// A load that is not in V, given by its power: forces times velocities. Its generalized force is Q_i = Σ force ·
/// ∂velocity/∂q'_i, its power Σ force · velocity.
struct Load {
    Origin origin;
    /// Whether it is a damper or Rayleigh's function, which textbooks write on the left-hand side.
    bool dissipative = false;
    struct Pair {
        GiNaC::ex velocity, force;
        std::optional<GiNaC::ex> position = {};  ///< the quantity whose rate the velocity is, if there is one
    };
    std::vector<Pair> pairs;
    /// Whether it is a force at a place that is fixed in no body, though the scene does not say which body it
    /// pushes: its work is then that along the way of the place.
    bool at_moving_place = false;
};

/// A particle or a body with what Newton's and Euler's equations need, for the formalisms that do not start from
/// T.
struct MassElement {
    Origin origin;
    GiNaC::ex mass;
    Vector3 position, velocity;  ///< of the mass centre
    struct Rotation {
        std::array<Vector3, 3> axes;        ///< the body's unit axes, along N
        Vector3 w_NB_B;                     ///< angular velocity along the body's axes
        std::array<GiNaC::ex, 6> inertia;   ///< xx yy zz xy yz zx along the body's axes, about the mass centre
        std::optional<Vector3> about = {};  ///< position of the mass centre minus that of the point of the body
                                            ///< about which `inertia` is given, along N
    };
    std::optional<Rotation> rotation = {};
    GiNaC::ex mass_rate = 0;  ///< of a mass that changes: its momentum changes by that times the velocity besides
    int frame = 0, point = 0,
        about = -1;  ///< positions in Mechanism::skeleton; `about` is the point about which `inertia` is given, if
                     ///< not the mass centre
};

/// A joint of the system graph. If it places a body (an arc of the tree), it describes the motion of the outer of
/// its two bodies relative to the inner one, which is nearer to the ground. If it closes a loop (a chord), it only
/// says which bodies it joins.
struct JointArc {
    std::string name, type;
    int parent = -1, child = -1;  ///< positions in Mechanism::masses; −1 is the ground
    enum class Role { places_child, places_parent, closes_loop } role;
    std::array<Vector3, 3> axes = {};  ///< the joint's axes in the inner body, along N
    Vector3 turning = {};              ///< ω of the outer body relative to the inner one, along `axes`
    Vector3 to_pivot = {};    ///< from the inner mass centre (from O) to the joint's point of the child, along N
    Vector3 from_pivot = {};  ///< from there to the outer mass centre (to O)
    std::array<Vector3, 3> slide_axes = {};  ///< the joint's axes in the parent, along N
    Vector3 shift = {};    ///< displacement of the child's point relative to the parent's, along `slide_axes`
    Vector3 sliding = {};  ///< the rate of `shift`

    int inner() const { return role == Role::places_parent ? child : parent; }
    int outer() const { return role == Role::places_parent ? parent : child; }
};

/// A spring with what its forces need: between two points, or along an expression.
struct SpringElement {
    Origin origin;
    GiNaC::ex stiffness, free_length;
    std::optional<std::pair<Vector3, Vector3>> between = {};  ///< positions of its ends
    GiNaC::ex along = 0;
    /// d in V = ½ k d², if V is written so: the length without the free length, or the difference of two positions
    /// on one axis.
    std::optional<GiNaC::ex> extension = {};
};

/// A rotor that turns with a coordinate: it adds ½ J q'² to T and nothing to the momentum of the bodies.
struct Rotor {
    Origin origin;
    int coordinate;  ///< position in Mechanism::q
    GiNaC::ex inertia;
};

struct Mechanism {
    // Defined in one file: inline, every file that holds one would compile the copies of all its parts.
    Mechanism();
    Mechanism(const Mechanism&);
    Mechanism(Mechanism&&) noexcept;
    Mechanism& operator=(const Mechanism&);
    Mechanism& operator=(Mechanism&&) noexcept;
    ~Mechanism();

    struct Parameter {
        GiNaC::symbol symbol;
        GiNaC::ex value;  ///< exact: a number, a constant such as π/4 or √2, an expression in other parameters
        bool independent = true;    ///< whether it is a number or a constant
        bool from_outside = false;  ///< whether it is the value of an input of that name, which callers give
        std::string unit, about;
        Shown shown = {};
        /// The value of an independent one as a fraction; to fifty digits where it is none, as of π/4.
        GiNaC::numeric number() const;
    };
    struct Input {
        std::array<GiNaC::symbol, 3> derivative;  ///< F, F', F''
        GiNaC::ex value;                          ///< in t, parameters and other inputs
        std::string unit;
    };
    struct Definition {
        std::string name;
        GiNaC::ex value;
    };

    /// A generalized speed of the scene, u = row·q' + offset.
    struct Speed {
        GiNaC::symbol u, udot;
        GiNaC::ex form;              ///< in q, q', t
        std::vector<GiNaC::ex> row;  ///< ∂form/∂q'
        GiNaC::ex offset;
        std::optional<GiNaC::ex> start;  ///< in parameters; nothing if the scene gives rates
        std::string unit;
        Place place;
        Shown shown = {};
    };

    /// A first-order state of the scene, z' = rate. Energies, loads and constraints see it as a given function of
    /// time, of which only the derivative is known.
    struct State {
        std::array<GiNaC::symbol, 3> derivative;  ///< z, z', z''
        GiNaC::ex rate;                           ///< in q, q', the states, inputs and t; not in z'
        GiNaC::ex start;                          ///< in parameters
        std::string unit, about;
        Place place;
        Shown shown = {};
    };

    /// A constraint as a row: row·q' + offset = 0 and, differentiated once more, row·q'' = acceleration.
    struct Constraint {
        std::string name;
        bool holonomic = true;              ///< as the scene declares it
        std::optional<GiNaC::ex> position;  ///< f(q,t) of a holonomic constraint
        std::vector<GiNaC::ex> row;         ///< ∂f/∂q, or the coefficients of q'
        GiNaC::ex offset;                   ///< ∂f/∂t, or the part without rates
        GiNaC::ex acceleration;             ///< −(row)'·q' − (offset)'
        GiNaC::symbol multiplier;           ///< λ: M q'' = F + Σ row λ
        Place place;
        std::optional<int> joint = {};  ///< position in `joints` of the joint whose loop the row closes
        bool between_axes = false;      ///< of such a row: whether it is the cosine of an angle between axes
        /// Position in `rollings` of the rolling condition to which the row belongs.
        std::optional<int> rolling = {};
        /// The constraints of the scene in which the square of this one stands, for people; empty for those that
        /// the scene gives (analysis/state/irregular_constraints.hpp).
        std::string squared_in = {};
        /// Whether this says that forces are in balance along a rate that no inertia resists
        /// (analysis/state/force_balance.hpp): the multiplier is zero on every motion.
        bool balance = false;
        bool norm = false;  ///< whether this is e·e = 1 of a quaternion: there is no inertia along its row
        /// Constraints with the same number, in `constraints` and `redundant`, depend on each other with factors
        /// that change with the pose, so that those in `constraints` alone lose rank at some poses where all of
        /// them together do not (analysis/audit/tied_rows.hpp).
        std::optional<int> tie = {};
        /// How much of the row at most is no combination of the others, divided by the size of such rows, where
        /// that is so little that the row counts as one (analysis/state/nearly_redundant.hpp).
        std::optional<double> nearly = {};
    };

    /// What tells the motions of a joint that closes a loop from other roots of its rows, which hold too where the
    /// child is turned by half a turn, or, if no turn is free, by a third of one about the diagonal of the axes.
    struct Alignment {
        int joint;         ///< position in `joints`
        std::size_t rows;  ///< how many of `constraints` close the joint's loop
        std::vector<GiNaC::ex>
            between;  ///< the products of axes that coincide, each 1 where the rows hold as meant
    };

    /// gap(q,t) ≥ 0: the contact is open where the gap is positive, and a constraint with λ ≥ 0 where it is zero.
    struct Unilateral {
        Constraint gap;
        GiNaC::ex restitution;  ///< relative speed after an impact divided by that before, 0 to 1; in parameters
    };

    /// Dry friction, whose force −coefficient·normal·sign(slip) is among `loads` (Origin::Kind::friction). While
    /// it sticks, slip = 0, and the force is at most resting·normal.
    struct Friction {
        std::string name;
        GiNaC::ex sliding_velocity;  ///< linear in the rates
        /// The second component of a sliding velocity v in a plane, along a direction perpendicular to the first.
        /// The friction is then a force of at most resting·normal in any direction, −coefficient·normal·v/|v|
        /// while it slides.
        std::optional<GiNaC::ex> across;
        std::vector<GiNaC::ex> direction;  ///< sign(slip), or the components of v/|v|
        bool is_held = false;              ///< whether `direction` is given by parameters (model/friction.hpp)
        GiNaC::ex coefficient, resting;    ///< kinetic and static
        GiNaC::ex normal;                  ///< N; for a constraint |λ|, for a contact λ
        /// The multiplier λ that gives N, of a constraint in `constraints` (of the contact mode); nothing if N is
        /// given.
        std::optional<GiNaC::symbol> multiplier;
        GiNaC::ex restitution;  ///< of the sliding velocity in an impact that does not slide through, 0 to 1
        Place place;
    };

    std::string name;  ///< the name of the scene's file, without folder and ending
    std::string title;
    std::shared_ptr<Symbols> symbols;
    std::shared_ptr<Intermediates> z;
    GiNaC::symbol t;
    std::vector<Parameter> parameters;
    std::vector<Input> inputs;
    std::vector<Definition> definitions;
    /// Of each function of `symbols`, its points; null if the scene leaves it open.
    std::vector<std::shared_ptr<const TabulatedFunction>> tables;
    std::vector<GiNaC::symbol> q, qdot, qddot;
    std::vector<std::string> units;              ///< units of the coordinates
    std::vector<Shown> shown_units;              ///< in which texts and plots show them
    std::vector<GiNaC::ex> q_start, qdot_start;  ///< in parameters
    std::vector<bool> q_is_guess,
        qdot_is_guess;          ///< values that may be changed so that the constraints hold at the start
    std::vector<Speed> speeds;  ///< if empty, the rates are the speeds
    std::vector<State> states;  ///< part of the state of a motion, behind q and the speeds
    std::vector<Part> kinetic, potential;
    std::optional<GiNaC::ex> given_lagrangian;  ///< if given, `kinetic` and `potential` are empty
    std::vector<Load> loads;
    std::vector<Load> impulses;  ///< ∫load dt of the impulses that act at the start; not among `loads`
    std::vector<MassElement>
        masses;  ///< the masses to which the parts of `kinetic` belong, except those of [energy] and of rotors
    std::vector<Rotor> rotors;  ///< the rotors of joints; not among `masses`
    std::vector<SpringElement> springs;
    std::vector<JointArc> joints;  ///< in the order of the scene
    Skeleton skeleton;             ///< how frames and points are connected
    Vector3 gravity{0, 0, 0};
    std::vector<Constraint> constraints;
    std::vector<Constraint> redundant;    ///< left out of `constraints` because they follow from these
    std::vector<Alignment> alignments;    ///< of joints that close loops
    std::vector<std::string> identities;  ///< rows of joints that hold in every position of the bodies
    /// A rolling condition, for the choice of the axes of its rows (analysis/state/redundancy.hpp).
    struct Rolling {
        std::string name, axes;         ///< its name, and the frame along whose axes the contact is given
        std::vector<Constraint> along;  ///< the same rows along these axes, without those that hold identically
        bool is_along = false;          ///< whether these rows have replaced those along N
    };
    std::vector<Rolling> rollings;
    std::vector<Unilateral> unilateral;
    std::vector<Friction> frictions;
    std::vector<Definition> outputs, events;

    /// What happens at a zero of an event, apart from its report.
    struct EventAction {
        bool stop = false;
        int direction = 0;  ///< +1: only where the value grows; −1: only where it falls; 0: both
        /// Q̂ by coordinate, in q, t and the rates before; empty if there is none.
        std::vector<GiNaC::ex> impulse = {};
        /// The new values of states, by their position in `states`, and of rates, by that of their coordinate.
        std::vector<std::pair<int, GiNaC::ex>> set = {}, rates = {};
        std::vector<std::string> record = {};  ///< the columns of a run whose values there are told
        std::optional<int> count = {};         ///< the run stops at the zero of this number
    };
    std::vector<EventAction> event_actions;  ///< one for each of `events`

    /// The functions that have no values.
    std::vector<GiNaC::symbol> open_functions() const;
    /// The points of the function that is called; null if it is open.
    const TabulatedFunction* table_of(const GiNaC::ex& function) const;

    /// Do rates or states jump at an event?
    bool has_kicks() const;
    /// Are zeros of an event counted?
    bool has_counts() const;

    /// Is the motion more than the integral of its rates? Contacts close, dry friction sticks, events kick, or
    /// are counted.
    bool has_modes() const { return !unilateral.empty() || !frictions.empty() || has_kicks() || has_counts(); }

    /// The settings of [simulation], in parameters; nothing for those that the scene does not give.
    struct Run {
        std::optional<GiNaC::ex> start, duration, tolerance, step, max_step, sample, period;
        std::string method = "auto";
        bool regularize = false;
    };
    Run run;

    /// Degrees of freedom of a scene without constraints: the number of coordinates.
    int size() const { return static_cast<int>(q.size()); }

    /// The constraints whose multipliers are not determined by the equations: gaps that may be closed, and
    /// constraints that follow from others.
    std::vector<const Constraint*> undetermined() const;

    /// The symbols that change with time, except the rates: coordinates, t, inputs, states.
    std::vector<GiNaC::symbol> moving() const;
    /// Those of them that change whatever the coordinates do: t, inputs, states.
    std::vector<GiNaC::symbol> clock() const;

    GiNaC::ex kinetic_energy() const;
    GiNaC::ex potential_energy() const;
    /// T − V, or the Lagrangian that the scene gives.
    GiNaC::ex lagrangian() const;

    /// The total time derivative of each value: q → q', q' → q'', inputs and states → their derivatives, t → 1.
    std::vector<GiNaC::ex> time_derivative(const std::vector<GiNaC::ex>& values) const;
    /// The part of the time derivative at q'' = 0 that does not come from q: ∂/∂t, inputs and states included.
    std::vector<GiNaC::ex> explicit_time_derivative(const std::vector<GiNaC::ex>& values) const;
    /// The time derivative at q'' = 0.
    std::vector<GiNaC::ex> time_derivative_without_acceleration(const std::vector<GiNaC::ex>& values) const;

    /// Q_i of the loads, per coordinate; `dissipative` selects dampers and Rayleigh's function, or all the others.
    std::vector<GiNaC::ex> generalized_forces(bool dissipative) const;
    /// Q̂_i of the impulses.
    std::vector<GiNaC::ex> generalized_impulses() const;
};

/// The same mechanism with a copy of its table of intermediate symbols. Whoever names further expressions does so
/// in a copy, so that the given mechanism does not change.
Mechanism with_own_intermediates(const Mechanism& mechanism);

/// A [polynomial]: its parameters, and its coefficients in them, highest power first.
struct PolynomialScene {
    Mechanism mechanism;  ///< with parameters only
    std::vector<GiNaC::ex> coefficients;
};

/// Throws SceneError as `build`. The scene must have a polynomial.
PolynomialScene polynomial_of(const Scene& scene);

/// Builds the mechanism of a scene. Throws ModelError for a scene with a [polynomial] in place of a mechanism, and
/// SceneError for wrong values in the scene (a negative mass or moment of inertia, a parameter that is not
/// finite), each with its place.
Mechanism build(const Scene& scene);

/// An exact number from a literal such as `0.1` or `2e3`.
GiNaC::numeric exact_number(const std::string& literal);

}  // namespace alembert
