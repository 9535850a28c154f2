// SPDX-License-Identifier: GPL-2.0-or-later
#include "present/report/shown_unit.hpp"

namespace alembert {

Json si_units(const Mechanism& m) {
    Json units = Json::object();
    for (std::size_t k = 0; k < m.q.size(); ++k)
        if (!m.units[k].empty()) units[m.q[k].get_name()] = m.units[k];
    for (const Mechanism::Speed& speed : m.speeds)
        if (!speed.unit.empty()) units[speed.u.get_name()] = speed.unit;
    for (const Mechanism::State& z : m.states)
        if (!z.unit.empty()) units[z.derivative[0].get_name()] = z.unit;
    return units;
}

}  // namespace alembert
