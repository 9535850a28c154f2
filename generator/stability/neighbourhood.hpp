// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// A scene near a point. Functions of its state are available as series, and without constraints as expressions.
///
///     const Neighbourhood near(local);
///     near.series(V), near.rate(near.series(V))       // V and dV/dt about the point
///     near.rate(V)                                    // dV/dt as an expression, where it is short
///
/// The variables are the independent coordinates on which something depends, then the independent speeds; all
/// others follow from the constraints. dV/dt = Σ ∂V/∂x_k f_k(x) with the field of field.hpp.

#include "stability/field.hpp"

namespace alembert {

class Neighbourhood {
public:
    /// `local` must outlive it. Throws NotAnalytic.
    explicit Neighbourhood(const Local& local);

    const Local& local;
    std::vector<GiNaC::symbol> states;
    Monomials monomials;

    int size() const { return static_cast<int>(states.size()); }
    Expansion series(const GiNaC::ex& in_rates) const;
    /// The time derivative along the motions.
    Expansion rate(const Expansion& of) const;
    /// The time derivative as an expression in the states and the parameters, in lowest terms. Nothing if it is
    /// too long to be read, and with constraints.
    std::optional<GiNaC::ex> rate(const GiNaC::ex& in_rates) const;
    /// The same with the values of all parameters inserted; nothing if one of them is not rational,
    /// and with constraints.
    std::optional<GiNaC::ex> with_numbers(const GiNaC::ex& e) const;
    /// Is `e` zero at the states point + Z z for all z?
    bool vanishes_on(const GiNaC::ex& e, const RealBallMatrix& Z) const;
    /// The value of an expression in numbers at the point.
    std::optional<RealBall> value(const GiNaC::ex& e) const;

private:
    State<Expansion> state_;
    std::vector<Expansion> field_;
};

}  // namespace alembert
