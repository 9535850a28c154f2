// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/exact/solve_together.hpp"

#include "analysis/exact/real_values.hpp"

namespace alembert {

using GiNaC::numeric;

std::optional<std::vector<numeric>> solve_together(const NumericConditions& conditions, std::vector<numeric> x,
                                                   double reach) {
    const auto as_float = [](const numeric& value) { return GiNaC::ex_to<numeric>(GiNaC::ex(value).evalf()); };
    const long digits = GiNaC::Digits;
    const numeric small = as_float(GiNaC::pow(numeric(10), numeric(-digits / 2)));
    const numeric smallest = GiNaC::pow(numeric(10), numeric(5 - digits));
    for (numeric& value : x) value = as_float(value);
    for (int round = 0; round < 60; ++round) {
        const auto f = conditions(x);
        if (!f) return std::nullopt;
        const std::size_t rows = f->size();
        std::vector<std::vector<numeric>> slopes;  // for each unknown
        for (numeric& value : x) {
            const numeric here = value;
            value += small;
            auto moved = conditions(x);
            value = here;
            if (!moved) return std::nullopt;
            for (std::size_t k = 0; k < rows; ++k) (*moved)[k] = ((*moved)[k] - (*f)[k]) / small;
            slopes.push_back(std::move(*moved));
        }
        std::vector<std::vector<numeric>> normal(rows, std::vector<numeric>(rows + 1));
        for (std::size_t k = 0; k < rows; ++k) {
            normal[k][rows] = (*f)[k];
            for (std::size_t j = 0; j < rows; ++j)
                for (const std::vector<numeric>& slope : slopes) normal[k][j] += slope[k] * slope[j];
        }
        const auto weights = solve_rows(std::move(normal), rows);
        if (!weights) return std::nullopt;
        numeric length = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            numeric step = 0;
            for (std::size_t k = 0; k < rows; ++k) step += slopes[i][k] * (*weights)[k];
            x[i] -= step;
            length += GiNaC::abs(step);
        }
        if (length.to_double() > reach) return std::nullopt;
        if (length < smallest) return x;
    }
    return std::nullopt;
}

}  // namespace alembert
