// SPDX-License-Identifier: GPL-2.0-or-later
#include "formalism/formalisms.hpp"

#include <fmt/format.h>

#include "formalism/dalembert.hpp"
#include "formalism/hamilton.hpp"
#include "formalism/kane.hpp"
#include "formalism/lagrange.hpp"
#include "formalism/lagrange1.hpp"
#include "formalism/nielsen.hpp"
#include "formalism/recursive.hpp"
#include "formalism/routh.hpp"
#include "formalism/roberson_wittenburg.hpp"
#include "formalism/routhian.hpp"
#include "formalism/schiehlen.hpp"

namespace alembert {

const std::vector<Formalism>& formalisms() {
    static const std::vector<Formalism> all{
        {"lagrange", "Lagrange's equations of the second kind", lagrange},
        {"lagrange1", "Lagrange's equations of the first kind", lagrange1},
        {"routh", "Routh's equations with multipliers", routh},
        {"kane", "Kane's equations", kane},
        {"dalembert", "the general equation of dynamics", dalembert},
        {"nielsen", "Nielsen's equations", nielsen},
        {"schiehlen", "Schiehlen's equations: Newton-Euler, projected", schiehlen},
        {"roberson-wittenburg", "Roberson and Wittenburg's equations", roberson_wittenburg},
        {"hamilton", "Hamilton's equations, the momenta eliminated", hamilton},
        {"recursive", "the recursive equations from body to body", recursive},
        {"routhian", "Routh's procedure, the momenta eliminated", routhian},
    };
    return all;
}

const Formalism& formalism(const std::string& name) {
    std::string known;
    for (const Formalism& f : formalisms()) {
        if (f.name == name) return f;
        known += (known.empty() ? "" : ", ") + f.name;
    }
    throw ModelError(fmt::format("--by {}: this formalism is not supported yet; expected one of: {}", name, known));
}

}  // namespace alembert
