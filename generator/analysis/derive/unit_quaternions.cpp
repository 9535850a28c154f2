// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/derive/unit_quaternions.hpp"

#include "model/formalism/elements.hpp"

namespace alembert {

using GiNaC::ex;

UnitQuaternions::UnitQuaternions(const Mechanism& m) : m_(m) {
    std::vector<ex> squares;
    for (const Mechanism::Constraint& c : m.constraints)
        if (c.norm) squares.push_back(m.z->expand(*c.position) + 1);
    if (squares.empty()) return;
    for (const Intermediates::Entry& entry : m.z->entries())
        for (const ex& square : squares)
            if (entry.definition.is_equal(square)) one_[entry.symbol] = 1;
}

ex UnitQuaternions::operator()(const ex& e) const {
    return any() ? substitute(*m_.z, {e}, one_).front() : e;
}

Equations UnitQuaternions::operator()(Equations equations) const {
    if (!any()) return equations;
    std::vector<ex> all;
    const auto each = [&](const auto& visit) {
        for (unsigned i = 0; i < equations.M.rows(); ++i)
            for (unsigned j = 0; j < equations.M.cols(); ++j) visit(equations.M(i, j));
        for (auto* list :
             {&equations.own, &equations.dissipative, &equations.applied, &equations.h, &equations.gamma})
            for (ex& value : *list) visit(value);
        for (auto& row : equations.A)
            for (ex& value : row) visit(value);
    };
    each([&](const ex& value) { all.push_back(value); });
    const std::vector<ex> shorter = substitute(*m_.z, all, one_);
    std::size_t next = 0;
    each([&](ex& value) { value = shorter[next++]; });
    return equations;
}

}  // namespace alembert
