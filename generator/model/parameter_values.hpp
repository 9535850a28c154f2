// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The values of expressions in parameters, at the scene's own values.
///
/// They are computed in floating point, each parameter once from those that it uses, because exact values of
/// chained powers would grow without bound.

#include <cmath>

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

    /// The expression itself where it has a pole, or a number beyond the range of CLN.
    GiNaC::ex in_numbers(const GiNaC::ex& e) const {
        try {
            return e.subs(known_, GiNaC::subs_options::no_pattern).evalf();
        } catch (const std::exception&) {
            return e;
        }
    }

    GiNaC::exmap known_;
};

}  // namespace alembert
