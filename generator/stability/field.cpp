// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/field.hpp"

namespace alembert {

std::vector<Expansion> field(const Local& local, const std::vector<Expansion>& x) {
    const Residuals& r = local.residuals;
    const std::vector<int> held(static_cast<std::size_t>(r.n + r.s), -1);
    State<Expansion> state = local.state_at(local.point, nullptr, held);
    const std::size_t ne = local.essential.size(), p = local.split.u.size();
    for (std::size_t k = 0; k < ne; ++k) state.q[local.split.q[local.essential[k]]] = x[k];
    for (std::size_t j = 0; j < p; ++j) state.qdot[local.split.u[j]] = x[ne + j];
    const std::vector<Expansion> value = interpret(r.program, state);
    std::vector<std::vector<Expansion>> M(p, std::vector<Expansion>(p + 1));
    for (std::size_t i = 0, next = 0; i < p; ++i) {
        for (std::size_t j = 0; j <= i; ++j) M[i][j] = M[j][i] = value[r.mass[next++]];
        M[i][p] = value[r.forcing[i]];
    }
    for (std::size_t k = 0; k < p; ++k)  // a mass matrix needs no exchange of rows
        for (std::size_t i = 0; i < p; ++i) {
            if (i == k) continue;
            const Expansion factor = M[i][k] / M[k][k];
            for (std::size_t j = k; j <= p; ++j) M[i][j] = M[i][j] - factor * M[k][j];
        }
    std::vector<Expansion> result;
    for (std::size_t k = 0; k < ne; ++k) result.push_back(value[r.rate[local.split.q[local.essential[k]]]]);
    for (std::size_t k = 0; k < p; ++k) result.push_back(M[k][p] / M[k][k]);
    return result;
}

Certain state_value(const Local& local, std::size_t k) {
    const std::size_t ne = local.essential.size();
    return k < ne ? local.point.q[local.split.q[local.essential[k]]] : local.point.u[local.split.u[k - ne]];
}

}  // namespace alembert
