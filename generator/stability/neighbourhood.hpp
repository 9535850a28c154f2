// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene without constraints near a point, for functions of its state: series and expressions side by side.
///
///     const Neighbourhood near(local);
///     near.series(V), near.rate(near.series(V))       // V and dV/dt about the point
///     near.rate(V)                                    // dV/dt as an expression, where it is short
///
/// The variables are the coordinates that something depends on, then the speeds; dV/dt = Σ V_q h + V_u M⁻¹ f.

#include "stability/field.hpp"

namespace alembert {

class Neighbourhood {
public:
    /// `local` must outlive it and have no constraints. Throws NotAnalytic.
    explicit Neighbourhood(const Local& local);

    const Local& local;
    std::vector<GiNaC::symbol> states;
    Monomials monomials;

    int size() const { return static_cast<int>(states.size()); }
    Expansion series(const GiNaC::ex& in_rates) const;
    /// The time derivative along the motions.
    Expansion rate(const Expansion& of) const;
    /// In the states and the parameters, in lowest terms. Nothing where it is too long to be read.
    std::optional<GiNaC::ex> rate(const GiNaC::ex& in_rates) const;
    /// The same with the numbers of all parameters; nothing where one of them is not rational.
    std::optional<GiNaC::ex> with_numbers(const GiNaC::ex& e) const;
    /// Is `e` zero for all z where the states are point + Z z?
    bool vanishes_on(const GiNaC::ex& e, const CertainMatrix& Z) const;
    /// The value of an expression in numbers at the point.
    std::optional<Certain> value(const GiNaC::ex& e) const;

private:
    std::vector<int> variables_;
    std::vector<Expansion> field_;
};

}  // namespace alembert
