// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/any_motion.hpp"

namespace alembert {

Equations any_motion(Equations e, const Mechanism& m) {
    for (int i = 0; i < e.size(); ++i) {
        const auto row = static_cast<unsigned>(i);
        for (unsigned j = 0; j < e.M.cols(); ++j) e.M(row, j) = row == j ? 1 : 0;
        e.own[i] = m.qddot[i];
        e.dissipative[i] = 0;
        e.applied[i] = 0;
    }
    return e;
}

}  // namespace alembert
