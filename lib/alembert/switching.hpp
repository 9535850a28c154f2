// SPDX-License-Identifier: MIT
#pragma once

/// Motions whose right-hand side jumps or has kinks where functions g_k(t, y) change their signs: dry friction
/// −μN sign(v), |x|, the larger of two forces, inputs that are switched on.
///
///     y' = f(t, y, sign g_1, …, sign g_K)
///
/// f is smooth in t and y while the signs stay as they are. So every sign is replaced by a constant σ_k, each
/// piece of the motion is integrated as a smooth system, and it ends where some g_k is zero, located as events
/// are. With ġ± the rate of g_k just after, for σ_k = ±1, the motion goes on
///
///  - through the zero, where both have the same sign;
///  - along g_k = 0, where ġ₊ < 0 < ġ₋ (it slides along the jump; a block with dry friction sticks): there σ_k is
///    the number α between −1 and 1 for which ġ_k = 0 (Filippov, Differential Equations with Discontinuous
///    Righthand Sides, 1988, §4; for σ_k that enter linearly this is his convex combination), until |α|
///    reaches 1;
///  - to either side, where ġ₊ > 0 > ġ₋: the motion is then ambiguous, and the run fails with a message that names
///    the function.
///
/// Dry friction with a static coefficient above the kinetic one sticks until |α| reaches their quotient r ≥ 1
/// (`bounds`), and a contact with zero sliding velocity begins to slide only where sticking would need more.
///
/// If several functions are zero at once, all choices of sides are tried, and the consistent one is taken.

#include <functional>
#include <string>
#include <vector>

#include "alembert/integrate.hpp"

namespace alembert {

/// A change of one of the signs.
struct SideChange {
    enum class Kind { crossing, sliding, leaving };
    double time = 0;
    int index = 0;
    Kind kind = Kind::crossing;
    int side = 0;  ///< the sign after it; 0: the function slides along its zero
};

struct Switching {
    std::vector<std::string> names = {};  ///< the names of the g_k, for messages
    /// f for given σ, each between −1 and 1.
    std::function<void(double t, const double* y, const double* sigma, double* rate)> rates = {};
    /// The right-hand side for one fixed σ, with what methods need besides (series, Jacobian).
    std::function<Rhs(const std::vector<double>& sigma)> smooth = {};
    /// K numbers g_k, then K numbers ġ_k for the y' given.
    std::function<void(double t, const double* y, const double* sigma, const double* rate, double* out)> values =
        {};
    /// K bounds r_k ≥ 1 of |α_k|, then K numbers that must not become negative (normal forces; 1 where there is
    /// none). May be empty; then all are 1.
    std::function<void(double t, const double* y, const double* sigma, const double* rate, double* out)> bounds =
        {};
    /// The message if the k-th of the latter numbers is negative. Required together with `bounds`.
    std::function<std::string(int k, double t, const double* y)> refusal = {};
    std::function<void(const SideChange&)> on_change = {};  ///< may be empty
    std::function<void(const std::vector<double>& sigma)> before_step =
        {};  ///< called with σ before on_step; may be empty

    int count() const { return static_cast<int>(names.size()); }
};

/// Like integrate(rhs, …). If a function has no consistent side, or more than one, the run fails with
/// FailureKind::no_side. While the motion slides, verner98 replaces the method taylor.
Trajectory integrate(const Switching& system, const std::vector<double>& initial, const Options& options,
                     const Events& events = {});

/// σ at a state whose sides are known, with side 0 for functions at their zero. Where it is consistent these
/// slide, with their α; otherwise they have the sign that g takes according to its rate.
std::vector<double> consistent_signs(const Switching& system, std::vector<int> sides, double t, const double* y,
                                     int dimension);

}  // namespace alembert
