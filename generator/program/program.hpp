// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Straight-line code as a hash-consed graph: exact constants, canonical order, one node for equal values.
///
///     Program program;
///     const int x = program.variable({Variable::Kind::coordinate, 0});
///     const int y = program.sum(0, {{2, x}, {-1, program.call(Op::sin, {x})}});      // 2x − sin x
///     program.roots.push_back({Group::output, "y", y});
///
/// The following rules make the graph the same in every run, in whatever order terms are given:
///  - terms and factors are ordered by content (`before`), never by the time at which they were made;
///  - a sum's leading coefficient is positive, and a factor that all coefficients share is taken out: b − a is
///    −1·(a − b);
///  - no even or odd function such as cos or sin has a negative argument;
///  - parts of sums and products that depend on parameters only are collected, to be computed once in a run.
/// A node's arguments precede it. GiNaC is not used from here on; `lower` is the last room that uses it.

#include <cln/rational.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "alembert/base/tabulated_function.hpp"
#include "program/kept_lists.hpp"

namespace alembert {

using Rational = cln::cl_RA;

enum class Op : unsigned char {
    number,
    pi,
    variable,
    sum,
    product,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    sinh,
    cosh,
    tanh,
    exp,
    log,
    sqrt,
    abs,
    sign,
    pow,
    atan2,
    min,
    max,
    unspecified,  ///< a call as in algebra/symbolic/unspecified.hpp; its first argument is the position of the
                  ///< function, which may have a table
};

/// The scene language's name: "sin" for Op::sin …
const char* name_of(Op op);

struct Variable {
    /// `unknown` is a variable that no state gives, such as a multiplier or a constant of the motion.
    enum class Kind : unsigned char { parameter, time, coordinate, rate, acceleration, unknown };
    Kind kind;
    int index = 0;
    friend bool operator==(const Variable&, const Variable&) = default;
};

/// That of Node::depends.
constexpr unsigned bit(Variable::Kind kind) {
    return 1U << static_cast<unsigned>(kind);
}

/// The lists stand in the program, and as long as it does.
struct Node {
    Op op = Op::number;
    Variable variable{};  ///< set if the node is a variable
    Rational number = 0;  ///< the value of a number, or the constant of a sum
    std::span<const int> args{};
    std::span<const Rational> coefficients{};  ///< for a sum, one for each argument
    std::span<const int> exponents{};  ///< for a product, one for each argument, all positive; or a single −1
    unsigned depends = 0;              ///< bits 1 << Variable::Kind
    int lead = 0;                      ///< the position of its first variable, for the order of terms
    double size = 1;                   ///< operations if the node were written out as a tree
    std::uint64_t hash = 0;            ///< of the contents; the same in every run
    std::span<const int>
        sources{};  ///< indices into Program::source_labels: the parts of the mechanism from which it comes

    bool is_number() const { return op == Op::number; }
    /// Whether it does not change during a run.
    bool is_constant() const { return (depends & ~1U) == 0; }
    /// Whether it is 1/x, the only form with a negative exponent.
    bool is_reciprocal() const { return op == Op::product && args.size() == 1 && exponents[0] == -1; }
    /// Whether it is a number times another node: c·x.
    bool is_scaled() const { return op == Op::sum && args.size() == 1 && cln::zerop(number); }
};

/// The name and unit of a coordinate, a speed or a parameter.
struct Quantity {
    std::string name, unit;
    double value = 0;           ///< the value of a parameter
    int rate_of = -1;           ///< for a speed that is the rate of a coordinate, the index of that coordinate
    bool from_outside = false;  ///< for a parameter that is the value of an input, which callers give
};

/// The meaning of a root. The roots of a group stand in the order of their entries, matrices row by row.
enum class Group : unsigned char {
    // M u' = f + Aᵀλ with A u' = γ; u = q' if the program has no other speeds.
    mass,           ///< M, its lower triangle
    forcing,        ///< f
    acceleration,   ///< u'
    rate,           ///< q', if the speeds are not the rates
    second_rate,    ///< q'', in the same case
    row,            ///< A in q', n for each constraint
    speed_row,      ///< A in speeds, s for each; zeros for constraints that the speeds have eliminated
    gamma,          ///< γ of each constraint that has a multiplier in the equations; Root::constraint tells which
    position,       ///< f(q, t) of each holonomic constraint, 0 of others
    velocity,       ///< A q' + b of each constraint
    redundant_row,  ///< the same of the constraints that follow from these: A in q',
    redundant_speed_row,  ///< in speeds,
    redundant_position,   ///< f(q, t) or 0,
    redundant_velocity,   ///< and A q' + b
    tied_row,    ///< A in u' of those of them that are tied to constraints above (Mechanism::Constraint::tie), s
                 ///< for each,
    tied_gamma,  ///< γ of these,
    tie,         ///< and what stands beside A in K (motion_system.hpp), lower triangle
    multiplier,  ///< λ
    projected,   ///< the state after one step of Newton's method to the constraints
    pivot,       ///< the divisors of this step
    speed,       ///< the scene's generalized speeds, as functions of the state or of the rates
    speed_rate,
    form_row,  ///< the coefficients of a speed as a linear form in q', n for each
    kinetic,
    potential,
    energy,
    power,
    jacobi,
    output,
    event,
    sliding_velocity,  ///< for each dry friction,
    stick_bound,       ///< its static coefficient over the kinetic one,
    friction,          ///< its coefficient while it slides,
    normal,            ///< its normal force,
    determinant,       ///< and the divisor of that force if it is a multiplier, else 1
                       ///< (program/lower/normal_forces.hpp)
    friction_column,   ///< ∂f/∂λ of friction whose normal force is a multiplier λ, a number for each speed;
                       ///< Root::constraint tells which λ
    sliding_acceleration,  ///< the rate of the sliding velocity at q'' = 0
    grip,                  ///< the restitution of the sliding velocity
    across,                ///< the second component of a sliding velocity in a plane whose direction follows from
                           ///< parameters; Root::constraint is the position of its friction
    load,                  ///< inverse dynamics: M q'' − f
    force,
    moment,  ///< the moments of joints, three components for each
    input,   ///< prescribed motions and their derivatives
    jacobian,
    parameter_jacobian,
    power_gradient,
    value_gradient,  ///< differentiate.hpp
    tangent,         ///< derivatives along a direction (tangent.hpp)
    event_impulse,   ///< the impulses of each event that has some, n for each
    function,        ///< results of functions of their own (named_function.hpp)
    alignment,       ///< products of axes that coincide, each 1 (Mechanism::Alignment); Root::constraint is its
                     ///< position
};

/// A value that the program computes for its users.
struct Root {
    Group group;
    std::string name;  ///< for people and for identifiers of emitted code; decides nothing
    int node;
    int constraint = -1;  ///< for γ, the position of its constraint; for `across`, that of its friction
};

struct Operations {
    int additions = 0, multiplications = 0, divisions = 0, functions = 0;
    int total() const { return additions + multiplications + divisions + functions; }
};

class Program {
public:
    // Defined in one file: inline, every file that holds one would compile the copies of all its parts.
    Program();
    Program(const Program&);
    Program(Program&&) noexcept;
    Program& operator=(const Program&);
    Program& operator=(Program&&) noexcept;
    ~Program();

    using Term = std::pair<Rational, int>;  ///< coefficient, node
    using Factor = std::pair<int, int>;     ///< node, exponent

    int number(const Rational& value);
    int pi();
    int variable(Variable variable);
    /// constant + Σ coefficient·node
    int sum(const Rational& constant, std::span<const Term> terms);
    int sum(const Rational& constant, std::initializer_list<Term> terms) {
        return sum(constant, {terms.begin(), terms.size()});
    }
    /// coefficient · Π node^exponent
    int product(const Rational& coefficient, std::span<const Factor> factors);
    int product(const Rational& coefficient, std::initializer_list<Factor> factors) {
        return product(coefficient, {factors.begin(), factors.size()});
    }
    /// base^exponent, exactly for a whole or half exponent, otherwise by `pow`.
    int power(int base, const Rational& exponent);
    int call(Op op, std::span<const int> args);
    int call(Op op, std::initializer_list<int> args) { return call(op, {args.begin(), args.size()}); }

    const Node& operator[](int node) const { return nodes_[node]; }
    int size() const { return static_cast<int>(nodes_.size()); }
    bool is_zero(int node) const { return nodes_[node].is_number() && cln::zerop(nodes_[node].number); }

    /// The canonical order of terms: variables by kind and index, then by first variable, size and content.
    bool before(int a, int b) const;

    /// All nodes that `roots` need, arguments first.
    std::vector<int> needed(std::span<const int> roots) const;
    std::vector<int> nodes_of(Group group) const;
    /// The constraints that have multipliers in the equations, in the order of γ.
    std::vector<int> kept_constraints() const;
    /// The nodes that a step of an integration evaluates: the accelerations, and the rates if the speeds are not
    /// the rates.
    std::vector<int> right_hand_side() const;
    /// The components of the state, coordinates first, on which these depend; −1 among them if time is one of what
    /// they depend on, or anything else that changes during a run.
    std::vector<int> needed_state() const;

    /// The operations at each evaluation of `roots`. Nodes that depend on parameters only are not counted.
    Operations count(std::span<const int> roots) const;

    /// A program with the same names and labels but without nodes and roots, from which a copy starts.
    Program shell() const;

    /// The same program with its nodes in the order in which the roots meet them, and without nodes that no root
    /// needs. The numbers of nodes are then the same in every run, in whatever order they were made.
    Program canonical() const;

    /// Sets the sources of new nodes from now on (indices into `source_labels`; 0 is the scene as a whole).
    /// Returns the former sources.
    std::span<const int> set_sources(std::span<const int> sources);
    std::span<const int> set_sources(std::initializer_list<int> sources) {
        return set_sources({sources.begin(), sources.size()});
    }

    std::vector<Root> roots;
    std::vector<std::string> source_labels;

    /// Nodes with this source are signs of a reaction on which a dry friction acts. A scene does not write them;
    /// they come from the solution for the normal forces (program/lower/normal_forces.hpp), and all but the last
    /// round of that solution look at trial values.
    struct ReactionSign {
        int source;
        std::string friction;
        bool is_trial;
    };
    std::vector<ReactionSign> reaction_signs;
    std::string name;                               ///< the name of the scene, that of its file without ending
    std::vector<Quantity> parameters, coordinates;  ///< the quantities to which the indices of variables refer
    std::vector<std::string> functions;  ///< names of [functions] and [tables], to which Op::unspecified refers
    /// Of each of them its points; null if it is open.
    std::vector<std::shared_ptr<const TabulatedFunction>> tables;
    std::vector<Quantity> speeds;  ///< the speeds in the state; if empty, the rates of the coordinates
    int states = 0;                ///< how many of the speeds, at the end, are first-order states of the scene
    std::string formulation;       ///< formalism and form, for people
    /// Whether the equations are in their readable form, with the order of terms of a book.
    bool is_textbook = false;
    /// Whether the mass matrix is singular at every state, so that there are no accelerations.
    bool singular = false;
    /// Friction takes its normal force from multipliers: Group::mass and Group::forcing lack it, the right-hand
    /// side has it.
    bool friction_on_multipliers = false;
    /// Group::mass and Group::forcing have the terms c A^T A and c A^T gamma of the norms of quaternions.
    bool has_norm_terms = false;

    /// Throws ModelError for a node with Op::unspecified: the function has no values, and is named.
    [[noreturn]] void refuse_unspecified(const Node& node) const;
    /// The table of a node with Op::unspecified; null if the function is open.
    const TabulatedFunction* table_of(const Node& node) const;
    /// The same with the table's owner.
    std::shared_ptr<const TabulatedFunction> shared_table_of(const Node& node) const;
    /// The position in `functions` of the one that a node with Op::unspecified calls.
    std::size_t function_of(const Node& node) const;
    /// Of a call of a table: the derivative that it is, and whether the intervals of its arguments are held, whose
    /// numbers then stand behind the arguments (alembert/base/tabulated_function.hpp).
    struct TableCall {
        TabulatedFunction::Orders orders{};
        std::array<int, 2> argument{};  ///< nodes
        std::array<int, 2> number{};    ///< nodes, if they are held
        bool is_held = false;
        std::size_t arguments = 1;
    };
    TableCall table_call(const Node& node) const;

private:
    /// The node with these contents, whose lists may stand anywhere.
    int intern(const Node& contents);
    int scaled(const Rational& coefficient, int node);
    int simpler_call(Op op, std::span<const int> args);

    std::vector<Node> nodes_;
    KnownItems known_;
    KeptLists<int> integers_;
    KeptLists<Rational> rationals_;
    std::vector<std::span<const int>> source_lists_;  ///< each once
    KnownItems known_sources_;
    std::span<const int> sources_;  ///< of new nodes
};

}  // namespace alembert
