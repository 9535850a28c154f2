// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/held_functions.hpp"

#include <algorithm>
#include <utility>

#include "algebra/symbolic/unspecified.hpp"

namespace alembert {

using GiNaC::ex;

namespace {

bool is_value_of_function(const ex& e) {
    const auto call = unspecified_call(e);
    return call && std::all_of(call->orders.begin(), call->orders.end(), [](int order) { return order == 0; });
}

/// The call's symbol and its value, if the position is a·f(…) + b with a number a and parameters in b.
std::optional<std::pair<GiNaC::symbol, ex>> held_by(const ex& position, const Mechanism& m) {
    const auto entry_of = [&](const ex& e) {
        return GiNaC::is_a<GiNaC::symbol>(e) ? m.z->find(GiNaC::ex_to<GiNaC::symbol>(e)) : nullptr;
    };
    ex sum = position;
    if (const auto* entry = entry_of(sum); entry != nullptr && !is_value_of_function(entry->definition))
        sum = entry->definition.expand();
    const std::size_t terms = GiNaC::is_a<GiNaC::add>(sum) ? sum.nops() : 1;
    for (std::size_t k = 0; k < terms; ++k) {
        const ex term = GiNaC::is_a<GiNaC::add>(sum) ? sum.op(k) : sum;
        const bool is_scaled = GiNaC::is_a<GiNaC::mul>(term) && term.nops() == 2;
        const ex number = is_scaled ? term.op(1) : ex(1), symbol = is_scaled ? term.op(0) : term;
        const auto* entry = entry_of(symbol);
        if (entry == nullptr || !is_value_of_function(entry->definition) || !GiNaC::is_a<GiNaC::numeric>(number))
            continue;
        const ex rest = (sum - term).expand();
        for (const GiNaC::symbol& s : m.symbols->all())
            if (rest.has(s) && m.symbols->info(s).kind != SymbolInfo::Kind::parameter) return std::nullopt;
        return std::pair(entry->symbol, ex(-rest / number));
    }
    return std::nullopt;
}

}  // namespace

std::vector<std::pair<GiNaC::symbol, ex>> held_functions(const Mechanism& m) {
    std::vector<std::pair<GiNaC::symbol, ex>> result;
    if (m.symbols->functions().empty()) return result;
    for (const Mechanism::Constraint& c : m.constraints)
        if (c.position)
            if (auto held = held_by(*c.position, m)) result.push_back(*std::move(held));
    return result;
}

}  // namespace alembert
