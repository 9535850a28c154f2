// SPDX-License-Identifier: GPL-2.0-or-later
#include "symbolic/distance.hpp"

#include <algorithm>
#include <set>

namespace alembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;

namespace {

/// Whether `e` depends on a coordinate, a rate or time otherwise than through functions.
bool moves_as_polynomial(const ex& e, const Intermediates& z) {
    if (is_a<GiNaC::function>(e)) return false;
    if (!is_a<GiNaC::symbol>(e))
        return std::any_of(e.begin(), e.end(), [&](const ex& part) { return moves_as_polynomial(part, z); });
    const GiNaC::symbol& symbol = ex_to<GiNaC::symbol>(e);
    if (const Intermediates::Entry* const entry = z.find(symbol)) return moves_as_polynomial(entry->definition, z);
    using Kind = SymbolInfo::Kind;
    const Kind kind = z.symbols().info(symbol).kind;
    return kind == Kind::coordinate || kind == Kind::speed || kind == Kind::input || kind == Kind::time;
}

bool holds(const ex& e, const Intermediates& z, std::set<unsigned>& seen) {
    if (is_a<GiNaC::symbol>(e)) {
        const GiNaC::symbol& symbol = ex_to<GiNaC::symbol>(e);
        const Intermediates::Entry* const entry = z.find(symbol);
        return entry != nullptr && seen.insert(symbol.gethash()).second && holds(entry->definition, z, seen);
    }
    return is_distance_from_number(e, z) ||
           std::any_of(e.begin(), e.end(), [&](const ex& part) { return holds(part, z, seen); });
}

}  // namespace

bool is_distance_from_number(const ex& e, const Intermediates& z) {
    if (!is_a<GiNaC::add>(e)) return false;
    const auto is_number = [](const ex& term) { return term.info(GiNaC::info_flags::numeric); };
    return std::any_of(e.begin(), e.end(), is_number) && moves_as_polynomial(e, z);
}

bool holds_distance_from_number(const ex& e, const Intermediates& z) {
    std::set<unsigned> seen;
    return holds(e, z, seen);
}

}  // namespace alembert
