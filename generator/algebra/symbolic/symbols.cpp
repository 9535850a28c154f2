// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/symbols.hpp"

#include <stdexcept>

namespace alembert {

GiNaC::symbol Symbols::declare(std::string name, SymbolInfo::Kind kind, int index, int order) {
    const GiNaC::symbol symbol(name + std::string(static_cast<std::size_t>(order), '\''));
    const auto rank = static_cast<int>(by_rank_.size());
    position_.emplace(symbol.gethash(), by_rank_.size());
    by_rank_.push_back(symbol);
    if (kind == SymbolInfo::Kind::function) functions_.push_back(symbol);
    infos_.push_back({.name = std::move(name), .kind = kind, .index = index, .order = order, .rank = rank});
    return symbol;
}

GiNaC::symbol Symbols::declare_intermediate(int index) {
    const GiNaC::symbol result = declare("z" + std::to_string(index), SymbolInfo::Kind::other, index);
    infos_.back().intermediate = true;
    return result;
}

GiNaC::symbol Symbols::declare_rate_before(const GiNaC::symbol& coordinate) {
    const SymbolInfo of = info(coordinate);
    const GiNaC::symbol result = declare(of.name, SymbolInfo::Kind::other, of.index, 1);
    infos_.back().before = true;
    return result;
}

const SymbolInfo& Symbols::info(const GiNaC::symbol& symbol) const {
    const auto found = position_.find(symbol.gethash());
    if (found == position_.end())
        throw std::out_of_range("symbol '" + symbol.get_name() + "' is not of this scene");
    return infos_[found->second];
}

}  // namespace alembert
