// SPDX-License-Identifier: GPL-2.0-or-later
// Every intermediate symbol stands for one function of atoms or for a polynomial in atoms
// (algebra/symbolic/intermediates.hpp). One that is linear in t is a phase; the sine or cosine of a phase is
// periodic, and whatever else holds a phase is not.
#include "stability/own_period.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "model/parameter_values.hpp"

namespace alembert {

namespace {

using GiNaC::ex;

constexpr long most_turns = 64;       // of one frequency within the period
constexpr double same_ratio = 1e-12;  // of frequencies, relative

class Frequencies {
public:
    Frequencies(const Derived& d, const Start& start)
        : m_(d.mechanism), e_(d.equations), values_(d.mechanism, start.parameters) {
        for (const Mechanism::Parameter& p : m_.parameters) parameters_.insert(p.symbol);
        phases_[m_.t] = 1;
    }

    /// All frequencies in 1/s; nothing if t stands elsewhere than in sines and cosines.
    std::optional<std::vector<double>> all() {
        for (const Intermediates::Entry& entry : e_.z->entries()) look_at(entry.symbol, entry.definition);
        std::vector<ex> outside{e_.own};
        for (const auto* list : {&e_.dissipative, &e_.applied, &e_.gamma, &e_.h})
            outside.insert(outside.end(), list->begin(), list->end());
        for (const auto& row : e_.A) outside.insert(outside.end(), row.begin(), row.end());
        for (std::size_t k = 0; k < e_.M.nops(); ++k) outside.push_back(e_.M.op(k));
        for (const Mechanism::Input& input : m_.inputs) look_at({}, m_.z->expand(input.value));
        for (const ex& one : outside) look_at({}, one);
        if (!periodic_) return {};
        return found_;
    }

private:
    bool is_steady(const ex& e) const {
        for (GiNaC::const_preorder_iterator i = e.preorder_begin(); i != e.preorder_end(); ++i)
            if (GiNaC::is_a<GiNaC::symbol>(*i) && !parameters_.contains(*i)) return false;
        return true;
    }

    /// ∂/∂t through the phases.
    ex rate_of(const ex& e) const {
        ex rate = 0;
        for (const auto& [symbol, own] : phases_) rate += e.diff(GiNaC::ex_to<GiNaC::symbol>(symbol)) * own;
        return rate.expand();
    }

    /// Takes sines and cosines of phases out; what is left is looked at by the caller.
    ex without_waves(const ex& e) {
        if (GiNaC::is_a<GiNaC::function>(e)) {
            const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
            const ex rate = e.nops() == 1 && (name == "sin" || name == "cos") ? rate_of(e.op(0)) : ex(0);
            if (!rate.is_zero() && is_steady(rate)) {
                if (const double number = values_.number(rate); std::isfinite(number)) {
                    found_.push_back(std::abs(number));
                    return 1;
                }
            }
        }
        if (e.nops() == 0) return e;
        ex sum = 0;  // any combination in which a phase that is left shows
        for (const ex& part : e) sum += GiNaC::symbol() * without_waves(part);
        return sum;
    }

    bool has_phase(const ex& e) const {
        for (const auto& [symbol, rate] : phases_)
            if (e.has(symbol)) return true;
        return false;
    }

    void look_at(const std::optional<GiNaC::symbol>& symbol, const ex& definition) {
        if (!has_phase(definition)) return;
        const ex rate = rate_of(definition);
        if (symbol && !rate.is_zero() && is_steady(rate)) {
            phases_[*symbol] = rate;
            return;
        }
        if (has_phase(without_waves(definition))) periodic_ = false;
    }

    const Mechanism& m_;
    const Equations& e_;
    const ParameterValues values_;
    GiNaC::exset parameters_;
    std::map<ex, ex, GiNaC::ex_is_less> phases_;  ///< t, and what is linear in it, with its rate
    std::vector<double> found_;
    bool periodic_ = true;
};

}  // namespace

std::optional<double> own_period(const Derived& derived, const Start& start) {
    const auto frequencies = Frequencies(derived, start).all();
    if (!frequencies || frequencies->empty()) return {};
    const double first = frequencies->front();
    if (!(first > 0)) return {};
    for (long turns = 1; turns <= most_turns; ++turns) {
        const double period = 2 * std::numbers::pi * static_cast<double>(turns) / first;
        const auto fits = [&](double frequency) {
            const double count = frequency * period / (2 * std::numbers::pi);
            return std::abs(count - std::round(count)) <= same_ratio * std::max(1.0, count);
        };
        if (std::all_of(frequencies->begin(), frequencies->end(), fits)) return period;
    }
    return {};
}

}  // namespace alembert
