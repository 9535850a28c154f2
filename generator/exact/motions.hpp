// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Random states of a mechanism that are exact: they obey the constraints and their derivatives, with the
/// accelerations and multipliers that the equations give, modulo 2⁶¹ − 1.
///
///     const Motions motions(mechanism, equations);
///     if (const auto state = motions.at(seed))
///         evaluate_mod(claim, state->point, roots);         // zero at each seed, if the claim is right
///
/// Positions: each holonomic constraint is solved for one coordinate, or one parameter (what is asked holds for
/// all values of the parameters), as the root of a polynomial: interpolated, all roots in the field found, one of
/// them taken. An angle that occurs in sines and cosines alone is solved for by the tangent of its half. Two
/// constraints that share two unknowns and leave no other way are solved together (exact/common_zeros.hpp).
/// Conditions of a motion that have no order of solving of this kind are `loose`: the states are then on f(q, t) =
/// const with any constants for these. What holds there, and divides by nothing that vanishes with f, holds on f =
/// 0. With Positions::free no condition is solved and all are loose: a combination of the equations of motion and
/// the differentiated constraints holds there, and no root has to exist. Equations of rest without such an order
/// have no states, and `obstacle` says so. Rates obey A q' + b = 0,
/// accelerations and multipliers M q'' − Aᵀλ = f, A q'' = γ: linear systems.
///
/// `unknown` m + k is the multiplier of constraint k of Mechanism::undetermined(): of a gap random, in equations
/// that hold it; of a redundant constraint its least share of the forces (exact/least_shares.hpp), as of those
/// that are kept.
///
/// Constraints may have several branches (x² = l²: x = l and x = −l), and what holds on one need not hold on the
/// others: of the roots of a polynomial of degree d one is drawn, so that a branch is met at 1/d of the seeds at
/// least. Where a quadratic equation has no root at some seed it is irreducible, and what holds at a random one of
/// its roots holds at the other.
///
/// States of rest instead: q' = q'' = 0, q and λ such that f + Aᵀλ = 0 (Zhang & Qin, §1.2: equilibrium from the
/// general equation of dynamics). Every root is taken in turn by some seed, so that all branches are met. An
/// equation of rest in parameters alone, g·(m₂ sin β − m₁ sin α) = 0, is solved for one of them if it has one
/// factor besides parameters, which do not vanish.

#include <set>

#include "exact/exact_state.hpp"
#include "exact/solving_order.hpp"
#include "exact/square_points.hpp"
#include "formalism/equations.hpp"

namespace alembert {

class Motions {
public:
    enum class At { motion, rest };
    enum class Positions { solved, free };

    /// `halves`: angles that are solved for may occur in parts of 1/2^halves; `halvings`: all others in these
    /// (exact/square_points.hpp), if not in the equations, in what will be asked.
    Motions(const Mechanism& mechanism, const Equations& equations, At at = At::motion, int halves = 0,
            int halvings = 0, Positions positions = Positions::solved);
    Motions(const Motions&) = delete;
    Motions& operator=(const Motions&) = delete;

    /// Nothing at an unusable seed: no root in the field, a zero denominator.
    /// `given`: values instead of random ones, of what is not solved for.
    std::optional<ExactState> at(std::uint64_t seed,
                                 const std::map<std::pair<Variable::Kind, int>, Prime>& given = {}) const;

    /// Conditions, in program(), that the states need not obey.
    const std::vector<int>& loose() const { return loose_; }
    /// Conditions of constraints without a row in the equations: they follow from the others, on some branch.
    const std::vector<int>& implied() const { return implied_; }

    /// Why there is no state at any seed; empty if there may be.
    const std::string& obstacle() const { return obstacle_; }
    At where() const { return at_; }

    /// In the order of solving.
    const std::vector<SolvingStep>& steps() const { return steps_; }

    /// The system's entries as nodes: what other arithmetic can evaluate too.
    struct System {
        std::vector<int> M;             ///< n·n, by rows
        std::vector<int> f;             ///< n
        std::vector<int> A;             ///< m·n, by rows
        std::vector<int> drift, gamma;  ///< m
        std::vector<int> redundant;     ///< rows of Mechanism::redundant, n each
    };
    const Program& program() const { return program_; }
    const System& entries() const { return system_; }
    int size() const { return n_; }
    int constraints() const { return m_; }
    /// `unknown` of the multiplier of row k: those that are kept first, then the redundant ones.
    int multiplier(int k) const { return k < m_ ? k : k + gaps_; }

private:
    void order(std::vector<int> conditions, const std::set<int>& irreducible);
    void find_branches();
    bool move(ExactState& state) const;
    bool share_out(ExactState& state) const;

    Program program_;
    System system_;
    std::vector<SolvingStep> steps_;
    std::vector<int> loose_, implied_;
    std::vector<bool> irreducible_;  ///< by step
    std::string obstacle_;
    At at_;
    int n_ = 0, m_ = 0, gaps_ = 0, halves_ = 0, finer_ = 0;
    std::optional<SquarePoints> usable_;  ///< refers to program_
};

}  // namespace alembert
