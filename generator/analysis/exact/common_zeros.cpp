// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/common_zeros.hpp"

#include <algorithm>

namespace alembert {

namespace {

using Pair = std::array<PrimePolynomial, 2>;

Prime cleared(bool turned, Prime x, std::size_t degree) {
    return turned ? (x * x + 1).power(degree / 2) : Prime(1);
}

/// Conditions as polynomials in the second unknown.
class InSecond {
public:
    InSecond(const TwoConditions& conditions, const ZerosOptions& options, std::size_t degree)
        : conditions_(conditions), options_(options), degree_(degree), through_(points(options, degree)) {
        for (const Prime y : points(options, degree))
            second_.push_back({y, cleared(options.turned[1], y, degree)});
    }

    /// f(x, ·) and g(x, ·); nothing if their degree is higher than allowed.
    std::optional<Pair> operator()(Prime x) const {
        std::array<std::vector<Prime>, 2> values;
        const Prime first = cleared(options_.turned[0], x, degree_);
        for (const auto& [y, clears] : second_) {
            const auto at = conditions_(x, y);
            if (!at) return std::nullopt;
            for (std::size_t which = 0; which < 2; ++which) values[which].push_back((*at)[which] * first * clears);
        }
        Pair result{through_(std::move(values[0])), through_(std::move(values[1]))};
        if (result[0].size() > degree_ + 1 || result[1].size() > degree_ + 1) return std::nullopt;
        return result;
    }

private:
    static std::vector<Prime> points(const ZerosOptions& options, std::size_t degree) {
        const ModularPoint random{.seed = options.seed};
        std::vector<Prime> list;
        for (std::size_t k = 0; k < degree + 3; ++k) list.push_back(random.random(901, k));
        return list;
    }

    const TwoConditions& conditions_;
    const ZerosOptions& options_;
    std::size_t degree_;
    Interpolation<Prime> through_;
    std::vector<std::pair<Prime, Prime>> second_;  ///< y, and the power of 1 + y² that clears it
};

}  // namespace

CommonZeros common_zeros(const TwoConditions& conditions, const ZerosOptions& options) {
    const ModularPoint random{.seed = options.seed};
    for (const std::size_t degree : {2UL, 4UL, 8UL}) {
        const InSecond in_second(conditions, options, degree);
        const auto first = in_second(random.random(900, 0));
        if (!first) continue;
        const std::size_t highest = degree * ((*first)[0].size() + (*first)[1].size());
        std::vector<Prime> x, y;
        for (std::size_t k = 0; k < highest + 3; ++k) {
            x.push_back(random.random(900, k));
            const auto at = in_second(x.back());
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
            const auto at = in_second(root);
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
