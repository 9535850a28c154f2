// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/common_zeros.hpp"

#include <algorithm>

namespace alembert {

namespace {

using Pair = std::array<PrimePolynomial, 2>;

Prime cleared(bool turned, Prime x, std::size_t degree) {
    return turned ? (x * x + 1).power(degree / 2) : Prime(1);
}

/// f(x, ·) and g(x, ·); nothing if their degree is higher than allowed.
std::optional<Pair> in_second(const TwoConditions& conditions, const ZerosOptions& options, Prime x,
                              std::size_t degree) {
    std::vector<Prime> y;
    std::array<std::vector<Prime>, 2> values;
    const ModularPoint random{.seed = options.seed};
    for (std::size_t k = 0; k < degree + 3; ++k) {
        y.push_back(random.random(901, k));
        const auto at = conditions(x, y.back());
        if (!at) return std::nullopt;
        for (std::size_t which = 0; which < 2; ++which)
            values[which].push_back((*at)[which] * cleared(options.turned[0], x, degree) *
                                    cleared(options.turned[1], y.back(), degree));
    }
    Pair result{interpolate(y, values[0]), interpolate(y, values[1])};
    if (result[0].size() > degree + 1 || result[1].size() > degree + 1) return std::nullopt;
    return result;
}

}  // namespace

CommonZeros common_zeros(const TwoConditions& conditions, const ZerosOptions& options) {
    const ModularPoint random{.seed = options.seed};
    for (const std::size_t degree : {2UL, 4UL, 8UL}) {
        const auto first = in_second(conditions, options, random.random(900, 0), degree);
        if (!first) continue;
        const std::size_t highest = degree * ((*first)[0].size() + (*first)[1].size());
        std::vector<Prime> x, y;
        for (std::size_t k = 0; k < highest + 3; ++k) {
            x.push_back(random.random(900, k));
            const auto at = in_second(conditions, options, x.back(), degree);
            if (!at) return {};
            y.push_back(resultant((*at)[0], (*at)[1]));
        }
        PrimePolynomial eliminated = interpolate(x, y);
        if (eliminated.size() > highest + 1) continue;
        const PrimePolynomial circle{1, 0, 1};  // the factor by which may have been multiplied too often
        while (options.turned[0] && eliminated.size() > 3 &&
               prime_polynomial::remainder(eliminated, circle).empty())
            eliminated = prime_polynomial::quotient(eliminated, circle);
        CommonZeros result;
        result.degree = eliminated.empty() ? 0 : eliminated.size() - 1;
        for (const Prime root : roots(eliminated, options.seed)) {
            const auto at = in_second(conditions, options, root, degree);
            if (!at) continue;
            for (const Prime other : roots(prime_polynomial::divisor((*at)[0], (*at)[1]), options.seed)) {
                const auto value = conditions(root, other);
                if (value && (*value)[0].is_zero() && (*value)[1].is_zero()) result.list.push_back({root, other});
            }
        }
        return result;
    }
    return {};
}

}  // namespace alembert
