// SPDX-License-Identifier: MIT
#pragma once

/// How long a step the power series of a motion allows, by the sizes of its last terms.
///
///     const SeriesLength lengths(order, log_of_allowed);
///     const double h = lengths(size, most);            // the last two terms are as large as allowed there
///     if (!lengths.decays(h, size)) …                  // nothing in the series limits the step
///
/// `size(k)` gives the norm of coefficient k, and `most(first, end, ratio)` the largest of size(k) ratio^k with
/// first ≤ k < end. With a tolerance ε, the length is
///
///     h = min over j = p−1, p of (ε / size(j))^(1/j)
///
/// A series may lack most of its powers: a pendulum that is let go horizontally has t², t⁶, t¹⁰ … alone, and its
/// last two terms say nothing. So the six terms before them, with size(k)^(−1/k) for the radius of convergence,
/// shorten the step where they say that it is clearly shorter. Where a series converges everywhere, as that of a
/// fast rotation does, this radius grows with k: from what the first three of the six say, and what the others
/// say, it is continued to the last terms then.

#include <algorithm>
#include <cmath>

namespace alembert {

inline double whole_power(double x, int exponent) {
    double power = 1;
    for (; exponent > 0; exponent /= 2, x *= x)
        if (exponent % 2 == 1) power *= x;
    return power;
}

class SeriesLength {
public:
    static constexpr int most_terms = 6;  ///< that `most` is asked for

    /// ε as its logarithm.
    SeriesLength(int order, double log_allowed)
        : order_(order),
          log_allowed_(log_allowed),
          share_(std::exp(log_allowed / order)),
          first_(std::max(2, order - 7)) {}

    /// 0 if one of the last two terms is not finite.
    template <typename Size, typename Most>
    double operator()(const Size& size, const Most& most) const {
        double shortest = HUGE_VAL;  // as a logarithm
        for (const int k : {order_ - 1, order_}) {
            const double term = size(k);
            if (!(term < HUGE_VAL)) return 0;
            if (term > 0) shortest = std::min(shortest, (log_allowed_ - std::log(term)) / k);
        }
        const double length = std::exp(shortest), bound = clearly * length;
        if (!(most(first_, order_ - 1, bound / share_) > 1)) return length;
        const double other = share_ * std::exp(log_radius(size));
        return other < bound ? other : length;
    }

    /// Whether terms before the last ones are clearly larger than these are allowed to be, at the length that
    /// these allow: so they are where the series decays geometrically. Several are asked, because a series may
    /// lack powers.
    template <typename Most>
    bool decays(double length, const Most& most) const {
        constexpr double larger = 10;  // at usual orders geometric decay makes 25 within two terms
        return length < HUGE_VAL &&
               most(std::max(1, order_ - 7), order_ - 1, length) > larger * std::exp(log_allowed_);
    }

private:
    static constexpr double clearly = 0.85;  ///< less is made by neighbouring terms that differ in size alone

    /// By the six terms before the last two.
    template <typename Size>
    double log_radius(const Size& size) const {
        constexpr double ahead = 2.5 / 3;  // from the middle of the second three to that of the last two
        double least[2] = {HUGE_VAL, HUGE_VAL};
        for (int k = first_; k < order_ - 1; ++k)
            if (const double term = size(k); term > 0) {
                double& of_three = least[k < order_ - 4 ? 0 : 1];
                of_three = std::min(of_three, -std::log(term) / k);
            }
        if (least[0] < least[1] && least[1] < HUGE_VAL) return least[1] + ahead * (least[1] - least[0]);
        return std::min(least[0], least[1]);
    }

    int order_;
    double log_allowed_, share_;
    int first_;
};

}  // namespace alembert
