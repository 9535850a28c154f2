// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The values of expressions in parameters, at the scene's own values.
///
/// They are computed in floating point, each parameter once from those that it uses, because exact values of
/// chained powers would grow without bound.

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/mechanism.hpp"

namespace alembert {

class ParameterValues {
public:
    explicit ParameterValues(const Mechanism& m) { add_parameters(m); }

    /// At other values of the independent parameters, which come in the order of Program.
    ParameterValues(const Mechanism& m, const std::vector<double>& independent) {
        std::size_t k = 0;
        for (const Mechanism::Parameter& p : m.parameters)
            if (p.independent) known_[p.symbol] = GiNaC::numeric(independent.at(k++));
        add_parameters(m);
    }

    /// Adds the state at the start, and what intermediate symbols are there; expressions in these are numbers
    /// then.
    void add_start(const Mechanism& m) {
        for (int i = 0; i < m.size(); ++i) {
            add(m.q[i], m.q_start[i]);
            add(m.qdot[i], m.qdot_start[i]);
        }
        add(m.t, m.run.start.value_or(0));
        for (const Intermediates::Entry& entry : m.z->entries()) add(entry.symbol, entry.definition);
    }

    /// NaN if `e` is not a real number, has a pole there or depends on more than parameters.
    double number(const GiNaC::ex& e) const {
        const GiNaC::ex value = in_numbers(e);
        if (!GiNaC::is_a<GiNaC::numeric>(value) || !GiNaC::ex_to<GiNaC::numeric>(value).is_real())
            return std::nan("");
        return GiNaC::ex_to<GiNaC::numeric>(value).to_double();
    }

private:
    void add_parameters(const Mechanism& m) {
        for (std::size_t round = 0; round <= m.parameters.size(); ++round)
            for (const Mechanism::Parameter& p : m.parameters)
                if (!known_.contains(p.symbol)) add(p.symbol, p.value);
    }

    void add(const GiNaC::symbol& symbol, const GiNaC::ex& e) {
        if (const GiNaC::ex value = in_numbers(e); GiNaC::is_a<GiNaC::numeric>(value)) known_[symbol] = value;
    }

    static bool is_exp(const GiNaC::ex& e) { return GiNaC::is_the_function<GiNaC::exp_SERIAL>(e); }
    static bool is_exponential(const GiNaC::ex& e) {
        return is_exp(e) || GiNaC::is_the_function<GiNaC::sinh_SERIAL>(e) ||
               GiNaC::is_the_function<GiNaC::cosh_SERIAL>(e);
    }
    static bool has_exponential(const GiNaC::ex& e) {
        return is_exponential(e) || std::any_of(e.begin(), e.end(), has_exponential);
    }

    /// Puts in the values. CLN takes exp(1e100) for 1, because the argument has too few digits to be reduced.
    class WithoutOverflow : public GiNaC::map_function {
    public:
        explicit WithoutOverflow(const GiNaC::exmap& known) : known_(known) {}

        GiNaC::ex operator()(const GiNaC::ex& e) override {
            if (const auto found = known_.find(e); found != known_.end()) return found->second;
            if (!is_exponential(e)) return e.map(*this);
            const GiNaC::ex argument = (*this)(e.op(0)).evalf();
            if (GiNaC::is_a<GiNaC::numeric>(argument) && GiNaC::ex_to<GiNaC::numeric>(argument).is_real()) {
                const double size = GiNaC::ex_to<GiNaC::numeric>(argument).to_double();
                if (std::abs(size) > 1e6 && is_exp(e) && size < 0) return 0;
                if (std::abs(size) > 1e6) throw std::overflow_error("beyond the range of double precision");
            }
            return e.map(*this);
        }

    private:
        const GiNaC::exmap& known_;
    };

    /// The expression itself where it has a pole, or a number beyond the range of CLN.
    GiNaC::ex in_numbers(const GiNaC::ex& e) const {
        try {
            if (has_exponential(e)) return WithoutOverflow(known_)(e).evalf();
            return e.subs(known_, GiNaC::subs_options::no_pattern).evalf();
        } catch (const std::exception&) {
            return e;
        }
    }

    GiNaC::exmap known_;
};

/// The independent ones whose values in the scene are positive.
inline std::vector<GiNaC::symbol> positive_parameters(const Mechanism& mechanism) {
    const ParameterValues values(mechanism);
    std::vector<GiNaC::symbol> result;
    for (const Mechanism::Parameter& p : mechanism.parameters)
        if (p.independent && values.number(p.symbol) > 0) result.push_back(p.symbol);
    return result;
}

}  // namespace alembert
