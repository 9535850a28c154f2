// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability/equilibrium/loads.hpp"

#include "algebra/symbolic/fourier.hpp"

namespace alembert {

using GiNaC::ex;

std::optional<std::vector<ex>> written_out_loads(const Mechanism& m) {
    constexpr double largest_tree = 2000;
    std::vector<ex> result = m.generalized_forces(false);
    const std::vector<ex> damping = m.generalized_forces(true);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const ex force = result[i] + damping[i];
        if (m.z->tree_size(force) > largest_tree) return std::nullopt;
        result[i] = m.z->expand(force);
    }
    return result;
}

bool have_potential(const std::vector<ex>& Q, const Mechanism& m) {
    for (int i = 0; i < m.size(); ++i)
        for (int j = 0; j < i; ++j) {
            const auto curl = fourier(Q[i].diff(m.q[j]) - Q[j].diff(m.q[i]), *m.symbols, 500);
            if (!curl || !is_zero(*curl)) return false;
        }
    return true;
}

}  // namespace alembert
