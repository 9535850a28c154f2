// SPDX-License-Identifier: MIT
#pragma once

/// Explicit Runge-Kutta methods as tables of numbers; explicit_rk.hpp turns them into code.
///
///     k_i = f(t + c_i h, y + h Σ_{j<i} a_ij k_j),  i < s;     y₁ = y + h Σ_j a_sj k_j;     k_s = f(t + h, y₁)
///
/// Row s of `a` holds the weights of the solution, so that k_s, the first stage of the next step, is a stage like
/// the others. The rows after it belong to dense output and are evaluated only in steps whose interior is needed.
///
/// Error estimate: one row e gives the vector h Σ_{j≤s} e_j k_j. Two rows give a fifth- and a third-order
/// estimate, which explicit_rk.hpp combines.
///
/// Dense output (Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed. 1993, §II.6), θ =
/// 0…1:
///
///     y(t + θh) = r₀ + θ(r₁ + (1−θ)(r₂ + θ(r₃ + (1−θ)(r₄ + θ(r₅ + …)))))
///     r₀ = y,  r₁ = y₁ − y,  r₂ = h k₀ − r₁,  r₃ = r₁ − h k_s − r₂,  r_{4+i} = h Σ_j d_ij k_j
///
/// Without rows d this is the cubic Hermite polynomial.
///
/// Sources: Runge 1895 for rk2 (the midpoint rule); Kutta 1901 for rk4; Dormand & Prince, J. Comp. Appl. Math. 6
/// (1980) 19-26 for dopri5, RK5(4)7M; its fourth-order continuous extension is Shampine's, as in Hairer, Nørsett,
/// Wanner, §II.6 and table II.5.2.

#include <array>

namespace alembert {

/// A method with s stages, `beyond` further stages for dense output, `estimates` rows of error weights and `dense`
/// rows d.
template <int s, int beyond, int estimates, int dense>
struct Tableau {
    static constexpr int stages = s;  ///< evaluations to get y₁, the first one included
    static constexpr int all_stages = s + 1 + beyond;
    static constexpr int error_rows = estimates;
    static constexpr int dense_rows = dense;
    using Row = std::array<double, all_stages>;

    int order;           ///< the order of y₁
    int dense_order;     ///< of the continuous extension: its error is O(h^(dense_order+1)) within a step
    int estimate_order;  ///< the error estimate is O(h^estimate_order); 0 for a fixed step
    std::array<double, all_stages> c;
    std::array<Row, all_stages> a;
    std::array<Row, estimates> e;
    std::array<Row, dense> d;
};

inline constexpr Tableau<1, 0, 0, 0> euler_tableau{
    .order = 1, .dense_order = 1, .estimate_order = 0, .c = {0, 1}, .a = {{{}, {1}}}, .e = {}, .d = {}};

/// The explicit midpoint rule.
inline constexpr Tableau<2, 0, 0, 0> rk2_tableau{.order = 2,
                                                 .dense_order = 3,
                                                 .estimate_order = 0,
                                                 .c = {0, 1. / 2, 1},
                                                 .a = {{{}, {1. / 2}, {0, 1}}},
                                                 .e = {},
                                                 .d = {}};

inline constexpr Tableau<4, 0, 0, 0> rk4_tableau{
    .order = 4,
    .dense_order = 3,
    .estimate_order = 0,
    .c = {0, 1. / 2, 1. / 2, 1, 1},
    .a = {{{}, {1. / 2}, {0, 1. / 2}, {0, 0, 1}, {1. / 6, 1. / 3, 1. / 3, 1. / 6}}},
    .e = {},
    .d = {}};

inline constexpr Tableau<6, 0, 1, 1> dopri5_tableau{
    .order = 5,
    .dense_order = 4,
    .estimate_order = 5,
    .c = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1},
    .a = {{{},
           {1. / 5},
           {3. / 40, 9. / 40},
           {44. / 45, -56. / 15, 32. / 9},
           {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
           {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
           {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}}},
    .e = {{{71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40}}},
    .d = {{{-12715105075. / 11282082432, 0, 87487479700. / 32700410799, -10690763975. / 1880347072,
            701980252875. / 199316789632, -1453857185. / 822651844, 69997945. / 29380423}}}};

}  // namespace alembert
