// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The Taylor coefficients of a motion, order by order: the power series in time of each node of a Program, from
/// those of its arguments.
///
///     const Recurrences series = recurrences(program);
///     series.nodes[7];          // sum: z_k = 2 x_k + Σ_j a_j b_(k−j)
///
/// With x_k the coefficient of order k of x, ⊗ the Cauchy product and x' the series j x_j (Jorba & Zou, A software
/// package for the numerical integration of ODEs by means of high-order Taylor methods, Experimental Math. 14
/// (2005), §2; Moore, Interval Analysis (1966), §11):
///
///     sum         z = Σ w x + Σ w a⊗b                               one accumulator for all its products
///     quotient    d⊗z = (numerator)                          no reciprocal is made where something is divided
///     root        z⊗z = a
///     power       k a_0 z_k = Σ_{j<k} (α(k−j) − j) a_{k−j} z_j
///     exponential k z_k = (a'⊗z)_k;  sine, cosine and the hyperbolic ones: k s_k = (a'⊗c)_k, k c_k = ∓(a'⊗s)_k
///     area        z' = a'·w: tan with w = 1 + z², tanh
///     ratio       z' = a'/w: log with w = a, atan with 1 + a², asin
///     turn        z' = (x y' − y x')/w: atan2
///
/// Accelerations are computed in one of two ways, whichever takes fewer Cauchy products: as the nodes that the
/// Program has for them, or coefficient by coefficient from M u' = f (and A u' = γ where there are multipliers),
/// with one factorization at order 0:
///
///     M_0 u'_k = f_k − Σ_{j≥1} M_j u'_{k−j}
///
/// Functions with a kink are an obstacle, because abs, sign, min and max have no series at the kink.

#include <optional>
#include <string>

#include "program/program.hpp"

namespace alembert {

/// A factor that does not change during a run: a number, multiplied by the node `constant` unless that is
/// negative.
struct Weight {
    Rational number = 1;
    int constant = -1;
};

struct SeriesNode {
    enum class Kind {
        time,
        coordinate,
        speed,
        work,
        unknown,  // given from outside; `index` tells which
        sum,
        residual,
        quotient,
        root,
        power,
        sine,
        cosine,
        hyperbolic_sine,
        hyperbolic_cosine,
        exponential,
        area,
        ratio,
        turn,
    };
    struct Linear {
        Weight weight;
        int node;
    };
    struct Bilinear {
        Weight weight;
        int a, b;
    };
    Kind kind = Kind::sum;
    int index = 0;
    std::vector<Weight> constants = {};   ///< for a sum or a numerator: terms at order 0 only
    std::vector<Linear> linear = {};      ///< likewise
    std::vector<Bilinear> bilinear = {};  ///< likewise
    std::vector<Bilinear> implied = {};   ///< for a residual: −M⊗u', without M_0 u'_k
    int a = -1, b = -1, w = -1;           ///< arguments; the divisor of a quotient is w
    Op op = Op::number;                   ///< for a ratio or an area: the function, for its value at order 0
    Weight exponent = {};
};

/// Entry of the matrix of the linear system: a node, or a constant.
struct SeriesEntry {
    int node = -1;
    Weight constant = {0, -1};
};

struct Recurrences {
    Program program;                    ///< with the constants to which the weights refer
    std::vector<SeriesNode> nodes;      ///< arguments come first, except `w` of an area
    std::vector<int> coordinate_rates;  ///< the node of each q', if the speeds are not the rates
    std::vector<int> accelerations;     ///< the node of each u'
    int work = -1;                      ///< the node of the power, if it is integrated
    std::vector<SeriesEntry> matrix;  ///< lower triangle of [M Aᵀ; A 0], empty if accelerations are ordinary nodes
    std::vector<int> residuals;       ///< one for each row
    std::vector<int> unknowns;        ///< one for each row: u', then −λ
    int solved_at = 0;                ///< nodes before this one precede the solution
    int preferred = 0;                ///< how many of the unknowns are accelerations

    /// The number of Cauchy products at each order; a square counts as half of one.
    double products() const;
};

/// The reason why a motion has no such series: it has no accelerations, or it contains a function without a
/// series. With `with_work` the power of loads is integrated together with the state.
std::optional<std::string> obstacle_to_recurrences(const Program& program, bool with_work = false);

/// Throws ModelError with the obstacle if there is one.
Recurrences recurrences(const Program& program, bool with_work = false);

}  // namespace alembert
