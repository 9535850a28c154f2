// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/bounded_factor.hpp"

#include <algorithm>
#include <set>

namespace alembert {

using GiNaC::ex;

namespace {

/// The bound on terms times symbols times the sum of the degrees, which takes about a tenth of a second.
constexpr double most_work = 4000;
constexpr int highest_degree = 12;

using SymbolSet = std::set<ex, GiNaC::ex_is_less>;

void gather(const ex& e, SymbolSet& symbols) {
    if (GiNaC::is_a<GiNaC::symbol>(e)) symbols.insert(e);
    for (const ex& part : e) gather(part, symbols);
}

bool is_small(const ex& sum, const SymbolSet& symbols) {
    int total = 0;
    for (const ex& symbol : symbols) {
        const int degree = sum.degree(symbol);
        if (degree > highest_degree) return false;
        total += degree;
    }
    return static_cast<double>(sum.nops()) * static_cast<double>(symbols.size()) * total <= most_work;
}

}  // namespace

ex factored(const ex& e) {
    if (GiNaC::is_a<GiNaC::mul>(e)) {
        GiNaC::exvector factors;
        for (const ex& factor : e) factors.push_back(factored(factor));
        return GiNaC::mul(std::move(factors));
    }
    if (GiNaC::is_a<GiNaC::power>(e)) return pow(factored(e.op(0)), e.op(1));
    if (!e.info(GiNaC::info_flags::rational_polynomial)) return e;
    const ex sum = e.expand();
    SymbolSet symbols;
    gather(sum, symbols);
    return is_small(sum, symbols) ? GiNaC::factor(sum) : e;
}

}  // namespace alembert
