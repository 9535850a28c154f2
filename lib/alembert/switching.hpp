// SPDX-License-Identifier: MIT
#pragma once

/// Motions whose right-hand side jumps or has kinks where functions g_k(t, y) change their signs: dry friction
/// −μN sign(v), |x|, the larger of two forces, inputs that are switched on.
///
///     y' = f(t, y, sign g_1, …, sign g_K)
///
/// f is smooth in t and y while the signs stay as they are. So every sign becomes a number σ_k that is held, each
/// piece of the motion is integrated as a smooth system, and it ends where some g_k is zero, located as events
/// are. With ġ± the rate of g_k just after, for σ_k = ±1, the motion goes on
///
///  - through the zero, where both have one sign;
///  - along g_k = 0, where ġ₊ < 0 < ġ₋ (it slides along the jump; a block with dry friction sticks): there σ_k is
///    the number α between −1 and 1 for which ġ_k = 0 (Filippov, Differential Equations with Discontinuous
///    Righthand Sides, 1988, §4; for σ_k that enter linearly this is his convex combination), until |α| comes to
///    1;
///  - to either side, where ġ₊ > 0 > ġ₋: that is ambiguous, and a failure that names the function.
///
/// Dry friction with a static coefficient above the kinetic one sticks until |α| comes to their quotient r ≥ 1
/// (`bounds`), and what is on its zero slides only where sticking would take more.
///
/// Several zeros at once: all choices of sides are tried, and the one that is consistent is taken.

#include <functional>
#include <string>
#include <vector>

#include "alembert/integrate.hpp"

namespace alembert {

/// What happened to one of the signs.
struct SideChange {
    enum class Kind { crossing, sliding, leaving };
    double time = 0;
    int index = 0;
    Kind kind = Kind::crossing;
    int side = 0;  ///< the sign after it; 0: slides
};

struct Switching {
    std::vector<std::string> names = {};  ///< of the g_k, for messages
    /// f for given σ, each from −1 to 1.
    std::function<void(double t, const double* y, const double* sigma, double* rate)> rates = {};
    /// The same for one σ, with what methods need beside it (series, Jacobian).
    std::function<Rhs(const std::vector<double>& sigma)> smooth = {};
    /// K numbers g_k, then K numbers ġ_k for the y' given.
    std::function<void(double t, const double* y, const double* sigma, const double* rate, double* out)> values =
        {};
    /// K bounds r_k ≥ 1 of |α_k|, then K numbers that must not become negative (normal forces; 1 where there is
    /// none). May be empty: all are 1.
    std::function<void(double t, const double* y, const double* sigma, const double* rate, double* out)> bounds =
        {};
    /// The message where the latter of k is negative. Needed with `bounds`.
    std::function<std::string(int k, double t, const double* y)> refusal = {};
    std::function<void(const SideChange&)> on_change = {};  ///< may be empty
    std::function<void(const std::vector<double>& sigma)> before_step =
        {};  ///< told σ before on_step; may be empty

    int count() const { return static_cast<int>(names.size()); }
};

/// As integrate(rhs, …). What has no consistent side, or more than one, is FailureKind::no_side. The method taylor
/// gives way to verner98 while the motion slides.
Trajectory integrate(const Switching& system, const std::vector<double>& initial, const Options& options,
                     const Events& events = {});

/// σ at a state whose sides are known, 0 for those on their zero: these slide, with their α, where that is
/// consistent; else they have the sign that their g takes by its rate.
std::vector<double> consistent_signs(const Switching& system, std::vector<int> sides, double t, const double* y,
                                     int dimension);

}  // namespace alembert
