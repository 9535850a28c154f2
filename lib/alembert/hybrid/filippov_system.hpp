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
///    reaches 1. Where g_k depends on positions alone and stands still, as where a mass rests in a groove |x|, σ_k
///    changes g̈_k only, which takes the place of ġ_k in all of this;
///  - to either side, where ġ₊ > 0 > ġ₋: the motion is then ambiguous, and the run fails with a message that names
///    the function.
///
/// Dry friction with a static coefficient above the kinetic one sticks until |α| reaches their quotient r ≥ 1
/// (`bounds`), and a contact with zero sliding velocity begins to slide only where sticking would need more.
///
/// A function whose sign changes nothing where it is zero, and which stays there, is followed with σ = 0 until it
/// leaves its zero by more than errors of the tolerance. Where rates tell nothing of such functions, a short trial
/// of the motion does (continuous_sides.hpp).
///
/// If several functions are zero at once, all choices of sides are tried, and the consistent one is taken.
///
/// Dry friction in a plane acts against the direction of a sliding velocity v of two components, with a force in
/// a cone: the two are functions g of the list, a pair. While the contact sticks both are zero and have numbers
/// α_1 and α_2, with |α| ≤ r. While it slides, the system calculates the direction of v itself. The direction
/// changes smoothly as v passes through zero along a unit vector e,
///
///     (e + ρ e⊥)/√(1 + ρ²),   ρ = w·e⊥/w·e,   w = v + δ e,
///
/// so that a piece can end exactly at v = 0; e is chosen anew where v has turned by 60° from it. The small δ gives
/// a direction to a contact that begins to slide: that d for which v' = r d with r > 0. Where r = 0, as with equal
/// coefficients, the direction follows the load at a rate like 1/|v|, which δ bounds; it is dropped as soon as |v|
/// is a thousand times larger. With δ = ε^(2/3) V for the tolerance ε and the size V of sliding velocities the
/// error in position is about ε of the distances that go with V.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "alembert/ode/integrate.hpp"

namespace alembert {

/// A change of one of the signs.
struct ModeChange {
    enum class Kind { crossing, sliding, leaving };
    double time = 0;
    int index = 0;
    Kind kind = Kind::crossing;
    int side = 0;  ///< the sign after it; 0: the function slides along its zero
    /// For a pair that begins to slide in a plane (`side` is then 1) its direction.
    std::array<double, 2> direction = {0, 0};
};

/// The sides of all functions: the sign of each, 0 if it slides along its zero. A pair has the sides 0, 0 while it
/// sticks and 1, 1 while it slides in its plane.
struct FilippovMode {
    std::vector<int> of = {};
    struct Slide {
        double along = 1, across = 0;  ///< e, a unit vector
        double smoothing = 0;          ///< δ
    };
    std::vector<Slide> slides = {};  ///< of the pairs
    /// For functions that are zero without having to be kept there, because their signs change nothing where they
    /// are zero, as that of N v in |N v| with N = 0: the size up to which they count as zero. 0, or nothing, for
    /// all others.
    std::vector<double> idle_up_to = {};

    bool is_idle(std::size_t k) const { return k < idle_up_to.size() && idle_up_to[k] > 0 && of[k] == 0; }
    /// Whether a function is kept at its zero by its σ.
    bool slides_at_zero(std::size_t k) const { return of[k] == 0 && !is_idle(k); }
    int& operator[](std::size_t k) { return of[k]; }
    int operator[](std::size_t k) const { return of[k]; }
    std::size_t size() const { return of.size(); }
    bool is_pair(int k) const { return k < 2 * static_cast<int>(slides.size()); }
};

struct FilippovSystem {
    std::vector<std::string> names = {};  ///< the names of the g_k, for messages
    /// The number of pairs; the pair c has the functions 2c and 2c + 1.
    int pairs = 0;
    /// The size of the sliding velocities of pairs, if it is known before the run; else 0.
    double speed = 0;
    /// f for given σ, each between −1 and 1. With pairs σ begins with two numbers for each: 0 and 1 while it
    /// sticks, 1 and δ while it slides; and its two functions have α_1, α_2 or e for their σ.
    std::function<void(double t, const double* y, const double* sigma, double* rate)> rates = {};
    /// The right-hand side for one fixed σ, with what methods need besides (series, Jacobian).
    std::function<Rhs(const std::vector<double>& sigma)> smooth = {};
    /// Which g_k depend on positions and time alone, so that σ_k changes g̈_k and not ġ_k; empty if none does.
    std::vector<bool> positional = {};
    /// K numbers g_k, then K numbers ġ_k for the y' given; then K numbers g̈_k if `positional` is not empty, of
    /// which those of other functions are not used.
    std::function<void(double t, const double* y, const double* sigma, const double* rate, double* out)> values =
        {};
    /// K bounds r_k ≥ 1 of |α_k| (of |α| at the first function of a pair), then K numbers that must not become
    /// negative (normal forces; 1 where there is none). May be empty; then all are 1.
    std::function<void(double t, const double* y, const double* sigma, const double* rate, double* out)> bounds =
        {};
    /// The message if the k-th of the latter numbers is negative. Required together with `bounds`.
    std::function<std::string(int k, double t, const double* y)> refusal = {};
    /// Why the motion cannot go on through the zero of g_k at this state, from the side where it is; nothing where
    /// it can. May be empty.
    std::function<std::optional<std::string>(int k, double t, const double* y, const double* rate)> obstacle = {};
    /// Bounds on the g_k, with the σ of the last call of `before_step`; may be empty.
    EventBounds bounds_of_functions = {};
    /// The events of the run that look at forces, whose values jump where a sign changes.
    std::vector<int> events_of_forces = {};
    std::function<void(const ModeChange&)> on_change = {};  ///< may be empty
    /// Called for each function that does not slide along its zero where an integration begins; may be empty.
    std::function<void(const ModeChange&)> on_begin = {};
    std::function<void(const std::vector<double>& sigma)> before_step =
        {};  ///< called with σ before on_step and before the events of the run; may be empty

    int count() const { return static_cast<int>(names.size()); }
    /// How many numbers `values` gives.
    std::size_t numbers() const { return names.size() * (positional.empty() ? 2 : 3); }
    bool is_positional(int k) const { return !positional.empty() && positional[static_cast<std::size_t>(k)]; }
    /// The position of the function k in σ.
    std::size_t place(int k) const { return static_cast<std::size_t>(2 * pairs + k); }
    /// The σ of these sides; for functions that slide along their zeros it is 0.
    std::vector<double> sigma(const FilippovMode& sides) const;
    /// No sides yet: all functions at the side +1.
    FilippovMode start() const;
};

/// Like integrate(rhs, …). If a function has no consistent side, or more than one, the run fails with
/// FailureKind::no_side. While the motion slides, verner98 replaces the method taylor.
Trajectory integrate(const FilippovSystem& system, const std::vector<double>& initial, const Options& options,
                     const Events& events = {});

/// The same with what all smooth pieces can do besides: `project`, `quick_times`, `on_method` and `by`.
Trajectory integrate(const FilippovSystem& system, const System& abilities, const std::vector<double>& initial,
                     const Options& options, const Events& events, const RunPiece& piece = {});

/// σ at a state of the motion, for evaluations after it. g_k counts as zero below `still` of k. Where it is
/// consistent such a function slides along its zero, with its α; otherwise it has the sign that g takes according
/// to its rate. `found` gets the sides with 0 for all zeros, if it is not null.
std::vector<double> consistent_signs(const FilippovSystem& system, const std::function<double(int k)>& still,
                                     double t, const double* y, int dimension, FilippovMode* found = nullptr);

}  // namespace alembert
