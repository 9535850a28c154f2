// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Mechanisms of textbooks as T, V and Q, with Lagrange's equations straight from GiNaC's `diff`.

#include <functional>
#include <string>
#include <vector>

#include "algebra/symbolic/symbols.hpp"

namespace alembert::test {

struct Mechanics {
    Symbols symbols;
    std::vector<GiNaC::symbol> q, qdot, qddot;
    GiNaC::ex T, V, R;         ///< R: Rayleigh's function
    std::vector<GiNaC::ex> Q;  ///< applied; empty for none
    GiNaC::symbol time;

    Mechanics();
    GiNaC::symbol parameter(const std::string& name);
    GiNaC::symbol input(const std::string& name);
    /// Declares q, q', q'' for each name.
    void coordinates(const std::vector<std::string>& names);

    /// d/dt f, for f of coordinates, rates and time.
    GiNaC::ex dot(const GiNaC::ex& f) const;
    /// d/dt ∂L/∂q'ᵢ − ∂L/∂qᵢ + ∂R/∂q'ᵢ
    GiNaC::ex residual(int i) const;
    GiNaC::ex applied(int i) const { return Q.empty() ? GiNaC::ex(0) : Q[static_cast<std::size_t>(i)]; }
};

struct NamedCase {
    std::string name;
    std::function<void(Mechanics&)> build;
};

const std::vector<NamedCase>& mechanisms();

}  // namespace alembert::test
