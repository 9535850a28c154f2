// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Expressions of the scene language as values in a mechanism that has been built: what claims and the like are
/// read with.
///
///     Formulas formulas(scene, mechanism);
///     const ex residual = formulas.value(claim.lhs) - formulas.value(claim.rhs);
///
/// Known are the names of the scene, multipliers, the momenta p_<coordinate> (∂L/∂q', Zhang & Qin §1.7) and what
/// `know` adds. Throws SceneMistake for a name that is none of these.

#include "model/places.hpp"

namespace alembert {

class Formulas {
public:
    /// `sheets`: those on which the mechanism was built, if it was.
    Formulas(const Scene& scene, const Mechanism& mechanism, std::shared_ptr<RootSheets> sheets = {});
    Formulas(const Formulas&) = delete;
    Formulas& operator=(const Formulas&) = delete;

    GiNaC::ex value(const Expression& expression) { return translator_.scalar(expression); }
    void know(const std::string& name, const GiNaC::ex& value) { translator_.know(name, value); }
    void has_no_derivative(const GiNaC::symbol& symbol) { translator_.has_no_derivative(symbol); }
    /// The frames and points of the scene.
    Places& places() { return places_; }

private:
    Translator translator_;
    Places places_;
};

}  // namespace alembert
