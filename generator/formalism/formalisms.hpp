// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// All formalisms: one row each.
///
///     const Formalism& kane = formalism("kane");
///     if (const auto reason = kane.obstacle(mechanism)) …   // it does not apply, and why
///     const Equations equations = kane.derive(mechanism);
///
/// Whoever adds one writes its file and its row in formalisms.cpp; help, messages, `agree` and the tests follow
/// from the row.

#include "formalism/equations.hpp"
#include "formalism/steps.hpp"

namespace alembert {

struct Formalism {
    std::string name, title;  ///< "kane", "Kane's equations"
    /// Why it does not apply to a scene; nothing where it does.
    std::optional<std::string> (*obstacle)(const Mechanism&);
    /// Throws ModelError with the obstacle where there is one. The mechanism stays as it is; what the derivation
    /// names is in a table of the equations, Equations::z.
    Equations (*derive)(const Mechanism&);
    /// What it shows on its way, at readable size, from a mechanism in terms of the equations (`in_terms_of`);
    /// null: nothing but the energies and forces that all show.
    OwnSteps (*steps)(const Mechanism&, const Equations&) = nullptr;
    /// What it shows at any size; null: nothing.
    std::vector<Section> (*outline)(const Mechanism&) = nullptr;
    bool independent = false;  ///< it needs independent coordinates
    bool in_momenta = false;   ///< its steps end in first-order equations, which are shown instead of `derive`'s
    std::string without_constraints =
        {};  ///< the formalism that it is, word for word, where there are no constraints
};
const std::vector<Formalism>& formalisms();

/// "lagrange, lagrange1, routh …"
std::string formalism_names();

/// Throws ModelError for a name that is none of them.
const Formalism& formalism(const std::string& name);

}  // namespace alembert
