// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/derive/abbreviations.hpp"

#include <algorithm>
#include <functional>

namespace alembert {

using GiNaC::ex;
using GiNaC::is_a;
using GiNaC::numeric;

namespace {

constexpr double largest_definition = 400;  // nodes

struct Power {
    ex sum;
    numeric power;
};

/// `e` as a sum to a rational power; nothing if it does not have this form.
std::optional<Power> power_of_sum(const ex& e) {
    if (is_a<GiNaC::add>(e)) return Power{e, 1};
    if (is_a<GiNaC::power>(e) && is_a<GiNaC::add>(e.op(0)) && is_a<numeric>(e.op(1)) &&
        GiNaC::ex_to<numeric>(e.op(1)).is_rational())
        return Power{e.op(0), GiNaC::ex_to<numeric>(e.op(1))};
    return std::nullopt;
}

/// The factor μ with a = μ b, if it is a product of parameters and numbers.
template <class IsSteady>
std::optional<ex> ratio(const ex& a, const ex& b, const IsSteady& is_steady) {
    if (a.nops() != b.nops()) return std::nullopt;
    for (std::size_t j = 0; j < b.nops(); ++j) {
        const ex factor = a.op(0) / b.op(j);
        if (is_steady(factor) && (a - factor * b).expand().is_zero()) return factor;
    }
    return std::nullopt;
}

class Renaming : public GiNaC::map_function {
public:
    explicit Renaming(std::function<ex(const ex&)> one) : one_(std::move(one)) {}
    ex operator()(const ex& e) override { return one_(e); }

private:
    std::function<ex(const ex&)> one_;
};

}  // namespace

Abbreviations::Abbreviations(const Mechanism& mechanism) : m_(mechanism) {
    int index = 0;
    for (const Mechanism::Definition& d : m_.definitions) {
        if (m_.z->tree_size(d.value) > largest_definition) continue;
        const ex value = m_.z->expand(d.value).expand();
        ex factor = 1;
        std::vector<Power> powers;
        const auto take = [&](const ex& part) {
            if (is_steady(part))
                factor *= part;
            else
                powers.push_back(power_of_sum(part).value_or(Power{part, 0}));
        };
        if (is_a<GiNaC::mul>(value))
            for (const ex& part : value) take(part);
        else
            take(value);
        if (powers.size() != 1 || powers[0].power.is_zero()) continue;
        list_.push_back({.name = m_.symbols->declare(d.name, SymbolInfo::Kind::definition, index++),
                         .value = value,
                         .factor = factor,
                         .sum = powers[0].sum.expand(),
                         .power = powers[0].power});
    }
}

bool Abbreviations::is_steady(const ex& e) const {
    if (is_a<GiNaC::symbol>(e))
        return m_.symbols->info(GiNaC::ex_to<GiNaC::symbol>(e)).kind == SymbolInfo::Kind::parameter;
    return std::all_of(e.begin(), e.end(), [this](const ex& part) { return is_steady(part); });
}

/// sum^power = μ^power · (name / factor)^(power / own power), for sum = μ · own sum.
std::optional<ex> Abbreviations::named(const ex& sum, const numeric& power) const {
    for (const Kept& kept : list_) {
        const auto mu = ratio(sum.expand(), kept.sum, [this](const ex& e) { return is_steady(e); });
        if (!mu) continue;
        const numeric exponent = power / kept.power;
        if (!power.is_integer() && !mu->is_equal(1)) continue;
        if (!exponent.is_integer() && !kept.factor.is_equal(1)) continue;
        return GiNaC::pow(*mu, power) * GiNaC::pow(kept.name / kept.factor, exponent);
    }
    return std::nullopt;
}

ex Abbreviations::operator()(const ex& e) const {
    Renaming rename([this](const ex& part) { return (*this)(part); });
    if (const auto found = power_of_sum(e))
        if (const auto shorter = named(found->sum, found->power)) return *shorter;
    return e.nops() == 0 ? e : e.map(rename);
}

}  // namespace alembert
