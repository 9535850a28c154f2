// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The table of all formalisms, with one row for each.
///
///     const Formalism& kane = formalism("kane");
///     if (const auto reason = kane.obstacle(mechanism)) …   // it does not apply, and why
///     const Equations equations = kane.derive(mechanism);
///
/// To add a formalism, write its file and its row in formalisms.cpp; help, messages, `agree` and the tests follow
/// from the row.

#include "model/formalism/equations.hpp"
#include "model/formalism/steps.hpp"

namespace alembert {

struct Formalism {
    std::string name, title;  ///< "kane", "Kane's equations"
    /// The reason why it does not apply to a scene, or nothing if it applies.
    std::optional<std::string> (*obstacle)(const Mechanism&);
    /// Throws ModelError with the obstacle if there is one. The mechanism does not change; the intermediate
    /// symbols of the derivation are in the equations' own table, Equations::z.
    Equations (*derive)(const Mechanism&);
    /// The steps of its derivation, for equations of readable size and a mechanism in terms of the equations
    /// (`in_terms_of`). If null, it shows only the energies and forces that all formalisms show.
    OwnSteps (*steps)(const Mechanism&, const Equations&) = nullptr;
    /// Sections that it shows for equations of any size; may be null.
    std::vector<Section> (*outline)(const Mechanism&) = nullptr;
    bool independent = false;  ///< whether it needs independent coordinates
    /// Whether its steps end in first-order equations, which are shown instead of those of `derive`.
    bool in_momenta = false;
    std::string without_constraints =
        {};  ///< the formalism with which it is identical if there are no constraints
};
const std::vector<Formalism>& formalisms();

/// "lagrange, lagrange1, routh …"
std::string formalism_names();

/// Throws ModelError for a name that is none of them.
const Formalism& formalism(const std::string& name);

}  // namespace alembert
