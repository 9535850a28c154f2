// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Equilibria and steady motions as the roots of a system of equations, and Newton's method for them.
///
///     const SteadyProblem problem(mechanism, equations, start);
///     if (const auto root = problem.solve(problem.start())) root->at.q;        // obeys the constraints
///
/// In independent coordinates r and speeds w (linear/linearize.hpp), steady is
///     Uᵀ(f − M c) = 0,     r'_e = 0,     w_c = given,
/// e being the essential coordinates and c the cyclic ones, whose rates are given: those of the state from which
/// the search starts. With `Rates::free` the last equations are left out, and the rates follow from the others (a
/// rotor that a torque drives and friction brakes). The first equations are the forces left over at w' = 0, which
/// need no inertia: a pole of spherical coordinates is an equilibrium too.
///
/// Newton's method chooses the independent coordinates anew at each step, so that a constraint may turn through
/// any pose at which its rows are independent. Steps are of least length where the system does not determine them
/// (Gauss-Newton), and bounded. In long double.

#include <optional>

#include "linear/dependence.hpp"
#include "lower/start.hpp"

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
    long double residual = 0;  ///< largest force left over, of the sum of what each unknown may do
    long double step = 0;      ///< Newton's last step: what the root is known to, by scale
    bool isolated = true;      ///< false: the equations leave a direction free to first order
};

class SteadyProblem {
public:
    /// About the state of `start`. Throws ModelError where the equations change with time other than through
    /// inputs, IntegrationError where constraints or inertia are singular at this state and near it.
    SteadyProblem(const Mechanism& mechanism, const Equations& equations, const Start& start);

    const Residuals& residuals() const { return residuals_; }
    const Instant<long double>& start() const { return start_; }
    void set_start(Instant<long double> start) { start_ = std::move(start); }
    /// Of each coordinate: does the motion of any other depend on it?
    const std::vector<bool>& essential() const { return essential_; }
    /// Rows: combinations of all speeds that move cyclic coordinates only; their values are what is given.
    const MatrixOf<long double>& kept_speeds() const { return kept_speeds_; }
    /// The size of an ordinary change of each coordinate; 1 unless set.
    void set_scales(std::vector<long double> scales) { scales_ = std::move(scales); }
    const std::vector<long double>& scales() const { return scales_; }

    /// `given`: speeds of which the cyclic ones are kept. `at` must obey the constraints. `split`: null for the
    /// one that suits the state.
    SteadySystem linearized_at(const Instant<long double>& at, const std::vector<long double>& given,
                               Rates rates = Rates::given, const Split* split = nullptr) const;

    /// From a state, moved onto the constraints first; its cyclic rates are the given ones. Nothing where Newton's
    /// method does not converge.
    std::optional<SteadyRoot> solve(Instant<long double> from, Rates rates = Rates::given, int most = 60) const;

    /// Moves dependent coordinates and speeds until the constraints hold; false if they do not.
    bool settle_at(Instant<long double>& at, const Split* split = nullptr) const;

    /// The largest |element| of a change of coordinates, each by its scale.
    long double size(const VectorOf<long double>& change) const;

    /// The state as a start of the mechanism, with the rates that belong to the speeds.
    Start start_at(const Start& like, const Instant<long double>& at) const;

private:
    Split split_at(const Instant<long double>& at) const;

    const Mechanism& m_;
    Residuals residuals_;
    Instant<long double> start_;
    std::vector<bool> essential_, follows_q_, follows_u_;
    std::vector<long double> scales_;
    MatrixOf<long double> kept_speeds_;
};

/// The state that Newton's method reaches from that of `start`, as options: "--at theta=0"; empty where it reaches
/// none.
std::string steady_nearby(const Mechanism& mechanism, const Equations& equations, const Start& start);

}  // namespace alembert
