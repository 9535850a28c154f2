// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/inputs_in_time.hpp"

namespace alembert {

GiNaC::exmap inputs_in_time(const Mechanism& m) {
    GiNaC::exmap result;
    for (const Mechanism::Input& input : m.inputs) {
        GiNaC::ex value = m.z->expand(input.value);
        for (const GiNaC::symbol& derivative : input.derivative) {
            result[derivative] = value;
            value = value.diff(m.t);
        }
    }
    return result;
}

}  // namespace alembert
