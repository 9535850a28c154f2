// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equilibria and steady motions as the roots of a system of equations, and Newton's method for them.
///
///     const SteadyProblem problem(mechanism, equations, start);
///     if (const auto root = problem.solve(problem.start())) root->at.q;        // obeys the constraints
///
/// In independent coordinates r and speeds w (stability/linear/linearize.hpp), a motion is steady if
///     Uᵀ(f − M c) = 0,     r'_e = 0,     w_c = given,
/// where e are the essential coordinates and c the cyclic ones. The rates of the latter are given, namely those of
/// the state from which the search starts. With `Rates::free` the last equations are left out, and these rates
/// follow from the others (a rotor that a torque drives and friction brakes). The first equations are the
/// unbalanced forces at w' = 0, which need no inertia: a pole of spherical coordinates is an equilibrium too.
///
/// Newton's method chooses the independent coordinates again at each step, so that it may pass through any pose at
/// which the rows of the constraints are independent. Steps are bounded, and of least length if the system does
/// not determine them (Gauss-Newton). The computation is in long double.

#include <optional>

#include "program/lower/start.hpp"
#include "stability/linear/dependence.hpp"

namespace alembert {

enum class Rates { given, free };

/// The system at one state that obeys the constraints.
struct SteadySystem {
    Split split;
    Tangent<long double> tangent;
    std::vector<Eigen::Index> unknowns;  ///< columns of the tangent: essential coordinates, speeds
    VectorOf<long double> residual;      ///< equations of forces, then of rates
    MatrixOf<long double> by;            ///< its derivative by the unknowns
};

struct SteadyRoot {
    Instant<long double> at;
    /// The largest unbalanced force, relative to the sum of the effects of all unknowns.
    long double residual = 0;
    long double step = 0;  ///< Newton's last step, which is the accuracy of the root, in units of the scales
    bool isolated = true;  ///< false if the equations leave a direction free to first order
};

/// A first-order state of the scene that has a rate.
struct MovingState {
    std::size_t number;  ///< among those of the scene
    std::size_t place;   ///< among the speeds
    long double scale;   ///< the size of an ordinary change
};

class SteadyProblem {
public:
    /// About the state of `start`. Mechanism and equations must outlive it. Throws ModelError where the equations
    /// change with time other than through inputs, IntegrationError where constraints or inertia are singular at
    /// this state and near it.
    SteadyProblem(const Mechanism& mechanism, const Equations& equations, const Start& start);

    const Residuals& residuals() const { return residuals_; }
    /// Whether the equations have a first approximation at this state; they have none at a kink.
    bool has_first_approximation(const Instant<long double>& at) const;
    /// Of which a step of `solve` computes values and derivatives.
    std::size_t nodes() const { return at_rest_ ? at_rest_->steady.size() : residuals_.steady.size(); }
    const Instant<long double>& start() const { return start_; }
    void set_start(Instant<long double> start) { start_ = std::move(start); }
    /// For each coordinate, whether the motion of any other depends on it.
    const std::vector<bool>& essential() const { return essential_; }
    /// Rows: combinations of all speeds that move cyclic coordinates only; their values are the given ones.
    const MatrixOf<long double>& kept_speeds() const { return kept_speeds_; }
    /// Whether nothing moves this first-order state, whose place is among the speeds.
    bool is_held(std::size_t place) const;
    /// The size of an ordinary change of each coordinate; 1 unless set.
    void set_scales(std::vector<long double> scales) { scales_ = std::move(scales); }
    const std::vector<long double>& scales() const { return scales_; }
    /// None unless set.
    void set_states(std::vector<MovingState> states) { states_ = std::move(states); }
    const std::vector<MovingState>& states() const { return states_; }

    /// The cyclic ones of the speeds `given` are kept. `at` must obey the constraints. If `split` is null, the one
    /// that suits the state is used.
    SteadySystem linearized_at(const Instant<long double>& at, const std::vector<long double>& given,
                               Rates rates = Rates::given, const Split* split = nullptr) const;

    /// Solves from a state, which is moved onto the constraints first; its cyclic rates are the given ones.
    /// Nothing if Newton's method does not converge.
    std::optional<SteadyRoot> solve(Instant<long double> from, Rates rates = Rates::given, int most = 60) const;

    /// Moves dependent coordinates and speeds until the constraints hold; false if they do not.
    bool settle_at(Instant<long double>& at, const Split* split = nullptr) const;

    /// The largest |element| of a change of coordinates, each divided by its scale.
    long double size(const VectorOf<long double>& change) const;

    /// The state as a start of the mechanism, with the rates that belong to the speeds.
    Start start_at(const Start& like, const Instant<long double>& at) const;

private:
    Split split_at(const Instant<long double>& at) const;
    /// For each coordinate, whether it stays as it is in every steady motion.
    std::vector<bool> resting() const;
    SteadySystem system_of(const Residuals& residuals, const Instant<long double>& at,
                           const std::vector<long double>& given, Rates rates, const Split& split) const;
    /// linearized_at where the essential coordinates are at rest, in a fraction of the time. Their rates are no
    /// unknowns in it.
    SteadySystem resting_system(const Instant<long double>& at, const std::vector<long double>& given,
                                Rates rates) const;
    /// Sets to zero what equations of forces have of roundings alone: those of a force that nothing here changes.
    void leave_out_roundings(SteadySystem& system) const;
    /// Whether coordinates and rates are so small that a part of the scales, or of a rate 1, is more than a
    /// rounding of theirs. They are not where Newton's method has gone to infinity: the given x' of a blade that
    /// stands across x.
    bool is_resolved(const Instant<long double>& at) const;
    /// The largest residual, relative to the sum of the effects of all unknowns.
    long double unbalanced(const SteadySystem& here) const;
    /// The size of an ordinary change of an unknown.
    long double scale_of(const SteadySystem& here, Eigen::Index unknown) const;

    const Mechanism& mechanism_;
    const Equations& equations_;
    Residuals residuals_;
    std::optional<Residuals> at_rest_;  ///< with the rates 0 that Newton's method leaves at 0
    Instant<long double> start_;
    std::vector<bool> essential_, follows_q_, follows_u_;
    std::vector<long double> scales_;
    std::vector<MovingState> states_;
    MatrixOf<long double> kept_speeds_;
    MatrixOf<long double> kept_states_;  ///< the rows of first-order states without a rate, which nothing moves
};

/// The state that Newton's method reaches from that of `start`, as a user would type it: {"theta", "0"}; empty if
/// it reaches none.
std::vector<std::pair<std::string, std::string>> steady_nearby(const Mechanism& mechanism,
                                                               const Equations& equations, const Start& start);

}  // namespace alembert
