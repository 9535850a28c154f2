// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Straight-line code as a hash-consed graph: exact constants, canonical order, one node for equal values.
///
///     Program program;
///     const int x = program.variable({Variable::Kind::coordinate, 0});
///     const int y = program.sum(0, {{2, x}, {-1, program.call(Op::sin, {x})}});      // 2x − sin x
///     program.roots.push_back({Group::output, "y", y});
///
/// Rules that make the graph the same in every run, whatever order the terms came in:
///  - terms and factors are ordered by content (`before`), never by when they were made;
///  - a sum's leading coefficient is positive, and all equal coefficients are drawn out: b − a is −1·(a − b);
///  - cos is even, sin and the other odd functions are odd: no negative argument;
///  - what depends on parameters alone is gathered inside sums and products, to be computed once a run.
/// A node's arguments precede it. No GiNaC here: `lower` is where it ends.

#include <cln/rational.h>

#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

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
};

/// "sin" for Op::sin …; as in the scene language.
const char* name_of(Op op);

struct Variable {
    /// `unknown`: what no state gives, such as a multiplier or a constant of the motion.
    enum class Kind : unsigned char { parameter, time, coordinate, rate, acceleration, unknown };
    Kind kind;
    int index = 0;
    friend bool operator==(const Variable&, const Variable&) = default;
};

struct Node {
    Op op = Op::number;
    Variable variable{};  ///< of a variable
    Rational number = 0;  ///< of a number; the constant of a sum
    std::vector<int> args{};
    std::vector<Rational> coefficients{};  ///< of a sum: one for each argument
    std::vector<int> exponents{};          ///< of a product: one for each argument, positive; or a lone −1
    unsigned depends = 0;                  ///< bits 1 << Variable::Kind
    int lead = 0;                          ///< position of the first variable in it, for the order
    double size = 1;                       ///< operations when written out as a tree
    std::uint64_t hash = 0;                ///< of the content; the same in every run
    std::vector<int> sources{};            ///< indices into Program::source_labels: whose term it is

    bool is_number() const { return op == Op::number; }
    /// Depends on nothing that changes during a run.
    bool is_constant() const { return (depends & ~1U) == 0; }
    /// 1/x: the only place of a negative exponent.
    bool is_reciprocal() const { return op == Op::product && args.size() == 1 && exponents[0] == -1; }
    /// A number times something: c·x.
    bool is_scaled() const { return op == Op::sum && args.size() == 1 && cln::zerop(number); }
};

/// A coordinate, a speed or a parameter as people know it.
struct Quantity {
    std::string name, unit;
    double value = 0;  ///< of a parameter
    int rate_of = -1;  ///< of a speed that is the rate of a coordinate: which
};

/// What a root is. The roots of a group stand in the order of their entries, matrices row by row.
enum class Group : unsigned char {
    // M u' = f + Aᵀλ with A u' = γ; u = q' where the program has no speeds of its own.
    mass,          ///< M, its lower triangle
    forcing,       ///< f
    acceleration,  ///< u'
    rate,          ///< q', where the speeds are not the rates
    second_rate,   ///< q'', likewise
    row,           ///< A in q', n for each constraint
    speed_row,     ///< A in speeds, s for each; zeros for constraints that the speeds have eliminated
    gamma,         ///< γ, of each constraint that has a multiplier in the equations: Root::constraint
    position,      ///< f(q, t) of each holonomic constraint, 0 of others
    velocity,      ///< A q' + b of each constraint
    multiplier,    ///< λ
    projected,     ///< the state after one step of Newton's method to the constraints
    pivot,         ///< what this step divides by
    speed,         ///< the scene's generalized speeds, in the state or in rates
    speed_rate,
    form_row,  ///< of a speed as a linear form in q', n for each
    kinetic,
    potential,
    energy,
    power,
    jacobi,
    output,
    event,
    slip,         ///< of each dry friction: its sliding velocity,
    stick_bound,  ///< its static coefficient over the kinetic one,
    friction,     ///< its coefficient while it slides,
    normal,       ///< its normal force,
    determinant,  ///< and what this is divided by where it is a multiplier, else 1 (lower/normal_forces.hpp)
    load,         ///< inverse dynamics: M q'' − f
    force,
    moment,  ///< of joints, three components for each
    input,   ///< prescribed motions and their derivatives
    jacobian,
    parameter_jacobian,
    power_gradient,  ///< differentiate.hpp
};

/// A value that somebody wants.
struct Root {
    Group group;
    std::string name;  ///< for people and for identifiers of emitted code; decides nothing
    int node;
    int constraint = -1;  ///< of γ: the position of its constraint
};

struct Operations {
    int additions = 0, multiplications = 0, divisions = 0, functions = 0;
    int total() const { return additions + multiplications + divisions + functions; }
};

class Program {
public:
    using Term = std::pair<Rational, int>;  ///< coefficient, node
    using Factor = std::pair<int, int>;     ///< node, exponent

    int number(const Rational& value);
    int pi();
    int variable(Variable variable);
    /// constant + Σ coefficient·node
    int sum(const Rational& constant, const std::vector<Term>& terms);
    /// coefficient · Π node^exponent
    int product(const Rational& coefficient, const std::vector<Factor>& factors);
    /// base^exponent for a whole or half exponent exactly, through `pow` otherwise.
    int power(int base, const Rational& exponent);
    int call(Op op, std::vector<int> args);

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
    /// What a step of an integration evaluates: the accelerations, and the rates where the speeds are not the
    /// rates.
    std::vector<int> right_hand_side() const;

    /// Operations at each evaluation of `roots`: what depends on parameters alone is not counted.
    Operations count(std::span<const int> roots) const;

    /// Names and labels without any node or root: where a copy begins.
    Program shell() const;

    /// The same program with its nodes in the order in which the roots meet them, and without those that no root
    /// needs. Numbers of nodes are then the same in every run, whatever order they were made in.
    Program canonical() const;

    /// New nodes get these sources from now on (indices into `source_labels`; 0 is the scene as a whole). Gives
    /// the former ones.
    std::vector<int> set_sources(std::vector<int> sources) { return std::exchange(sources_, std::move(sources)); }

    std::vector<Root> roots;
    std::vector<std::string> source_labels;
    std::string name;                               ///< of the scene, a file's stem
    std::vector<Quantity> parameters, coordinates;  ///< what the variables' indices mean
    std::vector<Quantity> speeds;                   ///< of the state beside the coordinates; empty: their rates
    std::string formulation;                        ///< formalism and form, for people
    bool is_textbook = false;  ///< the equations are in their readable form; the order of terms is the book's
    bool singular = false;     ///< no state makes the mass matrix regular; the accelerations are missing

private:
    int intern(Node node);
    int scaled(const Rational& coefficient, int node);

    std::vector<Node> nodes_;
    std::unordered_map<std::uint64_t, std::vector<int>> known_;
    std::vector<int> sources_{0};
};

}  // namespace alembert
