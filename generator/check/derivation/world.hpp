// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// The names that a line may hold, with their values: as they are in the system, or as a derivation states them.
///
///     World truth(system);
///     truth.know("x_1", truth.value("dot(pos(M1),ex(N))"));
///     truth.value("m1*x_1'^2/2")

#include <string>

#include "model/formulas.hpp"

namespace alembert {

class World {
public:
    World(const Scene& scene, const Mechanism& mechanism, std::shared_ptr<RootSheets> sheets)
        : m_(mechanism), formulas_(scene, mechanism, std::move(sheets)) {}

    void know(const std::string& name, const GiNaC::ex& value) { formulas_.know(name, value); }
    /// Throws NoMeaning for a text that has no value here.
    GiNaC::ex value(const std::string& text);
    GiNaC::ex value(const Expression& expression);

private:
    const Mechanism& m_;
    Formulas formulas_;
};

}  // namespace alembert
