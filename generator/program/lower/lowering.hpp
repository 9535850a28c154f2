// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

/// Converts expressions to nodes of a program, each expression once.
///
///     Lowering lowering(program, mechanism, false);
///     lowering.lower_definitions({kinetic});      // the intermediate symbols that it is defined by
///     const int T = lowering(kinetic);

#include <map>
#include <vector>

#include "model/mechanism.hpp"
#include "program/program.hpp"

namespace alembert {

class Lowering {
public:
    Lowering(Program& program, const Mechanism& mechanism, bool fold)
        : program_(program), m_(mechanism), fold_(fold) {}

    int operator()(const GiNaC::ex& e);

    /// Sets the node of a symbol that is not one of the scene's, or of an expression wherever it occurs.
    int define(const GiNaC::ex& symbol, int node);

    /// Lowers the intermediate symbols one after the other, so that no recursion is deeper than a definition.
    void lower_definitions(const std::vector<GiNaC::ex>& roots);

private:
    int lowered(const GiNaC::ex& e);

    static Rational rational(const GiNaC::ex& e);
    int symbol(const GiNaC::symbol& s);
    int parameter(int index);

    /// The value of an expression in parameters at the scene's values, in double precision.
    Rational folded(const GiNaC::ex& e);
    int input(int index, int order);
    int state(int index, int order);

    Program& program_;
    const Mechanism& m_;
    bool fold_;
    std::map<GiNaC::ex, int, GiNaC::ex_is_less> known_;
};

}  // namespace alembert
