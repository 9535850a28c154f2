// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Exact random states of a mechanism: modulo 2⁶¹ − 1 they obey the constraints and their derivatives, and they
/// have the accelerations and multipliers that the equations give.
///
///     const Motions motions(mechanism, equations);
///     if (const auto state = motions.at(seed))
///         evaluate_mod(claim, state->point, roots);         // zero at each seed, if the claim is right
///
/// Positions: each holonomic constraint is solved for one coordinate, or for one parameter (the statements to be
/// tested hold for all values of the parameters), as the root of a polynomial. The polynomial is interpolated, all
/// its roots in the field are found, and one of them is taken. An angle that occurs only in sines and cosines is
/// found by the tangent of its half. Two constraints with two common unknowns that cannot be solved otherwise are
/// solved together (analysis/exact/common_zeros.hpp). Conditions of a motion that cannot be solved in such an
/// order are `loose`: the states are then on f(q, t) = const with any constants for these. A statement that holds
/// there and does not divide by something that vanishes with f also holds on f = 0. With Positions::free no
/// condition is solved, and all are loose: a combination of the equations of motion and the differentiated
/// constraints holds there too, and no root has to exist. If equations of rest cannot be solved in such an order,
/// there are no states, and `obstacle` says so; states in numbers obey them all the same. Rates obey A q' + b = 0,
/// accelerations and multipliers M q'' − Aᵀλ = f, A q'' = γ: linear systems.
///
/// `unknown` m + k is the multiplier of constraint k of Mechanism::undetermined(): For a gap, in equations that
/// contain it, the multiplier is random; for a redundant constraint it is its share of least norm in the forces
/// (analysis/exact/least_shares.hpp), as for the constraints that are kept.
///
/// Dry friction on a constraint has the normal force |λ|, so that the equations are linear in q'' and λ once the
/// sign of each such λ is known. All signs are tried, from a random one on, and the first solution that has the
/// signs with which it was found is taken; a sign is Legendre's symbol here, as in every evaluation
/// (program/modular.hpp). Parameters are squares, and count as positive; those that are negative in the scene are
/// squares times -1, which is none, and those that are zero are of either kind.
///
/// Constraints may have several branches (x² = l²: x = l and x = −l), and a statement that holds on one branch
/// need not hold on the others. One of the roots of a polynomial of degree d is drawn at random, so that each
/// branch is reached with at least 1/d of the seeds. If a quadratic equation has no root for some seed, it is
/// irreducible, and a statement that holds at a random one of its roots also holds at the other.
///
/// Where the rows of constraints depend on each other there is no state. Of a chain of loops that each have a
/// branch on which this comes out at the next loop, few of the draws of all roots would be usable. Therefore the
/// rows that a step makes known are compared with those before, and if they depend on each other, another root is
/// taken in its place, or in that of the step before. A branch with states is still met by at least as many seeds
/// as draw all its roots at once.
///
/// Unknowns that the equations leave open at every state, such as the acceleration of a spin without a moment of
/// inertia, are random (`open_unknowns`): what holds for all their values follows from the equations.
///
/// With the scene's own branch given, `on_own_branch` draws states on that branch alone
/// (analysis/exact/own_point.hpp), and conditions are solved for variables that they determine there: a branch on
/// which an angle is π whatever the others are is lost where the condition is solved for one of these.
///
/// States of rest instead: q' = q'' = 0, q and λ such that f + Aᵀλ = 0 (Zhang & Qin, §1.2: equilibrium from the
/// general equation of dynamics). Every root is taken in turn by some seed, so that all branches are met. An
/// equation of rest in parameters alone, g·(m₂ sin β − m₁ sin α) = 0, is solved for one of them if it has one
/// factor besides parameters, which do not vanish. An equation x·(l − √(x² + h²)) = 0 that is solved for l
/// vanishes with its other factor too: some seeds take x = 0, and so all choices of factors are met. Equations
/// that cannot be solved one after the other as they are may become so when they are combined
/// (analysis/exact/reduced_sums.hpp).

#include <map>
#include <set>

#include "analysis/exact/exact_state.hpp"
#include "analysis/exact/own_point.hpp"
#include "analysis/exact/quadratic_residue_points.hpp"
#include "analysis/exact/solving_order.hpp"
#include "model/formalism/equations.hpp"

namespace alembert {

class Motions {
public:
    enum class At { motion, rest };
    enum class Positions { solved, free };

    /// Which states are drawn. Angles that are solved for may occur divided by up to 2^halves, and all others by
    /// up to 2^halvings (analysis/exact/quadratic_residue_points.hpp), in the equations and in the expressions
    /// that will be evaluated.
    struct Sampling {
        At at = At::motion;
        int halves = 0, halvings = 0;
        Positions positions = Positions::solved;
        std::optional<OwnBranch> own = {};
    };
    Motions(const Mechanism& mechanism, const Equations& equations);
    Motions(const Mechanism& mechanism, const Equations& equations, Sampling sampling);
    Motions(const Motions&) = delete;
    Motions& operator=(const Motions&) = delete;

    /// Values, instead of random ones, of variables that are not solved for, and turns of angles with these
    /// values, as in ModularPoint.
    struct Given {
        std::map<std::pair<Variable::Kind, int>, Prime> values;
        std::map<Prime, PrimeTurn> angles;
    };
    /// Nothing for an unusable seed: there is no root in the field, or a denominator is zero. Bit r of `turned`:
    /// the multiplier of row rows_with_friction()[r] has the sign opposite to Legendre's symbol.
    std::optional<ExactState> at(std::uint64_t seed, const Given& given, unsigned turned = 0) const;
    std::optional<ExactState> at(std::uint64_t seed, unsigned turned = 0) const {
        return at(seed, Given{.values = {}, .angles = {}}, turned);
    }

    /// The same, on the scene's own branch. Nothing also where the branches cannot be told apart.
    std::optional<ExactState> on_own_branch(std::uint64_t seed) const;
    /// Whether there may be several branches, so that `at` draws one of them.
    bool has_branches() const { return has_branches_; }
    const std::optional<OwnBranch>& own() const { return own_; }

    /// The conditions, as nodes of program(), that the states need not obey.
    const std::vector<int>& loose() const { return loose_; }
    /// The conditions of constraints without a row in the equations; they follow from the others on some branch.
    const std::vector<int>& implied() const { return implied_; }

    /// The reason why there is no state for any seed; empty if there may be states.
    const std::string& obstacle() const { return obstacle_; }
    At where() const { return at_; }

    /// The steps in the order of solving.
    const std::vector<SolvingStep>& steps() const { return steps_; }
    /// Those that this seed takes, in numbers.
    const std::vector<SolvingStep>& steps(std::uint64_t seed) const {
        const std::size_t choice = seed % (other_orders_.size() + 1);
        return choice == 0 ? steps_ : other_orders_[choice - 1].steps;
    }
    /// The same in exact arithmetic, which takes another order only where a factor lacks its variable.
    const std::vector<SolvingStep>& exact_steps(std::uint64_t seed) const {
        return is_lost_ ? steps(seed) : steps_;
    }
    /// At rest, orders whose conditions that are left contradict the others, but for some values of parameters
    /// that are zero or equal.
    const std::vector<SolvingOrder>& contradicted() const { return contradicted_; }

    /// The entries of the system as nodes, which can also be evaluated in other arithmetic.
    struct System {
        std::vector<int> M;              ///< n·n, by rows
        std::vector<int> f;              ///< n
        std::vector<int> A;              ///< m·n, by rows
        std::vector<int> offset, gamma;  ///< m
        std::vector<int> redundant;      ///< rows of Mechanism::redundant, n each
    };
    const Program& program() const { return program_; }
    const System& entries() const { return system_; }
    int size() const { return n_; }
    int halves() const { return halves_; }
    int constraints() const { return m_; }
    /// The sign that an independent parameter has in the scene, and so in all states; 0 for any.
    int sign_of_parameter(int parameter) const { return own_value(parameter).csgn(); }
    /// The value of an independent parameter in the scene.
    const GiNaC::numeric& own_value(int parameter) const {
        return own_values_[static_cast<std::size_t>(parameter)];
    }
    /// The rows on which friction acts, in ascending order: `f` contains the absolute values of their multipliers,
    /// linearly, and no other multiplier of the equations.
    const std::vector<int>& rows_with_friction() const { return rows_with_friction_; }
    /// Whether signs, absolute values, min or max decide in the equations or the constraints.
    bool has_sides() const { return has_sides_; }
    /// The columns of the system of accelerations and multipliers that the equations leave open at every state.
    const std::vector<std::size_t>& open_unknowns() const { return open_unknowns_; }
    /// The index of the `unknown` that is the multiplier of row k; the kept rows come first, then the redundant
    /// ones.
    int multiplier(int k) const { return k < m_ ? k : k + gaps_; }

private:
    void order(const std::vector<int>& conditions);
    /// Orders the conditions of rest: constraints, and sums that vanish.
    void order_rest(const std::vector<int>& positions, const std::vector<GiNaC::ex>& balance, const Mechanism& m,
                    const std::vector<std::pair<GiNaC::symbol, int>>& given);
    /// Where an equation of rest has factors: all choices of one factor of each equation, since one of them may
    /// lack the variable for which the equation is solved, have no root in exact arithmetic, or be there twice,
    /// which Newton's method does not like. False if one of the choices cannot be solved.
    bool find_other_factors(const std::map<int, GiNaC::ex>& sums, const Mechanism& m,
                            const std::vector<std::pair<GiNaC::symbol, int>>& given);
    /// Whether conditions that are left are not zero where the steps are taken.
    bool contradict(const SolvingOrder& order) const;
    /// Where the roots exist that these nodes and the conditions need.
    void find_usable_points(std::vector<int> nodes, int halvings);
    void find_branches();
    void find_open_unknowns();
    void find_known_rows();
    /// Positions for one of the seeds of find_open_unknowns, preferably where the rows are independent.
    bool solve_any(ExactState& state) const;
    /// M, −Aᵀ and A at values of entries(), with a last column of zeros.
    std::vector<std::vector<Prime>> matrix_of_system(const ModularValues& at) const;
    std::optional<ExactState> solved(ExactState state, const OwnPoint* own, unsigned turned) const;
    enum class Outcome { solved, no_root, dependent_rows };
    /// The rows of constraints that are known, in echelon form.
    struct KnownRows {
        std::vector<std::vector<Prime>> rows{};
        std::vector<std::size_t> pivots{};
        int draws = 0;  ///< how many roots were taken
    };
    /// Takes the steps from `step` on. `known` is null if rows may depend on each other.
    Outcome solve_steps(ExactState& state, const OwnPoint* own, std::size_t step, KnownRows* known) const;
    /// Adds the rows that become known before this step; false if they depend on each other.
    bool add_known_rows(const ExactState& state, std::size_t step, KnownRows& known) const;
    bool move(ExactState& state, unsigned turned) const;
    bool accelerate(ExactState& state, unsigned turned) const;
    bool share_out(ExactState& state) const;

    Program program_;
    System system_;
    std::vector<SolvingStep> steps_;
    std::vector<SolvingOrder> other_orders_, contradicted_;  ///< at rest, of other factors
    bool is_lost_ = false;  ///< whether a factor lacks the variable for which its equation is solved
    std::vector<int> loose_, implied_, rows_with_friction_;
    std::vector<bool> irreducible_;  ///< for each step
    std::vector<std::size_t> open_unknowns_;
    std::vector<std::vector<std::size_t>> known_rows_;  ///< that become known before each step, and after the last
    bool has_branches_ = false, has_sides_ = false;
    std::optional<OwnBranch> own_;
    std::optional<OwnPoints> own_points_;  ///< refers to program_, steps_ and own_
    std::string obstacle_;
    At at_;
    int n_ = 0, m_ = 0, gaps_ = 0, halves_ = 0, finer_ = 0;
    std::vector<GiNaC::numeric> own_values_;        ///< of each independent parameter
    std::optional<QuadraticResiduePoints> usable_;  ///< refers to program_
};

}  // namespace alembert
