// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/derive/euler_form.hpp"

#include <algorithm>

namespace alembert {

namespace {

using Kind = Phrase::Kind;

bool is_symbol(const Phrase& p, const Phrase& of) {
    return p.kind == Kind::symbol && p.symbol.is_equal(of.symbol);
}

bool is_difference(const Phrase& p) {
    return p.kind == Kind::sum && p.args.size() == 2 &&
           (p.args[0].kind == Kind::negative) != (p.args[1].kind == Kind::negative);
}

/// The position in the sum of the one term (P − Q)·first·second without further factors; −1 if there is none.
int gyroscopic_term(const Phrase& sum, const Phrase& first, const Phrase& second) {
    if (sum.kind != Kind::sum) return -1;
    for (std::size_t i = 0; i < sum.args.size(); ++i) {
        const Phrase& term = sum.args[i].kind == Kind::negative ? sum.args[i].args[0] : sum.args[i];
        if (term.kind != Kind::product || term.args.size() != 3) continue;
        const auto count = [&](const auto& test) {
            return std::count_if(term.args.begin(), term.args.end(), test);
        };
        if (count(is_difference) == 1 && count([&](const Phrase& p) { return is_symbol(p, first); }) == 1 &&
            count([&](const Phrase& p) { return is_symbol(p, second); }) == 1)
            return static_cast<int>(i);
    }
    return -1;
}

void rewrite(Phrase& term, const Phrase& first, const Phrase& second) {
    const bool is_negative = term.kind == Kind::negative;
    const Phrase product = is_negative ? term.args[0] : term;
    Phrase difference = *std::find_if(product.args.begin(), product.args.end(), is_difference);
    if (!is_negative) {
        // The term that had the minus now comes first.
        for (Phrase& arg : difference.args) arg = phrases::negative(arg);
        if (difference.args[0].kind == Kind::negative) std::swap(difference.args[0], difference.args[1]);
    }
    term = phrases::negative(phrases::product({std::move(difference), first, second}));
}

}  // namespace

void write_as_euler(std::vector<ReadableEquation>& equations, const std::vector<Phrase>& rows) {
    const std::size_t n = std::min(equations.size(), rows.size());
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = a + 1; b < n; ++b)
            for (std::size_t c = b + 1; c < n; ++c) {
                const std::size_t of[] = {a, b, c};
                int found[3], count = 0;
                for (int k = 0; k < 3; ++k) {
                    found[k] = gyroscopic_term(equations[of[k]].lhs, rows[of[(k + 1) % 3]], rows[of[(k + 2) % 3]]);
                    count += found[k] >= 0 ? 1 : 0;
                }
                for (int k = 0; count >= 2 && k < 3; ++k)
                    if (found[k] >= 0)
                        rewrite(equations[of[k]].lhs.args[static_cast<std::size_t>(found[k])],
                                rows[of[(k + 1) % 3]], rows[of[(k + 2) % 3]]);
            }
}

}  // namespace alembert
