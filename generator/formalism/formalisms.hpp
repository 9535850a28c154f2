// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// All formalisms by their names in --by. Each throws ModelError, with the reason, for a scene that it does not apply to.

#include "formalism/equations.hpp"

namespace alembert {

struct Formalism {
    std::string name, title;  ///< "kane", "Kane's equations"
    Equations (*derive)(const Mechanism&);
};
const std::vector<Formalism>& formalisms();

/// Throws ModelError for a name that is none of them.
const Formalism& formalism(const std::string& name);

}  // namespace alembert
