// SPDX-License-Identifier: GPL-2.0-or-later
#include "algebra/symbolic/distance.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace alembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;

namespace {

class Search {
public:
    explicit Search(const Intermediates& z) : z_(z) {}

    bool is_distance(const ex& e) {
        if (!is_a<GiNaC::add>(e)) return false;
        const auto is_number = [](const ex& term) { return term.info(GiNaC::info_flags::numeric); };
        return std::any_of(e.begin(), e.end(), is_number) && degree(e) == 1;
    }

    bool holds(const ex& e) {
        if (is_a<GiNaC::symbol>(e)) {
            const GiNaC::symbol& symbol = ex_to<GiNaC::symbol>(e);
            const Intermediates::Entry* const entry = z_.find(symbol);
            return entry != nullptr && seen_.insert(symbol.gethash()).second && holds(entry->definition);
        }
        return is_distance(e) || std::any_of(e.begin(), e.end(), [&](const ex& part) { return holds(part); });
    }

private:
    static constexpr int nonlinear = 2;  // this degree and all higher ones

    /// The degree in coordinates, rates and time outside of functions.
    int degree(const ex& e) {
        if (is_a<GiNaC::symbol>(e)) return degree_of(ex_to<GiNaC::symbol>(e));
        int result = 0;
        if (is_a<GiNaC::add>(e))
            for (const ex& part : e) result = std::max(result, degree(part));
        if (is_a<GiNaC::mul>(e))
            for (const ex& part : e) result += degree(part);
        if (is_a<GiNaC::power>(e)) result = degree(e.op(0)) == 0 ? 0 : nonlinear;
        return std::min(result, nonlinear);
    }

    int degree_of(const GiNaC::symbol& symbol) {
        if (const auto known = degrees_.find(symbol.gethash()); known != degrees_.end()) return known->second;
        using Kind = SymbolInfo::Kind;
        const Kind kind = z_.symbols().info(symbol).kind;
        const bool moves =
            kind == Kind::coordinate || kind == Kind::speed || kind == Kind::input || kind == Kind::time;
        const Intermediates::Entry* const entry = z_.find(symbol);
        return degrees_[symbol.gethash()] = entry != nullptr ? degree(entry->definition) : moves ? 1 : 0;
    }

    const Intermediates& z_;
    std::map<unsigned, int> degrees_;
    std::set<unsigned> seen_;
};

}  // namespace

bool is_distance_from_number(const ex& e, const Intermediates& z) {
    return Search(z).is_distance(e);
}

bool holds_distance_from_number(const ex& e, const Intermediates& z) {
    return Search(z).holds(e);
}

}  // namespace alembert
