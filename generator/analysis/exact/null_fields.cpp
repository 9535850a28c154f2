// SPDX-License-Identifier: GPL-2.0-or-later
// Gauss-Jordan elimination with intermediate symbols and, in parallel, with numbers modulo the prime.
#include "analysis/exact/null_fields.hpp"

#include <algorithm>

namespace alembert {

using GiNaC::ex;

std::optional<NullFields> null_fields(std::vector<std::vector<ex>> rows,
                                      std::vector<std::vector<std::vector<Prime>>> values, Intermediates& z) {
    NullFields result;
    const std::size_t size = rows.empty() ? 0 : rows[0].size();
    const auto is_zero = [&](std::size_t r, std::size_t i) {
        return std::all_of(values.begin(), values.end(), [&](const auto& at) { return at[r][i].is_zero(); });
    };
    const auto pivot_of = [&](std::size_t r) {
        std::size_t best = size;
        for (std::size_t i = 0; i + 1 < size; ++i) {
            if (std::any_of(values.begin(), values.end(), [&](const auto& at) { return at[r][i].is_zero(); }))
                continue;
            if (best == size || z.tree_size(rows[r][i]) < z.tree_size(rows[r][best])) best = i;
        }
        return best;
    };
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const std::size_t column = pivot_of(r);
        if (column == size) return std::nullopt;
        result.pivots.push_back(column);
        for (std::size_t i = 0; i < size; ++i)
            if (i != column) rows[r][i] = is_zero(r, i) ? ex(0) : z.name(rows[r][i] / rows[r][column]);
        rows[r][column] = 1;
        for (auto& at : values) {
            const Prime scale = at[r][column].inverse();
            for (Prime& v : at[r]) v *= scale;
        }
        for (std::size_t s = 0; s < rows.size(); ++s) {
            if (s == r || is_zero(s, column)) continue;
            const ex factor = rows[s][column];
            for (auto& at : values) {
                const Prime f = at[s][column];
                for (std::size_t i = 0; i < size; ++i) at[s][i] -= f * at[r][i];
            }
            for (std::size_t i = 0; i < size; ++i) {
                if (i == column || is_zero(s, i))
                    rows[s][i] = 0;
                else if (!is_zero(r, i))
                    rows[s][i] = z.name(rows[s][i] - factor * rows[r][i]);
            }
        }
    }
    for (std::size_t f = 0; f < size; ++f) {
        if (std::find(result.pivots.begin(), result.pivots.end(), f) != result.pivots.end()) continue;
        std::vector<ex> field(size, 0);
        field[f] = 1;
        for (std::size_t r = 0; r < rows.size(); ++r) field[result.pivots[r]] = z.name(-rows[r][f]);
        result.fields.push_back(std::move(field));
    }
    return result;
}

}  // namespace alembert
